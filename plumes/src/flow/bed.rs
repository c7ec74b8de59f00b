//! The boundary layer over a rough bed: the logarithmic law.
//!
//! *Source*: law of the wall, Schlichting, Boundary-Layer Theory, ch. 17; for the sea bed Soulsby 1997,
//! Dynamics of Marine Sands, eq. 22: u(z′) = (u_*/κ) ln(z′/z0).
//!
//! *Parameters*: z0 `roughness_m` (m; 0.001 rippled sand, Soulsby table 7 within a factor of a few),
//! δ `thickness_m` (m). Von Kármán's κ = 0.4.
//!
//! *Deviations*: the law multiplies the current that flows above, u(z′) = U ln(z′/z0)/ln(δ/z0) below δ, so that the
//! free current is reached at δ; in water shallower than δ it is reached at the surface. Zero below z0.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::math;
use world::ranges::Positive;

use crate::error::PlumeError;
use crate::flow::number::Number;

/// Von Kármán's constant.
pub const KARMAN: f64 = 0.4;

/// A rough bed under the currents.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BedSpec {
    /// Height at which the law reaches zero, m.
    #[serde(with = "world::limits::roughness_m")]
    pub roughness_m: Positive,
    /// Height at which it reaches the free current, m.
    #[serde(with = "world::limits::depth_m")]
    pub thickness_m: Positive,
}

impl BedSpec {
    /// The boundary layer, checked.
    ///
    /// # Errors
    /// If the roughness is not well below the thickness.
    pub fn build(&self, field: &str) -> Result<BoundaryLayer, PlumeError> {
        let (z0, delta) = (self.roughness_m.get(), self.thickness_m.get());
        if delta < 3.0 * z0 {
            let problem = format!("must be > 0 and at most a third of thickness_m ({delta}), got {z0}");
            return Err(PlumeError::new(format!("{field}.roughness_m"), problem));
        }
        Ok(BoundaryLayer::new(z0, delta))
    }
}

/// The logarithmic law, ready to use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryLayer {
    z0: f64,
    delta: f64,
    /// The top in deep water, m, and the logarithm of its height in units of the roughness.
    deep: (f64, f64),
}

impl BoundaryLayer {
    fn new(z0: f64, delta: f64) -> Self {
        let top = delta.max(3.0 * z0);
        Self { z0, delta, deep: (top, math::ln(top / z0)) }
    }

    /// ln(top/z0).
    fn ln_top<N: Number>(&self, top_m: N) -> N {
        let (deep_m, ln_deep) = self.deep;
        if top_m.value() == deep_m { ln_deep.into() } else { (top_m / self.z0).ln() }
    }

    /// Height at which the free current is reached in water of this depth, m.
    pub fn top<N: Number>(&self, depth_m: N) -> N {
        let top = N::from(self.delta).least(depth_m);
        top.greatest(N::from(3.0 * self.z0))
    }

    /// Roughness and height of the law, m.
    pub(super) fn scales_m(&self) -> [f64; 2] {
        [self.z0, self.delta]
    }

    /// Part of the free current that is left at a height above the bed.
    pub fn factor<N: Number>(&self, height_m: N, depth_m: N) -> N {
        let top = self.top(depth_m);
        if height_m.value() >= top.value() {
            1.0.into()
        } else if height_m.value() <= self.z0 {
            0.0.into()
        } else {
            (height_m / self.z0).ln() / self.ln_top(top)
        }
    }

    /// Friction velocity u_*, m/s, under a free current of this speed.
    pub fn friction_velocity(&self, free_speed_m_s: f64, depth_m: f64) -> f64 {
        KARMAN * free_speed_m_s / self.ln_top(self.top(depth_m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer() -> BoundaryLayer {
        BedSpec { roughness_m: Positive::new(0.001), thickness_m: Positive::new(1.0) }.build("water.bed").unwrap()
    }

    #[test]
    fn log_law_has_its_values() {
        let l = layer();
        // ln(10)/ln(1000) = 1/3, ln(100)/ln(1000) = 2/3.
        assert!((l.factor(0.01, 5.0) - 1.0 / 3.0).abs() < 1e-12);
        assert!((l.factor(0.1, 5.0) - 2.0 / 3.0).abs() < 1e-12);
        assert_eq!(l.factor(1.0, 5.0), 1.0);
        assert_eq!(l.factor(0.0005, 5.0), 0.0);
        // In half a metre of water the free current is reached at the surface.
        assert_eq!(l.factor(0.5, 0.5), 1.0);
    }

    #[test]
    fn friction_velocity_gives_the_profile_back() {
        let l = layer();
        let u_star = l.friction_velocity(0.3, 5.0);
        let u = u_star / KARMAN * math::ln(0.2 / 0.001);
        assert!((u - 0.3 * l.factor(0.2, 5.0)).abs() < 1e-12);
    }
}
