//! How far a step of a given length disturbs mixed water: the error of the kernel's vertical step, computed, not
//! sampled.
//!
//! *Source*: the well-mixed condition (Thomson 1987, J. Fluid Mech. 180, 529) applied to one step of `kernel.rs`. A
//! step of dt turns even water into 1 + q dt. The deviation r then obeys ∂r/∂t = ∂(K ∂r/∂z)/∂z + q, which is solved
//! from even water. That dt must be short compared with 1/|K''|: Visser 1997, Mar. Ecol. Prog. Ser. 158, 275; Ross &
//! Sharples 2004, Limnol. Oceanogr. Methods 2, 289.
//!
//! *Parameters*: dt the step (s), how long it is used (s), K_z at the levels of one column of the flow grid (m²/s).
//!
//! *Deviations*: dt·max|K''| alone is not sufficient. The tests cover parabolas, interfaces 0.2 to 2 m thick at 0.001
//! to 0.03 m²/s, gaps and waves, in 6 m of water and 24 levels. There the worst 24th of the depth deviates by 0.5 to
//! 3.6 times that number. The value computed here agrees with 150 000 filaments to 2 % of even plus a tenth of the
//! error (`tests_evenness.rs`). The error is smaller for filaments that share their mixing (`eddy_size_m`).

use world::math;

/// Parts of the depth that are compared with even water: as many as the default grid has levels.
const PARTS: usize = 24;
/// Cells of the depth on which the deviation spreads.
const CELLS: usize = 20 * PARTS;
/// Step of the two normal numbers in the sums over them, and the limit of the sums, in standard deviations.
const NORMAL: (f64, f64) = (0.5, 4.0);
/// Distance between starting heights, as a part of the kick at the nearest level or of the distance to it.
const FINE: f64 = 1.0 / 6.0;
/// Implicit steps of the deviation, each longer than the one before by [`GROWTH`].
const STEPS: i32 = 60;
const GROWTH: f64 = 1.15;

/// K_z between bed and surface as the filaments of one place see it: linear from level to level.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MixingProfile {
    /// Depth, m.
    depth: f64,
    /// Levels above the bed, m, rising from 0 to the depth.
    height: Vec<f64>,
    /// K_z there, m²/s.
    k: Vec<f64>,
}

impl MixingProfile {
    /// At heights above the bed (m), from 0 upwards to the depth.
    pub(crate) fn new(height: Vec<f64>, k: Vec<f64>) -> Self {
        Self { depth: *height.last().expect("a grid has two levels"), height, k }
    }

    /// Whether all of its numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.depth > 0.0 && self.k.iter().all(|k| (0.0..1e12).contains(k))
    }

    /// Greatest |K''| at a level, from the slopes on both sides, 1/s.
    pub(crate) fn sharpest(&self) -> f64 {
        let slope = |n: usize| (self.k[n] - self.k[n - 1]) / (self.height[n] - self.height[n - 1]);
        let bend = |n: usize| 2.0 * (slope(n + 1) - slope(n)).abs() / (self.height[n + 1] - self.height[n - 1]);
        (1..self.k.len() - 1).map(bend).fold(0.0, f64::max)
    }

    /// Greatest deviation from even water of any 24th of the depth, as a part of even, after `lasts_s` in steps of
    /// `dt_s`.
    pub(crate) fn unevenness(&self, dt_s: f64, lasts_s: f64) -> f64 {
        let cell = self.depth / CELLS as f64;
        let gained = self.gained(dt_s, cell);
        let mut off = vec![0.0; CELLS];
        // Exchange between two cells, 1/s.
        let per: Vec<f64> = (1..CELLS).map(|n| self.diffusivity(n as f64 * cell).0 / (cell * cell)).collect();
        let first = lasts_s * (GROWTH - 1.0) / (GROWTH.powi(STEPS) - 1.0);
        for n in 0..STEPS {
            spread(&mut off, &per, &gained, first * GROWTH.powi(n));
        }
        let parts = off.chunks(CELLS / PARTS);
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        parts.map(|part| mean(part).abs()).fold(0.0, f64::max)
    }

    /// K_z and its slope at a height.
    fn diffusivity(&self, height: f64) -> (f64, f64) {
        let above = self.height.partition_point(|h| *h <= height);
        let n = above.clamp(1, self.k.len() - 1);
        let slope = (self.k[n] - self.k[n - 1]) / (self.height[n] - self.height[n - 1]);
        (self.k[n - 1] + slope * (height - self.height[n - 1]), slope)
    }

    /// What one step adds to even water per second: by cell, as a part of even.
    fn gained(&self, dt_s: f64, cell: f64) -> Vec<f64> {
        let starts = self.starts(dt_s);
        let here: Vec<(f64, f64)> = starts.iter().map(|h| self.diffusivity(*h)).collect();
        let side = (NORMAL.1 / NORMAL.0) as i32;
        let weight = |x: f64| math::exp(-0.5 * x * x);
        let nodes = |from: i32| (from..=side).map(|n| f64::from(n) * NORMAL.0);
        let all: f64 = nodes(-side).map(weight).sum();
        let mut sums = Sums::new(cell);
        let mut moved = vec![(0.0, 0.0); starts.len()];
        for x in nodes(-side) {
            for ((m, h), (k, slope)) in moved.iter_mut().zip(&starts).zip(&here) {
                let kick = (2.0 * k * dt_s).sqrt() * x;
                let there = self.diffusivity(self.folded(h + kick)).0;
                let secant = if kick.abs() > 1e-5 * self.depth { (there - k) / kick } else { *slope };
                *m = (h + kick, 0.25 * dt_s * (slope + secant));
            }
            for y in nodes(0) {
                // Only the square of the second number counts, so both of its signs are taken together.
                let sides = if y > 0.0 { 2.0 } else { 1.0 };
                let part = sides * weight(x) * weight(y) / (all * all);
                let end = |(to, drift): (f64, f64)| self.folded(to + drift * (x * x + y * y));
                let mut last = end(moved[0]);
                for (m, w) in moved[1..].iter().zip(starts.windows(2)) {
                    let next = end(*m);
                    sums.add(last, next, part * (w[1] - w[0]));
                    last = next;
                }
            }
        }
        let density = sums.density();
        density.iter().map(|c| (c - 1.0) / dt_s).collect()
    }

    /// Starting heights from bed to surface, close together near a level, where the slope bends within a kick.
    fn starts(&self, dt_s: f64) -> Vec<f64> {
        let mut starts = vec![0.0];
        for n in 1..self.k.len() {
            let (low, high) = (self.height[n - 1], self.height[n]);
            let kicks = [n - 1, n].map(|n| (2.0 * self.k[n] * dt_s).sqrt());
            // No finer than rounding and the number of starts allow.
            let least = (high - low) / 2000.0;
            let mut h = low;
            while h < high {
                let near = [h - low + kicks[0], high - h + kicks[1]];
                h += (FINE * near[0].min(near[1])).max(least);
                starts.push(h.min(high));
            }
        }
        starts
    }

    fn folded(&self, height: f64) -> f64 {
        let turned = height.abs() % (2.0 * self.depth);
        turned.min(2.0 * self.depth - turned)
    }
}

/// One implicit step of ∂r/∂t = ∂(K ∂r/∂z)/∂z + q (Thomas' algorithm).
fn spread(r: &mut [f64], per: &[f64], q: &[f64], dt: f64) {
    let n = r.len();
    let mut above = vec![0.0; n];
    for i in 0..n {
        let low = if i > 0 { per[i - 1] * dt } else { 0.0 };
        let up = per.get(i).map_or(0.0, |p| p * dt);
        let (carried, before) = if i > 0 { (above[i - 1], r[i - 1]) } else { (0.0, 0.0) };
        let whole = 1.0 + low + up - low * carried;
        above[i] = up / whole;
        r[i] = (r[i] + q[i] * dt + low * before) / whole;
    }
    for i in (0..n - 1).rev() {
        r[i] += above[i] * r[i + 1];
    }
}

/// Adds up pieces of even density: the mass below each face, as sums of ramps.
struct Sums {
    cell: f64,
    rise: Vec<f64>,
    shift: Vec<f64>,
}

impl Sums {
    fn new(cell: f64) -> Self {
        Self { cell, rise: vec![0.0; CELLS + 2], shift: vec![0.0; CELLS + 2] }
    }

    /// A mass between two heights.
    fn add(&mut self, a: f64, b: f64, mass: f64) {
        let (low, high) = (a.min(b), a.max(b));
        // A piece compressed to a point would have no density.
        let high = high.max(low + 1e-9 * self.cell);
        let rise = mass / (high - low);
        for (from, rise) in [(low, rise), (high, -rise)] {
            // The first face at or above `from`.
            let face = (from / self.cell).ceil() as usize;
            let face = face.min(CELLS + 1);
            self.rise[face] += rise;
            self.shift[face] += rise * from;
        }
    }

    /// Density in each cell.
    fn density(&self) -> Vec<f64> {
        let (mut rise, mut shift, mut below) = (0.0, 0.0, 0.0);
        let mut density = Vec::with_capacity(CELLS);
        for face in 0..=CELLS {
            rise += self.rise[face];
            shift += self.shift[face];
            let mass = rise * (face as f64 * self.cell) - shift;
            if face > 0 {
                density.push((mass - below) / self.cell);
            }
            below = mass;
        }
        density
    }
}
