//! Density of water of a salinity and a temperature at the pressure of the surface.
//!
//! *Source*: Millero & Poisson 1981, Deep-Sea Res. 28A, 625 (EOS-80 at one atmosphere; Unesco Tech. Papers Mar. Sci.
//! 38); pure water: Bigg 1967, Br. J. Appl. Phys. 18, 521.
//!
//! *Parameters*: practical salinity, 0 to 42; temperature, −2 to 40 °C.
//!
//! *Deviations*: none. Pressure is left out: what is released and the water around are compressed alike.

/// Density, kg/m³.
pub(super) fn density(salinity: f64, t_c: f64) -> f64 {
    let polynomial = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * t_c + c);
    let pure = polynomial(&[999.842_594, 6.793_952e-2, -9.095_290e-3, 1.001_685e-4, -1.120_083e-6, 6.536_332e-9]);
    let a = polynomial(&[8.244_93e-1, -4.0899e-3, 7.6438e-5, -8.2467e-7, 5.3875e-9]);
    let b = polynomial(&[-5.724_66e-3, 1.0227e-4, -1.6546e-6]);
    pure + salinity * (a + b * salinity.sqrt() + 4.8314e-4 * salinity)
}

/// The salinity at which water of this temperature has this density, from 0 to 42.
pub(super) fn salinity(density_kg_m3: f64, t_c: f64) -> f64 {
    let (mut low, mut high) = (0.0, 42.0);
    if density(low, t_c) >= density_kg_m3 {
        return low;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if density(middle, t_c) < density_kg_m3 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Check values of Unesco Tech. Papers Mar. Sci. 44 (Fofonoff & Millard 1983).
    #[test]
    fn check_values_of_the_equation_of_state() {
        for (s, t, want) in
            [(0.0, 5.0, 999.96675), (35.0, 5.0, 1027.67547), (0.0, 25.0, 997.04796), (35.0, 25.0, 1023.34306)]
        {
            assert!((density(s, t) - want).abs() < 1e-5, "{}", density(s, t));
        }
        assert!((salinity(density(31.0, 12.0), 12.0) - 31.0).abs() < 1e-9);
        assert_eq!(salinity(990.0, 12.0), 0.0);
    }
}
