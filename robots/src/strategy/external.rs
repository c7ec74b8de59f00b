//! A searcher outside this program decides: each period it is asked, and its answer is carried out.
//!
//! *Source*: ours; the lock-step of a simulator and a controller, as in hardware-in-the-loop tests.
//!
//! *Parameters*: see [`ExternalSpec`].
//!
//! *Deviations*: none. Between two answers the last order holds. Before the first one the vehicle keeps the heading,
//! depth and speed with which it set out; one that set out slower than it can be steered takes its least speed, so that
//! a first order without a speed does not leave it to sink. Who answers, and how, is the business of the run: here are
//! only the answers.

use super::about::About;
use super::setting::Setting;
use super::spec::{Strategy, StrategyParams, StrategySpec};
use crate::error::RobotError;
use crate::handoff::{
    Behaviour, Decision, ExchangeTiming, Goal, GuidanceStatus, Manoeuvre, MotionOrder, Observation, Outcome, Reply,
    ReplyOutcome, Shown, Vertical,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the strategy.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExternalSpec {
    /// Simulated time between two questions, s; at least one step.
    #[default(Positive::new(1.0))]
    pub period_s: Positive,
    /// How long the run waits for an answer, s of real time.
    #[serde(with = "world::limits::answer_s")]
    #[default(Positive::new(1.0))]
    pub deadline_s: Positive,
    /// What the robot does without an answer.
    #[default(OnLate::Hold)]
    pub on_late: OnLate,
}

/// What a robot does when an answer is late, absent or of no use.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum OnLate {
    /// It goes on with the last order.
    Hold,
    /// A strategy of this program decides until the next answer.
    Fallback(Box<StrategySpec>),
    /// It ends its mission.
    Abort,
}

impl Listed for ExternalSpec {
    const ENTRY: Entry = Entry {
        name: "External",
        what: "a searcher outside this program decides, asked in lock-step over zenoh, from Python or from Rust",
        source: "ours; docs/interfaces.md",
    };
}

impl ExternalSpec {
    fn fallback(&self) -> Option<&StrategySpec> {
        match &self.on_late {
            OnLate::Fallback(spec) => Some(spec),
            _ => None,
        }
    }
}

impl StrategyParams for ExternalSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        let late = match &self.on_late {
            OnLate::Hold => Late::Hold,
            OnLate::Abort => Late::Abort,
            OnLate::Fallback(spec) if spec.about().consulted.is_some() => {
                return Err(RobotError::invalid(
                    "strategy.on_late",
                    "must be a strategy of this program, got External",
                ));
            }
            OnLate::Fallback(spec) => Late::Fallback(spec.build(setting)?),
        };
        Ok(Box::new(External {
            late,
            goal: None,
            behaviour: Behaviour::Other("external"),
            outcome: None,
            standing_in: None,
        }))
    }

    fn check(&self, setting: &Setting) -> Result<(), RobotError> {
        self.fallback().map_or(Ok(()), |spec| spec.check(setting))
    }

    fn about(&self) -> About {
        let fallback = self.fallback().map(|spec| spec.about()).unwrap_or_default();
        About {
            needs: fallback.needs.into_iter().map(|n| n.within("on_late")).collect(),
            wishes: fallback.wishes.within("on_late"),
            declares_at_most: usize::MAX,
            consulted: Some(ExchangeTiming { period_s: self.period_s.get(), deadline_s: self.deadline_s.get() }),
            ..About::default()
        }
    }
}

/// What stands in for an answer.
#[derive(Debug)]
enum Late {
    Hold,
    Fallback(Box<dyn Strategy>),
    Abort,
}

/// State of the strategy.
#[derive(Debug)]
struct External {
    late: Late,
    goal: Option<Goal>,
    behaviour: Behaviour,
    outcome: Option<Outcome>,
    /// While the fallback decides: what its goals' numbers are counted from.
    standing_in: Option<u32>,
}

impl Strategy for External {
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision {
        if seen.guidance.aborted {
            self.outcome.get_or_insert(Outcome::Aborted);
        }
        let goal = *self.goal.get_or_insert_with(|| setting_out(seen));
        let none = Reply::default();
        let mut answer = &none;
        match &seen.told {
            Some(ReplyOutcome::Answer(told)) => {
                self.standing_in = None;
                answer = told;
                self.take(told);
            }
            Some(ReplyOutcome::Nothing) => match &self.late {
                Late::Hold => {}
                Late::Fallback(_) => {
                    self.standing_in.get_or_insert(goal.id);
                }
                Late::Abort => {
                    self.outcome.get_or_insert(Outcome::Aborted);
                }
            },
            None => {}
        }
        if let (Some(base), Late::Fallback(strategy)) = (self.standing_in, &mut self.late) {
            let decision = stand_in(strategy.as_mut(), base, seen, rng);
            self.goal = Some(decision.goal);
            self.behaviour = decision.behaviour;
            self.outcome = self.outcome.or(decision.outcome);
            return Decision { outcome: self.outcome, ..decision };
        }
        let goal = self.goal.unwrap_or(goal);
        let behaviour = self.behaviour;
        Decision {
            behaviour,
            goal,
            declared: answer.declared,
            picture: answer.picture,
            ways: None,
            outcome: self.outcome,
        }
    }

    fn shown(&self) -> Shown {
        match (&self.late, self.standing_in) {
            (Late::Fallback(strategy), Some(_)) => strategy.shown(),
            _ => Shown::default(),
        }
    }
}

impl External {
    fn take(&mut self, told: &Reply) {
        if let (Some(MotionOrder::Move(order)), Some(last)) = (&told.order, self.goal) {
            self.goal = Some(Goal {
                id: order.id.unwrap_or(last.id.wrapping_add(1)),
                manoeuvre: order.manoeuvre,
                vertical: order.vertical.unwrap_or(last.vertical),
                speed_m_s: order.speed_m_s.unwrap_or(last.speed_m_s),
            });
        }
        self.behaviour = told.behaviour.unwrap_or(self.behaviour);
        self.outcome = self.outcome.or(told.outcome);
    }
}

/// The goal before the first answer: on as it set out, at least as fast as it can be steered.
fn setting_out(seen: &Observation) -> Goal {
    let e = &seen.estimate;
    Goal {
        id: 0,
        manoeuvre: Manoeuvre::Steer { heading: e.attitude.heading },
        vertical: Vertical::Depth(e.depth_m.max(0.0)),
        speed_m_s: e.v_ground_body.x.max(seen.able.least_speed_m_s),
    }
}

/// A decision of the fallback. It counts its goals from 0, so it is shown the guidance's answers in its own numbers.
fn stand_in(strategy: &mut dyn Strategy, base: u32, seen: &Observation, rng: &mut Stream) -> Decision {
    let guidance = match seen.guidance.goal_id.checked_sub(base) {
        Some(goal_id) => GuidanceStatus { goal_id, ..seen.guidance },
        None => GuidanceStatus::default(),
    };
    let own = Observation { guidance, told: None, ..seen.clone() };
    let mut decision = strategy.step(&own, rng);
    decision.goal.id = decision.goal.id.saturating_add(base);
    decision
}

#[cfg(test)]
#[path = "external_tests.rs"]
mod tests;
