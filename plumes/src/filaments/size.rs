//! How a filament grows with its age.
//!
//! *Source*: Farrell, Murlis, Long, Li & Cardé 2002, Environ. Fluid Mech. 2, 143: R² = R0² + γt.
//!
//! *Parameters*: `initial_size_m` R0 (m), `growth_m2_s` γ (m²/s), `vertical_size_limit_m` (m).
//!
//! *Deviations*: R is the standard deviation of the kernel exp(−r²/2R²)/((2π)^{3/2}R³), which integrates to 1
//! (the printed form exp(−r²/R²)/(√(8π³)R³) integrates to 0.3536). Computed from the age, never added up.
//! The vertical size stops at the limit, and at half the local depth: no eddy is larger than that.

use crate::release::ReleaseSpec;

/// Growth law of one source's filaments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Size {
    r0_squared: f64,
    growth: f64,
    vertical_limit: f32,
}

impl Size {
    pub(super) fn new(release: &ReleaseSpec) -> Self {
        let r0 = release.initial_size_m.get();
        Self {
            r0_squared: r0 * r0,
            growth: release.growth_m2_s.get(),
            vertical_limit: release
                .vertical_size_limit_m
                .map_or(f32::MAX, |v| v.get() as f32),
        }
    }

    /// Horizontal size at an age (s), m.
    #[inline]
    pub(super) fn horizontal(&self, age_s: f64) -> f32 {
        (self.r0_squared + self.growth * age_s.max(0.0)).sqrt() as f32
    }

    /// Vertical size of a filament of this horizontal size over a bed at `bed` (m, negative), m.
    #[inline]
    pub(super) fn vertical(&self, horizontal: f32, bed: f32) -> f32 {
        horizontal.min(self.vertical_limit).min(-0.5 * bed)
    }
}
