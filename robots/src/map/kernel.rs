//! The chance that dye from each cell was met: Gaussians around the back-trajectory of the measured flow.
//!
//! *Source*: Wang & Pang, eqs. 1–3, after Pang & Farrell 2006.
//!
//! *Parameters*: μ `mu`; σx, σy, σz, m/√s; look-back h, s; the cell's size Lx, Ly, Lz; u′ and T are ours: see
//! `TrajectorySpec::strayed_m2`.
//!
//! *Deviations*: the papers are two-dimensional. Here there may be a third factor for the vertical, with mirror
//! images in the map's upper and lower edge (surface and bed), and no vertical flow. A Gaussian is cut off seven
//! standard deviations from its middle (it is 2.3e-11 of its peak there). Chances above 1 and merged releases: see
//! `terms` and `releases`. The vehicle's place is the middle of its cell, as in the paper.

mod anywhere;
pub(super) mod flow_history;
pub(super) mod releases;
pub(super) mod terms;

use super::spec::TrajectorySpec;
use crate::handoff::BeliefGrid;
use anywhere::{REACH, ROOT_TAU, ReleaseSets};
use flow_history::FlowHistory;
use releases::Gatherer;
use std::sync::Arc;
use terms::Terms;
use world::math;

/// The kernel over a grid, centred on the vehicle's place.
#[derive(Clone, Debug)]
pub(super) struct Kernel {
    grid: Arc<BeliefGrid>,
    /// The cell within which dye is met, m: that of eq. 1, however many places it has.
    meets_m: [f64; 3],
    mu: f64,
    gatherer: Gatherer,
    terms: Terms,
    image: Vec<f64>,
    at: [f64; 3],
}

impl Kernel {
    /// A kernel before its first use.
    #[cfg(test)]
    pub(super) fn new(grid: &Arc<BeliefGrid>, spec: &TrajectorySpec) -> Self {
        Self::within(grid, 1, spec)
    }

    /// The same for a grid of places, so many in a cell along each horizontal axis.
    pub(super) fn within(grid: &Arc<BeliefGrid>, places: usize, spec: &TrajectorySpec) -> Self {
        let k = places as f64;
        let meets_m = [grid.cell_m[0] * k, grid.cell_m[1] * k, grid.cell_m[2]];
        let horizontal = [meets_m[0], meets_m[1]];
        Self {
            meets_m,
            grid: grid.clone(),
            mu: spec.mu.get(),
            gatherer: Gatherer::new(spec, horizontal),
            terms: Terms::new(grid.n),
            image: vec![0.0; grid.n[2]],
            at: [0.0; 3],
        }
    }

    /// Gathers the releases of the history for a sensor in the middle of `cell`.
    pub(super) fn gather(&mut self, history: &FlowHistory, cell: usize) {
        self.at = self.grid.local_centre(cell);
        self.gatherer.gather(history.releases());
    }

    /// [`Kernel::gather`], then the tables for the whole grid.
    pub(super) fn aim(&mut self, history: &FlowHistory, cell: usize) {
        self.gather(history, cell);
        self.terms.clear();
        let (grid, at, image) = (&self.grid, self.at, &mut self.image);
        let meets_m = self.meets_m;
        let high = grid.cell_m[2] * grid.n[2] as f64;
        for set in &self.gatherer.sets {
            self.terms.add(set.log2, |axis, row| {
                let (h, s) = (grid.cell_m[axis], set.var_m2[axis].sqrt());
                if axis < 2 {
                    let reach = gaussian(row, at[axis] - set.s_m[axis], h, s);
                    if meets_m[axis] != h {
                        let share = meets_m[axis] / h;
                        row[reach.0..reach.1].iter_mut().for_each(|g| *g *= share);
                    }
                    reach
                } else if grid.n[2] == 1 {
                    row.fill(1.0);
                    (0, 1)
                } else {
                    let mut reach = gaussian(row, at[2], h, s);
                    for mirrored in [-at[2], 2.0 * high - at[2]] {
                        image.fill(0.0);
                        let (lo, hi) = gaussian(image, mirrored, h, s);
                        if lo < hi {
                            reach = (reach.0.min(lo), reach.1.max(hi));
                            for (a, b) in row.iter_mut().zip(image.iter()) {
                                *a += b;
                            }
                        }
                    }
                    reach
                }
            });
        }
    }

    /// γ, the chance of no detection, for a source in each cell.
    pub(super) fn not_detecting(&self, out: &mut [f64]) {
        self.terms.product(self.mu, out);
    }

    /// Σ p over the releases, for a source in each cell.
    pub(super) fn expected(&self, out: &mut [f64]) {
        self.terms.sum(out);
    }

    /// The same for a source at any place, after [`Kernel::gather`] or [`Kernel::aim`].
    pub(super) fn anywhere(&self) -> ReleaseSets {
        ReleaseSets::new(&self.grid, self.meets_m, self.mu, self.at, &self.gatherer.sets)
    }

    /// The vehicle's place for which it was made, in the grid's own axes, m.
    pub(super) fn place(&self) -> [f64; 3] {
        self.at
    }

    /// Sets of releases in use.
    #[cfg(test)]
    pub(super) fn sets(&self) -> usize {
        self.gatherer.sets.len()
    }
}

/// Adds h/(√(2π) s)·exp(−x²/2s²) to a row of zeros, where x is the distance of each cell's middle from `peak`; the
/// cells are `h` wide and the first one's middle is at h/2. Returns the cells reached. It uses ratios from the cell
/// nearest to the peak outwards: four exponentials per row, and an error under n²·1e-16.
fn gaussian(row: &mut [f64], peak: f64, h: f64, s: f64) -> (usize, usize) {
    let n = row.len() as f64;
    let first = 0.5 * h - peak;
    let lo = ((-REACH * s - first) / h).ceil().clamp(0.0, n);
    let hi = ((REACH * s - first) / h).floor().clamp(-1.0, n - 1.0);
    if hi < lo {
        return (0, 0);
    }
    let (lo, hi) = (lo as usize, hi as usize);
    let mid = (-first / h).round().clamp(lo as f64, hi as f64) as usize;
    let x = first + mid as f64 * h;
    let a = 0.5 / (s * s);
    let top = h / (ROOT_TAU * s) * math::exp(-x * x * a);
    let bend = math::exp(-2.0 * h * h * a);
    row[mid] = top;
    let (mut g, mut ratio) = (top, math::exp(-(2.0 * x + h) * h * a));
    for cell in &mut row[mid + 1..=hi] {
        g *= ratio;
        ratio *= bend;
        *cell = g;
    }
    let (mut g, mut ratio) = (top, math::exp((2.0 * x - h) * h * a));
    for cell in row[lo..mid].iter_mut().rev() {
        g *= ratio;
        ratio *= bend;
        *cell = g;
    }
    (lo, hi + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn ratios_give_the_exponential(
            peak in -300.0..600.0f64, h in 0.1..10.0f64, s in 0.05..40.0f64,
        ) {
            let mut row = vec![0.0; 100];
            let (lo, hi) = gaussian(&mut row, peak, h, s);
            for (i, g) in row.iter().enumerate() {
                let x = (i as f64 + 0.5) * h - peak;
                let exact = h / (ROOT_TAU * s) * math::exp(-x * x / (2.0 * s * s));
                if i >= lo && i < hi {
                    prop_assert!((g - exact).abs() <= 1e-11 * exact + 1e-300, "{i}: {g} {exact}");
                } else {
                    prop_assert!(*g == 0.0 && exact < 2.4e-11 * h / (ROOT_TAU * s));
                }
            }
        }
    }
}
