//! Threshold analyser: which local maxima count as spikes, by half the running average of spikes.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4: floor and C_avg/2 rule, after Page et al.
//! 2011a (J. Exp. Biol. 214:1498), who give each animal a threshold of its own.
//!
//! *Parameters*: `HalfMean`: floor `floor_v`, V, -4.98; share of the average `share`, 1/2; memory of the average
//! `memory_s` (not published), 10 s, the upper end of the paper's short-term memory. Averaged are
//! all spikes above the floor: it is applied first and "thereafter" the average is formed, and an average of accepted
//! spikes alone would never come down in weaker water. Each probe has its own average: the paper's Fig. 8 judges one
//! record by its own threshold. `Level`: a
//! constant `level_v`, for comparison.
//!
//! *Deviations*: the running average decays with time (e-fold in `memory_s`), not with the number of spikes: an old
//! average must not outlive a loss of the plume.

use crate::handoff::MAX_PROBES;
use crate::track::data::Spike;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::math;
use world::ranges::{Finite, Fraction, Positive};

/// The analysers a tracker can have.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum ThresholdSpec {
    /// Half of the running average, not below a floor.
    #[default]
    HalfMean(HalfMean),
    /// A constant level.
    Level(Level),
}

/// Parameters of the C_avg/2 rule.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HalfMean {
    /// Least threshold, V.
    #[default(Finite::new(-4.98))]
    pub floor_v: Finite,
    /// Threshold as a share of the average.
    #[default(Fraction::new(0.5))]
    pub share: Fraction,
    /// Time constant with which the average decays, s.
    #[default(Positive::new(10.0))]
    pub memory_s: Positive,
}

/// Parameters of the constant level.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Level {
    /// The level, V.
    #[default(Finite::new(-4.98))]
    pub level_v: Finite,
}

/// A mean that decays: weights and weighted sum at the latest spike.
#[derive(Clone, Copy, Debug, Default)]
struct Running {
    t_s: f64,
    weight: f64,
    sum_v: f64,
}

/// The unit.
#[derive(Clone, Debug)]
pub struct ThresholdAnalyser {
    spec: ThresholdSpec,
    bottom_v: f64,
    running: [Running; MAX_PROBES],
}

impl ThresholdAnalyser {
    /// The unit for probes whose range begins at `bottom_v`.
    pub fn new(spec: &ThresholdSpec, bottom_v: f64) -> Self {
        Self { spec: spec.clone(), bottom_v, running: [Running::default(); MAX_PROBES] }
    }

    /// The present threshold of a probe above the bottom of its range, V.
    pub fn above_v(&self, probe: usize) -> f64 {
        match &self.spec {
            ThresholdSpec::Level(p) => p.level_v.get() - self.bottom_v,
            ThresholdSpec::HalfMean(p) => {
                let r = &self.running[probe];
                let floor = p.floor_v.get() - self.bottom_v;
                if r.weight > 0.0 { floor.max(p.share.get() * r.sum_v / r.weight) } else { floor }
            }
        }
    }

    /// Whether a local maximum is a spike; it enters the average afterwards.
    pub fn accepts(&mut self, top: &Spike) -> bool {
        let accepted = top.magnitude_v > self.above_v(top.probe);
        if let ThresholdSpec::HalfMean(p) = &self.spec
            && top.magnitude_v > p.floor_v.get() - self.bottom_v
        {
            let r = &mut self.running[top.probe];
            let fade = math::exp(-(top.t_s - r.t_s).max(0.0) / p.memory_s.get());
            *r = Running { t_s: top.t_s, weight: r.weight * fade + 1.0, sum_v: r.sum_v * fade + top.magnitude_v };
        }
        accepted
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::testing::spike;

    fn with(change: impl FnOnce(&mut HalfMean)) -> ThresholdAnalyser {
        let mut p = HalfMean::default();
        change(&mut p);
        ThresholdAnalyser::new(&ThresholdSpec::HalfMean(p), -5.0)
    }

    #[test]
    fn the_floor_first_then_half_of_the_average() {
        let mut a = with(|_| {});
        assert!((a.above_v(0) - 0.02).abs() < 1e-12);
        assert!(!a.accepts(&spike(0.0, 0, 0.0199)), "below the floor is noise");
        assert!(a.accepts(&spike(0.0, 0, 1.0)));
        assert!((a.above_v(0) - 0.5).abs() < 1e-12);
        assert!(!a.accepts(&spike(0.0, 0, 0.4)));
        // 0.4 was above the floor: the average is 0.7.
        assert!((a.above_v(0) - 0.35).abs() < 1e-12);
        assert!((a.above_v(1) - 0.02).abs() < 1e-12, "its own record");
    }

    #[test]
    fn it_forgets_in_its_memory() {
        let mut a = with(|p| p.memory_s = Positive::new(2.0));
        a.accepts(&spike(0.0, 0, 4.0));
        a.accepts(&spike(2.0, 0, 1.0));
        let e = math::exp(-1.0);
        assert!((a.above_v(0) - 0.5 * (4.0 * e + 1.0) / (e + 1.0)).abs() < 1e-12);
    }

    #[test]
    fn a_level_stays() {
        let mut level = ThresholdAnalyser::new(&ThresholdSpec::Level(Level::default()), -5.0);
        assert!(level.accepts(&spike(0.0, 0, 3.0)));
        assert!((level.above_v(0) - 0.02).abs() < 1e-12);
    }
}
