//! The open-loop strategy: a time table drives the actuators until its end.
//!
//! *Source*: open-loop vehicle trials (Prestero 2001, chapter 6).
//!
//! *Parameters*: see [`crate::behave::TimeTable`].
//!
//! *Deviations*: none.

use super::about::About;
use super::setting::Setting;
use super::spec::{Strategy, StrategyParams};
use crate::behave::{Behave, Stride, TimeTable};
use crate::error::RobotError;
use crate::handoff::{Behaviour, Decision, Goal, Manoeuvre, Observation, Outcome, Vertical};
use crate::memory::PlumeMemory;
use world::catalogue::Entry;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters: the time table.
pub type OpenLoopSpec = crate::behave::TimeTableParams;

impl Listed for OpenLoopSpec {
    const ENTRY: Entry = Entry {
        name: "OpenLoop",
        what: "rudder, stern plane and propeller from a time table",
        source: "open-loop vehicle trials (Prestero 2001, chapter 6)",
    };
}

impl StrategyParams for OpenLoopSpec {
    fn build(&self, _: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(OpenLoop::new(self)?))
    }

    fn about(&self) -> About {
        About::no_search()
    }
}

/// State of the open-loop strategy.
#[derive(Debug)]
pub struct OpenLoop {
    table: TimeTable,
    memory: PlumeMemory,
    goal: Option<Goal>,
    over: bool,
}

impl OpenLoop {
    /// # Errors
    /// [`RobotError::Invalid`] if the table's times are not in order.
    pub fn new(spec: &OpenLoopSpec) -> Result<Self, RobotError> {
        Ok(Self { table: TimeTable::new(spec)?, memory: PlumeMemory::default(), goal: None, over: false })
    }
}

impl Strategy for OpenLoop {
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision {
        if self.goal.is_none() {
            self.table.enter(seen, &self.memory);
        }
        let stride = if self.over { Stride::Keep } else { self.table.step(seen, false, &mut self.memory, rng) };
        let last_id = self.goal.map_or(0, |g| g.id);
        match stride {
            Stride::Start(manoeuvre) | Stride::Adjust(manoeuvre) => {
                self.goal = Some(direct(last_id + 1, manoeuvre, seen));
            }
            Stride::Over => self.over = true,
            Stride::Keep => {}
        }
        let still = Manoeuvre::Direct { rudder_rad: 0.0, stern_rad: 0.0, rpm: 0.0 };
        let behaviour = if self.over { Behaviour::Done } else { Behaviour::OpenLoop };
        let goal = self.goal.unwrap_or_else(|| direct(0, still, seen));
        Decision { outcome: self.over.then_some(Outcome::Completed), ..Decision::new(behaviour, goal) }
    }
}

/// A direct goal; its depth and speed are the vehicle's present ones, and nothing uses them.
fn direct(id: u32, manoeuvre: Manoeuvre, seen: &Observation) -> Goal {
    Goal {
        id,
        manoeuvre,
        vertical: Vertical::Depth(seen.estimate.depth_m),
        speed_m_s: seen.estimate.v_ground_body.x.max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::TimeTableRow;
    use crate::handoff::testing::seen;
    use nalgebra::Vector2;
    use world::ranges::{Finite, NonNegative, Positive};

    /// The first tick comes at 100 s: the table counts from there. Before its first row the drives rest.
    #[test]
    fn one_goal_a_row_and_completed_at_the_end() {
        let row = |t_s, rudder_deg| TimeTableRow {
            t_s: NonNegative::new(t_s),
            rudder_deg: Finite::new(rudder_deg),
            stern_deg: Finite::new(0.0),
            rpm: Finite::new(1500.0),
        };
        let spec = OpenLoopSpec { table: vec![row(1.0, 0.0), row(3.0, 10.0)], end_s: Positive::new(5.0) };
        let mut s = OpenLoop::new(&spec).expect("legal");
        let mut rng = Stream::new(1, "auv0", "strategy");
        let mut step = |t_s| s.step(&seen(100.0 + t_s, Vector2::zeros(), 0.0, None), &mut rng);
        let first = step(0.0).goal.id;
        for (t_s, goal, rudder_deg, rpm) in [
            (0.98, 0, 0.0, 0.0),
            (1.0, 1, 0.0, 1500.0),
            (2.98, 1, 0.0, 1500.0),
            (3.0, 2, 10.0, 1500.0),
            (4.98, 2, 10.0, 1500.0),
        ] {
            let d = step(t_s);
            assert_eq!((d.behaviour, d.outcome, d.goal.id), (Behaviour::OpenLoop, None, first + goal), "{t_s}");
            let want = Manoeuvre::Direct { rudder_rad: f64::to_radians(rudder_deg), stern_rad: 0.0, rpm };
            assert_eq!(d.goal.manoeuvre, want, "{t_s}");
        }
        for t_s in [5.0, 6.0] {
            let end = step(t_s);
            assert_eq!((end.behaviour, end.outcome), (Behaviour::Done, Some(Outcome::Completed)), "{t_s}");
        }
    }
}
