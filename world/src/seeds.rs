//! One seed for each run; from it, one stream of random numbers for each pair (entity, purpose).
//!
//! The key of a stream is a stable hash of its names, so adding a sensor does not change the numbers of the others.

use crate::math;
use rand::{Rng, RngExt, SeedableRng};
use xxhash_rust::xxh3::xxh3_64_with_seed;

/// A portable random stream (ChaCha8). Its user holds it.
#[derive(Clone, Debug)]
pub struct Stream {
    rng: rand_chacha::ChaCha8Rng,
    spare: Option<f64>,
}

impl Stream {
    /// The stream of `entity` for `purpose` under the run's `seed`.
    #[must_use]
    pub fn new(seed: u64, entity: &str, purpose: &str) -> Self {
        Self {
            rng: rand_chacha::ChaCha8Rng::seed_from_u64(key(seed, entity, purpose)),
            spare: None,
        }
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.rng.random::<f64>()
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.rng.next_u64()
    }

    /// Standard normal (Box–Muller over portable functions, both values used).
    pub fn normal(&mut self) -> f64 {
        if let Some(z) = self.spare.take() {
            return z;
        }
        let radius = (-2.0 * math::ln(1.0 - self.uniform())).sqrt();
        let (s, c) = math::sin_cos(std::f64::consts::TAU * self.uniform());
        self.spare = Some(radius * s);
        radius * c
    }

    /// Exponential waiting time for events of the given rate, s for a rate in 1/s.
    pub fn exponential(&mut self, rate: f64) -> f64 {
        -math::ln(1.0 - self.uniform()) / rate
    }
}

/// Stable key of a stream: it depends on the seed and the two names, and on nothing else.
#[must_use]
pub fn key(seed: u64, entity: &str, purpose: &str) -> u64 {
    xxh3_64_with_seed(format!("{entity}\u{1f}{purpose}").as_bytes(), seed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_repeatable_and_apart() {
        let mut a = Stream::new(7, "auv0", "lbl");
        let mut b = Stream::new(7, "auv0", "lbl");
        let mut c = Stream::new(7, "auv0", "dvl");
        let (x, y, z) = (a.bits(), b.bits(), c.bits());
        assert_eq!(x, y);
        assert_ne!(x, z);
    }

    #[test]
    fn normals_have_unit_variance() {
        let mut s = Stream::new(1, "test", "normal");
        let n = 100_000;
        let (mut m, mut v) = (0.0, 0.0);
        for _ in 0..n {
            let z = s.normal();
            m += z;
            v += z * z;
        }
        // 5 standard errors: 5/√n for the mean, 5·√(2/n) for the variance.
        assert!((m / n as f64).abs() < 0.016);
        assert!((v / n as f64 - 1.0).abs() < 0.0224);
    }
}
