//! The shift between a picture and those before it, found where they overlap.
//!
//! *Source*: normalised cross-correlation (Lewis 1995, Vision Interface, 120) of the brightness on the ground; for
//! mosaics of the sea bed on a vehicle's navigation: Eustice, Pizarro & Singh 2008, IEEE J. Oceanic Eng. 33, 103.
//!
//! *Parameters*: `reach_m` largest shift looked for.
//!
//! *Deviations*: whole cells, no turn: the compass is trusted. A shift counts only if its correlation stands out:
//! [`SURE`] times the spread of chance, of which as many cells as four share one piece of news. Otherwise the
//! navigation alone is followed.

use super::ground::{GroundCell, Patch};
use std::collections::BTreeMap;

/// Least correlation over the spread of chance, and by itself.
const SURE: f64 = 5.0;
const LEAST: f64 = 0.2;
/// Least number of cells that overlap.
const OVERLAP: usize = 60;
/// Cells that share one piece of news.
const ALIKE: f64 = 4.0;

/// Brightness on the ground, by all pictures so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct GroundBrightness(BTreeMap<[i32; 2], [f64; 2]>);

impl GroundBrightness {
    /// Adds a picture, shifted by whole cells.
    pub(super) fn add(&mut self, patch: &Patch, shift: [i32; 2]) {
        for s in &patch.cells {
            let at = [s.at[0] + shift[0], s.at[1] + shift[1]];
            let sums = self.0.entry(at).or_default();
            sums[0] += s.pixels * s.mean[0];
            sums[1] += s.pixels;
        }
    }

    /// The shift, of at most `reach_cells` along each axis, that brings a picture onto what is known; it is looked for
    /// about another one. `None` if none stands out.
    pub(super) fn shift(&self, patch: &Patch, about: [i32; 2], reach_cells: i32) -> Option<[i32; 2]> {
        // A table of the ground that the search can meet.
        let ends = |k: usize| {
            let low = patch.cells.iter().map(|s| s.at[k]).min()? + about[k] - reach_cells;
            let high = patch.cells.iter().map(|s| s.at[k]).max()? + about[k] + reach_cells;
            Some((low, high))
        };
        let ((x0, x1), (y0, y1)) = (ends(0)?, ends(1)?);
        let width = (x1 - x0 + 1) as usize;
        let mut table = vec![f64::NAN; width * (y1 - y0 + 1) as usize];
        for (at, sums) in &self.0 {
            if (x0..=x1).contains(&at[0]) && (y0..=y1).contains(&at[1]) {
                table[(at[1] - y0) as usize * width + (at[0] - x0) as usize] = sums[0] / sums[1];
            }
        }
        let mut best: Option<(f64, [i32; 2])> = None;
        for dy in -reach_cells..=reach_cells {
            for dx in -reach_cells..=reach_cells {
                let shift = [about[0] + dx, about[1] + dy];
                if shift.iter().any(|s| s.abs() > reach_cells) {
                    continue;
                }
                let known = |s: &GroundCell| {
                    let (x, y) = (s.at[0] + shift[0] - x0, s.at[1] + shift[1] - y0);
                    table[y as usize * width + x as usize]
                };
                let (n, r) = correlation(patch.cells.iter().map(|s| (s.mean[0], known(s))));
                let sure = r * (n as f64 / ALIKE).sqrt();
                if n < OVERLAP || r < LEAST || sure < SURE {
                    continue;
                }
                if best.is_none_or(|(most, _)| sure > most) {
                    best = Some((sure, shift));
                }
            }
        }
        best.map(|(_, shift)| shift)
    }
}

/// Number of pairs in which both are numbers, and their correlation.
fn correlation(pairs: impl Iterator<Item = (f64, f64)>) -> (usize, f64) {
    let mut n = 0;
    let mut sums = [0.0; 5];
    for (a, b) in pairs.filter(|(_, b)| b.is_finite()) {
        n += 1;
        for (sum, v) in sums.iter_mut().zip([a, b, a * a, b * b, a * b]) {
            *sum += v;
        }
    }
    let [a, b, aa, bb, ab] = sums.map(|s| s / (n as f64).max(1.0));
    let spread = ((aa - a * a) * (bb - b * b)).max(0.0).sqrt();
    (n, if spread > 1e-12 { (ab - a * b) / spread } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::seeds::Stream;

    /// Sides of the ground's table and of a picture, cells.
    const GROUND: i32 = 60;
    const PICTURE: i32 = 20;

    fn ground(seed: u64) -> Vec<f64> {
        let mut r = Stream::new(seed, "test", "ground");
        (0..GROUND * GROUND).map(|_| r.normal()).collect()
    }

    /// A square of the ground from `from`, laid `off` cells from where it belongs, with noise of its own.
    fn picture(ground: &[f64], from: [i32; 2], off: [i32; 2], noise: f64, seed: u64) -> Patch {
        let mut r = Stream::new(seed, "test", "noise");
        let mut cells = Vec::new();
        for y in 0..PICTURE {
            for x in 0..PICTURE {
                let v = ground[((from[1] + y) * GROUND + from[0] + x) as usize];
                cells.push(GroundCell {
                    at: [from[0] + x + off[0], from[1] + y + off[1]],
                    pixels: 4.0,
                    mean: [v + noise * r.normal(), 0.0],
                    way_m: 2.0,
                });
            }
        }
        Patch { cells, noise: [noise, noise], height_m: 2.0, texture: [1.0, noise] }
    }

    #[test]
    fn a_known_shift_is_found_where_pictures_overlap() {
        let g = ground(1);
        let mut known = GroundBrightness::default();
        known.add(&picture(&g, [20, 20], [0, 0], 0.5, 1), [0, 0]);
        for off in [[0, 0], [3, -2], [-7, 6], [10, 0]] {
            let second = picture(&g, [27, 24], off, 0.5, 2);
            let back = off.map(|o: i32| -o);
            assert_eq!(known.shift(&second, [0, 0], 10), Some(back), "{off:?}");
        }
    }

    /// Noise alone, another ground, too little overlap, or a shift beyond what is searched: navigation is followed.
    #[test]
    fn what_does_not_stand_out_is_no_shift() {
        let (g, other) = (ground(1), ground(2));
        let mut known = GroundBrightness::default();
        known.add(&picture(&g, [20, 20], [0, 0], 0.5, 1), [0, 0]);
        assert_eq!(known.shift(&picture(&other, [22, 20], [0, 0], 0.5, 2), [0, 0], 8), None);
        assert_eq!(known.shift(&picture(&g, [22, 20], [0, 0], 9.0, 3), [0, 0], 8), None);
        let corner = picture(&g, [38, 38], [0, 0], 0.1, 4);
        assert_eq!(known.shift(&corner, [0, 0], 1), None);
        let far = picture(&g, [22, 20], [12, 0], 0.1, 5);
        assert_eq!(known.shift(&far, [0, 0], 8), None);
        assert_eq!(GroundBrightness::default().shift(&far, [0, 0], 8), None);
    }
}
