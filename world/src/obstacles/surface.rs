//! How an obstacle's surface looks and sounds: how it reflects light and sound.

use crate::ranges::{Finite, Fraction};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Optical and acoustic properties of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Surface {
    /// Share of red, green and blue light that is reflected, equally in all directions.
    pub albedo: (Fraction, Fraction, Fraction),
    /// Backscatter strength per square metre at a grazing angle of 90°, dB.
    #[serde(with = "crate::limits::level_db")]
    pub backscatter_db: Finite,
}

impl Default for Surface {
    /// Grey rock: a fifth of the light, -10 dB (APL-UW High-Frequency Ocean Environmental Acoustic Models Handbook
    /// 1994, section IV: rough rock at tens of kHz and above has -7 to -13 dB at steep angles).
    fn default() -> Self {
        let fifth = || Fraction::new(0.2);
        Self { albedo: (fifth(), fifth(), fifth()), backscatter_db: Finite::new(-10.0) }
    }
}
