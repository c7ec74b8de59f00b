//! Rhodamine in the water: takes up green light and glows red and orange in its place.
//!
//! *Source:* rhodamine B, molar extinction 106 000 L/(mol cm) at its peak (Du, Fuh, Li, Corkan & Lindsey 1998, Photochem. Photobiol.
//! 68, 141), molar mass 479 g/mol: 51 000 m²/kg to base e; quantum yield in water 0.31 (Magde, Rojas & Seybold 1999,
//! Photochem. Photobiol. 70, 737). In water it absorbs about 554 nm with a shoulder near 520 nm and glows about 580 nm;
//! rhodamine WT, made from it, does so within a few nanometres (Smart & Laidlaw 1977, Water Resour. Res. 13, 15).
//!
//! *Parameters:* `absorption_m2_kg` at the peak 51 000; `quantum_yield` 0.31; `scattering_m2_kg` 0: what is dissolved does not
//! scatter; greater for a dye given off with milk or starch.
//!
//! *Deviations:* lines as Gaussians: 554 nm and a third of it at 520 nm, each 40 nm wide; glow 580 nm, 45 nm wide. No quenching in
//! strong solution; what glows is not taken up and given off again.

use super::bands::{Rgb, WIDTH_NM, band_mean, each};
use serde::{Deserialize, Serialize};
use std::f64::consts::{LN_2, PI};
use world::ranges::{Fraction, NonNegative};

/// Peak, width, height of the lines that absorb.
const ABSORBS: [(f64, f64, f64); 2] = [(554.0, 40.0, 1.0), (520.0, 40.0, 0.33)];
/// Peak and width of the glow, nm.
const GLOWS: (f64, f64) = (580.0, 45.0);

/// What a scenario may say of the dye's looks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DyeSpec {
    /// Absorption at the peak to base e, m²/kg.
    pub absorption_m2_kg: NonNegative,
    /// Photons given off for one taken up.
    pub quantum_yield: Fraction,
    /// Scattering, evenly to all sides, m²/kg.
    pub scattering_m2_kg: NonNegative,
}

impl Default for DyeSpec {
    fn default() -> Self {
        Self {
            absorption_m2_kg: NonNegative::new(51_000.0),
            quantum_yield: Fraction::new(0.31),
            scattering_m2_kg: NonNegative::new(0.0),
        }
    }
}

/// Optical properties of a kilogram of dye in a cubic metre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dye {
    /// Absorption by colour, m²/kg.
    pub absorption: Rgb,
    /// Scattering, m²/kg.
    pub scattering: f64,
    /// `glow[i][j]`: light of colour `i` given off for light of colour `j`, m²/kg.
    pub glow: [Rgb; 3],
}

impl Dye {
    /// The dye of a specification.
    #[must_use]
    pub fn new(spec: &DyeSpec) -> Self {
        let peak = spec.absorption_m2_kg.get();
        let absorption = each(|i| {
            let lines = ABSORBS.map(|(nm, width, height)| height * band_mean(i, nm, width));
            peak * lines.iter().sum::<f64>()
        });
        // A glow of one photon a nanometre-wide share of daylight, spread over its line: its part in each band.
        let area = |width: f64| width * (PI / (4.0 * LN_2)).sqrt();
        let part = each(|i| area(WIDTH_NM) * band_mean(i, GLOWS.0, GLOWS.1) / area(GLOWS.1));
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
    fn it_takes_green_and_gives_red() {
        let dye = Dye::new(&DyeSpec::default());
        let [r, g, b] = dye.absorption;
        assert!(g > 3.0 * r && r > b, "{:?}", dye.absorption);
        assert!(dye.glow[0][1] > dye.glow[1][1] && dye.glow[1][1] > 10.0 * dye.glow[2][1]);
    }

    #[test]
    fn it_gives_no_more_than_it_takes() {
        // Bands overlap, so the shares of a line in them add up to more than one; over bands side by side to less.
        let dye = Dye::new(&DyeSpec {
            quantum_yield: Fraction::new(1.0),
            ..DyeSpec::default()
        });
        for j in 0..3 {
            let given: f64 = (0..3).map(|i| dye.glow[i][j]).sum();
            assert!(given < 1.2 * dye.absorption[j], "{given}");
        }
    }
}
