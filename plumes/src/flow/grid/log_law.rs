//! The current between a rough bed and the lowest level above it: logarithmic, not linear.
//!
//! *Source*: law of the wall, as `flow::bed`.
//!
//! *Parameters*: the bed's roughness and the height at which the law ends, m.
//!
//! *Deviations*: none: where the free current is the same at all heights of the cell, this is the law itself.

use crate::logarithm::ln;

/// The law in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LogLaw {
    /// Reciprocal of the roughness, 1/m.
    per_m: f32,
    top_m: f32,
    /// Least height of the law's top, m.
    least_top_m: f32,
}

impl LogLaw {
    pub(crate) fn new([roughness_m, top_m]: [f64; 2]) -> Self {
        Self { per_m: (1.0 / roughness_m) as f32, top_m: top_m as f32, least_top_m: (3.0 * roughness_m) as f32 }
    }

    /// What a part of the lowest cell's height lacks to the part of the current above that flows there. The cell is
    /// `high_m` high, in water `depth_m` deep.
    #[inline(always)]
    pub(crate) fn extra(&self, part: f32, high_m: f32, depth_m: f32) -> f32 {
        let least = |a: f32, b: f32| if a < b { a } else { b };
        let most = |a: f32, b: f32| if a > b { a } else { b };
        let top = most(least(self.top_m, depth_m), self.least_top_m);
        let here = ln(most(part * high_m * self.per_m, 1.0), 0);
        // Not zero, should the whole cell lie in the roughness.
        let there = most(ln(most(least(top, high_m) * self.per_m, 1.0), 0), 1e-6);
        least(here / there, 1.0) - part
    }
}
