//! Where odour is likely to be met now, and the vehicle's path that most likely meets it.
//!
//! *Source*: Farrell, Pang & Li 2003: the detection likelihood by place and the path most likely to detect, the first
//! and the last of its four products (the second is the source map itself, the third is in `paths`).
//!
//! *Parameters*: steps of the path.
//!
//! *Deviations*: reconstructed. Expected odour by place: α ← Aᵀ (α + π) from the oldest step to the newest, with one
//! release per step from the present source map π; chance of detecting 1 − exp(−b α), as for independent releases of
//! small chances. In each step the path moves to one of eight neighbours (26 in space) or stays. It has the greatest
//! chance of at least one detection if these chances stay as they are; a place counts each time it is visited.

use super::mapper::Hmm;
use crate::handoff::Odour;
use world::math;

impl Hmm {
    /// Present chance of a detection in each cell, given the source map and the flow of the look-back.
    pub fn detection_map(&self) -> Vec<f64> {
        let n = self.grid.n;
        let source = self.with.belief.p();
        let mut alpha = vec![0.0; self.grid.len()];
        let mut next = alpha.clone();
        for step in self.chain() {
            for (a, p) in alpha.iter_mut().zip(source.iter()) {
                *a += p;
            }
            for axis in 0..3 {
                step.push(axis, &alpha, n, &mut next);
                std::mem::swap(&mut alpha, &mut next);
            }
        }
        alpha.iter().map(|a| 1.0 - math::exp(-self.b * a)).collect()
    }

    /// All products except the source map, for a vehicle in `cell`; the path most likely to detect has `steps` steps.
    pub(super) fn odour(&self, t_s: f64, cell: usize, steps: usize) -> Odour {
        let detection = self.detection_map();
        let mut walk = vec![cell];
        walk.extend(best_walk(self.grid.n, &detection, cell, steps));
        Odour { t_s, grid: self.grid.clone(), came: self.likely_odour_path(cell).unwrap_or_default(), detection, walk }
    }
}

/// Path of `steps` moves from `start` with the least Π (1 − p), by dynamic programming over cells and steps.
pub(super) fn best_walk(n: [usize; 3], p: &[f64], start: usize, steps: usize) -> Vec<usize> {
    let gain: Vec<f64> = p.iter().map(|p| -math::ln((1.0 - p).max(1e-300))).collect();
    let mut best = vec![f64::NEG_INFINITY; p.len()];
    best[start] = 0.0;
    let mut from: Vec<Vec<usize>> = Vec::with_capacity(steps);
    for _ in 0..steps {
        let mut next = vec![f64::NEG_INFINITY; p.len()];
        let mut origin = vec![usize::MAX; p.len()];
        for (cell, value) in best.iter().enumerate() {
            if *value > f64::NEG_INFINITY {
                for to in neighbours(n, cell) {
                    let reached = value + gain[to];
                    if reached > next[to] {
                        (next[to], origin[to]) = (reached, cell);
                    }
                }
            }
        }
        best = next;
        from.push(origin);
    }
    let mut at = (0..best.len()).fold(start, |m, c| if best[c] > best[m] { c } else { m });
    let mut path = vec![at];
    for origin in from.iter().rev() {
        at = origin[at];
        path.push(at);
    }
    path.reverse();
    path.remove(0);
    path
}

/// The cell itself and all cells that touch it.
pub(super) fn neighbours(n: [usize; 3], cell: usize) -> impl Iterator<Item = usize> {
    let place = [cell % n[0], cell / n[0] % n[1], cell / (n[0] * n[1])];
    let span = [0, 1, 2].map(|a| (place[a].saturating_sub(1), (place[a] + 1).min(n[a] - 1)));
    (span[2].0..=span[2].1).flat_map(move |k| {
        (span[1].0..=span[1].1).flat_map(move |j| (span[0].0..=span[0].1).map(move |i| (k * n[1] + j) * n[0] + i))
    })
}
