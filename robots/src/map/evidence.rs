//! Weight of a reading: chances that the model leaves out, and readings that repeat each other.
//!
//! *Source*: chance ε of a false detection: Wang & Pang give none. Chance ν that dye is missed although the model has
//! it there: gross-error model, Huber 1964, Ann. Math. Statist. 35, 73. Readings that are not independent: the
//! likelihood to the power of their independent share, Miller & Dunson 2019, J. Am. Stat. Assoc. 114, 1113 (coarsened
//! posterior).
//!
//! *Parameters*: ε `false_detection`; ν `missed`, 0; correlation time τ of the model's error, `correlation_s`, s, 0.
//!
//! *Deviations*: in the papers a map never doubts its model. γ is a product over hundreds of releases and may fall to
//! 1e-280 in a second, so that a source that was once crossed without a detection never comes back. Here γ ← ν + (1 −
//! ν) γ, and an update has the weight min(1, period / τ). The defaults ν = 0 and τ = 0 give the papers' rules.

use super::spec::invalid;
use crate::error::RobotError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Fraction, NonNegative};

/// How far the map doubts its model of the plume.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DoubtSpec {
    /// Chance ν that dye is missed where the model is sure of it: gaps in the plume, or a plume beside its modelled
    /// place.
    pub missed: Fraction,
    /// Correlation time τ, s: readings within this time count once. 0: each update is independent of the one before.
    pub correlation_s: NonNegative,
}

impl Default for DoubtSpec {
    fn default() -> Self {
        Self {
            missed: Fraction::new(0.0),
            correlation_s: NonNegative::new(0.0),
        }
    }
}

/// The same, ready for updates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Evidence {
    /// Chance ε of a detection where there is no dye.
    pub epsilon: f64,
    missed: f64,
    /// Share of an update that counts as new.
    pub share: f64,
}

impl Evidence {
    /// For updates every `period_s`.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if ε would let a belief vanish, or if ν leaves readings without any meaning.
    pub(super) fn new(
        epsilon: Fraction,
        doubt: &DoubtSpec,
        period_s: f64,
    ) -> Result<Self, RobotError> {
        let (epsilon, missed) = (epsilon.get(), doubt.missed.get());
        if !(epsilon > 0.0 && epsilon < 1.0) {
            let problem = format!("must be greater than 0 and less than 1, got {epsilon}");
            return Err(invalid("false_detection", &problem));
        }
        if missed >= 1.0 {
            return Err(invalid(
                "doubt.missed",
                &format!("must be less than 1, got {missed}"),
            ));
        }
        let tau_s = doubt.correlation_s.get();
        Ok(Self {
            epsilon,
            missed,
            share: if tau_s > period_s {
                period_s / tau_s
            } else {
                1.0
            },
        })
    }

    /// Chance of no detection where the model gives `gamma`.
    pub(super) fn none(&self, gamma: f64) -> f64 {
        self.missed + (1.0 - self.missed) * gamma
    }

    /// Chance of a detection where the model gives `gamma` for none.
    pub(super) fn some(&self, gamma: f64) -> f64 {
        self.epsilon + (1.0 - self.epsilon) * (1.0 - self.none(gamma))
    }

    /// Turns the model's chances of no detection into likelihoods of the observation.
    pub(super) fn weigh(&self, detected: bool, gamma: &mut [f64]) {
        for g in gamma {
            *g = if detected {
                self.some(*g)
            } else {
                self.none(*g)
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evidence(missed: f64, tau_s: f64) -> Evidence {
        let doubt = DoubtSpec {
            missed: Fraction::new(missed),
            correlation_s: NonNegative::new(tau_s),
        };
        Evidence::new(Fraction::new(1e-3), &doubt, 1.0).expect("legal")
    }

    #[test]
    fn without_doubt_the_model_is_taken_at_its_word() {
        let e = evidence(0.0, 0.0);
        for gamma in [1e-280, 0.3, 0.999_999, 1.0] {
            assert_eq!(e.none(gamma), gamma);
            assert_eq!(e.some(gamma), 1e-3 + (1.0 - 1e-3) * (1.0 - gamma));
        }
        assert_eq!(e.share, 1.0);
        // A time shorter than the period changes nothing.
        assert_eq!(evidence(0.0, 0.5).share, 1.0);
    }

    #[test]
    fn doubt_bounds_what_an_update_can_say() {
        let e = evidence(0.2, 8.0);
        assert_eq!(e.none(0.0), 0.2);
        assert_eq!(e.none(1.0), 1.0);
        // The chances of the two outcomes, without ε, still add up to 1.
        assert!((e.none(0.4) + (e.some(0.4) - 1e-3) / (1.0 - 1e-3) - 1.0).abs() < 1e-15);
        assert_eq!(e.share, 0.125);
    }

    #[test]
    fn chances_that_say_nothing_are_refused() {
        let doubt = DoubtSpec {
            missed: Fraction::new(1.0),
            ..DoubtSpec::default()
        };
        let text = Evidence::new(Fraction::new(0.1), &doubt, 1.0)
            .expect_err("refused")
            .to_string();
        assert_eq!(text, "map.doubt.missed: must be less than 1, got 1");
        let text = Evidence::new(Fraction::new(0.0), &DoubtSpec::default(), 1.0)
            .expect_err("refused")
            .to_string();
        assert_eq!(
            text,
            "map.false_detection: must be greater than 0 and less than 1, got 0"
        );
    }
}
