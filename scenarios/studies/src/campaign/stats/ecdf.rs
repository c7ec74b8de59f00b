//! Share of a sample at or below a value.
//!
//! *Source*: the empirical distribution; its interval at one value is [`wilson`](super::wilson) of the count there.
//! *Parameters*: none.
//! *Deviations*: the sample may belong to a larger number of trials (errors exist only for trials that declared). Then
//! the shares are of all trials, and the curve ends below 1.
//! *Written here*: the one in statrs counts neither trials without a value nor intervals.

use super::{Interval, finite_sorted, wilson};

/// Shares at or below each value of a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Ecdf {
    sorted: Vec<f64>,
    n: u64,
}

impl Ecdf {
    /// From the finite values of a sample, out of `n` trials.
    pub fn new(values: impl IntoIterator<Item = f64>, n: u64) -> Self {
        let sorted = finite_sorted(values);
        let n = n.max(sorted.len() as u64);
        Self { sorted, n }
    }

    /// Sorted values.
    pub fn values(&self) -> &[f64] {
        &self.sorted
    }

    /// Number of trials.
    pub fn n(&self) -> u64 {
        self.n
    }

    /// Share of trials at or below `x`, with its interval; 0 if there are no trials.
    pub fn share_at(&self, x: f64) -> (f64, Interval) {
        let k = self.sorted.partition_point(|v| *v <= x) as u64;
        (k as f64 / self.n.max(1) as f64, wilson(k, self.n))
    }

    /// Each distinct value with the share and interval there.
    pub fn steps(&self) -> Vec<(f64, f64, Interval)> {
        let mut values = self.sorted.clone();
        values.dedup();
        values
            .into_iter()
            .map(|x| {
                let (share, interval) = self.share_at(x);
                (x, share, interval)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_what_is_at_or_below() {
        let e = Ecdf::new([3.0, 1.0, 1.0, f64::NAN], 5);
        assert_eq!(e.share_at(0.9).0, 0.0);
        assert_eq!(e.share_at(1.0).0, 0.4);
        assert_eq!(e.share_at(9.0), (0.6, wilson(3, 5)));
        let steps = e.steps();
        assert_eq!(steps.len(), 2);
        assert_eq!((steps[1].0, steps[1].1), (3.0, 0.6));
    }

    #[test]
    fn of_nothing_is_zero_and_unknown() {
        let e = Ecdf::new([], 0);
        assert_eq!(e.share_at(1.0), (0.0, wilson(0, 0)));
        assert!(e.steps().is_empty());
    }
}
