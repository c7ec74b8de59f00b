//! Coloured noise, ẍ + 2ζωẋ + ω²x = Gω²n, advanced without error at any step.
//!
//! *Source*: Farrell et al. 2002, Environ. Fluid Mech. 2, 143 (the noise at the corners of the wind
//! grid); exact step of a linear stochastic equation: Gillespie 1996, Phys. Rev. E 54, 2084.
//!
//! *Parameters*: σ `std` (unit of x), ω `omega` (rad/s; Farrell 0.2), ζ `damping` (Farrell 0.1). Farrell's gain
//! follows from σ² = G²ω/(4ζ) (G = 2 gives σ² = 2).
//!
//! *Deviations*: Farrell steps by Euler, whose variance depends on the step. Here (x, ẋ) is multiplied by the matrix
//! exponential Φ(h), and a normal pair of covariance P − ΦPΦᵀ is added; P = diag(σ², ω²σ²) is the stationary
//! covariance, in which the process starts. So variance and autocorrelation e^(−ζωt)[cos ω_d t + ζ/√(1−ζ²) sin ω_d t]
//! hold at every step. Only ζ < 1.

use world::math;
use world::seeds::Stream;

/// The process at one place.
#[derive(Clone, Debug)]
pub struct ColouredNoise {
    x: f64,
    v: f64,
    rng: Stream,
}

/// The effect of a step of fixed length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseStep {
    phi: [[f64; 2]; 2],
    // Lower Cholesky factor of the covariance that is added.
    chol: [f64; 3],
    std: f64,
    omega: f64,
}

impl NoiseStep {
    /// Step of `h` s of noise with standard deviation `std`, frequency `omega` rad/s, damping ratio in (0, 1).
    pub fn new(std: f64, omega: f64, damping: f64, h: f64) -> Self {
        let decay = math::exp(-damping * omega * h);
        let w_d = omega * (1.0 - damping * damping).sqrt();
        let (s, c) = math::sin_cos(w_d * h);
        let q = damping * omega / w_d;
        let phi = [[decay * (c + q * s), decay * s / w_d], [-decay * omega * omega * s / w_d, decay * (c - q * s)]];
        let (px, pv) = (std * std, std * std * omega * omega);
        let cov = |a: [f64; 2], b: [f64; 2]| a[0] * px * b[0] + a[1] * pv * b[1];
        let q11 = (px - cov(phi[0], phi[0])).max(0.0);
        let q12 = -cov(phi[0], phi[1]);
        let q22 = (pv - cov(phi[1], phi[1])).max(0.0);
        let l11 = q11.sqrt();
        let l21 = if l11 > 0.0 { q12 / l11 } else { 0.0 };
        let l22 = (q22 - l21 * l21).max(0.0).sqrt();
        Self { phi, chol: [l11, l21, l22], std, omega }
    }
}

impl ColouredNoise {
    /// A process drawn from the stationary law of `step`.
    pub fn stationary(step: &NoiseStep, mut rng: Stream) -> Self {
        let x = step.std * rng.normal();
        let v = step.std * step.omega * rng.normal();
        Self { x, v, rng }
    }

    /// Present value.
    pub fn value(&self) -> f64 {
        self.x
    }

    /// Advances by one step.
    pub fn advance(&mut self, step: &NoiseStep) {
        let (a, b) = (self.rng.normal(), self.rng.normal());
        let [[p, q], [r, s]] = step.phi;
        let [l11, l21, l22] = step.chol;
        let x = p * self.x + q * self.v + l11 * a;
        self.v = r * self.x + s * self.v + l21 * a + l22 * b;
        self.x = x;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ensemble variance and correlation at lag 12 s, reached in steps of four lengths, with Farrell's ω and ζ.
    #[test]
    fn variance_and_autocorrelation_hold_at_any_step() {
        let (std, omega, zeta, lag) = (0.7, 0.2, 0.1, 12.0);
        let n = 40_000;
        let w_d = omega * (1.0_f64 - zeta * zeta).sqrt();
        let (s, c) = math::sin_cos(w_d * lag);
        let rho = math::exp(-zeta * omega * lag) * (c + zeta / (1.0 - zeta * zeta).sqrt() * s);
        for steps in [1, 3, 24, 120] {
            let step = NoiseStep::new(std, omega, zeta, lag / f64::from(steps));
            let (mut v0, mut v1, mut xy) = (0.0, 0.0, 0.0);
            for k in 0..n {
                let rng = Stream::new(11, &format!("member{k}"), &format!("steps{steps}"));
                let mut x = ColouredNoise::stationary(&step, rng);
                let start = x.value() / std;
                for _ in 0..steps {
                    x.advance(&step);
                }
                let end = x.value() / std;
                v0 += start * start;
                v1 += end * end;
                xy += start * end;
            }
            let n = f64::from(n);
            // Standard errors: √(2/n) of a unit variance, √((1+ρ²)/n) of the lagged product; 4 of them.
            let tol = 4.0 * (2.0 / n).sqrt();
            assert!((v0 / n - 1.0).abs() < tol, "{steps}: {}", v0 / n);
            assert!((v1 / n - 1.0).abs() < tol, "{steps}: {}", v1 / n);
            let tol = 4.0 * ((1.0 + rho * rho) / n).sqrt();
            assert!((xy / n - rho).abs() < tol, "{steps}: {} vs {rho}", xy / n);
        }
    }

    /// Two half steps equal one step: the transition composes exactly.
    #[test]
    fn steps_compose() {
        let one = NoiseStep::new(1.0, 0.2, 0.1, 4.0);
        let half = NoiseStep::new(1.0, 0.2, 0.1, 2.0);
        for i in 0..2 {
            for j in 0..2 {
                let twice = half.phi[i][0] * half.phi[0][j] + half.phi[i][1] * half.phi[1][j];
                assert!((twice - one.phi[i][j]).abs() < 1e-14);
            }
        }
    }
}
