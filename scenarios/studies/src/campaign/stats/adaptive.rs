//! How many runs are needed until a share is known as precisely as wanted.
//!
//! *Source*: the Wilson interval of [`wilson`](super::wilson), solved for n; examined only after whole batches.
//! *Parameters*: wanted half width; greatest n; smallest first batch, 20.
//! *Deviations*: if the interval decides when to stop, it holds a little less often than 95 % (Frey, Am. Stat. 64
//! (2010) 242-245). There are few looks, each with at least 1.25 times the runs of the last, which keeps this effect
//! small.

use super::wilson;

const FIRST: u64 = 20;

/// The next number of runs, given the successes of `n` runs; `None` if the half width is small enough or `n_max` is
/// reached. It depends on counts only, so every machine takes the same steps.
pub fn next_n(successes: u64, n: u64, half_width: f64, n_max: u64) -> Option<u64> {
    if n >= n_max || (n > 0 && wilson(successes, n).half_width() <= half_width) {
        return None;
    }
    if n == 0 {
        return Some(FIRST.min(n_max));
    }
    let share = successes as f64 / n as f64;
    let enough = |m: u64| {
        let k = (share * m as f64).round() as u64;
        wilson(k.min(m), m).half_width() <= half_width
    };
    // Double, then halve the step: the width falls with n, except for the rounding of k.
    let (mut low, mut high) = (n, n.saturating_mul(2).min(n_max));
    while high < n_max && !enough(high) {
        low = high;
        high = high.saturating_mul(2).min(n_max);
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if enough(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    // At least a quarter more (few looks), and at most four times as many from one estimate.
    let least = n + (n / 4).max(1);
    Some(high.clamp(least, n.saturating_mul(4)).min(n_max))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(share: f64, half_width: f64, n_max: u64) -> Vec<u64> {
        let mut looks = vec![];
        let (mut k, mut n) = (0, 0);
        while let Some(next) = next_n(k, n, half_width, n_max) {
            assert!(next > n && next <= n_max, "{n} -> {next}");
            n = next;
            k = (share * n as f64).round() as u64;
            looks.push(n);
        }
        looks
    }

    #[test]
    fn ends_when_the_interval_is_as_narrow_as_asked() {
        for share in [0.0, 0.3, 0.5, 0.9, 1.0] {
            let looks = run(share, 0.05, 100_000);
            let n = *looks.last().unwrap();
            assert!(wilson((share * n as f64).round() as u64, n).half_width() <= 0.05);
            // The normal approximation requires z² p q / h², plus a few for the ends.
            let normal = super::super::Z95.powi(2) * share * (1.0 - share) / 0.0025;
            assert!((n as f64) < 1.3 * normal + 80.0, "{share}: {looks:?}");
            assert!(looks.len() <= 6, "{looks:?}");
        }
    }

    #[test]
    fn ends_at_the_most_allowed() {
        assert_eq!(run(0.5, 0.001, 333).last(), Some(&333));
        assert_eq!(run(0.5, 0.001, 7), [7]);
        assert_eq!(next_n(0, 0, 0.1, 0), None);
        assert_eq!(next_n(5, 10, 0.9, 100), None);
    }
}
