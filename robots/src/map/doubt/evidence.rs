//! Weight of a reading: chances that the model leaves out, and readings that repeat each other.
//!
//! *Source*: chance ε of a false detection: Wang & Pang give none. Chance ν that dye is missed although the model has
//! it there: gross-error model, Huber 1964, Ann. Math. Statist. 35, 73. Readings that are not independent, `Tempered`:
//! the likelihood to the power of their independent share, Miller & Dunson 2019, J. Am. Stat. Assoc. 114, 1113
//! (coarsened posterior). `Markov`: Bernoulli trials that form a Markov chain, Klotz 1973, Ann. Statist. 1, 373.
//!
//! *Parameters*: ε `false_detection`; ν `missed`, 0; correlation time τ of readings, `correlation_s`, s, 0; `repeats`;
//! errors of navigation and of the flow: see `navigation` and `flows`.
//!
//! *Deviations*: in the papers a map never doubts its model. γ is a product over hundreds of releases and may fall to
//! 1e-280 in a second, so that a source that was once crossed without a detection never comes back. Here γ ← ν + (1 −
//! ν) γ. With `Tempered` an update has the weight min(1, period / τ). With `Markov` a reading is, with chance ρ =
//! exp(−Δt / τ), the one before it once more (the same patch of dye, or the same gap), which every source explains
//! alike, and otherwise a new one with the model's chance: for the same result as before the likelihood is ρ + (1 − ρ)
//! L, for another one (1 − ρ) L. So the first reading of an encounter and its end count in full, and what lies between
//! counts once in τ. Klotz has one chance for all trials; here that of the moment, so that the chain's own share of
//! detections follows L with a lag of τ. The defaults ν = 0 and τ = 0 give the papers' rules.

use crate::error::RobotError;
use crate::map::kernel::terms::LEAST;
use crate::map::spec::must;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::math;
use world::ranges::{Fraction, NonNegative, Positive};

/// Most strengths of the source, and the legal range of each.
const MOST_STRENGTHS: usize = 9;
/// See above.
const STRENGTHS: (f64, f64) = (0.01, 100.0);

/// What a reading says that repeats the one before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Repeats {
    /// Every reading has the weight min(1, period / τ).
    #[default]
    Tempered,
    /// A reading is the one before it once more, with chance exp(−Δt / τ); otherwise it counts in full.
    Markov,
}

/// How far the map doubts its model of the plume.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DoubtSpec {
    /// Chance ν that dye is missed where the model is sure of it: gaps in the plume, or a plume beside its modelled
    /// place.
    #[default(Fraction::new(0.0))]
    pub missed: Fraction,
    /// Correlation time τ, s: readings within this time count once. 0: each update is independent of the one before.
    #[default(NonNegative::new(0.0))]
    pub correlation_s: NonNegative,
    /// How readings within τ count.
    #[default(Repeats::Tempered)]
    pub repeats: Repeats,
    /// Standard deviation of a position fix in each horizontal axis, m, as its instrument states it: an error that all
    /// readings until the next fix share. 0: the believed position is true.
    #[default(NonNegative::new(0.0))]
    pub fix_m: NonNegative,
    /// Standard deviation of the rate at which the believed position drifts away between two fixes, in each horizontal
    /// axis, m/s. The mission begins where the vehicle believes it does.
    #[serde(with = "world::limits::stream_m_s")]
    #[default(NonNegative::new(0.0))]
    pub drift_m_s: NonNegative,
    /// Standard deviation, in each horizontal axis, of the flow along the whole way behind the vehicle from the measured
    /// one, m/s: an error that all releases share. 0: the measured flow is true.
    #[serde(with = "world::limits::stream_m_s")]
    #[default(NonNegative::new(0.0))]
    pub flow_m_s: NonNegative,
    /// Possible strengths of the source: releases in each release period, all equally likely before the mission. None
    /// given: one, as in the papers. At most 9, each from 0.01 to 100.
    pub strengths: Vec<Positive>,
    /// Time for which that error lasts, s: what is known of it is forgotten at this rate. Not given: for the mission.
    pub flow_lasts_s: Option<Positive>,
}

/// The same, ready for updates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::map) struct Evidence {
    /// Chance ε of a detection where there is no dye.
    pub epsilon: f64,
    missed: f64,
    /// Releases in each release period.
    strength: f64,
    /// Share of an update that counts as new.
    pub share: f64,
    /// Correlation time of the Markov chain of readings, s; 0: there is none.
    chain_s: f64,
    /// Time and result of the reading before.
    before: Option<(f64, bool)>,
}

impl Evidence {
    /// For updates every `period_s`.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if ε would let a belief vanish, or if ν leaves readings without any meaning.
    pub(in crate::map) fn new(epsilon: Fraction, doubt: &DoubtSpec, period_s: f64) -> Result<Self, RobotError> {
        let (epsilon, missed) = (epsilon.get(), doubt.missed.get());
        let problem = format!("must be greater than 0 and less than 1, got {epsilon}");
        must(epsilon > 0.0 && epsilon < 1.0, "false_detection", problem)?;
        must(missed < 1.0, "doubt.missed", format!("must be less than 1, got {missed}"))?;
        let problem = format!("must be at most {MOST_STRENGTHS}, got {}", doubt.strengths.len());
        must(doubt.strengths.len() <= MOST_STRENGTHS, "doubt.strengths", problem)?;
        let (least, most) = STRENGTHS;
        let strengths = doubt.strengths.iter().map(|s| s.get());
        let odd = strengths.clone().find(|s| !(least..=most).contains(s));
        let problem = format!("must be from {least} to {most} each, got {}", odd.unwrap_or_default());
        must(odd.is_none(), "doubt.strengths", problem)?;
        let tau_s = doubt.correlation_s.get();
        Ok(Self {
            epsilon,
            missed,
            strength: strengths.clone().next().unwrap_or(1.0),
            share: match doubt.repeats {
                Repeats::Tempered if tau_s > period_s => period_s / tau_s,
                _ => 1.0,
            },
            chain_s: match doubt.repeats {
                Repeats::Tempered => 0.0,
                Repeats::Markov => tau_s,
            },
            before: None,
        })
    }

    /// Chance ρ that a reading at `t_s` is the one before it once more; 0 if it has another result.
    pub(in crate::map) fn repeated(&mut self, t_s: f64, detected: bool) -> f64 {
        let before = self.before.replace((t_s, detected));
        match before {
            Some((then_s, same)) if same == detected && self.chain_s > 0.0 => math::exp((then_s - t_s) / self.chain_s),
            _ => 0.0,
        }
    }

    /// Chance of no detection where the model gives `gamma`.
    pub(in crate::map) fn none(&self, gamma: f64) -> f64 {
        let gamma = to_power(gamma, self.strength);
        self.missed + (1.0 - self.missed) * gamma
    }

    /// Chance of a detection where the model gives `gamma` for none.
    pub(in crate::map) fn some(&self, gamma: f64) -> f64 {
        self.epsilon + (1.0 - self.epsilon) * (1.0 - self.none(gamma))
    }

    /// Turns the model's chances of no detection into likelihoods of an observation at `t_s`.
    pub(in crate::map) fn weigh(&mut self, t_s: f64, detected: bool, gamma: &mut [f64]) {
        let same = self.repeated(t_s, detected);
        for g in gamma {
            let new = if detected { self.some(*g) } else { self.none(*g) };
            *g = mixed(same, new);
        }
    }
}

/// A chance to a power, at least the least of a product. Most cells are far from the plume and have 1; a whole number is
/// the usual power and takes a few products.
fn to_power(gamma: f64, power: f64) -> f64 {
    if power == 1.0 || gamma == 1.0 {
        return gamma;
    }
    if power.fract() != 0.0 {
        return math::powf(gamma, power).max(LEAST);
    }
    let (mut left, mut square, mut product) = (power as u32, gamma, 1.0);
    while left > 0 {
        if left % 2 == 1 {
            product *= square;
        }
        square *= square;
        left /= 2;
    }
    product.max(LEAST)
}

/// Likelihood of a reading that repeats the one before with chance `same` and has the likelihood `new` otherwise. For
/// `same` = 0 it is `new`, bit for bit.
pub(in crate::map) fn mixed(same: f64, new: f64) -> f64 {
    same + (1.0 - same) * new
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evidence(missed: f64, tau_s: f64) -> Evidence {
        let doubt =
            DoubtSpec { missed: Fraction::new(missed), correlation_s: NonNegative::new(tau_s), ..DoubtSpec::default() };
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
    fn whole_powers_are_products() {
        for gamma in [0.0, 1e-200, 0.3, 0.999, 1.0] {
            assert_eq!(to_power(gamma, 1.0), gamma);
            for power in [2.0, 3.0, 10.0, 100.0, 0.5, 2.5] {
                let want = math::powf(gamma, power).max(LEAST);
                let got = to_power(gamma, power);
                assert!((got / want - 1.0).abs() < 1e-12, "{gamma}^{power}: {got} {want}");
            }
        }
    }

    #[test]
    fn a_chain_of_readings_counts_an_encounter_once() {
        let doubt =
            DoubtSpec { correlation_s: NonNegative::new(4.0), repeats: Repeats::Markov, ..DoubtSpec::default() };
        let mut e = Evidence::new(Fraction::new(1e-3), &doubt, 1.0).expect("legal");
        assert_eq!(e.share, 1.0);
        let mut told = |t_s: f64, detected: bool, gamma: f64| {
            let mut l = [gamma];
            e.weigh(t_s, detected, &mut l);
            l[0]
        };
        let new = 1e-3 + (1.0 - 1e-3) * 0.5;
        // The first detection counts in full, the next one little, the end of the encounter in full again.
        assert_eq!(told(1.0, true, 0.5), new);
        let rho = math::exp(-0.25);
        assert!((told(2.0, true, 0.5) - (rho + (1.0 - rho) * new)).abs() < 1e-15);
        assert_eq!(told(3.0, false, 0.5), 0.5);
        // The probabilities of both results add up to 1, but for the constant (1 - ρ) of the change.
        let (same, other) = (rho + (1.0 - rho) * 0.3, (1.0 - rho) * 0.7);
        assert!((same + other - 1.0).abs() < 1e-15);
        // A long time after it a reading is new.
        assert!((told(200.0, false, 0.5) - 0.5).abs() < 1e-9);
    }
}
