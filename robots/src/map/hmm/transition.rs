//! One step of the hidden Markov chain: the chances A[i, j] that odour goes from cell i to cell j.
//!
//! *Source*: Farrell, Pang & Li 2003 (IEEE SMC-B 33(6)): a Gaussian around the place to which the measured flow
//! leads, integrated over the cell.
//!
//! *Parameters*: displacement in the step, m; variance σ² dt, m².
//!
//! *Deviations*: the paper starts each step from the middle of cell i. Then odour never leaves its cell in a flow of
//! less than half a cell per step. If odour instead started from anywhere in the cell, each step with a fractional
//! displacement f h would add a variance of f (1 − f) h² (and a step without flow 0.8 σ√dt h) that water does not
//! have: with cells of 2.5 × 4 m and 0.5 m/√s six times the plume's own. Here the rest of the displacement is carried
//! into the next step ([`Drift`]): each step goes whole cells, their sum stays within half a cell of the flow's, and
//! the hops to both sides have exactly the variance σ² dt ([`spread`]). Odour that goes beyond the map's sides is
//! lost; in the vertical it is reflected at the map's edges (surface and bed).

use std::sync::Arc;

/// Greatest share of the odour that goes one cell to either side in one part of a step.
const MOST_ASIDE: f64 = 0.25;
/// Most parts of a step: a spread of 32 cells.
const MOST_PARTS: f64 = 2000.0;
/// Chances this small would only cost time.
const SMALL: f64 = 1e-14;

/// Greatest spread in a step over cells of h (m), m. For odour that spreads farther in one step the cells must be
/// larger.
pub(super) fn widest(h: f64) -> f64 {
    (2.0 * MOST_PARTS * MOST_ASIDE).sqrt() * h
}

/// Chances of −n … n cells for a spread of standard deviation s over cells of h (m). They come from as many hops of
/// one cell to either side as give exactly the variance s²; for many hops they are the Gaussian. `None` if s is
/// beyond [`widest`].
pub(super) fn spread(s: f64, h: f64) -> Option<Arc<[f64]>> {
    let aside = 0.5 * s * s / (h * h);
    let parts = (aside / MOST_ASIDE).ceil().max(1.0);
    // A number that is not finite is refused as well.
    if !(parts <= MOST_PARTS) {
        return None;
    }
    let q = aside / parts;
    let mut p = vec![1.0];
    for _ in 0..parts as usize {
        let mut next = vec![0.0; p.len() + 2];
        for (i, v) in p.iter().enumerate() {
            next[i] += q * v;
            next[i + 1] += (1.0 - 2.0 * q) * v;
            next[i + 2] += q * v;
        }
        let ends = next.iter().take_while(|v| **v < SMALL).count();
        p = next[ends..next.len() - ends].to_vec();
    }
    Some(p.into())
}

/// Splits a displacement into whole cells and a rest that is carried into the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Drift {
    left_m: [f64; 2],
}

impl Drift {
    /// Number of cells to move in a step of displacement `u` (m) over cells of `cell_m`.
    pub(super) fn cells(&mut self, u: [f64; 2], cell_m: [f64; 3]) -> [isize; 2] {
        [0, 1].map(|a| {
            let due = self.left_m[a] + u[a];
            // A displacement beyond this leaves any map, and still fits an integer.
            let cells = (due / cell_m[a]).round().clamp(-1e9, 1e9);
            self.left_m[a] = due - cells * cell_m[a];
            cells as isize
        })
    }
}

/// The chances of moving `first`, `first + 1`, … cells along an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hops {
    /// Least number of cells.
    pub first: isize,
    /// Chance of each number of cells.
    pub p: Arc<[f64]>,
    /// Whether odour is reflected at the edges; otherwise it is lost.
    pub mirrors: bool,
}

impl Hops {
    /// A move of `by` cells with a spread (of −n … n cells) around it.
    pub(super) fn new(by: isize, spread: &Arc<[f64]>, mirrors: bool) -> Self {
        Self { first: by - (spread.len() / 2) as isize, p: spread.clone(), mirrors }
    }

    /// No move.
    pub(super) fn still() -> Self {
        Self { first: 0, p: Arc::new([1.0]), mirrors: true }
    }

    /// The cell where a hop of `d` cells from `i` ends among `n`, if it is in the map.
    #[inline]
    pub(super) fn land(&self, i: usize, d: isize, n: usize) -> Option<usize> {
        let (mut j, n) = (i as isize + d, n as isize);
        if self.mirrors {
            j = j.rem_euclid(2 * n);
            j = j.min(2 * n - 1 - j);
        }
        (j >= 0 && j < n).then_some(j as usize)
    }

    /// Chance of moving from `i` to `j` among `n` cells.
    pub(super) fn chance(&self, i: usize, j: usize, n: usize) -> f64 {
        let hops = (self.first..).zip(self.p.iter());
        hops.filter(|(d, _)| self.land(i, *d, n) == Some(j)).map(|(_, p)| p).sum()
    }

    /// The adjoint, g ← A g: from the values of the cells after a step to their values before it. Only the cells
    /// `support` of g are not zero; returns the range of cells that are not zero in the result.
    pub(super) fn pull(&self, g: &[f64], support: (usize, usize), out: &mut [f64]) -> (usize, usize) {
        let n = g.len();
        if n == 1 && self.mirrors {
            // A single layer keeps everything.
            out[0] = g[0];
            return (0, 1);
        }
        out.fill(0.0);
        if self.mirrors {
            for (i, o) in out.iter_mut().enumerate() {
                for (d, p) in (self.first..).zip(self.p.iter()) {
                    *o += self.land(i, d, n).map_or(0.0, |j| p * g[j]);
                }
            }
            return (0, n);
        }
        let last = self.first + self.p.len() as isize - 1;
        let edge = |j: isize| j.clamp(0, n as isize) as usize;
        let lo = edge(support.0 as isize - last);
        let hi = edge(support.1 as isize - self.first);
        for (d, p) in (self.first..).zip(self.p.iter()) {
            // out[i] += p·g[i + d] for all i + d in the support.
            let from = edge(support.0 as isize - d);
            let to = edge(support.1 as isize - d);
            if from < to {
                let g = &g[(from as isize + d) as usize..(to as isize + d) as usize];
                for (o, g) in out[from..to].iter_mut().zip(g) {
                    *o += p * g;
                }
            }
        }
        (lo, hi)
    }
}

/// One step: first with the flow of the odour's level, then up or down.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Transition {
    /// Along the two horizontal axes: one pair for all levels, or one per level.
    pub levels: Vec<[Hops; 2]>,
    /// Up and down.
    pub vertical: Hops,
}

impl Transition {
    /// The hops along an axis from level `k`.
    pub(super) fn hops(&self, axis: usize, k: usize) -> &Hops {
        if axis == 2 {
            return &self.vertical;
        }
        &self.levels[k.min(self.levels.len() - 1)][axis]
    }

    /// Whether the flow differs between levels.
    pub(super) fn sheared(&self) -> bool {
        self.levels.len() > 1
    }

    /// Forward along one axis of a whole map, α ← Aᵀ α.
    pub(super) fn push(&self, axis: usize, alpha: &[f64], n: [usize; 3], out: &mut [f64]) {
        let stride = [1, n[0], n[0] * n[1]][axis];
        out.fill(0.0);
        for (index, a) in alpha.iter().enumerate() {
            if *a == 0.0 {
                continue;
            }
            let i = index / stride % n[axis];
            let base = index - i * stride;
            let hops = self.hops(axis, index / (n[0] * n[1]));
            for (d, p) in (hops.first..).zip(hops.p.iter()) {
                if let Some(j) = hops.land(i, d, n[axis]) {
                    out[base + j * stride] += p * a;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(128))]

        #[test]
        fn steps_add_up_to_the_flow_and_spread_by_their_variance_alone(
            u in -20.0..20.0f64, s in 0.05..5.0f64, h in 0.5..8.0f64,
        ) {
            let mut drift = Drift::default();
            let p = spread(s, h).expect("not beyond the widest");
            let (mut upto, mut asked) = (0.0, 0.0);
            for _ in 0..50 {
                let [i, _] = drift.cells([u, 0.0], [h; 3]);
                let hops = Hops::new(i, &p, false);
                let of = |f: &dyn Fn(f64) -> f64| -> f64 {
                    (hops.first..).zip(hops.p.iter()).map(|(d, p)| p * f(d as f64 * h)).sum()
                };
                let mean = of(&|x| x);
                let var = of(&|x| (x - mean) * (x - mean));
                prop_assert!((of(&|_| 1.0) - 1.0).abs() < 1e-11);
                prop_assert!((var - s * s).abs() < 1e-9 * (1.0 + s * s), "{var} {}", s * s);
                (upto, asked) = (upto + mean, asked + u);
                prop_assert!((upto - asked).abs() <= 0.5 * h + 1e-9);
            }
        }
    }

    #[test]
    fn a_spread_over_too_many_cells_is_none() {
        let h = 2.5;
        assert!(spread(widest(h) * 0.999, h).is_some());
        assert!(spread(widest(h) * 1.001, h).is_none());
        assert!(spread(65_536.0, 1e-6).is_none());
        assert!(spread(f64::INFINITY, 1.0).is_none());
    }

    #[test]
    fn mirrors_lose_nothing() {
        let hops = Hops::new(0, &spread(3.0, 1.0).unwrap(), true);
        for i in 0..5 {
            let total: f64 = (0..5).map(|j| hops.chance(i, j, 5)).sum();
            assert!((total - 1.0).abs() < 1e-12);
        }
    }
}
