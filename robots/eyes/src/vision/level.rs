//! Removes from a picture what changes slowly over it: the veil's gradient, uneven light, the lens's fall-off.
//!
//! *Source*: shading correction by a polynomial of second order, colour by colour (Russ 2011, The Image Processing
//! Handbook, 6th ed., ch. 4); ours here, not in Tian et al. 2013.
//!
//! *Parameters*: a least-squares fit of 1, x, y, x², xy, y² to some [`SAMPLES`] pixels of even spacing.
//!
//! *Deviations*: the fit is subtracted and the mean put back. Levels end at 0 and 254, so that nothing becomes white,
//! which means "nothing there"; white stays white and takes no part in the fit.

use super::colour_pattern::WHITE;
use image::{Rgb, RgbImage};
use nalgebra::{Matrix6, Vector6};

/// Approximate number of pixels for the fit.
const SAMPLES: usize = 20_000;
/// Greatest level.
const TOP: f64 = 254.0;

/// The picture without its slow changes.
pub fn levelled(picture: &RgbImage) -> RgbImage {
    let (w, h) = picture.dimensions();
    let there = (picture.pixels()).filter(|p| p.0 != WHITE).count();
    // An odd stride avoids sampling the same columns again and again in pictures of even width.
    let stride = (there / SAMPLES).max(1) | 1;
    let terms = |x: u32, y: u32| {
        let u = f64::from(2 * x + 1) / f64::from(w) - 1.0;
        let v = f64::from(2 * y + 1) / f64::from(h) - 1.0;
        Vector6::new(1.0, u, v, u * u, u * v, v * v)
    };
    let (mut squares, mut sums) = (Matrix6::zeros(), [Vector6::zeros(); 3]);
    let sampled = (picture.enumerate_pixels()).filter(|(_, _, p)| p.0 != WHITE);
    for (x, y, p) in sampled.step_by(stride) {
        let t = terms(x, y);
        squares += t * t.transpose();
        for (sum, level) in sums.iter_mut().zip(p.0) {
            *sum += t * f64::from(level);
        }
    }
    let n = squares[(0, 0)];
    if n == 0.0 {
        return picture.clone();
    }
    // Thin pictures leave some terms undetermined: these are left out.
    let Ok(inverse) = squares.pseudo_inverse(1e-9 * n) else {
        return picture.clone();
    };
    let fits = sums.map(|sum| inverse * sum);
    let means = sums.map(|sum| sum[0] / n);
    let mut out = picture.clone();
    for (x, y, p) in out.enumerate_pixels_mut().filter(|(_, _, p)| p.0 != WHITE) {
        let t = terms(x, y);
        *p = Rgb([0, 1, 2].map(|k| {
            let level = f64::from(p.0[k]) - fits[k].dot(&t) + means[k];
            level.clamp(0.0, TOP).round() as u8
        }));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::testing::picture;
    use super::*;

    #[test]
    fn a_slope_and_a_bowl_become_even_and_what_is_sharp_stays() {
        let light = |x: u32, y: u32| 60 + x + (y * y) / 40;
        let p = RgbImage::from_fn(80, 60, |x, y| {
            let spot = if (20..24).contains(&x) && (30..34).contains(&y) { 40 } else { 0 };
            Rgb([(light(x, y) - spot) as u8; 3])
        });
        let got = levelled(&p);
        let at = |x, y| i32::from(got.get_pixel(x, y).0[0]);
        let even = at(60, 10);
        for (x, y) in [(2, 2), (77, 57), (40, 30), (5, 55)] {
            assert!((at(x, y) - even).abs() <= 2, "{x} {y}: {} {even}", at(x, y));
        }
        assert!((at(22, 32) + 40 - even).abs() <= 2);
    }

    #[test]
    fn pictures_too_thin_for_a_surface_are_kept_or_evened() {
        let one = picture(1, &[[9, 80, 200]]);
        assert_eq!(levelled(&one), one);
        let column = levelled(&picture(1, &[[10, 10, 10], [20, 20, 20], [30, 30, 30], [40, 40, 40]]));
        assert!(column.pixels().all(|p| p.0 == [25; 3]), "{column:?}");
        let white = picture(2, &[WHITE; 4]);
        assert_eq!(levelled(&white), white);
        assert_eq!(levelled(&RgbImage::new(0, 0)).len(), 0);
    }
}
