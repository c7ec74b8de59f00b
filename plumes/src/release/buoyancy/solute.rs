//! What can be dissolved in a release, and the volume that it takes there.
//!
//! *Source*: apparent molar volumes at 20 °C. Sodium chloride: 16.35 + 1.87 c^½ cm³/mol (c in mol/L), the form of
//! Redlich & Meyer 1964, Chem. Rev. 64, 221, through the densities of the CRC Handbook of Chemistry and Physics
//! ("Concentrative properties of aqueous solutions"), within 0.1 cm³/mol up to 10 %. Ethanol: densities of OIML R 22
//! (1975), its formula at 20 °C. 2-Propanol: International Critical Tables 3 (1928), 120, smoothed; within 0.4 kg/m³ of
//! Lebo 1921, J. Am. Chem. Soc. 43, 1005. Dye: the volume of the solid, sodium fluorescein of 1.6 g/cm³.
//!
//! *Parameters*: none.
//!
//! *Deviations*: what is dissolved together does not act on each other's volume: for salt and alcohol an interaction of
//! 0.25 cm³ kg/mol² would lessen the final buoyancy by about 2 of 7 kg/m³. Volumes at 20 °C are used at all
//! temperatures.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A dissolved substance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Solute {
    /// Sodium chloride, NaCl.
    SodiumChloride,
    /// 2-Propanol, C3H8O.
    Propanol,
    /// Ethanol, C2H6O.
    Ethanol,
    /// A fluorescent dye.
    Dye,
}

/// Apparent specific volume of 2-propanol in water (cm³/g) by its mass fraction of both.
const PROPANOL: [(f64, f64); 9] = [
    (0.00, 1.1886),
    (0.01, 1.1890),
    (0.02, 1.1885),
    (0.045, 1.1846),
    (0.08, 1.1725),
    (0.11, 1.1624),
    (0.15, 1.1545),
    (0.19, 1.1505),
    (0.30, 1.1560),
];

impl Solute {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::SodiumChloride, Self::Propanol, Self::Ethanol, Self::Dye];

    /// Most of it in a litre of solution, g: the end of its table.
    pub(super) const fn most_g_l(self) -> f64 {
        match self {
            Self::SodiumChloride => 300.0,
            Self::Propanol => 280.0,
            Self::Ethanol => 600.0,
            Self::Dye => 50.0,
        }
    }

    /// Volume of a gram of it, cm³, where a litre of solution holds `g_l` of it beside `water_g_l` of water.
    pub(super) fn volume_cm3_g(self, g_l: f64, water_g_l: f64) -> f64 {
        let part = g_l / (g_l + water_g_l);
        match self {
            Self::SodiumChloride => {
                const MOLAR_G: f64 = 58.443;
                (16.35 + 1.87 * (g_l / MOLAR_G).sqrt()) / MOLAR_G
            }
            Self::Propanol => between(&PROPANOL, part),
            Self::Ethanol => ethanol(part),
            Self::Dye => 1.0 / 1.6,
        }
    }
}

fn between(table: &[(f64, f64)], x: f64) -> f64 {
    let n = table.partition_point(|(at, _)| *at <= x);
    let (below, above) = (table[n.max(1) - 1], table[n.clamp(1, table.len() - 1)]);
    if above.0 <= below.0 {
        return below.1;
    }
    below.1 + (above.1 - below.1) * (x - below.0) / (above.0 - below.0)
}

/// Apparent specific volume of ethanol by its mass fraction, cm³/g.
fn ethanol(part: f64) -> f64 {
    const A: [f64; 12] = [
        998.201_23,
        -192.976_949_5,
        389.123_895_8,
        -1_668.103_923,
        13_522.154_41,
        -88_292.783_88,
        306_287.404_2,
        -613_838.123_4,
        747_017.299_8,
        -547_846.135_4,
        223_446.033_4,
        -39_032.854_26,
    ];
    // At no ethanol at all the quotient below is 0/0; a thousandth of a per cent is near enough.
    let part = part.max(1e-5);
    let density = A.iter().rev().fold(0.0, |sum, a| sum * part + a);
    1e3 * (1.0 / density - (1.0 - part) / A[0]) / part
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 000 g of a solution of this mass fraction, from the volumes of its parts.
    fn density(solute: Solute, part: f64) -> f64 {
        let water = 1.0 - part;
        let (mut litre, mut volume) = (1e3, 1.0);
        for _ in 0..50 {
            volume = water / 0.998_203 + part * solute.volume_cm3_g(litre * part, litre * water);
            litre = 1e3 / volume;
        }
        1e3 / volume
    }

    #[test]
    fn volumes_give_back_the_densities_of_the_handbooks() {
        use Solute::{Ethanol, Propanol, SodiumChloride};
        for (solute, part, want, within) in [
            (SodiumChloride, 0.01, 1005.3, 0.2),
            (SodiumChloride, 0.05, 1034.0, 0.2),
            (SodiumChloride, 0.10, 1070.7, 0.3),
            (Ethanol, 0.10, 981.87, 0.05),
            (Ethanol, 0.50, 913.77, 0.05),
            (Propanol, 0.05, 989.0, 0.7),
            (Propanol, 0.10, 982.0, 0.7),
            (Propanol, 0.20, 969.6, 0.7),
        ] {
            let got = density(solute, part);
            assert!((got - want).abs() < within, "{solute:?} {part}: {got}");
        }
        assert!((ethanol(1.0) - 1e3 / 789.24).abs() < 1e-3);
    }
}
