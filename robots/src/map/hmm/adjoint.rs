//! The chance that odour of each cell is met at the vehicle, computed backwards from the vehicle.
//!
//! *Source*: the adjoint of Farrell, Pang & Li 2003's product of transition matrices. Of Φ(l, k) = A_{l+1} … A_k only
//! the column of the vehicle's cell j is needed, so g_k = e_j, g_{l−1} = A_l g_l and Φ_ij(l, k) = g_l[i]: each step
//! takes one product of a matrix and a vector instead of a product of two matrices.
//!
//! *Parameters*: none.
//!
//! *Deviations*: if the flow is the same at all levels, each A is a product of one matrix per axis, and so is each g:
//! three rows instead of a map. Neighbouring steps whose g are nearly equal (by the rule of `releases`; `merge` = 0:
//! never) then enter as a power of one g, the mean along each axis. In sheared flow g is a whole map.
//! With several places in a cell the chance at the vehicle's place stands for the cell's size round it, as in `kernel`.

use super::mapper::Hmm;
use super::transition::Hops;
use crate::map::kernel::terms::{LEAST, Terms};

/// When less than this share of odour is left in the map, it is followed no further back.
const GONE: f64 = 1e-12;

impl Hmm {
    /// Chance of no detection with the vehicle in `cell`, for a source in each cell.
    pub(super) fn not_detecting(&mut self, cell: usize, out: &mut [f64]) {
        if self.steps.iter().chain(&self.assumed).any(|s| s.sheared()) {
            out.fill(1.0);
            let meets = (self.with.places * self.with.places) as f64;
            self.back(cell, |g| {
                for (o, g) in out.iter_mut().zip(g) {
                    *o = (*o * (1.0 - self.b * (meets * g).min(1.0))).max(LEAST);
                }
            });
        } else {
            self.look_back(cell);
            self.terms.product(self.b, out);
        }
    }

    /// The same rows for releases of a size: the chance that dye with its middle in each cell is met.
    fn rows_met(&self, cell: usize) -> [Vec<f64>; 3] {
        let mut rows = self.rows_at(cell);
        for (a, size) in self.size.iter().enumerate().filter(|(_, s)| s.len() > 1) {
            let point = std::mem::take(&mut rows[a]);
            rows[a] = vec![0.0; point.len()];
            Hops::new(0, size, false).pull(&point, (0, point.len()), &mut rows[a]);
        }
        rows
    }

    /// One row per axis for a place: 1 at the place, 0 elsewhere.
    pub(super) fn rows_at(&self, cell: usize) -> [Vec<f64>; 3] {
        let place = self.grid.place(cell);
        [0, 1, 2].map(|a| {
            let mut row = vec![0.0; self.grid.n[a]];
            row[place[a]] = 1.0;
            row
        })
    }

    /// Builds the terms of all steps back from now for a vehicle in `cell`, for a flow that is the same at all
    /// levels.
    fn look_back(&mut self, cell: usize) {
        let mut g = self.rows_met(cell);
        let mut earlier = g.clone();
        let mut support = self.grid.place(cell).map(|i| (i, i + 1));
        for (a, size) in self.size.iter().enumerate() {
            let far = size.len() / 2;
            let (lo, hi) = support[a];
            support[a] = (lo.saturating_sub(far), (hi + far).min(self.grid.n[a]));
        }
        self.gatherer.gather(self.with.watch.history.releases());
        let mut terms = std::mem::replace(&mut self.terms, Terms::new(self.grid.n));
        terms.clear();
        let chain = self.chain();
        let mut sets = self.gatherer.sets.iter().map(|set| set.log2);
        let mut steps = chain.iter().rev();
        let mut mean = g.clone();
        while steps.len() > 0 {
            let log2 = sets.next().unwrap_or(0);
            let mut reach = [(usize::MAX, 0); 3];
            mean.iter_mut().for_each(|row| row.fill(0.0));
            for step in steps.by_ref().take(1 << log2) {
                for a in 0..3 {
                    support[a] = step.hops(a, 0).pull(&g[a], support[a], &mut earlier[a]);
                    reach[a] = (reach[a].0.min(support[a].0), reach[a].1.max(support[a].1));
                }
                std::mem::swap(&mut g, &mut earlier);
                for (sum, row) in mean.iter_mut().zip(&g) {
                    for (s, v) in sum.iter_mut().zip(row) {
                        *s += v;
                    }
                }
            }
            let peaks = mean.iter().map(|row| row.iter().fold(0.0, |m: f64, v| m.max(*v)));
            if peaks.product::<f64>() < GONE {
                break;
            }
            let share = 1.0 / f64::from(1_u32 << log2);
            let places = self.with.places as f64;
            terms.add(log2, |a, row| {
                let meets = if a < 2 { share * places } else { share };
                for (r, m) in row.iter_mut().zip(&mean[a]) {
                    *r = m * meets;
                }
                reach[a]
            });
        }
        self.terms = terms;
    }

    /// Calls `each` with g of each step back from now, always as a whole map.
    pub(super) fn back(&self, cell: usize, mut each: impl FnMut(&[f64])) {
        let n = self.grid.n;
        let layer = n[0] * n[1];
        let mut g = vec![0.0; self.grid.len()];
        let ([x, y, _], k) = (self.rows_met(cell), self.grid.place(cell)[2]);
        for (j, across) in y.iter().enumerate().filter(|(_, v)| **v > 0.0) {
            let row = self.grid.index([0, j, k]);
            for (g, along) in g[row..].iter_mut().zip(&x) {
                *g = across * along;
            }
        }
        let mut earlier = g.clone();
        let longest = n[0].max(n[1]).max(n[2]);
        let (mut line, mut pulled) = (vec![0.0; longest], vec![0.0; longest]);
        for step in self.chain().iter().rev() {
            // Backwards: first the vertical, then each level with its own flow.
            for axis in [2, 1, 0] {
                let stride = [1, n[0], layer][axis];
                for start in (0..g.len()).filter(|c| (c / stride).is_multiple_of(n[axis])) {
                    let along = (0..n[axis]).map(|i| start + i * stride);
                    let mut any = false;
                    for (l, c) in line.iter_mut().zip(along.clone()) {
                        *l = g[c];
                        any |= g[c] > 0.0;
                    }
                    let row = &mut pulled[..n[axis]];
                    row.fill(0.0);
                    if any {
                        let hops = step.hops(axis, start / layer);
                        hops.pull(&line[..n[axis]], (0, n[axis]), row);
                    }
                    for (c, v) in along.zip(row) {
                        earlier[c] = *v;
                    }
                }
                std::mem::swap(&mut g, &mut earlier);
            }
            if g.iter().fold(0.0, |m: f64, v| m.max(*v)) < GONE {
                break;
            }
            each(&g);
        }
    }
}
