//! A belief kept as logarithms, so that an hour of evidence neither underflows nor loses its sum.
//!
//! *Source*: Bayes' rule for a source that stays in place: Wang & Pang, eqs. 4–6, first prior 1/mn.
//!
//! *Parameters*: share of the credible area, 95 %.
//!
//! *Deviations*: the paper works with the probabilities themselves; a cell that was once at zero could then never
//! come back. With several places in a cell (`grid.places`) the source is at one of them, all equally likely at first,
//! and the cell has the sum of their probabilities: the likelihood of all readings together is integrated over the
//! cell. Errors of navigation: see `navigation`.

use super::credible;
use super::doubt::navigation::{Block, NavigationError};
use crate::handoff::{Belief, BeliefGrid, Odour};
use std::sync::Arc;
use world::math;

/// Share of the probability that the credible area holds.
const CREDIBLE: f64 = 0.95;
/// e to a power below this is zero in f64.
const LN_ZERO: f64 = -745.0;

/// Logarithms of the probabilities, and the belief that they represent.
#[derive(Clone, Debug)]
pub(super) struct LogBelief {
    ln_p: Vec<f64>,
    belief: Belief,
    work: Vec<f64>,
    ln_evidence: f64,
    /// Several places in each cell: their probabilities, and the cell of each.
    within: Option<(Vec<f64>, Vec<usize>)>,
    /// The readings since the last fix, if navigation has a stated error, and the logarithm of the probability of all
    /// before them.
    block: Option<(Block, f64)>,
}

impl LogBelief {
    /// All cells with the same probability.
    pub(super) fn uniform(grid: &Arc<BeliefGrid>) -> Self {
        let n = grid.len();
        let mut new = Self {
            ln_p: vec![0.0; n],
            belief: Belief {
                t_s: 0.0,
                updates: 0,
                informed: false,
                grid: grid.clone(),
                p: Arc::new(vec![1.0 / n as f64; n]),
                best: 0,
                entropy_nat: 0.0,
                credible_95: 0.0,
                odour: None,
                outlook: None,
            },
            work: Vec::with_capacity(n),
            ln_evidence: 0.0,
            within: None,
            block: None,
        };
        new.normalise();
        new.ln_evidence = 0.0;
        new
    }

    /// The same for a source at one of the `places`, which are those of the cells or several in each; readings between
    /// two fixes share an error if one is stated.
    pub(super) fn over(cells: &Arc<BeliefGrid>, places: &Arc<BeliefGrid>, stated: Option<NavigationError>) -> Self {
        let mut new = Self::uniform(cells);
        if places.n != cells.n {
            let n = places.len();
            let share = [0, 1, 2].map(|a| places.n[a] / cells.n[a]);
            let cell = |i: usize| {
                let at = places.place(i);
                cells.index([0, 1, 2].map(|a| at[a] / share[a]))
            };
            new.ln_p = vec![-math::ln(n as f64); n];
            new.within = Some((vec![1.0 / n as f64; n], (0..n).map(cell).collect()));
        }
        new.block = stated.map(|s| (Block::new(s, places, &new.ln_p), 0.0));
        new
    }

    /// Probability of each place.
    pub(super) fn p(&self) -> &[f64] {
        match &self.within {
            Some((p, _)) => p,
            None => &self.belief.p,
        }
    }

    /// Logarithm of the probability of all readings so far.
    pub(super) fn ln_evidence(&self) -> f64 {
        self.ln_evidence
    }

    /// A position fix at `t_s`: readings after it no longer share the error of those before.
    pub(super) fn fixed(&mut self, t_s: f64) {
        if let Some((block, before)) = &mut self.block {
            block.fixed(t_s, &self.ln_p);
            *before = self.ln_evidence;
        }
    }

    /// The belief.
    pub(super) fn belief(&self) -> &Belief {
        &self.belief
    }

    /// Logarithms of the probabilities, normalised.
    #[cfg(test)]
    pub(super) fn ln_p(&self) -> &[f64] {
        &self.ln_p
    }

    /// Attaches what is known of the odour to the belief.
    pub(super) fn say(&mut self, odour: Odour) {
        self.belief.odour = Some(Arc::new(odour));
    }

    /// Takes in the likelihood of an observation, one number per cell (greater than zero; a common factor does not
    /// matter), to the power of `share`.
    pub(super) fn update(&mut self, t_s: f64, detected: bool, likelihood: &[f64], share: f64) {
        // Most cells are far from the plume, and all those have the same likelihood.
        let mut last = (1.0, 0.0);
        for (ln_p, l) in self.ln_p.iter_mut().zip(likelihood) {
            assert!(
                *l > 0.0 && l.is_finite(),
                "a cell's likelihood is {l} at {t_s} s; must be > 0: check the mapper's chance of false detection"
            );
            if *l != last.0 {
                last = (*l, math::ln(*l));
            }
            *ln_p += share * last.1;
        }
        if let Some((block, before)) = &mut self.block {
            block.update(t_s, likelihood, share, &mut self.ln_p);
            self.ln_evidence = *before;
        }
        self.belief.t_s = t_s;
        self.belief.updates += 1;
        self.belief.informed |= detected;
        self.normalise();
    }

    /// Replaces the probabilities by others (greater than or equal to zero, not all zero).
    pub(super) fn replace(&mut self, t_s: f64, detected: bool, mass: &[f64]) {
        // Most cells of a map of particles hold none, and all those have the same mass.
        let mut last = (f64::NAN, f64::NAN);
        for (ln_p, m) in self.ln_p.iter_mut().zip(mass) {
            if *m != last.0 {
                last = (*m, math::ln(m.max(1e-300)));
            }
            *ln_p = last.1;
        }
        self.belief.t_s = t_s;
        self.belief.updates += 1;
        self.belief.informed |= detected;
        self.normalise();
    }

    fn normalise(&mut self) {
        let max = self.ln_p.iter().fold(f64::NEG_INFINITY, |m, v| m.max(*v));
        let p: &mut Vec<f64> = match &mut self.within {
            Some((p, _)) => p,
            None => Arc::make_mut(&mut self.belief.p),
        };
        let mut last = (0.0, 1.0);
        for (p, ln_p) in p.iter_mut().zip(&self.ln_p) {
            let x = ln_p - max;
            if x != last.0 {
                last = (x, if x > LN_ZERO { math::exp(x) } else { 0.0 });
            }
            *p = last.1;
        }
        let total = sum(p);
        let (scale, ln_total) = (1.0 / total, max + math::ln(total));
        self.ln_evidence += ln_total;
        let (mut best, mut highest, mut entropy) = (0, f64::NEG_INFINITY, 0.0);
        for (i, (p, ln_p)) in p.iter_mut().zip(&mut self.ln_p).enumerate() {
            *p *= scale;
            *ln_p -= ln_total;
            // A cell of zero probability has no part in the entropy, whatever its logarithm.
            entropy -= *p * *ln_p;
            if *ln_p > highest {
                (best, highest) = (i, *ln_p);
            }
        }
        if let Some((places, cells)) = &self.within {
            let p = Arc::make_mut(&mut self.belief.p);
            p.fill(0.0);
            for (place, cell) in places.iter().zip(cells) {
                p[*cell] += place;
            }
            (best, entropy) = (0, 0.0);
            for (i, v) in p.iter().enumerate() {
                entropy -= v * math::ln(v.max(1e-300));
                if *v > p[best] {
                    best = i;
                }
            }
        }
        let p = &self.belief.p;
        let grid = &self.belief.grid;
        let size = if grid.n[2] == 1 { grid.cell_m[0] * grid.cell_m[1] } else { grid.cell_m.iter().product() };
        self.belief.best = best;
        self.belief.entropy_nat = entropy.max(0.0);
        self.belief.credible_95 = credible::cells(p, CREDIBLE, &mut self.work) as f64 * size;
    }
}

/// Sum in eight lanes: fast, and its error grows with an eighth of the cells.
fn sum(p: &[f64]) -> f64 {
    let mut lanes = [0.0; 8];
    let chunks = p.chunks_exact(8);
    let rest: f64 = chunks.remainder().iter().sum();
    for chunk in chunks {
        for (lane, v) in lanes.iter_mut().zip(chunk) {
            *lane += v;
        }
    }
    lanes.iter().sum::<f64>() + rest
}
