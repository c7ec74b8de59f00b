//! Absorption and scattering of sea water, from pure water to that of turbid harbours: Jerlov's optical water types.
//!
//! *Source:* types IB to 5C as measured: Williamson & Hollins 2022, Appl. Opt. 61, 9951, "Measured IOPs of Jerlov
//! water types"; types 7C and 9C, for which there are no measurements, by inversion of K_d: Solonenko & Mobley 2015,
//! Appl. Opt. 54, 5392, table 7. Both read from a secondary source: jerlov 0.22.0 (PyPI), `williamson2022_iop.csv`
//! and `solonenko2015_iop.csv`, the latter interpolated linearly between its steps of 25 nm. Pure water: absorption
//! Pope & Fry 1997, Appl. Opt. 36, 8710, table 3, read from three transcriptions that agree; scattering of sea water
//! Morel 1974 (Mobley 1994, Light and Water, section 3.8): 0.00758/m (400 nm/λ)^4.32.
//!
//! *Parameters:* none; the water is found by its beam attenuation c at 530 nm.
//!
//! *Deviations:* between two types, the water is their mixture with that c; water clearer than IB is a mixture with
//! pure sea water, and water murkier than 9C has more of what 9C has besides pure water. That the visibility
//! determines the type is a simplification: yellow matter and particles vary independently. Between type 5C and 7C it
//! changes from measured to inverted values, whose scattering is less certain.

use super::bands::{GREEN, NM, Spectrum, each};
use world::math;

/// Absorption of pure water.
const PURE: Spectrum = [0.00478, 0.00979, 0.0173, 0.0434, 0.0642, 0.2224, 0.3012, 0.439];

/// Absorption and scattering of types IB, II, III, 1C, 3C, 5C, 7C, 9C, 1/m.
pub(super) const TYPES: [(&str, Spectrum, Spectrum); 8] = [
    (
        "IB",
        [0.0428, 0.0390, 0.0380, 0.0519, 0.0763, 0.227, 0.306, 0.417],
        [0.139, 0.133, 0.128, 0.124, 0.121, 0.118, 0.115, 0.113],
    ),
    (
        "II",
        [0.0686, 0.0588, 0.0520, 0.0607, 0.0822, 0.231, 0.309, 0.422],
        [0.202, 0.193, 0.186, 0.180, 0.174, 0.170, 0.166, 0.162],
    ),
    (
        "III",
        [0.125, 0.104, 0.0847, 0.0806, 0.0944, 0.241, 0.321, 0.445],
        [0.316, 0.307, 0.298, 0.291, 0.284, 0.278, 0.273, 0.268],
    ),
    (
        "1C",
        [0.171, 0.137, 0.106, 0.0948, 0.103, 0.248, 0.329, 0.461],
        [0.464, 0.452, 0.442, 0.432, 0.423, 0.416, 0.408, 0.402],
    ),
    (
        "3C",
        [0.228, 0.186, 0.147, 0.128, 0.127, 0.268, 0.350, 0.493],
        [0.699, 0.681, 0.666, 0.652, 0.639, 0.627, 0.617, 0.607],
    ),
    ("5C", [0.395, 0.283, 0.205, 0.169, 0.150, 0.285, 0.373, 0.545], [1.29, 1.26, 1.23, 1.21, 1.18, 1.16, 1.14, 1.12]),
    ("7C", [0.753, 0.480, 0.310, 0.225, 0.183, 0.301, 0.381, 0.528], [3.63, 3.18, 2.81, 2.50, 2.25, 2.03, 1.84, 1.68]),
    ("9C", [1.242, 0.849, 0.576, 0.414, 0.314, 0.390, 0.444, 0.574], [4.84, 4.24, 3.74, 3.33, 2.98, 2.69, 2.45, 2.23]),
];

/// Absorption and scattering of pure sea water, 1/m.
pub(super) fn pure() -> (Spectrum, Spectrum) {
    let scatters = each(|i| 16.06 * 4.72e-4 * math::powf(400.0 / NM[i], 4.32));
    (PURE, scatters)
}

/// Absorption and scattering, 1/m, of the water whose beam attenuation at 530 nm is `c`; not below that of pure sea
/// water.
pub(super) fn of_attenuation(c: f64) -> (Spectrum, Spectrum) {
    let at = |w: &(Spectrum, Spectrum)| w.0[GREEN] + w.1[GREEN];
    let mut below = pure();
    let mut above = below;
    for (k, (_, a, b)) in TYPES.iter().enumerate() {
        above = (*a, *b);
        if c <= at(&above) || k + 1 == TYPES.len() {
            break;
        }
        below = above;
    }
    if c > at(&above) {
        // Murkier than all types: more of the same in pure water.
        below = pure();
    }
    let share = (c - at(&below)) / (at(&above) - at(&below));
    let mix = |x: Spectrum, y: Spectrum| each(|i| x[i] + share * (y[i] - x[i]));
    (mix(below.0, above.0), mix(below.1, above.1))
}

#[cfg(test)]
mod tests {
    use super::super::bands::N;
    use super::*;

    #[test]
    fn each_type_is_found_by_its_attenuation() {
        for (name, a, b) in TYPES {
            let (got_a, got_b) = of_attenuation(a[GREEN] + b[GREEN]);
            for i in 0..N {
                assert!((got_a[i] - a[i]).abs() < 1e-12, "{name}");
                assert!((got_b[i] - b[i]).abs() < 1e-12, "{name}");
            }
        }
    }

    #[test]
    fn attenuation_comes_back_and_never_falls_with_murkiness() {
        let (a, b) = pure();
        let mut last = 0.0;
        for k in 0..200 {
            let c = (a[GREEN] + b[GREEN]) * math::powf(1.03, f64::from(k));
            let (a, b) = of_attenuation(c);
            assert!((a[GREEN] + b[GREEN] - c).abs() < 1e-12 * c);
            let all: f64 = (0..N).map(|i| a[i] + b[i]).sum();
            assert!(all > last, "{c}");
            last = all;
            assert!(a.iter().chain(&b).all(|v| *v > 0.0));
        }
    }
}
