//! Decision unit, up-stream motion: whether the present step's spikes allow another step up-stream.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4 (`StepRule`); Page et al. 2011a (J. Exp.
//! Biol. 214:1498) as summed up there in section 2.2: a spike above the threshold at the antennules moves the animal
//! up-stream, in a binary fashion (`Gated`).
//!
//! *Parameters*: `StepRule`: present magnitude over the previous one `ratio`, 1 (0.9 and 1.1 were tried in the
//! paper); prediction error `prediction_error`, a share of the prediction, 0.02. That error has a sign:
//! the paper defines it as "predicted value minus the average spike magnitude" and takes a large one
//! for a perceived loss, so that a magnitude above the prediction is no error. `Gated`: least number of spikes in the
//! step, `spikes`, 1.
//!
//! *Deviations*: "exceeds" is taken strictly, so that no signal never exceeds no signal. The first step after a sweep
//! has no previous one; it allows another step if it has any spike. `Gated` is not in the paper's tracker.

use crate::track::data::StepRecord;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::ranges::{NonNegative, Positive};

/// The rules a tracker can have.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum AdvanceSpec {
    /// More than before, or as predicted.
    #[default]
    StepRule(StepRule),
    /// Any spike: odour-gated rheotaxis.
    Gated(Gated),
}

/// Parameters of the step rule.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StepRule {
    /// The present magnitude must exceed this share of the previous one.
    #[default(Positive::new(1.0))]
    pub ratio: Positive,
    /// Otherwise the prediction error must be below this share of the prediction.
    #[default(NonNegative::new(0.02))]
    pub prediction_error: NonNegative,
}

/// Parameters of the gate.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Gated {
    /// Least number of spikes in the step.
    #[default(NonZeroUsize::MIN)]
    pub spikes: NonZeroUsize,
}

impl AdvanceSpec {
    /// Whether the step allows another one up-stream.
    pub fn allows(&self, step: &StepRecord) -> bool {
        match self {
            Self::Gated(p) => step.spikes >= p.spikes.get(),
            Self::StepRule(_) if step.spikes == 0 => false,
            Self::StepRule(p) => {
                let more = step.previous_v.is_none_or(|before| step.mean_v > p.ratio.get() * before);
                let lost = |predicted: f64| predicted - step.mean_v >= p.prediction_error.get() * predicted;
                more || step.predicted_v.is_some_and(|predicted| !lost(predicted))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(spikes: usize, mean_v: f64, previous_v: f64, predicted_v: f64) -> StepRecord {
        StepRecord {
            spikes,
            mean_v,
            previous_v: Some(previous_v),
            predicted_v: Some(predicted_v),
            ..Default::default()
        }
    }

    #[test]
    fn more_than_before_or_within_two_per_cent_of_the_prediction() {
        let rule = AdvanceSpec::default();
        assert!(rule.allows(&step(3, 1.01, 1.0, 9.0)), "more than before");
        assert!(!rule.allows(&step(3, 1.0, 1.0, 1.03)), "as before is not more");
        assert!(rule.allows(&step(3, 0.99, 1.0, 1.0)), "1 % below the prediction");
        assert!(!rule.allows(&step(3, 0.97, 1.0, 1.0)), "3 % below it");
        assert!(rule.allows(&step(3, 0.97, 1.0, 0.5)), "above it is no loss");
        assert!(!rule.allows(&step(0, 0.0, 0.0, 0.0)), "nothing");
        let first = StepRecord { spikes: 1, mean_v: 0.1, ..Default::default() };
        assert!(rule.allows(&first));
    }

    #[test]
    fn the_gate_asks_for_spikes_only() {
        let gate = AdvanceSpec::Gated(Gated::default());
        assert!(gate.allows(&step(1, 0.1, 1.0, 1.0)));
        assert!(!gate.allows(&step(0, 0.0, 1.0, 1.0)));
    }
}
