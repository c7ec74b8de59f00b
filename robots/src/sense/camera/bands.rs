//! The three colours a camera tells apart: red, green and blue, as sums over one band each.
//!
//! *Source:* spectral sensitivities of colour cameras: Jiang, Liu, Gu & Süsstrunk 2013, IEEE WACV, 168 (28 cameras: peaks near 600,
//! 530 and 460 nm, each about 80 nm wide).
//!
//! *Parameters:* middle [`WAVELENGTH_NM`] 610, 540, 460 nm, full width at half height [`WIDTH_NM`] 80 nm.
//!
//! *Deviations:* Gaussian bands; water is taken at a band's middle, so that light which reddens or blues within a band is not
//! followed. Amounts of light are counts of photons relative to daylight, which is (1, 1, 1).

use world::math;

/// Red, green and blue of anything.
pub(super) type Rgb = [f64; 3];

/// Middle of the bands, nm.
pub(super) const WAVELENGTH_NM: Rgb = [610.0, 540.0, 460.0];
/// Full width of a band at half its height, nm.
pub(super) const WIDTH_NM: f64 = 80.0;

/// The same for each colour.
#[must_use]
pub(super) fn each(f: impl FnMut(usize) -> f64) -> Rgb {
    [0, 1, 2].map(f)
}

/// Three colours of a scenario as plain numbers.
#[must_use]
pub(super) fn plain<T: Into<f64>>(c: (T, T, T)) -> Rgb {
    [c.0.into(), c.1.into(), c.2.into()]
}

/// Mean over a band of a spectrum that is a Gaussian of height 1 about `peak_nm`, `width_nm` wide at half height.
#[must_use]
pub(super) fn band_mean(band: usize, peak_nm: f64, width_nm: f64) -> f64 {
    let squares = width_nm * width_nm + WIDTH_NM * WIDTH_NM;
    let off = WAVELENGTH_NM[band] - peak_nm;
    width_nm / squares.sqrt() * math::exp(-4.0 * std::f64::consts::LN_2 * off * off / squares)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_mean_is_the_integral_it_stands_for() {
        let shape = |x: f64, middle: f64, width: f64| {
            math::exp(-4.0 * std::f64::consts::LN_2 * (x - middle) * (x - middle) / (width * width))
        };
        for (band, middle) in WAVELENGTH_NM.into_iter().enumerate() {
            let (mut both, mut alone) = (0.0, 0.0);
            for nm in 100..1100 {
                let nm = f64::from(nm);
                let s = shape(nm, middle, WIDTH_NM);
                both += s * shape(nm, 554.0, 40.0);
                alone += s;
            }
            assert!((band_mean(band, 554.0, 40.0) - both / alone).abs() < 1e-6);
        }
    }
}
