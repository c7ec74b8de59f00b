//! Fast Fourier sum that turns complex coefficients into a periodic line.
//!
//! *Source*: Cooley & Tukey 1965, Math. Comp. 19, 297, in the iterative form with bit reversal.
//!
//! *Parameters*: the length, a power of two.
//!
//! *Deviations*: none.

use world::math;

/// Twiddle factors of one length.
pub(super) struct Fourier {
    turns: Vec<[f64; 2]>,
}

impl Fourier {
    pub(super) fn new(n: usize) -> Self {
        assert!(
            n.is_power_of_two(),
            "a Fourier sum needs a power of two, got {n}"
        );
        let turns = (0..n / 2).map(|k| {
            let (s, c) = math::sin_cos(std::f64::consts::TAU * k as f64 / n as f64);
            [c, s]
        });
        Self {
            turns: turns.collect(),
        }
    }

    /// x_m = Σ_j c_j e^(2πi jm/n), in place.
    pub(super) fn sum(&self, c: &mut [[f64; 2]]) {
        let n = c.len();
        let bits = n.trailing_zeros();
        for i in 0..n {
            let j = i.reverse_bits() >> (usize::BITS - bits);
            if i < j {
                c.swap(i, j);
            }
        }
        let mut half = 1;
        while half < n {
            let stride = n / (2 * half);
            for from in (0..n).step_by(2 * half) {
                for k in 0..half {
                    let [wr, wi] = self.turns[k * stride];
                    let [br, bi] = c[from + half + k];
                    let [ar, ai] = c[from + k];
                    let (tr, ti) = (wr * br - wi * bi, wr * bi + wi * br);
                    c[from + k] = [ar + tr, ai + ti];
                    c[from + half + k] = [ar - tr, ai - ti];
                }
            }
            half *= 2;
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
        Fourier::new(n as usize).sum(&mut fast);
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
