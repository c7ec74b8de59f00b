//! Decision unit, pace: how fast the head moves and when a step is over.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 3 (6.1 cm/s along, 3 cm/s across), Fig. 9 (a
//! step takes 3.5 s, the sweep 20 s); section 7 (situation-dependent speed is its future work); section 6.1: animals
//! keep 10 cm/s or more, "speed is regulated by odorant pulse arrival rate".
//!
//! *Parameters*: `Fixed`: speeds `forward_m_s` 0.061, `left_m_s` 0.03; time at rest before a decision `dwell_s`, 1.86
//! s: 3.5 s less the 1.64 s of a 10 cm step. `Adaptive`: least and greatest forward speed `least_m_s` 0.1 (the
//! animals'), `most_m_s` 0.15 (the gantry's own limit), across `left_m_s` 0.15; first sweep `sweep_m_s` 0.03, as in
//! Fixed, because a good start is worth the time, and later sweeps `reacquire_m_s` 0.15; number of spikes that is
//! enough for a decision `enough`, 1, which shows that the head is in the plume: steering gathers spikes over several
//! steps and needs no second one; longest time at rest `dwell_s`, 1.5; time before the end of a motion at which the
//! next one is decided, `lead_s`, 0.1 s (two scans), so that the head does not stop.
//!
//! *Deviations*: in `Adaptive` the speed grows linearly with the spikes of the last step up to `enough`. With enough
//! of them the next step follows without rest; with fewer the head waits for them, at most `dwell_s`. `enough` 2 made
//! half of all steps wait, because a head in a smooth thread of dye meets few maxima. Shorter rests take more gaps
//! of the plume for its end, longer ones cost time at each.

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::ranges::{NonNegative, Positive};

/// The paces a tracker can have.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum PaceSpec {
    /// The same speeds and rest for every step.
    #[default]
    Fixed(Fixed),
    /// Faster with more spikes, no rest if there are enough.
    Adaptive(Adaptive),
}

/// Parameters of the fixed pace.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "FixedPace")]
#[serde(deny_unknown_fields, default)]
pub struct Fixed {
    /// Speed along the stream, m/s.
    #[default(Positive::new(0.061))]
    pub forward_m_s: Positive,
    /// Speed across the stream, m/s.
    #[default(Positive::new(0.03))]
    pub left_m_s: Positive,
    /// Time at rest before a decision, s.
    #[default(NonNegative::new(1.86))]
    pub dwell_s: NonNegative,
}

/// Parameters of the adaptive pace.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "AdaptivePace")]
#[serde(deny_unknown_fields, default)]
pub struct Adaptive {
    /// Forward speed without spikes, m/s.
    #[default(Positive::new(0.1))]
    pub least_m_s: Positive,
    /// Forward speed with enough spikes, m/s.
    #[default(Positive::new(0.15))]
    pub most_m_s: Positive,
    /// Speed across the stream, m/s.
    #[default(Positive::new(0.15))]
    pub left_m_s: Positive,
    /// Speed of the first sweep, m/s.
    #[default(Positive::new(0.03))]
    pub sweep_m_s: Positive,
    /// Speed of later sweeps, m/s.
    #[default(Positive::new(0.15))]
    pub reacquire_m_s: Positive,
    /// Number of spikes in a step that is enough for a decision.
    #[default(NonZeroUsize::MIN)]
    pub enough: NonZeroUsize,
    /// Longest time at rest, s.
    #[default(NonNegative::new(1.5))]
    pub dwell_s: NonNegative,
    /// How long before the end of a motion the next one is decided, s.
    #[default(NonNegative::new(0.1))]
    pub lead_s: NonNegative,
}

impl PaceSpec {
    /// Speeds (forward, left) of the step after one with so many spikes, m/s.
    pub fn speed_m_s(&self, spikes: usize) -> Vector2<f64> {
        match self {
            Self::Fixed(p) => Vector2::new(p.forward_m_s.get(), p.left_m_s.get()),
            Self::Adaptive(p) => {
                let (least, most) = (p.least_m_s.get(), p.most_m_s.get());
                let share = (spikes as f64 / p.enough.get() as f64).min(1.0);
                Vector2::new(least + (most - least) * share, p.left_m_s.get())
            }
        }
    }

    /// Speeds of the first sweep, or of a later one, m/s.
    pub fn sweep_m_s(&self, later: bool) -> Vector2<f64> {
        match self {
            Self::Fixed(p) => Vector2::new(p.forward_m_s.get(), p.left_m_s.get()),
            Self::Adaptive(p) => {
                let left = if later { p.reacquire_m_s } else { p.sweep_m_s };
                Vector2::new(p.least_m_s.get(), left.get())
            }
        }
    }

    /// Whether a step is over: `rest_s` is the time since the head came to rest, if it did; `to_go_s` the time of
    /// motion left; `spikes` those of the step.
    pub fn over(&self, rest_s: Option<f64>, to_go_s: f64, spikes: usize) -> bool {
        match self {
            Self::Fixed(p) => rest_s.is_some_and(|r| r >= p.dwell_s.get()),
            Self::Adaptive(p) if spikes >= p.enough.get() => rest_s.is_some() || to_go_s <= p.lead_s.get(),
            Self::Adaptive(p) => rest_s.is_some_and(|r| r >= p.dwell_s.get()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fixed_pace_rests_whatever_it_smells() {
        let p = PaceSpec::default();
        assert_eq!(p.speed_m_s(0), p.speed_m_s(99));
        assert!(!p.over(None, 0.0, 99));
        assert!(!p.over(Some(1.8), 0.0, 99));
        assert!(p.over(Some(1.86), 0.0, 0));
    }

    #[test]
    fn the_adaptive_pace_grows_with_spikes_and_does_not_stop_when_they_suffice() {
        let p = PaceSpec::Adaptive(Adaptive::default());
        let v: Vec<f64> = (0..6).map(|n| p.speed_m_s(n).x).collect();
        assert!(v.windows(2).all(|w| w[1] >= w[0]));
        assert!((v[0] - 0.1).abs() < 1e-12 && (v[1] - 0.15).abs() < 1e-12 && v[5] == v[1]);
        assert!(p.over(None, 0.1, 1) && !p.over(None, 0.2, 1));
        assert!(!p.over(None, 0.0, 0) && !p.over(Some(1.4), 0.0, 0) && p.over(Some(1.5), 0.0, 0));
        let two = PaceSpec::Adaptive(Adaptive {
            enough: NonZeroUsize::new(2).expect("2 is not zero"),
            ..Adaptive::default()
        });
        assert!((two.speed_m_s(1).x - 0.125).abs() < 1e-12);
        assert!(!two.over(None, 0.0, 1) && two.over(None, 0.0, 2));
    }
}
