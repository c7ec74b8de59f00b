//! How fast turbulence mixes: parabolic where the bed drives it, damped by stratification.
//!
//! *Source*: K_z = κ u_* z′(1 − z′/h), h the depth of the stream, Elder 1959, J. Fluid Mech. 5, 544 (depth mean κu_*H/6
//! = 0.067 u_*H); damping (1 + 10/3 Ri)^(−3/2) of the diffusivity, Munk & Anderson 1948, J. Mar. Res. 7, 276;
//! transverse K = 0.15 u_*H, Fischer et al. 1979, Mixing in Inland and Coastal Waters, section 5.1.
//!
//! *Parameters*: `horizontal_m2_s` and `background_vertical_m2_s` (m²/s), added everywhere; `transverse`, times u_*H,
//! added to the horizontal one (Fischer 0.15; 0 omits it). κ = 0.4.
//!
//! *Deviations*: in layered water h ends at the lowest interface across which the density changes. Eddies of the bed do
//! not stir what lies above it; only the background is left there (no wind is modelled). Ri = N²/S², with N² and the
//! shear of the layers. The shear of the bed's stream, u_*/(κz′), is added to S² as a square, so that Ri stays finite
//! in the tails of an interface. A column without bed friction has only the constants.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::NonNegative;
use world::units::GRAVITY_M_S2;

use crate::flow::bed::KARMAN;

/// Diffusivities that are given, and coefficients of those that are derived.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MixingSpec {
    /// Horizontal diffusivity everywhere, m²/s.
    #[serde(with = "world::limits::diffusivity_m2_s")]
    pub horizontal_m2_s: NonNegative,
    /// Vertical diffusivity added everywhere, m²/s.
    #[serde(with = "world::limits::vertical_m2_s")]
    pub background_vertical_m2_s: NonNegative,
    /// Horizontal diffusivity by bed friction, in units of u_*H.
    #[serde(with = "world::limits::transverse")]
    pub transverse: NonNegative,
}

impl Default for MixingSpec {
    fn default() -> Self {
        Self {
            horizontal_m2_s: NonNegative::new(0.0),
            background_vertical_m2_s: NonNegative::new(0.0),
            transverse: NonNegative::new(0.0),
        }
    }
}

/// Vertical diffusivity of a neutral stream of depth `reach_m` at a height above the bed, m²/s.
pub fn parabolic(u_star_m_s: f64, height_m: f64, reach_m: f64) -> f64 {
    let s = (height_m / reach_m).clamp(0.0, 1.0);
    KARMAN * u_star_m_s * reach_m * s * (1.0 - s)
}

/// Gradient Richardson number of a density gradient (kg/m⁴) in a squared shear (1/s²).
pub fn richardson(drho_dz: f64, density_kg_m3: f64, shear2: f64) -> f64 {
    let n2 = (-GRAVITY_M_S2 * drho_dz / density_kg_m3).max(0.0);
    // A minimum shear keeps the result finite in still, stratified water.
    n2 / shear2.max(1e-12)
}

/// Part of the neutral diffusivity that is left at a gradient Richardson number.
pub fn damping(ri: f64) -> f64 {
    let x = 1.0 + 10.0 / 3.0 * ri;
    1.0 / (x * x.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_mixes_at_bed_and_surface_and_beyond() {
        for height in [0.0, -1.0, 0.2, 0.4] {
            assert_eq!(parabolic(0.0028, height, 0.2), 0.0, "{height}");
        }
    }

    #[test]
    fn stratification_damps() {
        assert_eq!(damping(0.0), 1.0);
        // Ri = 0.9: (1 + 3)^(−3/2) = 1/8.
        assert!((damping(0.9) - 0.125).abs() < 1e-12);
        // 2 kg/m³ over 1 m in a shear of 0.2 1/s: 9.81·2/1000/0.04.
        assert!((richardson(-2.0, 1000.0, 0.04) - 0.4905).abs() < 1e-9);
        assert_eq!(richardson(1.0, 1000.0, 0.04), 0.0);
    }
}
