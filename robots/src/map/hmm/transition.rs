//! One step of the hidden Markov chain: the chances A[i, j] that odour goes from cell i to cell j.
//!
//! *Source*: Farrell, Pang & Li 2003 (IEEE SMC-B 33(6)): a Gaussian round the place the measured flow leads to,
//! integrated over the cell.
//!
//! *Parameters*: displacement in the step, m; variance σ² dt, m².
//!
//! *Deviations*: the paper starts from the middle of cell i. Then odour in a flow of less than half a cell a
//! step never leaves its cell; here the Gaussian is averaged over cell i as well, so that the mean displacement
//! is right for any flow. What reaches past the map's sides is lost; in the vertical it is turned back at the
//! map's edges (surface and bed). A Gaussian ends at six standard deviations; each row then sums to 1 again.

use world::math;

/// Standard deviations at which a Gaussian ends.
const REACH: f64 = 6.0;

/// The chances of going `first`, `first + 1`, … cells along an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hops {
    /// Least number of cells.
    pub first: isize,
    /// Chance of each.
    pub p: Vec<f64>,
    /// Turned back at the edges; else lost.
    pub mirrors: bool,
}

impl Hops {
    /// Displacement u and standard deviation s (m) over cells of size h (m).
    pub(super) fn new(u: f64, s: f64, h: f64, mirrors: bool) -> Self {
        let lo = ((u - REACH * s) / h).floor() as isize - 1;
        let hi = ((u + REACH * s) / h).ceil() as isize + 1;
        let f = |d: isize| antiderivative((d as f64 * h - u) / s);
        let raw = |d: isize| ((s / h) * (f(d + 1) - 2.0 * f(d) + f(d - 1))).max(0.0);
        let mut p: Vec<f64> = (lo..=hi).map(raw).collect();
        let total: f64 = p.iter().sum();
        for v in &mut p {
            *v /= total;
        }
        // Chances this small would only cost time.
        let small = |v: &f64| *v < 1e-14;
        let front = p.iter().take_while(|v| small(v)).count();
        let back = p.iter().rev().take_while(|v| small(v)).count();
        let p = p[front..p.len() - back].to_vec();
        Self {
            first: lo + front as isize,
            p,
            mirrors,
        }
    }

    /// Stays where it is.
    pub(super) fn still() -> Self {
        Self {
            first: 0,
            p: vec![1.0],
            mirrors: true,
        }
    }

    /// Where a hop of `d` cells from `i` ends among `n`, if in the map.
    #[inline]
    pub(super) fn land(&self, i: usize, d: isize, n: usize) -> Option<usize> {
        let (mut j, n) = (i as isize + d, n as isize);
        if self.mirrors {
            j = j.rem_euclid(2 * n);
            j = j.min(2 * n - 1 - j);
        }
        (j >= 0 && j < n).then_some(j as usize)
    }

    /// Chance of going from `i` to `j` among `n` cells.
    pub(super) fn chance(&self, i: usize, j: usize, n: usize) -> f64 {
        let hops = (self.first..).zip(&self.p);
        hops.filter(|(d, _)| self.land(i, *d, n) == Some(j))
            .map(|(_, p)| p)
            .sum()
    }

    /// Adjoint, g ← A g: what a place is worth, a step earlier. Only cells `support` of g are not zero; answers
    /// with those of the result.
    pub(super) fn pull(
        &self,
        g: &[f64],
        support: (usize, usize),
        out: &mut [f64],
    ) -> (usize, usize) {
        let n = g.len();
        if n == 1 && self.mirrors {
            // A single layer keeps all.
            out[0] = g[0];
            return (0, 1);
        }
        out.fill(0.0);
        if self.mirrors {
            for (i, o) in out.iter_mut().enumerate() {
                for (d, p) in (self.first..).zip(&self.p) {
                    *o += self.land(i, d, n).map_or(0.0, |j| p * g[j]);
                }
            }
            return (0, n);
        }
        let last = self.first + self.p.len() as isize - 1;
        let edge = |j: isize| j.clamp(0, n as isize) as usize;
        let lo = edge(support.0 as isize - last);
        let hi = edge(support.1 as isize - self.first);
        for (d, p) in (self.first..).zip(&self.p) {
            // out[i] += p·g[i + d] for i + d in the support.
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

/// z Φ(z) + φ(z), whose second differences are the average of a normal distribution over two cells.
fn antiderivative(z: f64) -> f64 {
    let phi = math::exp(-0.5 * z * z) / std::f64::consts::TAU.sqrt();
    let cumulative = 0.5 * (1.0 + math::erf(z * std::f64::consts::FRAC_1_SQRT_2));
    z * cumulative + phi
}

/// One step: first with the flow of the level where it is, then up or down.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Transition {
    /// Along the two horizontal axes: one pair for all levels, or one a level.
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

    /// The flow differs from level to level.
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
            for (d, p) in (hops.first..).zip(&hops.p) {
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
        fn mean_displacement_is_the_flows_and_variance_the_spread_and_the_cells(
            u in -20.0..20.0f64, s in 0.05..5.0f64, h in 0.5..8.0f64,
        ) {
            let hops = Hops::new(u, s, h, false);
            let total: f64 = hops.p.iter().sum();
            let at = |d: isize| d as f64 * h;
            let mean: f64 = (hops.first..).zip(&hops.p).map(|(d, p)| p * at(d)).sum();
            prop_assert!((total - 1.0).abs() < 1e-12);
            prop_assert!((mean - u).abs() < 1e-6 * (1.0 + u.abs()));
            // Start and end within a cell each spread by at most h²/4 beyond the Gaussian.
            let var: f64 = (hops.first..).zip(&hops.p).map(|(d, p)| p * (at(d) - u) * (at(d) - u)).sum();
            prop_assert!(var >= s * s * 0.999_99 && var <= s * s + 0.5 * h * h);
        }
    }

    #[test]
    fn slow_flow_still_moves() {
        let hops = Hops::new(0.2, 0.3, 2.5, false);
        let gone: f64 = (hops.first..)
            .zip(&hops.p)
            .filter(|(d, _)| *d > 0)
            .map(|(_, p)| p)
            .sum();
        assert!(gone > 0.08, "{gone}");
    }

    #[test]
    fn mirrors_lose_nothing() {
        let hops = Hops::new(0.0, 3.0, 1.0, true);
        for i in 0..5 {
            let total: f64 = (0..5).map(|j| hops.chance(i, j, 5)).sum();
            assert!((total - 1.0).abs() < 1e-12);
        }
    }
}
