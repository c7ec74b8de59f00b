//! Decision unit, steering: the side to which the contrast between the leftmost and the rightmost probe pulls.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4 (`Fixed`: minimum percentage difference in
//! peak concentration, 30 %) and section 7 (adaptive specification of the contrast threshold is its future work).
//!
//! *Parameters*: `Fixed`: least contrast `threshold`, 0.3, of the mean of the step's spike magnitudes: the paper says "peak concentration" and, of the step,
//! "average recorded peak", hence the mean. `Adaptive`: the difference in standard errors `errors`, 1.5: more than a
//! lone spike (1) or two equal ones on one side (1.41) can give, so that at least three that agree are needed to
//! steer.
//!
//! *Deviations*: the percentage refers to the larger side, (left - right) / larger, because that stays finite if one
//! side has nothing. `Adaptive` compares sums of magnitudes, which contain both rate and strength, and takes their
//! error from the same spikes: the variance of a sum over a Poisson number of spikes is the expected sum of squares.
//! It gathers spikes since the head last moved aside, so that few spikes steer late rather than never.

use crate::track::data::{StepRecord, Tally};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{Fraction, Positive};

/// The steering rules a tracker can have.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum ContrastSpec {
    /// A fixed difference between the sides.
    #[default]
    Fixed(Fixed),
    /// A difference beyond its own uncertainty.
    Adaptive(Adaptive),
}

/// Parameters of the fixed threshold.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "FixedContrast")]
#[serde(deny_unknown_fields, default)]
pub struct Fixed {
    /// Least difference, as a share of the larger side.
    #[default(Fraction::new(0.3))]
    pub threshold: Fraction,
}

/// Parameters of the adaptive threshold.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "AdaptiveContrast")]
#[serde(deny_unknown_fields, default)]
pub struct Adaptive {
    /// Least difference, in its standard errors.
    #[default(Positive::new(1.5))]
    pub errors: Positive,
}

/// Where the contrast pulls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pull {
    /// Contrast, left positive, -1 to 1.
    pub contrast: f64,
    /// 1 to the left, -1 to the right, 0 if the contrast is too small.
    pub side: f64,
}

impl ContrastSpec {
    /// Whether it uses the spikes since the head last moved aside, not only those of the step.
    pub fn gathers(&self) -> bool {
        matches!(self, Self::Adaptive(_))
    }

    /// The pull of a step's spikes.
    pub fn pull(&self, step: &StepRecord) -> Pull {
        let of = |t: &Tally| match self {
            Self::Fixed(_) => t.mean_v(),
            Self::Adaptive(_) => t.sum_v,
        };
        let (left, right) = (of(&step.left), of(&step.right));
        let larger = left.max(right);
        if larger <= 0.0 {
            return Pull::default();
        }
        let contrast = (left - right) / larger;
        let enough = match self {
            Self::Fixed(p) => contrast.abs() >= p.threshold.get(),
            Self::Adaptive(p) => {
                let error = (step.left.squares_v2 + step.right.squares_v2).sqrt();
                (left - right).abs() >= p.errors.get() * error
            }
        };
        Pull { contrast, side: if enough && contrast != 0.0 { contrast.signum() } else { 0.0 } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(left: &[f64], right: &[f64]) -> StepRecord {
        let mut r = StepRecord::default();
        left.iter().for_each(|m| r.left.add(*m));
        right.iter().for_each(|m| r.right.add(*m));
        r
    }

    #[test]
    fn thirty_per_cent_of_the_larger_side() {
        let rule = ContrastSpec::default();
        assert_eq!(rule.pull(&step(&[1.0], &[0.71])).side, 0.0);
        let p = rule.pull(&step(&[2.0, 2.0], &[1.0, 1.6]));
        assert!((p.contrast - 0.35).abs() < 1e-12);
        assert_eq!(p.side, 1.0);
        assert_eq!(rule.pull(&step(&[0.6], &[1.0])).side, -1.0);
        assert_eq!(rule.pull(&step(&[], &[0.1])), Pull { contrast: -1.0, side: -1.0 });
        assert_eq!(rule.pull(&step(&[], &[])), Pull::default());
        let always = ContrastSpec::Fixed(Fixed { threshold: Fraction::new(0.0) });
        assert_eq!(always.pull(&step(&[1.0], &[1.0])).side, 0.0, "no side is greater");
    }

    #[test]
    fn the_adaptive_threshold_grows_with_the_noise_of_the_spikes() {
        let rule = ContrastSpec::Adaptive(Adaptive { errors: Positive::new(1.5) });
        // One spike against none: one standard error. Four: two.
        assert_eq!(rule.pull(&step(&[1.0], &[])).side, 0.0);
        assert_eq!(rule.pull(&step(&[1.0; 4], &[])).side, 1.0);
        // The same ratio of sides, three to one, is enough with many spikes and not with few.
        assert_eq!(rule.pull(&step(&[1.0; 3], &[1.0])).side, 0.0);
        assert_eq!(rule.pull(&step(&[1.0; 12], &[1.0; 4])).side, 1.0);
        // One huge spike is no evidence.
        assert_eq!(rule.pull(&step(&[9.0, 0.1, 0.1], &[0.1])).side, 0.0);
    }
}
