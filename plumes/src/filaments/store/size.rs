//! How a filament grows with its age.
//!
//! *Source*: Farrell, Murlis, Long, Li & Cardé 2002, Environ. Fluid Mech. 2, 143: R² = R0² + γt. Where eddies are
//! resolved down to a size l: dR²/dt = 2K(R/l)^(4/3), the 4/3 law of Richardson 1926, Proc. R. Soc. A 110, 709, that is
//! R^(2/3) = R0^(2/3) + ⅔ K l^(−4/3) t, with K the diffusivity of the eddies below l.
//!
//! *Parameters*: `initial_size_m` R0 (m), `growth_m2_s` γ (m²/s), `vertical_size_limit_m` (m); `eddy_size_m` l (m),
//! with K from the water at the source.
//!
//! *Deviations*: R is the standard deviation of the kernel exp(−r²/2R²)/((2π)^{3/2}R³), which integrates to 1 (the
//! printed form exp(−r²/R²)/(√(8π³)R³) integrates to 0.3536). It is computed from the age, never accumulated. The
//! vertical size stops at the limit, and at half the local depth, because no eddy is larger. With resolved eddies,
//! growth ends at l, below which no structure is claimed. The part of K that makes a filament grow does not kick it:
//! growth and kicks together always amount to K.

use crate::release::ReleaseSpec;
use world::math;

/// Growth law of one source's filaments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    r0_squared: f64,
    growth: f64,
    vertical_limit: f32,
    eddies: Option<InEddies>,
}

/// Growth by the eddies smaller than the filament; lengths to the power 2/3.
#[derive(Clone, Copy, Debug, PartialEq)]
struct InEddies {
    start: f64,
    end: f64,
    per_s: f64,
}

impl Size {
    pub(crate) fn new(release: &ReleaseSpec) -> Self {
        let r0 = release.initial_size_m.get();
        let power = |length: f64| math::powf(length, 2.0 / 3.0);
        Self {
            r0_squared: r0 * r0,
            growth: release.growth_m2_s.get(),
            vertical_limit: release.vertical_size_limit_m.map_or(f32::MAX, |v| v.get() as f32),
            eddies: release.eddy_size_m.map(|l| InEddies {
                start: power(r0),
                end: power(l.get()).max(power(r0)),
                per_s: 0.0,
            }),
        }
    }

    /// Takes the diffusivity of the eddies that are not resolved, m²/s.
    pub(crate) fn stirred_by(&mut self, k_m2_s: f64) {
        if let Some(e) = &mut self.eddies {
            e.per_s = 2.0 / 3.0 * k_m2_s / (e.end * e.end);
        }
    }

    /// What [`Self::stirred_by`] has made of the newest diffusivity; the rest follows from the release.
    pub(crate) fn stirred(&self) -> Option<f64> {
        let Self { r0_squared: _, growth: _, vertical_limit: _, eddies } = self;
        eddies.map(|e| e.per_s)
    }

    /// Takes over what [`Self::stirred`] told of the same release.
    pub(crate) fn stir(&mut self, stirred: Option<f64>) {
        if let (Some(e), Some(per_s)) = (&mut self.eddies, stirred) {
            e.per_s = per_s;
        }
    }

    /// Whether growth takes a part of the diffusivity from the kicks.
    pub(crate) fn shares(&self) -> bool {
        self.eddies.is_some()
    }

    /// Whether a filament of this age (s) has reached the size at which it stops growing.
    pub(crate) fn is_grown(&self, age_s: f64) -> bool {
        (self.eddies).is_some_and(|e| e.start + e.per_s * age_s.max(0.0) >= e.end)
    }

    /// Part of the diffusivity that kicks a filament of this age (s).
    #[inline]
    pub(crate) fn kicked(&self, age_s: f64) -> f32 {
        self.eddies.map_or(1.0, |e| {
            let s = (e.start + e.per_s * age_s.max(0.0)) / e.end;
            if s < 1.0 { (1.0 - s * s) as f32 } else { 1.0 }
        })
    }

    /// Horizontal size at an age (s), m.
    #[inline]
    pub(crate) fn horizontal(&self, age_s: f64) -> f32 {
        if let Some(e) = &self.eddies {
            let s = (e.start + e.per_s * age_s.max(0.0)).min(e.end);
            return (s * s.sqrt()) as f32;
        }
        (self.r0_squared + self.growth * age_s.max(0.0)).sqrt() as f32
    }

    /// Vertical size, m, of a filament of this horizontal size over a bed at `bed` (m, negative).
    #[inline]
    pub(crate) fn vertical(&self, horizontal: f32, bed: f32) -> f32 {
        horizontal.min(self.vertical_limit).min(-0.5 * bed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::ranges::Positive;

    /// Variance from growth and kicks together grows by 2K per second at any age.
    #[test]
    fn growth_and_kicks_share_the_eddies() {
        let (k, l) = (1e-5, 0.008);
        let mut size = Size::new(&ReleaseSpec {
            initial_size_m: Positive::new(0.001),
            eddy_size_m: Some(Positive::new(l)),
            ..ReleaseSpec::default()
        });
        size.stirred_by(k);
        let variance = |t: f64| f64::from(size.horizontal(t)) * f64::from(size.horizontal(t));
        let dt = 0.01;
        // Up to the age at which the filament is as large as l: (l^(2/3) − R0^(2/3)) / (2K/3 l^(−4/3)) = 7.2 s.
        for n in 1..700 {
            let t = f64::from(n) * dt;
            let grown = (variance(t + dt) - variance(t - dt)) / (2.0 * dt);
            let kicked = 2.0 * k * f64::from(size.kicked(t));
            // R in f32: R² has an error of 2e-7 of 6e-5 at worst, over 0.02 s.
            assert!(((grown + kicked) / (2.0 * k) - 1.0).abs() < 1e-4, "{t}");
        }
        assert!((f64::from(size.horizontal(8.0)) - l).abs() < 1e-8);
        assert_eq!(size.kicked(8.0), 1.0);
    }
}
