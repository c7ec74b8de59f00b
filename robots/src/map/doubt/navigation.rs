//! An error of navigation that all readings between two position fixes share.
//!
//! *Source*: Bayes' rule with a nuisance parameter that is integrated out, e.g. Gelman et al. 2013, Bayesian Data
//! Analysis, section 3.1; the errors are those of dead reckoning with fixes, Pang 2009, section 4.
//!
//! *Parameters*: standard deviation of a fix in each horizontal axis, `fix_m`; rate of drift after it, `drift_m_s`.
//!
//! *Deviations*: none of the mappers' papers has this. Between two fixes the believed place is off by the same vector δ
//! ~ N(0, σ²) for all readings, so their joint likelihood Λ is known as a function of s + δ alone, s being the source.
//! Integrated over δ it is Λ convolved with the Gaussian: once per block of readings between two fixes, not once per
//! reading. Blocks are independent: a fix replaces the position. Within a block σ² = fix² + (drift · time since)²,
//! taken for all of its readings at its end. Before the first fix there is drift alone, because the mission begins
//! where the vehicle believes it does. Beyond the map's edge Λ is as at the edge.

use super::evidence::DoubtSpec;
use crate::handoff::BeliefGrid;
use std::sync::Arc;
use world::math;

/// Standard deviations at which the Gaussian is cut off.
const REACH: f64 = 4.0;
/// Below this standard deviation, in cells, a step to either neighbour has the Gaussian's variance; a sampled Gaussian
/// would not.
const NARROW: f64 = 0.7;
/// Least likelihood relative to the greatest of a block.
const LEAST: f64 = 1e-290;

/// The stated error, and how it grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::map) struct NavigationError {
    fix_m: f64,
    drift_m_s: f64,
    /// Begin of the block, s; whether it began with a fix.
    since: Option<(f64, bool)>,
}

impl NavigationError {
    /// As the parameters say; `None` if navigation is taken to be true.
    pub(in crate::map) fn from_doubt(doubt: &DoubtSpec) -> Option<Self> {
        let (fix_m, drift_m_s) = (doubt.fix_m.get(), doubt.drift_m_s.get());
        (fix_m > 0.0 || drift_m_s > 0.0).then_some(Self { fix_m, drift_m_s, since: None })
    }

    /// A fix at `t_s`, or the mission's begin.
    pub(super) fn begin(&mut self, t_s: f64, fixed: bool) {
        self.since = Some((t_s, fixed));
    }

    /// Standard deviation at the begin of the block, m, rate of drift, m/s, and time since, s.
    pub(super) fn parts(&mut self, t_s: f64) -> [f64; 3] {
        let (since_s, fixed) = *self.since.get_or_insert((t_s, false));
        let fix_m = if fixed { self.fix_m } else { 0.0 };
        [fix_m, self.drift_m_s, t_s - since_s]
    }

    /// Standard deviation at `t_s`, m.
    fn sigma_m(&mut self, t_s: f64) -> f64 {
        let [fix_m, rate, dt] = self.parts(t_s);
        (fix_m * fix_m + rate * rate * dt * dt).sqrt()
    }
}

/// The block of readings since the last fix, and what was known before.
#[derive(Clone, Debug)]
pub(in crate::map) struct Block {
    stated: NavigationError,
    grid: Arc<BeliefGrid>,
    /// Logarithm of the probabilities before the block.
    before: Vec<f64>,
    /// Logarithm of the joint likelihood of the block's readings, by the source's apparent place.
    ln_l: Vec<f64>,
    likely: Vec<f64>,
    row: Vec<f64>,
    weights: Vec<f64>,
}

impl Block {
    /// Before the first reading, for places with these logarithms of probabilities.
    pub(in crate::map) fn new(stated: NavigationError, grid: &Arc<BeliefGrid>, ln_p: &[f64]) -> Self {
        Self {
            stated,
            grid: grid.clone(),
            before: ln_p.to_vec(),
            ln_l: vec![0.0; ln_p.len()],
            likely: vec![0.0; ln_p.len()],
            row: Vec::new(),
            weights: Vec::new(),
        }
    }

    /// Closes the block at a fix; `ln_p` is what is known now (normalised).
    pub(in crate::map) fn fixed(&mut self, t_s: f64, ln_p: &[f64]) {
        self.stated.begin(t_s, true);
        self.before.copy_from_slice(ln_p);
        self.ln_l.fill(0.0);
    }

    /// Takes in the likelihood of a reading, to the power of `share`, and writes the logarithms of the probabilities
    /// (not normalised).
    pub(in crate::map) fn update(&mut self, t_s: f64, likelihood: &[f64], share: f64, ln_p: &mut [f64]) {
        let mut most = f64::NEG_INFINITY;
        for (ln_l, l) in self.ln_l.iter_mut().zip(likelihood) {
            *ln_l += share * math::ln(*l);
            most = most.max(*ln_l);
        }
        for (likely, ln_l) in self.likely.iter_mut().zip(&self.ln_l) {
            *likely = math::exp(ln_l - most);
        }
        let sigma_m = self.stated.sigma_m(t_s);
        for axis in 0..2 {
            self.blur(axis, sigma_m / self.grid.cell_m[axis]);
        }
        for ((ln_p, before), likely) in ln_p.iter_mut().zip(&self.before).zip(&self.likely) {
            *ln_p = before + most + math::ln(likely.max(LEAST));
        }
    }

    /// Convolves along an axis with a Gaussian of `sigma` cells.
    fn blur(&mut self, axis: usize, sigma: f64) {
        let n = self.grid.n[axis];
        if sigma == 0.0 || n == 1 {
            return;
        }
        weights(sigma, n, &mut self.weights);
        let stride = [1, self.grid.n[0]][axis];
        self.row.resize(n, 0.0);
        for start in 0..self.likely.len() {
            if !(start / stride).is_multiple_of(n) {
                continue;
            }
            for (i, r) in self.row.iter_mut().enumerate() {
                *r = self.likely[start + i * stride];
            }
            for i in 0..n {
                let mut sum = self.weights[0] * self.row[i];
                for (k, w) in self.weights.iter().enumerate().skip(1) {
                    sum += w * (self.row[i.saturating_sub(k)] + self.row[(i + k).min(n - 1)]);
                }
                self.likely[start + i * stride] = sum;
            }
        }
    }
}

/// Weights of a cell and of its neighbours on one side, for a Gaussian of `sigma` cells that reaches at most `n` cells.
fn weights(sigma: f64, n: usize, out: &mut Vec<f64>) {
    out.clear();
    if sigma < NARROW {
        let aside = 0.5 * sigma * sigma;
        out.extend([1.0 - 2.0 * aside, aside]);
        return;
    }
    let last = (REACH * sigma).ceil().min(n as f64) as usize;
    out.extend((0..=last).map(|k| math::exp(-0.5 * (k as f64 / sigma) * (k as f64 / sigma))));
    let total = out[0] + 2.0 * out[1..].iter().sum::<f64>();
    out.iter_mut().for_each(|w| *w /= total);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::grid;
    use world::ranges::NonNegative;

    fn doubt(fix_m: f64, drift_m_s: f64) -> DoubtSpec {
        DoubtSpec { fix_m: NonNegative::new(fix_m), drift_m_s: NonNegative::new(drift_m_s), ..DoubtSpec::default() }
    }

    /// A row of cells, an even map of it, and a block of readings with an error of two cells.
    fn row() -> (Vec<f64>, Block) {
        let grid = Arc::new(grid([41, 1, 1]));
        let even = vec![0.0; 41];
        let stated = NavigationError::from_doubt(&doubt(2.0 * grid.cell_m[0], 0.0)).expect("an error");
        let mut block = Block::new(stated, &grid, &even);
        block.fixed(0.0, &even);
        (even, block)
    }

    #[test]
    fn weights_have_sum_and_variance_of_the_gaussian() {
        let mut w = Vec::new();
        for sigma in [0.05, 0.3, 0.69, 0.71, 1.0, 3.3] {
            weights(sigma, 1000, &mut w);
            let sum = w[0] + 2.0 * w[1..].iter().sum::<f64>();
            let var: f64 = (w.iter().enumerate()).map(|(k, w)| 2.0 * (k * k) as f64 * w).sum();
            assert!((sum - 1.0).abs() < 1e-12);
            // The tail beyond four standard deviations has a thousandth of the variance.
            assert!((var / (sigma * sigma) - 1.0).abs() < 3e-3, "{sigma}: {var}");
        }
    }

    /// Two readings of one block against the integral over the shift written out, and against each reading blurred for
    /// itself.
    #[test]
    fn readings_of_a_block_share_their_error() {
        let (even, mut block) = row();
        let near = |i: usize, c: f64| math::exp(-0.5 * (i as f64 - c) * (i as f64 - c)) + 1e-9;
        let [a, b] = [20.0, 21.0].map(|c| (0..41).map(|i| near(i, c)).collect::<Vec<f64>>());
        let mut ln_p = even.clone();
        block.update(1.0, &a, 1.0, &mut ln_p);
        block.update(2.0, &b, 1.0, &mut ln_p);
        let shifted = |s: usize, of: &dyn Fn(usize) -> f64| -> f64 {
            let mut w = Vec::new();
            weights(2.0, 41, &mut w);
            let at = |d: isize| of((s as isize + d).clamp(0, 40) as usize);
            (-8..=8).map(|d: isize| w[d.unsigned_abs()] * at(d)).sum()
        };
        for (s, ln_p) in ln_p.iter().enumerate() {
            let joint = shifted(s, &|i| a[i] * b[i]);
            assert!((math::exp(*ln_p) / joint - 1.0).abs() < 1e-9, "{s}");
        }
        // As if every reading had an error of its own, the map would be narrower.
        let width = |p: &[f64]| {
            let sum: f64 = p.iter().sum();
            let mean: f64 = (0..41).map(|i| i as f64 * p[i]).sum::<f64>() / sum;
            (0..41).map(|i| (i as f64 - mean).powi(2) * p[i]).sum::<f64>() / sum
        };
        let own: Vec<f64> = (0..41).map(|s| shifted(s, &|i| a[i]) * shifted(s, &|i| b[i])).collect();
        let shared: Vec<f64> = ln_p.iter().map(|v| math::exp(*v)).collect();
        assert!(width(&shared) > 1.5 * width(&own));
    }

    #[test]
    fn each_block_has_an_error_of_its_own_and_drift_grows_within_it() {
        let mut stated = NavigationError::from_doubt(&doubt(3.0, 0.1)).expect("an error");
        assert_eq!(stated.sigma_m(5.0), 0.0);
        assert!((stated.sigma_m(15.0) - 1.0).abs() < 1e-12);
        stated.begin(20.0, true);
        assert_eq!(stated.sigma_m(20.0), 3.0);
        assert!((stated.sigma_m(60.0) - 5.0).abs() < 1e-12);
        assert_eq!(NavigationError::from_doubt(&doubt(0.0, 0.0)), None);
        // Two blocks with the same reading: the second narrows what the first has left.
        let (even, mut block) = row();
        let one: Vec<f64> = (0..41).map(|i| if i == 20 { 1.0 } else { 1e-9 }).collect();
        let mut ln_p = even;
        block.update(1.0, &one, 1.0, &mut ln_p);
        block.update(2.0, &one, 1.0, &mut ln_p);
        let ratio = ln_p[20] - ln_p[22];
        block.fixed(30.0, &ln_p.clone());
        block.update(31.0, &one, 1.0, &mut ln_p);
        assert!((ln_p[20] - ln_p[22] - 2.0 * ratio).abs() < 1e-5);
    }
}
