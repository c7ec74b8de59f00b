//! How long a condition has held without a break.
//!
//! *Source*: plain bookkeeping, used by rules of several sources.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

/// Since when a condition holds.
#[derive(Clone, Debug, Default)]
pub(super) struct HeldCondition {
    since_s: Option<f64>,
}

impl HeldCondition {
    /// Tells whether the condition holds at `t_s` and has held since at least `for_s` before, both in s.
    pub(super) fn for_s(&mut self, holds: bool, t_s: f64, for_s: f64) -> bool {
        if !holds {
            self.since_s = None;
            return false;
        }
        t_s - *self.since_s.get_or_insert(t_s) >= for_s
    }
}
