//! Moves up-flow in the plume, a little to one side, and turns to the other side at each detection.
//!
//! *Source*: Pang 2009, section 5.3, Table 1 (after Li 2001).
//!
//! *Parameters*: λ, `lambda_s`, s, 5.0; β, `beta_deg`, °, 20: 0 goes straight up-flow (the surge of surge-cast).
//! `active`, true; false is the passive strategy of Li 2001: one side of up-flow until the plume is lost.
//!
//! *Deviations*: Table 1 compares ψ_v - ψ_f with 180 without wrapping. Here the rule asks whether the vehicle's
//! heading is left or right of up-flow. If it is left, LHS = +1 (the vehicle would leave the plume on its left) and
//! the course is up-flow + β; otherwise it is up-flow - β. Each detection thus turns the vehicle to the other side,
//! which is the counter-turn. LHS is set before the course, not after it, which saves a delay of one sample. As long
//! as no flow has been measured, the vehicle's heading stands for up-flow.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::{RobotError, require};
use crate::handoff::{Lcdp, Manoeuvre, Observation, Side, detects};
use crate::memory::PlumeMemory;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "CounterTurnParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// The plume counts as lost after this time without a detection, s.
    #[default(Positive::new(5.0))]
    pub lambda_s: Positive,
    /// Angle to up-flow, °, less than 90.
    #[default(NonNegative::new(20.0))]
    pub beta_deg: NonNegative,
    /// Whether each detection turns it to the other side (Li's active strategy); otherwise it keeps the side that it
    /// began with (his passive one).
    #[default(true)]
    pub active: bool,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "CounterTurn",
        what: "track in: up-flow turned by beta, to the other side at each detection",
        source: "Pang 2009, section 5.3, Table 1",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(CounterTurn::new(self)?))
    }
}

/// State of the behaviour.
#[derive(Clone, Debug)]
pub struct CounterTurn {
    lambda_s: f64,
    beta_rad: f64,
    active: bool,
    begun: bool,
    last: Lcdp,
}

impl CounterTurn {
    /// # Errors
    /// [`RobotError::Invalid`] if β does not lead up-flow.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        require(
            params.beta_deg.get() < 90.0,
            "track_in.CounterTurn.beta_deg",
            format!("must be < 90, got {}", params.beta_deg.get()),
        )?;
        Ok(Self {
            lambda_s: params.lambda_s.get(),
            beta_rad: params.beta_deg.get().to_radians(),
            active: params.active,
            begun: false,
            last: Lcdp::new_at(0.0, nalgebra::Vector2::zeros()),
        })
    }

    fn turn(&self, seen: &Observation, up_flow: Heading, memory: &mut PlumeMemory) -> Manoeuvre {
        let nose = Side::from_rightward(up_flow.turn_to(seen.estimate.attitude.heading));
        memory.leaves = nose;
        Manoeuvre::Course { course: up_flow.turned(nose.other().sign() * self.beta_rad) }
    }
}

impl Behave for CounterTurn {
    fn enter(&mut self, seen: &Observation, memory: &PlumeMemory) {
        self.begun = false;
        self.last = memory.last_detection.unwrap_or(Lcdp::here(seen));
    }

    fn step(&mut self, seen: &Observation, _: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        let up_flow = memory.up_flow_or_nose(seen);
        if detects(seen) {
            self.last = Lcdp::here(seen);
            if self.begun && !self.active {
                return Stride::Keep;
            }
        } else if seen.t_s - self.last.t_s > self.lambda_s {
            // Use the copy in the memory if there is one: a navigation fix may have moved it.
            let same = memory.last_detection.filter(|d| d.t_s == self.last.t_s);
            memory.lose(same.unwrap_or(self.last), up_flow);
            return Stride::Over;
        } else if self.begun {
            return Stride::Keep;
        }
        let course = self.turn(seen, up_flow, memory);
        if self.begun {
            Stride::Adjust(course)
        } else {
            self.begun = true;
            Stride::Start(course)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{course, memory, step, v};
    use crate::handoff::testing::{seen, smelling};

    #[test]
    fn turns_to_the_other_side_of_up_flow() {
        // Up-flow, nose, leaves on, course: all four ways round north.
        for (up, nose, leaves, want) in [
            (0.0, 350.0, Side::Left, 20.0),
            (0.0, 10.0, Side::Right, 340.0),
            (350.0, 5.0, Side::Right, 330.0),
            (10.0, 355.0, Side::Left, 30.0),
            (180.0, 170.0, Side::Left, 200.0),
            (180.0, 190.0, Side::Right, 160.0),
        ] {
            let (mut b, mut m) = (CounterTurn::new(&Params::default()).expect("legal"), memory(Some(up), &[]));
            let o = smelling(seen(1.0, v(0.0, 0.0), nose, None), true);
            b.enter(&o, &m);
            let s = step(&mut b, &o, false, &mut m);
            assert!(course(s).is_some_and(|c| (c - want).abs() < 1e-6), "up {up}, nose {nose}: {s:?}");
            assert_eq!(m.leaves, leaves);
        }
    }

    #[test]
    fn lost_after_lambda_at_the_last_detection() {
        let (mut b, mut m) = (CounterTurn::new(&Params::default()).expect("legal"), memory(Some(0.0), &[]));
        let at = |t: f64, smells| smelling(seen(t, v(0.0, t), 350.0, None), smells);
        b.enter(&at(0.0, true), &m);
        assert!(matches!(step(&mut b, &at(0.0, true), false, &mut m), Stride::Start(_)));
        assert!(matches!(step(&mut b, &at(2.0, true), false, &mut m), Stride::Adjust(_)));
        assert_eq!(step(&mut b, &at(3.0, false), false, &mut m), Stride::Keep);
        assert_eq!(step(&mut b, &at(7.0, false), false, &mut m), Stride::Keep);
        assert_eq!(step(&mut b, &at(7.1, false), false, &mut m), Stride::Over);
        assert_eq!(m.lost.first().map(|l| l.position), Some(v(0.0, 2.0)));
    }

    #[test]
    fn the_passive_one_keeps_its_side_until_the_plume_is_lost() {
        let params = Params { active: false, ..Params::default() };
        let (mut b, mut m) = (CounterTurn::new(&params).expect("legal"), memory(Some(0.0), &[]));
        let at = |t: f64, nose, smells| smelling(seen(t, v(0.0, t), nose, None), smells);
        b.enter(&at(0.0, 350.0, true), &m);
        assert_eq!(course(step(&mut b, &at(0.0, 350.0, true), false, &mut m)).map(f64::round), Some(20.0));
        assert_eq!(step(&mut b, &at(2.0, 20.0, true), false, &mut m), Stride::Keep);
        assert_eq!(step(&mut b, &at(7.1, 20.0, false), false, &mut m), Stride::Over);
        // Left on the left of up-flow at first: the next contact begins from there and leads to the other side.
        b.enter(&at(9.0, 20.0, true), &m);
        assert_eq!(course(step(&mut b, &at(9.0, 20.0, true), false, &mut m)).map(f64::round), Some(340.0));
    }

    #[test]
    fn beta_must_lead_up_flow() {
        let params = Params { beta_deg: NonNegative::new(90.0), ..Params::default() };
        assert!(CounterTurn::new(&params).is_err());
    }
}
