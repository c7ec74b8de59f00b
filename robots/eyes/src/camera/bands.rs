//! Light by wavelength, and the red, green and blue that a camera makes of it.
//!
//! *Source:* sensitivities of a Nikon D5100 measured at the National Physical Laboratory: Darrodi, Finlayson, Goodman
//! & Mackiewicz 2015, J. Opt. Soc. Am. A 32, 381; its peaks and widths are those of the 28 cameras of Jiang, Liu, Gu
//! & Süsstrunk 2013, IEEE WACV, 168. Read from a secondary source: colour-science 0.4.7 (PyPI),
//! `characterisation/datasets/cameras`, 400 to 700 nm by 5 nm. Daylight: CIE standard illuminant D65.
//!
//! *Parameters:* wavelengths [`NM`], 35 nm apart from 425 nm; [`SENSES`] is sensitivity times daylight, divided
//! linearly between the two nearest of them and normalised to a sum of one for each colour, so that daylight is (1,
//! 1, 1).
//!
//! *Deviations:* there are only eight wavelengths. Compared with steps of 5 nm, light that has come 8 m down and 3 m
//! along through the waters of `waters.rs` is right within 8 % in all colours up to Jerlov's type 5C; red is worst
//! because water's absorption rises steeply at 590 nm. Amounts of light are counts of photons relative to daylight.
//! Colours of things are given for red, green and blue and interpolated linearly.

use world::math;

/// A quantity for red, green and blue.
pub(super) type Rgb = [f64; 3];

/// Number of wavelengths.
pub(super) const N: usize = 8;

/// A quantity by wavelength.
pub(super) type Spectrum = [f64; N];

/// The wavelengths, nm.
pub(super) const NM: Spectrum = [425.0, 460.0, 495.0, 530.0, 565.0, 600.0, 635.0, 670.0];

/// From one to the next, nm.
const STEP_NM: f64 = 35.0;

/// Index of 530 nm, at which visibility and opacity are given.
pub(super) const GREEN: usize = 3;

/// Sensitivity of red, green and blue pixels to each wavelength.
const SENSES: [Spectrum; 3] = [
    [0.0261, 0.0316, 0.0355, 0.0519, 0.1231, 0.4184, 0.2493, 0.0641],
    [0.0320, 0.1083, 0.2161, 0.3230, 0.2285, 0.0750, 0.0138, 0.0033],
    [0.1997, 0.4188, 0.2807, 0.0811, 0.0145, 0.0027, 0.0015, 0.0010],
];

/// Wavelengths at which red, green and blue of a thing's colour hold, nm: the middles of the sensitivities.
const MIDDLE_NM: Rgb = [600.0, 530.0, 460.0];

/// The same for each wavelength.
pub(super) fn each(mut f: impl FnMut(usize) -> f64) -> Spectrum {
    // A loop is compiled in place, `map` of an array is not.
    let mut all = [0.0; N];
    for (i, one) in all.iter_mut().enumerate() {
        *one = f(i);
    }
    all
}

/// The camera's response to a spectrum.
pub(super) fn see(light: &Spectrum) -> Rgb {
    SENSES.map(|senses| (0..N).map(|i| senses[i] * light[i]).sum())
}

/// A scenario's red, green and blue, by wavelength.
pub(super) fn spread<T: Into<f64>>(c: (T, T, T)) -> Spectrum {
    let [red, green, blue] = [c.0.into(), c.1.into(), c.2.into()];
    each(|i| {
        let part =
            |from: usize, to: usize| ((NM[i] - MIDDLE_NM[from]) / (MIDDLE_NM[to] - MIDDLE_NM[from])).clamp(0.0, 1.0);
        blue + (green - blue) * part(2, 1) + (red - green) * part(1, 0)
    })
}

/// A Gaussian of height 1 about `peak_nm`, `width_nm` wide at half height, averaged over the interval of each
/// wavelength.
pub(super) fn line(peak_nm: f64, width_nm: f64) -> Spectrum {
    each(|i| {
        let sum: f64 = (-34..35)
            .map(|off| {
                let off = f64::from(off);
                let x = (NM[i] + off - peak_nm) / width_nm;
                (1.0 - off.abs() / STEP_NM) * math::exp(-4.0 * std::f64::consts::LN_2 * x * x)
            })
            .sum();
        sum / STEP_NM
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn daylight_is_white() {
        for c in see(&[1.0; N]) {
            // Four digits of eight numbers.
            assert!((c - 1.0).abs() < 4e-4, "{c}");
        }
    }

    #[test]
    fn the_means_of_a_line_share_out_its_area() {
        let all: f64 = line(554.0, 40.0).into_iter().sum();
        let area = 40.0 * (std::f64::consts::PI / (4.0 * std::f64::consts::LN_2)).sqrt();
        assert!((all * STEP_NM / area - 1.0).abs() < 1e-3, "{all}");
        let l = line(554.0, 40.0);
        assert!(l[4] > l[3] && l[3] > 3.0 * l[5], "{l:?}");
    }

    #[test]
    fn a_colour_comes_back_at_the_middles_of_the_sensitivities() {
        let s = spread((0.3, 0.2, 0.1));
        assert_eq!([s[0], s[1], s[3], s[5], s[7]], [0.1, 0.1, 0.2, 0.3, 0.3]);
        assert!((s[2] - 0.15).abs() < 1e-12 && (s[4] - 0.25).abs() < 1e-12);
        assert_eq!(spread((0.5, 0.5, 0.5)), [0.5; N]);
    }
}
