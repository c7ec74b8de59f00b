//! What tells dye from other red things in a picture: its light, its hue and its edge.
//!
//! *Source*: rhodamine takes green out of the light and gives it back as red, and blue less than green (absorption peak
//! near 555 nm, emission near 580 nm). Water takes red out of the light first (Jerlov 1976, Marine Optics). Dye thins
//! out where it ends, a thing ends where it ends. The measures are ours.
//!
//! *Parameters*: none of its own; the limits stand in [`VerifierSpec`](robots::strategy::VerifierSpec).
//!
//! *Deviations*: much dye in front of something dark glows orange, and has then another hue than is asked for. Lengths
//! are four-hundredths of the picture's diagonal. The edge is not measured in a picture whose pixels are longer than
//! that, for there dye ends within a pixel, too.

use crate::numbers::{Sums, median};
use image::{GrayImage, RgbImage};
use nalgebra::Vector2;
use serde::Serialize;

/// Lengths in a picture's diagonal: one is a pixel in a picture of 320 × 240.
const LENGTHS: f64 = 400.0;
/// Width of the strips on both sides of the edge, and distance from which on a pixel is background, in such lengths.
const STRIP: f64 = 2.0;
const FAR: f64 = 12.0;

/// How the pixels of a mask look, beside the others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct DyeLook {
    /// Mean share of red in their light, as it was recorded; grey has a third.
    pub red: f64,
    /// By how much the share of green less that of blue is greater in them than far from them: negative where more
    /// green than blue is missing.
    pub yellow: f64,
    /// Part of the difference in redness between them and the rest that comes within four lengths at their edge;
    /// `None` where pixels are too coarse to tell.
    pub edge: Option<f64>,
}

/// Shares of red, green and blue in a pixel's light; a third each for black.
pub(super) fn shares(rgb: [f64; 3]) -> [f64; 3] {
    let all: f64 = rgb.iter().sum::<f64>() + 3.0;
    rgb.map(|level| (level + 1.0) / all)
}

/// Mean over the square about a pixel.
fn mean_about(sums: &Sums, at: usize, reach: usize) -> f64 {
    let (sum, n) = sums.about(at, reach);
    sum / n as f64
}

/// Mean of a quantity over some pixels; `None` if there are none.
pub(super) fn mean(pixels: usize, of: impl Fn(usize) -> bool, value: impl Fn(usize) -> f64) -> Option<f64> {
    let (mut sum, mut n) = (0.0, 0_u64);
    for at in (0..pixels).filter(|at| of(*at)) {
        sum += value(at);
        n += 1;
    }
    (n > 0).then(|| sum / n as f64)
}

/// Of two means the first less the second; 0 if there is not either.
pub(super) fn difference(a: Option<f64>, b: Option<f64>) -> f64 {
    a.zip(b).map_or(0.0, |(a, b)| a - b)
}

impl DyeLook {
    /// How the pixels of `mask` look in a picture and in the same, levelled; all three are of one size. All zero if it has
    /// none, or all.
    pub fn new(picture: &RgbImage, even: &RgbImage, mask: &GrayImage) -> Self {
        let (w, h) = (picture.width() as usize, picture.height() as usize);
        let n = w * h;
        let inside: Vec<bool> = mask.pixels().map(|m| m.0[0] > 0).collect();
        let level = |p: &RgbImage, at: usize, k: usize| f64::from(p.as_raw()[3 * at + k]);
        let recorded = |at: usize| shares([0, 1, 2].map(|k| level(picture, at, k)));
        let count = Sums::new(w, h, |at| f64::from(u8::from(inside[at])));
        let length = Vector2::new(w as f64, h as f64).norm() / LENGTHS;
        let reach = |lengths: f64| ((lengths * length).round() as usize).max(1);
        let far = |at: &usize| count.about(*at, reach(FAR)).0 == 0.0;
        let yellow = |at: usize| recorded(at)[1] - recorded(at)[2];
        let Some(red) = mean(n, |at| inside[at], |at| recorded(at)[0]) else {
            return Self::default();
        };
        let own = mean(n, |at| inside[at], yellow).unwrap_or_default();
        // The median, so that a thing of another colour does not stand for all.
        let outside = |at: &usize| !inside[*at];
        let around = median((0..n).filter(far).map(yellow)).or_else(|| median((0..n).filter(outside).map(yellow)));
        let Some(around) = around else {
            return Self::default();
        };
        Self {
            red,
            yellow: own - around,
            edge: (length >= 1.0 - 1e-9).then(|| {
                let smooth = [0, 1, 2].map(|k| Sums::new(w, h, |at| level(even, at, k)));
                let redness = |at: usize| shares([0, 1, 2].map(|k| mean_about(&smooth[k], at, reach(1.0))))[0];
                let strip = |at: usize, inner: bool| {
                    let share = mean_about(&count, at, reach(STRIP));
                    inside[at] == inner && if inner { share < 1.0 } else { share > 0.0 }
                };
                let whole = difference(mean(n, |at| inside[at], redness), mean(n, |at| !inside[at], redness));
                let step = difference(mean(n, |at| strip(at, true), redness), mean(n, |at| strip(at, false), redness));
                step / whole.max(1e-3)
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::level::levelled;
    use super::*;
    use image::{Luma, Rgb};

    /// A disc of a colour in water that goes over into it within so many pixels, and where it is more than half.
    fn disc(colour: [f64; 3], soft_px: f64) -> (RgbImage, GrayImage) {
        let water = [90.0, 140.0, 135.0];
        let share = |x: u32, y: u32| {
            let r = Vector2::new(f64::from(x) - 160.0, f64::from(y) - 120.0).norm();
            ((40.0 - r) / soft_px + 0.5).clamp(0.0, 1.0)
        };
        let picture = RgbImage::from_fn(320, 240, |x, y| {
            let s = share(x, y);
            Rgb([0, 1, 2].map(|k| (s * colour[k] + (1.0 - s) * water[k]).round() as u8))
        });
        let mask = GrayImage::from_fn(320, 240, |x, y| Luma([255 * u8::from(share(x, y) > 0.5)]));
        (picture, mask)
    }

    #[test]
    fn dye_is_red_lacks_green_and_thins_out() {
        let look = |colour, soft_px| {
            let (picture, mask) = disc(colour, soft_px);
            DyeLook::new(&picture, &levelled(&picture), &mask)
        };
        let dye = look([190.0, 70.0, 100.0], 30.0);
        assert!(dye.red > 0.4 && dye.yellow < -0.02, "{dye:?}");
        assert!(dye.edge.is_some_and(|edge| edge < 0.4), "{dye:?}");
        let coral = look([190.0, 70.0, 100.0], 1.0);
        assert!(coral.edge.is_some_and(|edge| edge > 0.6), "{coral:?}");
        let sponge = look([200.0, 130.0, 40.0], 30.0);
        assert!(sponge.yellow > 0.02, "{sponge:?}");
        let stone = look([80.0, 90.0, 95.0], 30.0);
        assert!(stone.red < 1.0 / 3.0, "{stone:?}");
    }

    #[test]
    fn lengths_go_with_the_picture() {
        let (picture, mask) = disc([190.0, 70.0, 100.0], 20.0);
        let twice = |w: u32, h: u32| {
            let by = image::imageops::FilterType::Nearest;
            let (p, m) = (image::imageops::resize(&picture, w, h, by), image::imageops::resize(&mask, w, h, by));
            DyeLook::new(&p, &levelled(&p), &m)
        };
        let (one, two) = (twice(320, 240), twice(640, 480));
        assert!((one.edge.unwrap() - two.edge.unwrap()).abs() < 0.03);
        assert!((one.red - two.red).abs() < 1e-9);
        assert_eq!(twice(160, 120).edge, None);
    }

    #[test]
    fn nothing_and_everything_look_like_nothing() {
        let (picture, mask) = disc([190.0, 70.0, 100.0], 20.0);
        for level in [0, 255] {
            let even = GrayImage::from_pixel(mask.width(), mask.height(), Luma([level]));
            assert_eq!(DyeLook::new(&picture, &picture, &even), DyeLook::default());
        }
        let none = RgbImage::new(0, 0);
        let empty = DyeLook::new(&none, &none, &GrayImage::new(0, 0));
        assert_eq!(empty, DyeLook::default());
    }
}
