//! Rhodamine in the water: absorbs green light and fluoresces red and orange.
//!
//! *Source:* rhodamine B, molar extinction 106 000 L/(mol cm) at its peak (Du, Fuh, Li, Corkan & Lindsey 1998,
//! Photochem. Photobiol. 68, 141), molar mass 479 g/mol: 51 000 m²/kg to base e; quantum yield in water 0.31 (Magde,
//! Rojas & Seybold 1999, Photochem. Photobiol. 70, 737). In water it absorbs about 554 nm with a shoulder near 520 nm
//! and fluoresces about 580 nm; rhodamine WT, which is made from it, agrees within a few nanometres (Smart & Laidlaw
//! 1977, Water Resour. Res. 13, 15).
//!
//! *Parameters:* `absorption_m2_kg` at the peak 51 000; `quantum_yield` 0.31; `scattering_m2_kg` 0, because dissolved
//! dye does not scatter; greater for a dye released with milk or starch.
//!
//! *Deviations:* lines are Gaussians: 554 nm and a third of it at 520 nm, each 40 nm wide; fluorescence 580 nm, 45 nm
//! wide. There is no quenching in strong solution, and fluorescent light is not absorbed and emitted again.

use super::bands::{N, Spectrum, each, line};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{Fraction, NonNegative};

/// Peak, width and height of the absorption lines.
const ABSORBS: [(f64, f64, f64); 2] = [(554.0, 40.0, 1.0), (520.0, 40.0, 0.33)];
/// Peak and width of the fluorescence, nm.
const GLOWS: (f64, f64) = (580.0, 45.0);

/// Optical parameters of the dye.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DyeSpec {
    /// Absorption at the peak to base e, m²/kg.
    #[default(NonNegative::new(51_000.0))]
    pub absorption_m2_kg: NonNegative,
    /// Photons emitted per absorbed photon.
    #[default(Fraction::new(0.31))]
    pub quantum_yield: Fraction,
    /// Scattering, the same in all directions, m²/kg.
    #[default(NonNegative::new(0.0))]
    pub scattering_m2_kg: NonNegative,
}

/// Optical properties of a kilogram of dye in a cubic metre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dye {
    /// Absorption by colour, m²/kg.
    pub absorption: Spectrum,
    /// Scattering, m²/kg.
    pub scattering: f64,
    /// `glow[i][j]`: light of colour `i` emitted for light of colour `j`, m²/kg.
    pub glow: [Spectrum; N],
}

impl Dye {
    /// The dye of a specification.
    pub fn new(spec: &DyeSpec) -> Self {
        let peak = spec.absorption_m2_kg.get();
        let lines = ABSORBS.map(|(nm, width, height)| line(nm, width).map(|v| height * v));
        let absorption = each(|i| peak * lines.iter().map(|l| l[i]).sum::<f64>());
        // An emitted photon gets a wavelength in proportion to the line's share in each.
        let glows = line(GLOWS.0, GLOWS.1);
        let all: f64 = glows.iter().sum();
        let part = glows.map(|g| g / all);
        Self {
            absorption,
            scattering: spec.scattering_m2_kg.get(),
            glow: part.map(|part| each(|j| spec.quantum_yield.get() * absorption[j] * part)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_takes_green_and_gives_orange() {
        let dye = Dye::new(&DyeSpec::default());
        let a = dye.absorption;
        assert!(a[4] > a[3] && a[3] > 3.0 * a[5] && a[5] > a[1], "{a:?}");
        // What it absorbs at 530 nm returns at 565 and 600 nm.
        assert!(dye.glow[4][3] > 5.0 * dye.glow[3][3] && dye.glow[5][3] > 5.0 * dye.glow[6][3]);
    }

    #[test]
    fn it_gives_as_many_photons_as_it_is_said_to() {
        let dye = Dye::new(&DyeSpec::default());
        for j in 0..N {
            let given: f64 = (0..N).map(|i| dye.glow[i][j]).sum();
            let want = 0.31 * dye.absorption[j];
            assert!((given - want).abs() <= 1e-12 * want, "{given} {want}");
        }
    }
}
