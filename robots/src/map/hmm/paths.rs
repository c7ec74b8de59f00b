//! The way that odour most likely took from a source to a place: Viterbi's algorithm over the chain.
//!
//! *Source*: Farrell, Pang & Li 2003, third product; Viterbi 1967.
//!
//! *Parameters*: steps between release and now.
//!
//! *Deviations*: reconstructed. The release's age is given, or is the age that most likely brought odour there: the
//! greatest Σ_i π_i Φ_ij(l, k). Of equal paths, the one with the lower cell numbers, counted from its end.

use super::mapper::Hmm;
use crate::map::mapper::Mapper;
use world::math;

/// A path takes no step of a smaller chance than this.
const NEVER: f64 = 1e-300;

impl Hmm {
    /// Cells of the most likely path of odour that was released `age` steps ago and is now in `end`, source first
    /// (`age` + 1 cells); `None` if no path leads there or the chain is shorter.
    pub fn odour_path(&self, end: usize, age: usize) -> Option<Vec<usize>> {
        let chain = self.chain();
        let first = chain.len().checked_sub(age)?;
        let n = self.grid.n;
        let ln = |p: f64| {
            if p > NEVER { math::ln(p) } else { f64::NEG_INFINITY }
        };
        let mut value: Vec<f64> = (self.with.belief.p().iter()).map(|p| ln(*p)).collect();
        let mut from: Vec<Vec<u32>> = Vec::with_capacity(age * 3);
        for step in &chain[first..] {
            // A is a product of one matrix per axis, so the best hop is found axis by axis.
            for axis in 0..3 {
                let levels = if axis == 2 { 1 } else { step.levels.len() };
                let list = |k: usize, i: usize| -> Vec<(usize, f64)> {
                    let all = (0..n[axis]).map(|j| (j, step.hops(axis, k).chance(i, j, n[axis])));
                    all.filter(|(_, p)| *p > NEVER).map(|(j, p)| (j, math::ln(p))).collect()
                };
                let chance: Vec<Vec<_>> = (0..levels).map(|k| (0..n[axis]).map(|i| list(k, i)).collect()).collect();
                let stride = [1, n[0], n[0] * n[1]][axis];
                let mut next = vec![f64::NEG_INFINITY; value.len()];
                let mut origin = vec![u32::MAX; value.len()];
                for (cell, v) in value.iter().enumerate() {
                    if *v == f64::NEG_INFINITY {
                        continue;
                    }
                    let i = cell / stride % n[axis];
                    let k = (cell / (n[0] * n[1])).min(levels - 1);
                    for (j, ln_p) in &chance[k][i] {
                        let to = cell - i * stride + j * stride;
                        if v + ln_p > next[to] {
                            (next[to], origin[to]) = (v + ln_p, cell as u32);
                        }
                    }
                }
                value = next;
                from.push(origin);
            }
        }
        if value[end] == f64::NEG_INFINITY {
            return None;
        }
        let mut at = end;
        let mut path = vec![at];
        for axes in from.chunks(3).rev() {
            for origin in axes.iter().rev() {
                at = origin[at] as usize;
            }
            path.push(at);
        }
        path.reverse();
        Some(path)
    }

    /// The most likely path of odour to `end`, of the age that most likely brought it; `None` while no flow is known,
    /// or if no path leads there.
    pub fn likely_odour_path(&self, end: usize) -> Option<Vec<usize>> {
        let source = self.belief().p.clone();
        let (mut age, mut best, mut most) = (0, None, 0.0);
        self.back(end, |g| {
            age += 1;
            let came: f64 = source.iter().zip(g).map(|(p, g)| p * g).sum();
            if came > most {
                (best, most) = (Some(age), came);
            }
        });
        self.odour_path(end, best?)
    }
}
