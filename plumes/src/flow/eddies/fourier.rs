//! Fast Fourier sum that turns complex coefficients into a periodic line.
//!
//! *Source*: Cooley & Tukey 1965, Math. Comp. 19, 297, in the iterative form with bit reversal.
//!
//! *Parameters*: the length, a power of two.
//!
//! *Deviations*: none. The arithmetic is written once, without fused multiply-add, and compiled for each version of
//! `path`, with the same bits.

use crate::path::Path;
use world::math;

/// Twiddle factors of one length.
pub(super) struct Fourier {
    /// Real and imaginary parts, stage after stage: one, two, four and so on.
    turns: [Vec<f64>; 2],
    /// Where each number of the input goes.
    places: Vec<usize>,
    path: Path,
}

impl Fourier {
    pub(super) fn new(n: usize) -> Self {
        assert!(
            n.is_power_of_two(),
            "a Fourier sum needs a power of two, got {n}"
        );
        let turn = |k: usize| math::sin_cos(std::f64::consts::TAU * k as f64 / n as f64);
        let stages = (0..n.trailing_zeros()).map(|stage| 1 << stage);
        let turns = stages.flat_map(|half: usize| (0..half).map(move |k| k * (n / (2 * half))));
        let (imaginary, real) = turns.map(turn).unzip();
        let bits = n.trailing_zeros();
        let place = |i: usize| {
            i.reverse_bits()
                .checked_shr(usize::BITS - bits)
                .unwrap_or(0)
        };
        Self {
            turns: [real, imaginary],
            places: (0..n).map(place).collect(),
            path: Path::detect(),
        }
    }

    /// x_m = Σ_j c_j e^(2πi jm/n), in place.
    pub(super) fn sum(&self, c: &mut [[f64; 2]]) {
        match self.path {
            Path::Portable => self.summed(c),
            // SAFETY: this variant is only made after the feature was detected.
            #[cfg(target_arch = "x86_64")]
            Path::Avx2 | Path::Avx512 => unsafe { self.summed_avx2(c) },
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn summed_avx2(&self, c: &mut [[f64; 2]]) {
        self.summed(c);
    }

    #[inline(always)]
    fn summed(&self, c: &mut [[f64; 2]]) {
        let n = c.len();
        // Real and imaginary parts apart, so that the processor works on several at once.
        let mut real: Vec<f64> = self.places.iter().map(|j| c[*j][0]).collect();
        let mut imaginary: Vec<f64> = self.places.iter().map(|j| c[*j][1]).collect();
        let mut half = 1;
        while half < n {
            let [wr, wi] = [0, 1].map(|part| &self.turns[part][half - 1..2 * half - 1]);
            let pairs = real.chunks_exact_mut(2 * half);
            for (real, imaginary) in pairs.zip(imaginary.chunks_exact_mut(2 * half)) {
                let ((ar, br), (ai, bi)) = (real.split_at_mut(half), imaginary.split_at_mut(half));
                for k in 0..half {
                    let tr = wr[k] * br[k] - wi[k] * bi[k];
                    let ti = wr[k] * bi[k] + wi[k] * br[k];
                    (ar[k], br[k]) = (ar[k] + tr, ar[k] - tr);
                    (ai[k], bi[k]) = (ai[k] + ti, ai[k] - ti);
                }
            }
            half *= 2;
        }
        for ((c, real), imaginary) in c.iter_mut().zip(real).zip(imaginary) {
            *c = [real, imaginary];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_like_the_definition() {
        let n = 32;
        let c: Vec<[f64; 2]> = (0..n)
            .map(|k| [math::sin(f64::from(k) * 1.3), math::cos(f64::from(k * k))])
            .collect();
        let mut fast = c.clone();
        let mut fourier = Fourier::new(n as usize);
        fourier.sum(&mut fast);
        for path in Path::all() {
            let mut again = c.clone();
            fourier.path = path;
            fourier.sum(&mut again);
            assert_eq!(again, fast, "{path:?}");
        }
        for m in 0..n {
            let mut want = [0.0, 0.0];
            for (j, c) in c.iter().enumerate() {
                let turn = std::f64::consts::TAU * j as f64 * f64::from(m) / f64::from(n);
                let (s, co) = math::sin_cos(turn);
                want[0] += c[0] * co - c[1] * s;
                want[1] += c[0] * s + c[1] * co;
            }
            for d in 0..2 {
                assert!((fast[m as usize][d] - want[d]).abs() < 1e-12);
            }
        }
    }
}
