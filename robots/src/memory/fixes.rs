//! Navigation fixes as a planner sees them: how far they moved the vehicle, and how far remembered places should
//! move.
//!
//! *Source*: Pang 2009, section 6, which explains its largest error of a declared place by navigation fixes near the
//! time of the declaration; the moving rules are ours.
//!
//! *Parameters*: none.
//!
//! *Deviations*: the papers give no rule. `Share`: dead reckoning drifts steadily between fixes. If a fix at T moves
//! the vehicle by J and the fix before it (or the start) was at T0, the drift at a time t between them was J (t - T0)
//! / (T - T0), and a point stored at t moves by that. Older points were already corrected by the earlier fix and
//! stay. This is exact for a steady drift; for noisy fixes it is the straight line between two of them. `Whole`:
//! every point moves by J. The points then keep the distances that dead reckoning gave them, and only the newest fix
//! places them: this is right if fixes are noisier than the drift of dead reckoning.

use crate::handoff::{Estimate, Need};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// What happens to remembered places when a fix moves the vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum FixMove {
    /// They stay, as in the papers.
    #[default]
    Stay,
    /// Each moves by the share of the jump that had accumulated when it was stored.
    Share,
    /// All move by the whole jump.
    Whole,
}

impl FixMove {
    /// The instruments that the rule needs; paths below the strategy.
    pub fn needs(self) -> Vec<Need> {
        match self {
            Self::Stay => Vec::new(),
            Self::Share | Self::Whole => vec![Need::wish("fixes", "lbl", "gets no fix that moves anything")],
        }
    }
}

/// A fix that moved the believed position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavigationFix {
    /// When the drift began, s: at the fix before, or at the start.
    pub since_s: f64,
    /// When the fix came, s.
    pub t_s: f64,
    /// How far it moved the vehicle (east, north), m.
    pub jump: Vector2<f64>,
}

impl NavigationFix {
    /// How far a place stored at `stored_s` moves (east, north), m.
    pub fn shift_of(&self, stored_s: f64, rule: FixMove) -> Vector2<f64> {
        match rule {
            FixMove::Stay => Vector2::zeros(),
            FixMove::Whole => self.jump,
            FixMove::Share => {
                let span_s = self.t_s - self.since_s;
                if span_s <= 0.0 {
                    return Vector2::zeros();
                }
                self.jump * ((stored_s - self.since_s) / span_s).clamp(0.0, 1.0)
            }
        }
    }
}

/// Number of newest jumps from which the scale is estimated.
const LOOK_BACK: usize = 16;
/// Median of a Rayleigh distribution of scale 1, times √2: the jump between two fixes with independent errors of 1 in
/// each axis.
const MEDIAN_JUMP: f64 = 1.665_109_222_315_395_5;

/// Watches the fixes of a mission.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FixWatch {
    /// Time of the fix before, or of the start; `None` before the first estimate.
    since_s: Option<f64>,
    jumps_m: VecDeque<f64>,
}

impl FixWatch {
    /// Takes in the estimate of a tick; returns a fix if one moved the estimate.
    pub fn observe(&mut self, estimate: &Estimate) -> Option<NavigationFix> {
        let since_s = *self.since_s.get_or_insert(estimate.t_s);
        if estimate.fix_jump == Vector2::zeros() {
            return None;
        }
        self.since_s = Some(estimate.t_s);
        if self.jumps_m.len() == LOOK_BACK {
            self.jumps_m.pop_front();
        }
        self.jumps_m.push_back(estimate.fix_jump.norm());
        Some(NavigationFix { since_s, t_s: estimate.t_s, jump: estimate.fix_jump })
    }

    /// Standard deviation of a fix along one axis, m, from the median of the last 16 jumps; zero if there was no fix.
    pub fn scale_m(&self) -> f64 {
        let mut sorted: Vec<f64> = self.jumps_m.iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        let n = sorted.len();
        match n {
            0 => 0.0,
            _ => (sorted[(n - 1) / 2] + sorted[n / 2]) / 2.0 / MEDIAN_JUMP,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;
    use world::seeds::Stream;

    fn estimate(t_s: f64, jump: Vector2<f64>) -> Estimate {
        let mut e = seen(t_s, Vector2::zeros(), 0.0, None).estimate;
        e.fix_jump = jump;
        e
    }

    #[test]
    fn a_steady_drift_is_taken_out_exactly() {
        // Believed = true + 0.1 m/s east since the fix at 100 s; the next fix comes at 200 s and takes 10 m back.
        let fix = NavigationFix { since_s: 100.0, t_s: 200.0, jump: Vector2::new(-10.0, 0.0) };
        for stored_s in [100.0, 130.0, 199.0, 200.0] {
            let drift = Vector2::new(0.1 * (stored_s - 100.0), 0.0);
            assert!((fix.shift_of(stored_s, FixMove::Share) + drift).norm() < 1e-12);
        }
        // The fix at 100 s has already corrected it.
        assert_eq!(fix.shift_of(99.0, FixMove::Share), Vector2::zeros());
        assert_eq!(fix.shift_of(99.0, FixMove::Whole), fix.jump);
        assert_eq!(fix.shift_of(150.0, FixMove::Stay), Vector2::zeros());
        let at_once = NavigationFix { since_s: 200.0, ..fix };
        assert_eq!(at_once.shift_of(200.0, FixMove::Share), Vector2::zeros());
    }

    #[test]
    fn drift_counts_from_the_start_and_then_from_the_fix_before() {
        let mut w = FixWatch::default();
        assert_eq!(w.observe(&estimate(5.0, Vector2::zeros())), None);
        let first = w.observe(&estimate(35.0, Vector2::x())).expect("it jumped");
        assert_eq!((first.since_s, first.t_s), (5.0, 35.0));
        assert_eq!(w.observe(&estimate(36.0, Vector2::zeros())), None);
        let second = w.observe(&estimate(65.0, Vector2::y())).expect("it jumped");
        assert_eq!((second.since_s, second.jump), (35.0, Vector2::y()));
    }

    #[test]
    fn scale_of_independent_fixes() {
        let mut w = FixWatch::default();
        assert_eq!(w.scale_m(), 0.0);
        let mut rng = Stream::new(1, "fixes", "test");
        let (mut last, mut scales) = (Vector2::zeros(), Vec::new());
        for k in 0..4000 {
            let fix = Vector2::new(rng.normal(), rng.normal()) * 5.0;
            w.observe(&estimate(f64::from(k), fix - last));
            last = fix;
            if k % 20 == 19 {
                scales.push(w.scale_m());
            }
        }
        // 200 estimates that share no jump: their mean is 5 m to five standard errors, and a median of 16 is off by
        // 1 / (2 · 16 · f(m) m) of itself in the mean at most, 5 % (f(m) m = 0.69 for a Rayleigh distribution).
        let n = scales.len() as f64;
        let mean = scales.iter().sum::<f64>() / n;
        let var = scales.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (n - 1.0);
        assert!((mean - 5.0).abs() < 5.0 * (var / n).sqrt() + 0.25, "{mean}, {var}");
    }
}
