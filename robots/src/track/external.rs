//! A searcher outside this program moves the head: each period it is asked, and its answer is carried out.
//!
//! *Source*: ours; the gantry's side of the robots' strategy of this name.
//!
//! *Parameters*: see [`ExternalSpec`].
//!
//! *Deviations*: none. Between two answers, and without one, the last order holds. The head waits before the first one.

use super::spec::GantryStrategyParams;
use crate::error::RobotError;
use crate::handoff::{
    Behaviour, Decision, ExchangeTiming, GantryLayout, GantryObservation, HeadGoal, MotionOrder, Outcome, ReplyOutcome,
};
use crate::searcher::Strategy;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the searcher.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "ExternalHeadSpec")]
#[serde(deny_unknown_fields, default)]
pub struct ExternalSpec {
    /// Simulated time between two questions, s; at least one step.
    #[default(Positive::new(0.2))]
    pub period_s: Positive,
    /// How long the run waits for an answer, s of real time.
    #[serde(with = "world::limits::answer_s")]
    #[default(Positive::new(1.0))]
    pub deadline_s: Positive,
    /// What the searcher does without an answer.
    #[default(OnLate::Hold)]
    pub on_late: OnLate,
}

/// What a gantry does when an answer is late, absent or of no use.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "OnLateHead")]
#[serde(deny_unknown_fields)]
pub enum OnLate {
    /// It goes on with the last order.
    Hold,
    /// It gives up.
    Abort,
}

impl Listed for ExternalSpec {
    const ENTRY: Entry = Entry {
        name: "External",
        what: "a searcher outside this program moves the head, asked in lock-step over zenoh, from Python or from Rust",
        source: "ours; docs/interfaces.md",
    };
}

impl GantryStrategyParams for ExternalSpec {
    fn build(&self, layout: &GantryLayout) -> Result<Box<dyn Strategy<HeadGoal>>, RobotError> {
        Ok(Box::new(External {
            on_late: self.on_late,
            fastest_m_s: Vector2::from(layout.max_speed_m_s),
            travel_m: layout.travel_m,
            last: Decision::new(Behaviour::Idle, HeadGoal::default()),
        }))
    }

    fn consulted(&self) -> Option<ExchangeTiming> {
        Some(ExchangeTiming { period_s: self.period_s.get(), deadline_s: self.deadline_s.get() })
    }
}

/// State of the searcher: its last decision.
#[derive(Debug)]
struct External {
    on_late: OnLate,
    fastest_m_s: Vector2<f64>,
    travel_m: [[f64; 2]; 2],
    last: Decision<HeadGoal>,
}

impl Strategy<HeadGoal> for External {
    fn step(&mut self, seen: &GantryObservation, _: &mut Stream) -> Decision<HeadGoal> {
        let id = self.last.goal.id;
        if id == 0 {
            self.last.goal.target_m = seen.readings.joints.position_m;
        }
        match &seen.told {
            Some(ReplyOutcome::Answer(told)) => {
                if let Some(MotionOrder::Head(order)) = &told.order {
                    self.last.goal = HeadGoal {
                        id: order.id.unwrap_or(id.wrapping_add(1)),
                        target_m: self.within(order.target_m),
                        speed_m_s: order.speed_m_s.unwrap_or(self.fastest_m_s).inf(&self.fastest_m_s),
                    };
                    self.last.behaviour = order.behaviour;
                }
                told.outcome.into_iter().for_each(|outcome| self.stop(outcome));
            }
            Some(ReplyOutcome::Nothing) if self.on_late == OnLate::Abort => self.stop(Outcome::Aborted),
            Some(ReplyOutcome::Nothing) | None => {}
        }
        self.last
    }
}

impl External {
    fn stop(&mut self, outcome: Outcome) {
        self.last.outcome.get_or_insert(outcome);
        self.last.behaviour = Behaviour::Done;
    }

    /// The nearest place that the axes reach.
    fn within(&self, target_m: Vector2<f64>) -> Vector2<f64> {
        let [forward, left] = self.travel_m;
        Vector2::new(target_m.x.clamp(forward[0], forward[1]), target_m.y.clamp(left[0], left[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::{GantryReadings, HeadOrder, Reply};
    use crate::track::testing::layout;

    fn searcher(on_late: OnLate) -> Box<dyn Strategy<HeadGoal>> {
        let spec = ExternalSpec { on_late, ..ExternalSpec::default() };
        spec.build(&layout()).expect("legal")
    }

    fn seen(told: Option<ReplyOutcome>) -> GantryObservation {
        GantryObservation { t_s: 1.0, readings: GantryReadings::default(), told }
    }

    fn to(forward: f64, left: f64) -> Option<ReplyOutcome> {
        Some(ReplyOutcome::Answer(Box::new(Reply {
            order: Some(MotionOrder::Head(HeadOrder {
                id: None,
                target_m: Vector2::new(forward, left),
                speed_m_s: None,
                behaviour: Behaviour::Cast,
            })),
            ..Reply::default()
        })))
    }

    #[test]
    fn orders_stay_within_the_machine_and_hold() {
        let mut s = searcher(OnLate::Hold);
        let mut rng = Stream::new(1, "crab0", "tracker");
        assert_eq!(s.step(&seen(None), &mut rng).goal.id, 0);
        let told = s.step(&seen(to(3.0, -0.2)), &mut rng);
        assert_eq!((told.goal.id, told.goal.target_m), (1, Vector2::new(2.0, -0.2)));
        assert_eq!(told.goal.speed_m_s, Vector2::new(0.15, 0.15));
        assert_eq!(s.step(&seen(Some(ReplyOutcome::Nothing)), &mut rng), told);
        assert_eq!(s.step(&seen(to(1.0, 0.0)), &mut rng).goal.id, 2);
    }

    #[test]
    fn it_stops_when_told_and_gives_up_without_answers_if_asked_to() {
        let mut rng = Stream::new(1, "crab0", "tracker");
        let over =
            Some(ReplyOutcome::Answer(Box::new(Reply { outcome: Some(Outcome::Completed), ..Reply::default() })));
        let mut s = searcher(OnLate::Hold);
        assert_eq!(s.step(&seen(over), &mut rng).outcome, Some(Outcome::Completed));
        let mut s = searcher(OnLate::Abort);
        assert_eq!(s.step(&seen(Some(ReplyOutcome::Nothing)), &mut rng).outcome, Some(Outcome::Aborted));
    }
}
