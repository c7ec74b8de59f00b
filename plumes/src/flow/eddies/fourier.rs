//! Fast Fourier sum that turns complex coefficients into periodic lines, four side by side.
//!
//! *Source*: Cooley & Tukey 1965, Math. Comp. 19, 297, in the iterative form with bit reversal.
//!
//! *Parameters*: the length, a power of two.
//!
//! *Deviations*: none. The arithmetic is written once, without fused multiply-add, and compiled for each version of
//! `path`, with the same bits.

use crate::simd::dispatch::InstructionSet;
use world::math;

/// Complex coefficients or values of four lines side by side: their real parts, and their imaginary parts.
pub(super) type Four = [[f64; 4]; 2];

/// Twiddle factors of one length.
pub(super) struct Fourier {
    /// Real and imaginary parts, stage after stage: one, two, four and so on.
    turns: Vec<[f64; 2]>,
    /// Pairs of places that change their values before the first stage.
    swaps: Vec<[usize; 2]>,
    path: InstructionSet,
}

impl Fourier {
    pub(super) fn new(n: usize) -> Self {
        assert!(n.is_power_of_two(), "a Fourier sum needs a power of two, got {n}");
        let turn = |k: usize| {
            let (s, c) = math::sin_cos(std::f64::consts::TAU * k as f64 / n as f64);
            [c, s]
        };
        let stages = (0..n.trailing_zeros()).map(|stage| 1 << stage);
        let turns = stages.flat_map(|half: usize| (0..half).map(move |k| k * (n / (2 * half))));
        let bits = n.trailing_zeros();
        let place = |i: usize| i.reverse_bits().checked_shr(usize::BITS - bits).unwrap_or(0);
        Self {
            turns: turns.map(turn).collect(),
            swaps: (0..n).map(|i| [i, place(i)]).filter(|[i, j]| i < j).collect(),
            path: InstructionSet::detect().narrow(),
        }
    }

    /// x_m = Σ_j c_j e^(2πi jm/n) of four lines, in place.
    pub(super) fn sum(&self, c: &mut [Four]) {
        self.path.run(
            #[inline(always)]
            || self.summed(c),
        );
    }

    /// Adds coefficients, each line times a factor, to others.
    pub(super) fn add_times(&self, to: &mut [Four], from: &[Four], factors: [f64; 4]) {
        self.path.run(
            #[inline(always)]
            || add_times(to, from, factors),
        );
    }

    #[inline(always)]
    fn summed(&self, c: &mut [Four]) {
        for [i, j] in &self.swaps {
            c.swap(*i, *j);
        }
        let mut half = 1;
        while half < c.len() {
            let turns = &self.turns[half - 1..2 * half - 1];
            for both in c.chunks_exact_mut(2 * half) {
                let (a, b) = both.split_at_mut(half);
                for ((a, b), [wr, wi]) in a.iter_mut().zip(b).zip(turns) {
                    let [[ar, ai], [br, bi]] = [*a, *b];
                    for l in 0..4 {
                        let tr = wr * br[l] - wi * bi[l];
                        let ti = wr * bi[l] + wi * br[l];
                        (a[0][l], b[0][l]) = (ar[l] + tr, ar[l] - tr);
                        (a[1][l], b[1][l]) = (ai[l] + ti, ai[l] - ti);
                    }
                }
            }
            half *= 2;
        }
    }
}

#[inline(always)]
fn add_times(to: &mut [Four], from: &[Four], factors: [f64; 4]) {
    for (to, from) in to.iter_mut().zip(from) {
        for (to, from) in to.iter_mut().zip(from) {
            for l in 0..4 {
                to[l] += factors[l] * from[l];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_like_the_definition() {
        let n = 32;
        let of = |k: i32| {
            let line = |l: usize| f64::from(k) * 1.3 + l as f64;
            [0, 1].map(|part| [0, 1, 2, 3].map(|l| math::sin(line(l) * f64::from(1 + part * k))))
        };
        let c: Vec<Four> = (0..n).map(of).collect();
        let mut fast = c.clone();
        let mut fourier = Fourier::new(n as usize);
        fourier.sum(&mut fast);
        let mut more = fast.clone();
        add_times(&mut more, &c, [0.3, -0.7, 0.0, 2.0]);
        for path in InstructionSet::all() {
            let mut again = c.clone();
            fourier.path = path;
            fourier.sum(&mut again);
            assert_eq!(again, fast, "{path:?}");
            fourier.add_times(&mut again, &c, [0.3, -0.7, 0.0, 2.0]);
            assert_eq!(again, more, "{path:?}");
        }
        for m in 0..n {
            let mut want = [[0.0; 4]; 2];
            for (j, c) in c.iter().enumerate() {
                let turn = std::f64::consts::TAU * j as f64 * f64::from(m) / f64::from(n);
                let (s, co) = math::sin_cos(turn);
                for l in 0..4 {
                    want[0][l] += c[0][l] * co - c[1][l] * s;
                    want[1][l] += c[0][l] * s + c[1][l] * co;
                }
            }
            let differences = fast[m as usize].iter().flatten().zip(want.iter().flatten());
            for (fast, want) in differences {
                assert!((fast - want).abs() < 1e-12);
            }
        }
    }
}
