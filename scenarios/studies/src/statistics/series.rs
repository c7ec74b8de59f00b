//! A record at a point: how often and how long it is above a threshold, how it fluctuates, and its memory.
//!
//! *Source*: integral time scale, Tennekes & Lumley 1972, A First Course in Turbulence, section 1.4 and 6.4.
//!
//! *Parameters*: the threshold, in the unit of the record.
//!
//! *Deviations*: the autocorrelation is summed up to its first zero.

/// A record at equal intervals.
#[derive(Clone, Debug, Default)]
pub(super) struct Series {
    pub(super) values: Vec<f64>,
    pub(super) step_s: f64,
}

impl Series {
    pub(super) fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// Share of the time during which it is above a threshold.
    pub(super) fn above(&self, threshold: f64) -> f64 {
        let n = self.values.iter().filter(|v| **v > threshold).count();
        n as f64 / self.values.len() as f64
    }

    /// Values above a threshold.
    pub(super) fn felt(&self, threshold: f64) -> Vec<f64> {
        let felt = self.values.iter().filter(|v| **v > threshold);
        felt.copied().collect()
    }

    /// Durations below a threshold between two times above it, s.
    pub(super) fn gaps(&self, threshold: f64) -> Vec<f64> {
        let (mut gaps, mut run) = (Vec::new(), None);
        for v in &self.values {
            if *v > threshold {
                if let Some(n @ 1..) = run {
                    gaps.push(n as f64 * self.step_s);
                }
                run = Some(0_usize);
            } else if let Some(n) = &mut run {
                *n += 1;
            }
        }
        gaps
    }

    /// Integral time of the fluctuations, s; `None` for a record that does not fluctuate.
    pub(super) fn integral_time_s(&self) -> Option<f64> {
        let (mean, n) = (self.mean(), self.values.len());
        let off: Vec<f64> = self.values.iter().map(|v| v - mean).collect();
        let product = |lag: usize| {
            let pairs = off.iter().zip(&off[lag..]).map(|(a, b)| a * b);
            pairs.sum::<f64>() / (n - lag) as f64
        };
        let variance = product(0);
        if variance <= 0.0 {
            return None;
        }
        let mut sum = 0.5;
        for lag in 1..n / 4 {
            let rho = product(lag) / variance;
            if rho <= 0.0 {
                break;
            }
            sum += rho;
        }
        Some(sum * self.step_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::math;
    use world::seeds::Stream;

    #[test]
    fn gaps_are_those_between_two_signals() {
        let s = Series { values: vec![0.0, 2.0, 0.0, 0.0, 3.0, 3.0, 0.0, 1.5, 0.0], step_s: 0.5 };
        assert_eq!(s.gaps(1.0), [1.0, 0.5]);
        assert!((s.above(1.0) - 4.0 / 9.0).abs() < 1e-15);
        assert_eq!(s.felt(1.0), [2.0, 3.0, 3.0, 1.5]);
    }

    #[test]
    fn integral_time_of_a_process_that_forgets() {
        // First-order process with memory 2 s, sampled every 0.1 s for 20 000 s: standard error about √(2·2/20 000)·few
        // = 5 %.
        let (tau, step_s) = (2.0, 0.1);
        let a = math::exp(-step_s / tau);
        let mut r = Stream::new(3, "test", "memory");
        let mut x = 0.0;
        let values = (0..200_000)
            .map(|_| {
                x = a * x + (1.0 - a * a).sqrt() * r.normal();
                x
            })
            .collect();
        let s = Series { values, step_s };
        let got = s.integral_time_s().unwrap();
        assert!((got / tau - 1.0).abs() < 0.15, "{got}");
        let flat = Series { values: vec![1.0; 50], step_s };
        assert_eq!(flat.integral_time_s(), None);
    }
}
