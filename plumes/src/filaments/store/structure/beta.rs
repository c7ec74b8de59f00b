//! Quantiles of the beta law.
//!
//! *Source*: the incomplete beta function as a continued fraction, DLMF 8.17.22, by the method of Lentz 1976, Appl.
//! Opt. 15, 668; its inverse by Newton's method within a bracket. `statrs` has both, with logarithms of the platform: the
//! bits of a run would differ between machines.
//!
//! *Parameters*: none.
//!
//! *Deviations*: a quantile is right to 1e-9.

use world::math;

/// A beta law.
pub(super) struct Beta {
    a: f64,
    b: f64,
    ln_of_both: f64,
}

impl Beta {
    /// With positive parameters.
    pub(super) fn new(a: f64, b: f64) -> Self {
        Self { a, b, ln_of_both: math::ln_gamma(a + b) - math::ln_gamma(a) - math::ln_gamma(b) }
    }

    /// x^a (1 − x)^b over the complete function.
    fn front(&self, x: f64) -> f64 {
        math::exp(self.ln_of_both + self.a * math::ln(x) + self.b * math::ln(1.0 - x))
    }

    /// Probability of less than x, in (0, 1).
    fn below(&self, x: f64) -> f64 {
        let Self { a, b, .. } = *self;
        if x < (a + 1.0) / (a + b + 2.0) {
            self.front(x) * fraction(x, a, b) / a
        } else {
            1.0 - self.front(x) * fraction(1.0 - x, b, a) / b
        }
    }

    /// The value below which lies a probability in (0, 1).
    pub(super) fn quantile(&self, probability: f64) -> f64 {
        const CLOSE: f64 = 1e-9;
        // Most of a very uneven law lies at its ends.
        if self.below(CLOSE) >= probability {
            return 0.0;
        }
        if self.below(1.0 - CLOSE) <= probability {
            return 1.0;
        }
        let (mut low, mut high) = (CLOSE, 1.0 - CLOSE);
        let mut x = self.a / (self.a + self.b);
        while high - low > CLOSE {
            let beyond = self.below(x) - probability;
            if beyond > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let next = x - beyond * x * (1.0 - x) / self.front(x);
            let inside = next > low && next < high;
            if inside && (next - x).abs() < 0.1 * CLOSE {
                return next;
            }
            x = if inside { next } else { 0.5 * (low + high) };
        }
        x
    }
}

/// The continued fraction of the incomplete function, for x below its mean.
fn fraction(x: f64, a: f64, b: f64) -> f64 {
    // Keeps a denominator from being zero.
    let apart = |v: f64| if v.abs() < 1e-300 { 1e-300 } else { v };
    let (mut c, mut d) = (1.0, 1.0 / apart(1.0 - (a + b) * x / (a + 1.0)));
    let mut h = d;
    for m in 1..500 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let before = h;
        for term in [even, odd] {
            d = 1.0 / apart(1.0 + term * d);
            c = apart(1.0 + term / c);
            h *= c * d;
        }
        if (h - before).abs() < 1e-12 * h.abs() {
            break;
        }
    }
    h
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_law() {
        let mut all = 0;
        for (a, b) in [(0.01, 0.03), (0.05, 2.0), (0.5, 0.5), (0.3, 30.0), (1.0, 3.0), (2.0, 5.0), (40.0, 300.0)] {
            let beta = Beta::new(a, b);
            let (mut mean, mut square) = (0.0, 0.0);
            let n = 20_000;
            for k in 0..n {
                let u = (f64::from(k) + 0.5) / f64::from(n);
                let x = beta.quantile(u);
                assert!((0.0..=1.0).contains(&x));
                if x > 1e-6 && x < 1.0 - 1e-6 {
                    assert!((beta.below(x) - u).abs() < 1e-4, "{a} {b} {u}: {x}");
                    all += 1;
                }
                mean += x / f64::from(n);
                square += x * x / f64::from(n);
            }
            let want = a / (a + b);
            assert!((mean / want - 1.0).abs() < 3e-3, "{a} {b}: {mean} {want}");
            let variance = want * (1.0 - want) / (a + b + 1.0);
            assert!(((square - mean * mean) / variance - 1.0).abs() < 0.01, "{a} {b}");
        }
        assert!(all > 50_000);
        // The median of a law with a = 1 and with b = 1; the arcsine law.
        let median = |a, b| Beta::new(a, b).quantile(0.5);
        assert!((median(1.0, 4.0) - (1.0 - math::powf(0.5, 0.25))).abs() < 1e-8);
        assert!((median(3.0, 1.0) - math::cbrt(0.5)).abs() < 1e-8);
        assert!((Beta::new(0.5, 0.5).quantile(0.25) - 0.146_446_609).abs() < 1e-8);
    }
}
