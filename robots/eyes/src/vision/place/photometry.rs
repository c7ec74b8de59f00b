//! Contrasts of a picture's pixels against its own background, with their noise; or why a picture says nothing.
//!
//! *Source*: shading correction by a polynomial of second order (Russ 2011, The Image Processing Handbook, 6th ed., ch.
//! 4), here fitted with Tukey's biweight (Beaton & Tukey 1974, Technometrics 16, 147), so that bodies and dye bend it
//! little. Levels become light by the sRGB transfer curve (IEC 61966-2-1).
//!
//! *Parameters*: blocks for the fit: some [`BLOCKS`] along the longer side; a picture is used if at least half of its
//! pixels lie between black and white.
//!
//! *Deviations*: two contrasts are kept of the three colours. `bright` = (Y - background)/background with Y = (R + 2G +
//! B)/4, the sum that the camera's colour saturation leaves as it is; `red` = change of R - G, relative to the
//! background of Y. Both are relative, so that exposure and gain do not matter. What fills much of a picture bends its
//! background: a dark patch of a seventh of it loses up to a quarter of its contrast, and beside wide dye the bed looks
//! less red than it is.

use crate::numbers::median;
use image::RgbImage;
use nalgebra::{SMatrix, SVector};
use serde::Serialize;

/// Terms of the polynomial.
const TERMS: usize = 7;
type Terms = SVector<f64, TERMS>;
/// Blocks along the picture's longer side.
const BLOCKS: u32 = 24;
/// Rounds of the robust fit, and its limit in standard deviations.
const ROUNDS: usize = 8;
const LIMIT: f64 = 5.0;
/// Levels beyond which a pixel says nothing: black and white.
const LEVELS: (u8, u8) = (2, 253);
/// Least brightness of the background, as a share of full scale.
const DARKEST: f64 = 1e-5;
/// Least share of pixels in between.
const USABLE: f64 = 0.5;
/// Least side of a picture, px.
const SMALLEST: u32 = 16;

/// Why a picture says nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Useless {
    /// No pixels, or so few that they show nothing.
    Empty,
    /// More than half of it is black.
    Dark,
    /// More than half of it is white.
    Bright,
    /// All pixels alike, without even noise: the camera did not see.
    Flat,
}

/// Contrasts of the pixels of a picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contrasts {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Of brightness and of redness, row by row; not a number where a pixel says nothing.
    pub(super) bright: Vec<f32>,
    pub(super) red: Vec<f32>,
    /// Standard deviation of a pixel's noise in the two.
    pub(super) noise: [f64; 2],
}

/// The contrasts of a picture whose full horizontal angle of view is `view_rad`.
///
/// # Errors
/// Why it says nothing.
pub(super) fn contrasts(picture: &RgbImage, view_rad: f64) -> Result<Contrasts, Useless> {
    let (w, h) = picture.dimensions();
    if w < SMALLEST || h < SMALLEST {
        return Err(Useless::Empty);
    }
    let size = [w, h];
    let n = w as usize * h as usize;
    let (y, rg) = light(picture, view_rad)?;
    let of_y = surface(&blocks(size, &y, &y));
    let of_rg = surface(&blocks(size, &y, &rg));
    let mut out = Contrasts { width: w, height: h, bright: vec![f32::NAN; n], red: vec![f32::NAN; n], noise: [0.0; 2] };
    for k in 0..n {
        let t = terms(size, f64::from(k as u32 % w), f64::from(k as u32 / w));
        let ground = of_y.dot(&t);
        if y[k].is_finite() && ground > DARKEST {
            out.bright[k] = ((y[k] - ground) / ground) as f32;
            out.red[k] = ((rg[k] - of_rg.dot(&t)) / ground) as f32;
        }
    }
    out.noise = [&out.bright, &out.red].map(|v| noise(v, w as usize));
    Ok(out)
}

/// Brightness of the pixels, not a number where one says nothing, and red less green, without the lens's fall-off.
fn light(picture: &RgbImage, view_rad: f64) -> Result<(Vec<f64>, Vec<f64>), Useless> {
    let (w, h) = picture.dimensions();
    let first = picture.get_pixel(0, 0);
    let curve: Vec<f64> = (0..256).map(|l| linear(f64::from(l) / 255.0)).collect();
    let n = w as usize * h as usize;
    let focal = 0.5 * f64::from(w) / world::math::tan(0.5 * view_rad);
    let (mut y, mut rg) = (vec![f64::NAN; n], vec![0.0; n]);
    let (mut dark, mut white) = (0, 0);
    for (k, p) in picture.pixels().enumerate() {
        let top = p.0.into_iter().max().unwrap_or(0);
        if top <= LEVELS.0 {
            dark += 1;
        } else if top >= LEVELS.1 {
            white += 1;
        } else {
            let lens = fall_off([w, h], focal, k);
            let [r, g, b] = p.0.map(|l| curve[usize::from(l)] / lens);
            y[k] = 0.25 * r + 0.5 * g + 0.25 * b;
            rg[k] = r - g;
        }
    }
    if (n - dark - white) as f64 <= USABLE * n as f64 {
        return Err(if dark >= white { Useless::Dark } else { Useless::Bright });
    }
    if picture.pixels().all(|p| p == first) {
        return Err(Useless::Flat);
    }
    Ok((y, rg))
}

/// Light of a level, both as shares of full scale.
fn linear(level: f64) -> f64 {
    if level <= 0.040_45 { level / 12.92 } else { world::math::powf((level + 0.055) / 1.055, 2.4) }
}

/// Share of its light that a lens lets through to pixel number `k`: cos⁴ of the angle from its axis (any text on
/// optics).
fn fall_off(size: [u32; 2], focal: f64, k: usize) -> f64 {
    let x = f64::from(k as u32 % size[0]) + 0.5 - 0.5 * f64::from(size[0]);
    let y = f64::from(k as u32 / size[0]) + 0.5 - 0.5 * f64::from(size[1]);
    let cos2 = focal * focal / (focal * focal + x * x + y * y);
    cos2 * cos2
}

/// The terms of the polynomial at a pixel: those of second order, and the fourth power of the distance from the middle.
fn terms(size: [u32; 2], x: f64, y: f64) -> Terms {
    let u = (2.0 * x + 1.0) / f64::from(size[0]) - 1.0;
    let v = (2.0 * y + 1.0) / f64::from(size[1]) - 1.0;
    let r2 = u * u + v * v;
    Terms::from([1.0, u, v, u * u, u * v, v * v, r2 * r2])
}

/// Means of blocks of pixels that say something, each with the terms of its middle.
fn blocks(size: [u32; 2], y: &[f64], of: &[f64]) -> Vec<(Terms, f64)> {
    let side = (size[0].max(size[1]) / BLOCKS).max(1);
    let mut out = Vec::new();
    for top in (0..size[1]).step_by(side as usize) {
        for left in (0..size[0]).step_by(side as usize) {
            let (mut sum, mut n) = (0.0, 0_u32);
            let (bottom, right) = ((top + side).min(size[1]), (left + side).min(size[0]));
            for row in top..bottom {
                for column in left..right {
                    let k = row as usize * size[0] as usize + column as usize;
                    if y[k].is_finite() {
                        sum += of[k];
                        n += 1;
                    }
                }
            }
            if 2 * n >= side * side {
                let middle = [left + right - 1, top + bottom - 1].map(|m| 0.5 * f64::from(m));
                out.push((terms(size, middle[0], middle[1]), sum / f64::from(n)));
            }
        }
    }
    out
}

/// The robust fit of the polynomial.
fn surface(blocks: &[(Terms, f64)]) -> Terms {
    let mut fit = Terms::zeros();
    let mut weights = vec![1.0; blocks.len()];
    for _ in 0..ROUNDS {
        let (mut squares, mut sums) = (SMatrix::<f64, TERMS, TERMS>::zeros(), Terms::zeros());
        for ((t, v), weight) in blocks.iter().zip(&weights) {
            squares += t * t.transpose() * *weight;
            sums += t * (*v * *weight);
        }
        // A little damping keeps terms that nothing determines at zero.
        let trace = squares[(0, 0)].max(f64::MIN_POSITIVE);
        for k in 1..TERMS {
            squares[(k, k)] += 1e-6 * trace;
        }
        let Some(solved) = squares.cholesky() else {
            return fit;
        };
        fit = solved.solve(&sums);
        let off: Vec<f64> = blocks.iter().map(|(t, v)| v - fit.dot(t)).collect();
        let limit = LIMIT * 1.4826 * middle(off.iter().map(|o| o.abs()));
        for (weight, off) in weights.iter_mut().zip(&off) {
            let share = if limit > 0.0 { off / limit } else { 0.0 };
            *weight = (1.0 - share * share).max(0.0).powi(2);
        }
    }
    fit
}

/// Standard deviation of the noise: of differences between neighbours in a row, without the largest twentieth, which
/// are edges.
fn noise(values: &[f32], width: usize) -> f64 {
    let mut squares: Vec<f64> = (values.chunks_exact(width))
        .flat_map(|row| row.windows(2))
        .map(|two| f64::from(two[1] - two[0]))
        .filter(|d| d.is_finite())
        .map(|d| d * d)
        .collect();
    squares.sort_by(f64::total_cmp);
    squares.truncate(squares.len() * 19 / 20);
    if squares.is_empty() {
        return 0.0;
    }
    // A normal variable without its largest twentieth has 0.759 of its variance.
    (squares.iter().sum::<f64>() / squares.len() as f64 / (2.0 * 0.759)).sqrt()
}

/// The middle one; 0 of none.
pub(super) fn middle(values: impl Iterator<Item = f64>) -> f64 {
    median(values).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;
    use world::seeds::Stream;

    fn noisy(seed: u64, level: impl Fn(u32, u32) -> f64) -> RgbImage {
        let mut r = Stream::new(seed, "test", "photometry");
        RgbImage::from_fn(64, 48, |x, y| {
            let l = level(x, y) + 2.0 * r.normal();
            Rgb([l.clamp(0.0, 255.0) as u8; 3])
        })
    }

    #[test]
    fn pictures_that_show_nothing_are_told_apart() {
        let of = |w, h, l| contrasts(&RgbImage::from_pixel(w, h, Rgb([l; 3])), 0.1).unwrap_err();
        assert_eq!(of(0, 0, 0), Useless::Empty);
        assert_eq!(of(1, 90, 100), Useless::Empty);
        assert_eq!(of(64, 48, 0), Useless::Dark);
        assert_eq!(of(64, 48, 255), Useless::Bright);
        assert_eq!(of(64, 48, 100), Useless::Flat);
        let half = |l: u8| {
            let p = RgbImage::from_fn(64, 48, |x, _| Rgb([if x < 40 { l } else { 90 }; 3]));
            contrasts(&p, 0.1).unwrap_err()
        };
        assert_eq!((half(0), half(255)), (Useless::Dark, Useless::Bright));
    }

    /// Light falls by a third from left to right, and a patch of 15 % of the picture reflects 40 % less.
    #[test]
    fn a_dark_patch_on_sloping_light_keeps_its_contrast() {
        let inside = |x: u32, y: u32| (20..40).contains(&x) && (10..33).contains(&y);
        let level = |share: f64| {
            let l =
                if share <= 0.003_130_8 { 12.92 * share } else { 1.055 * world::math::powf(share, 1.0 / 2.4) - 0.055 };
            255.0 * l
        };
        let light = |x: u32| 0.3 * (1.0 - 0.33 * f64::from(x) / 64.0);
        let p = noisy(1, |x, y| level(light(x) * if inside(x, y) { 0.6 } else { 1.0 }));
        let c = contrasts(&p, 0.1).unwrap();
        let (mut sums, mut n) = ([0.0; 2], [0.0; 2]);
        for (k, v) in c.bright.iter().enumerate() {
            let i = usize::from(inside(k as u32 % 64, k as u32 / 64));
            sums[i] += f64::from(*v);
            n[i] += 1.0;
        }
        let [out, inside] = [0, 1].map(|i| sums[i] / n[i]);
        // A patch of a seventh of the picture bends the fit: up to a quarter of its contrast is lost.
        assert!(out.abs() < 0.03, "{out}");
        assert!((-0.42..-0.3).contains(&inside), "{inside}");
        // Two levels of noise at some 140 are 2 · 2.2 · 2/140 of the light.
        assert!((0.02..0.05).contains(&c.noise[0]), "{:?}", c.noise);
    }
}
