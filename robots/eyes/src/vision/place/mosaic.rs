//! All pictures of a place laid over one another: the contrasts of the ground as they would be without water between,
//! and how sure they are.
//!
//! *Source*: the mean of independent measurements weighted by their precision (any text on statistics): a picture that
//! sees the share D of a contrast with the noise σ counts D²/σ².
//!
//! *Parameters*: side of the boxes over which the ground is averaged, [`BOX_M`].
//!
//! *Deviations*: see `evidence.rs` for how much the mean is trusted: not what the noise of independent pictures would
//! make of it, but the spread that the ground itself shows.

use super::clarity::SeenClarity;
use super::ground::Patch;
use crate::numbers::Sums;

/// Side of the boxes, m: a quarter of the least source that is sought.
pub(super) const BOX_M: f64 = 0.5;
/// Least share of a box's cells that must have been seen.
const SEEN: f64 = 0.6;
/// A contrast of which less than this arrives is not blown up further.
const FAINTEST: f64 = 0.02;

/// The ground about a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Mosaic {
    /// Side of a cell, m.
    pub cell_m: f64,
    /// East and north of the first cell's corner, in cells.
    pub low: [i32; 2],
    /// Cells along east and north.
    pub size: [usize; 2],
    /// Sums of precision times contrast, and of precision, by cell, for brightness and redness.
    sums: [Vec<[f64; 2]>; 2],
}

impl Mosaic {
    /// Of pictures with their shifts, in the square of `reach_m` about a place (cells `middle`).
    pub(super) fn from_patches<'a>(
        patches: impl Iterator<Item = (&'a Patch, [i32; 2])>,
        water: &SeenClarity,
        cell_m: f64,
        middle: [i32; 2],
        reach_m: f64,
    ) -> Self {
        let half = (reach_m / cell_m).ceil() as i32;
        let side = 2 * half as usize + 1;
        let low = middle.map(|m| m - half);
        let mut sums = [0, 1].map(|_| vec![[0.0; 2]; side * side]);
        for (patch, shift) in patches {
            for s in &patch.cells {
                let [x, y] = [0, 1].map(|k| s.at[k] + shift[k] - low[k]);
                if x < 0 || y < 0 || x >= side as i32 || y >= side as i32 {
                    continue;
                }
                let left = water.left(s.way_m).max(FAINTEST);
                let at = y as usize * side + x as usize;
                for ((sums, noise), mean) in sums.iter_mut().zip(patch.noise).zip(s.mean) {
                    let noise = noise.max(1e-4);
                    let rate = s.pixels * left / (noise * noise);
                    let sum = &mut sums[at];
                    sum[0] += rate * mean;
                    sum[1] += rate * left;
                }
            }
        }
        Self { cell_m, low, size: [side; 2], sums }
    }

    /// Contrast of brightness and redness of a cell; `None` if no picture shows it.
    pub fn contrast(&self, column: usize, row: usize) -> Option<[f64; 2]> {
        let k = row * self.size[0] + column;
        let of = |s: [f64; 2]| (s[1] > 0.0).then(|| s[0] / s[1]);
        Some([of(self.sums[0][k])?, of(self.sums[1][k])?])
    }

    /// Means over boxes about every cell.
    pub(super) fn boxes(&self) -> Boxes {
        let [w, h] = self.size;
        let half = (0.5 * BOX_M / self.cell_m).round().max(0.0) as usize;
        let part = |k: usize, i: usize| Sums::new(w, h, |n| self.sums[k][n][i]);
        let seen = Sums::new(w, h, |n| f64::from(u8::from(self.sums[0][n][1] > 0.0)));
        // Brightness and redness, their precisions, number seen.
        let sums = [part(0, 0), part(1, 0), part(0, 1), part(1, 1), seen];
        let all = ((2 * half + 1) * (2 * half + 1)) as f64;
        let mean = |n: usize| {
            let [b, r, of_b, of_r, seen] = sums.each_ref().map(|s| s.about(n, half).0);
            (seen >= SEEN * all && of_b > 0.0 && of_r > 0.0)
                .then(|| BoxMean { contrast: [b / of_b, r / of_r], variance: [1.0 / of_b, 1.0 / of_r] })
        };
        Boxes { width: w, step: 2 * half + 1, means: (0..w * h).map(mean).collect() }
    }
}

/// The mean over a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BoxMean {
    /// Contrasts of brightness and redness.
    pub(super) contrast: [f64; 2],
    /// Their variance by the pixels' noise alone.
    pub(super) variance: [f64; 2],
}

/// Means over boxes about every cell.
pub(super) struct Boxes {
    width: usize,
    /// Cells from one box to the next that shares none with it.
    step: usize,
    means: Vec<Option<BoxMean>>,
}

impl Boxes {
    /// About a cell; `None` outside, or if too little of the box has been seen.
    pub(super) fn mean_at(&self, column: i64, row: i64) -> Option<BoxMean> {
        let [x, y] = [column, row].map(|v| usize::try_from(v).ok());
        let (x, y) = (x?, y?);
        if x >= self.width {
            return None;
        }
        *self.means.get(y * self.width + x)?
    }

    /// Boxes that share no cell.
    pub(super) fn apart(&self) -> impl Iterator<Item = &BoxMean> {
        let rows = self.means.chunks(self.width).step_by(self.step);
        rows.flat_map(|row| row.iter().step_by(self.step)).flatten()
    }
}
