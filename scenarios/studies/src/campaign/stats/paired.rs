//! Difference between two arms that ran with the same seeds and conditions.
//!
//! *Source*: for shares, Agresti & Min, Stat. Med. 24 (2005) 729-740: Wald's interval for matched pairs with 1/2 added
//! to each of the four cells. For quantities, the median of the differences within pairs with a bootstrap interval
//! ([`quantile_interval`](super::quantile_interval)), or the mean of the differences with Student's interval
//! ([`mean_interval`](super::mean_interval)).
//! *Parameters*: z = 1.96; least pairs for a verdict, [`LEAST_PAIRS`] = 6: with fewer, even pairs that all agree in
//! direction occur by chance more often than 5 % (2 · 0.5^5 = 6 %).
//! *Deviations*: none. Each comparison stands alone; among many, some differ by chance.

use super::{Interval, Z95, finite_sorted, mean_interval, quantile, quantile_interval};

/// Least number of pairs for a verdict.
pub const LEAST_PAIRS: usize = 6;

/// Which direction is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// A larger value is better.
    More,
    /// A smaller value is better.
    Less,
}

/// The verdict of a difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separation {
    /// The first arm is better than the second.
    Better,
    /// The first arm is worse.
    Worse,
    /// The interval contains 0, or there are too few pairs.
    NotSeparable,
}

impl Separation {
    /// The verdict in words.
    pub fn label(self) -> &'static str {
        match self {
            Separation::Better => "better",
            Separation::Worse => "worse",
            Separation::NotSeparable => "not separable at this n",
        }
    }
}

/// First arm minus second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Number of pairs.
    pub pairs: usize,
    /// The difference.
    pub estimate: f64,
    /// Its 95 % interval.
    pub interval: Interval,
    /// What it says about the first arm.
    pub verdict: Separation,
}

impl Difference {
    fn new(pairs: usize, estimate: f64, interval: Interval, better: Better) -> Self {
        let more = match better {
            Better::More => Separation::Better,
            Better::Less => Separation::Worse,
        };
        let less = match better {
            Better::More => Separation::Worse,
            Better::Less => Separation::Better,
        };
        let verdict = if pairs < LEAST_PAIRS || interval.contains(0.0) {
            Separation::NotSeparable
        } else if interval.low > 0.0 {
            more
        } else {
            less
        };
        Self { pairs, estimate, interval, verdict }
    }
}

/// Difference of two shares from pairs of (first, second); `None` if there are no pairs.
pub fn paired_share(pairs: impl IntoIterator<Item = (bool, bool)>, better: Better) -> Option<Difference> {
    let (mut n, mut first, mut second) = (0_usize, 0.0, 0.0);
    for (a, b) in pairs {
        n += 1;
        first += f64::from(u8::from(a && !b));
        second += f64::from(u8::from(b && !a));
    }
    if n == 0 {
        return None;
    }
    let (b, c, m) = (first + 0.5, second + 0.5, n as f64 + 2.0);
    let d = (b - c) / m;
    let half = Z95 * ((b + c) / m - d * d).sqrt() / m.sqrt();
    let interval = Interval { low: (d - half).max(-1.0), high: (d + half).min(1.0) };
    Some(Difference::new(n, (first - second) / n as f64, interval, better))
}

/// Median of the differences within pairs of (first, second). Pairs with a value that is not finite are left out;
/// `None` if there are no pairs.
pub fn paired_median(
    pairs: impl IntoIterator<Item = (f64, f64)>,
    better: Better,
    seed: u64,
    name: &str,
) -> Option<Difference> {
    let sorted = finite_sorted(pairs.into_iter().map(|(a, b)| a - b));
    let estimate = quantile(&sorted, 0.5)?;
    let interval = quantile_interval(&sorted, 0.5, seed, name)?;
    Some(Difference::new(sorted.len(), estimate, interval, better))
}

/// Mean of the differences within pairs of (first, second). Pairs with a value that is not finite are left out. If
/// there are fewer pairs than an interval needs, the interval is infinite.
pub fn paired_mean(pairs: impl IntoIterator<Item = (f64, f64)>, better: Better) -> Option<Difference> {
    let values = finite_sorted(pairs.into_iter().map(|(a, b)| a - b));
    if values.is_empty() {
        return None;
    }
    let interval = mean_interval(&values).unwrap_or(Interval { low: f64::NEG_INFINITY, high: f64::INFINITY });
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    Some(Difference::new(values.len(), mean, interval, better))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(both: usize, first: usize, second: usize, neither: usize) -> Vec<(bool, bool)> {
        let all = [((true, true), both), ((true, false), first), ((false, true), second), ((false, false), neither)];
        all.into_iter().flat_map(|(pair, n)| std::iter::repeat_n(pair, n)).collect()
    }

    /// 53 and 8 discordant of 300: ((53.5 - 8.5)/302) ± 1.96 · sqrt(62/302 - d²) / sqrt(302).
    #[test]
    fn shares_follow_the_formula() {
        let d = paired_share(shares(200, 53, 8, 39), Better::More).unwrap();
        assert!((d.estimate - 0.15).abs() < 1e-12);
        assert!((d.interval.low - 0.1008).abs() < 2e-4, "{d:?}");
        assert!((d.interval.high - 0.1972).abs() < 2e-4, "{d:?}");
        assert_eq!(d.verdict, Separation::Better);
        let turned = paired_share(shares(200, 8, 53, 39), Better::More).unwrap();
        assert_eq!(turned.verdict, Separation::Worse);
        assert!((turned.interval.low + d.interval.high).abs() < 1e-12);
    }

    #[test]
    fn like_arms_are_not_separable() {
        for pairs in [shares(10, 0, 0, 0), shares(0, 0, 0, 10), shares(30, 5, 5, 3)] {
            let d = paired_share(pairs, Better::More).unwrap();
            assert_eq!((d.estimate, d.verdict), (0.0, Separation::NotSeparable));
            assert!(d.interval.low < 0.0 && d.interval.high > 0.0);
        }
        let same = (0..9).map(|k| (f64::from(k), f64::from(k)));
        let d = paired_median(same, Better::Less, 1, "x").unwrap();
        assert_eq!((d.estimate, d.verdict), (0.0, Separation::NotSeparable));
    }

    #[test]
    fn less_of_an_error_is_better() {
        let closer = (0..40).map(|k| (f64::from(k), f64::from(k) + 2.0 + f64::from(k % 3)));
        let d = paired_median(closer.clone(), Better::Less, 1, "x").unwrap();
        assert_eq!((d.pairs, d.estimate, d.verdict), (40, -3.0, Separation::Better));
        let d = paired_median(closer.map(|(a, b)| (b, a)), Better::Less, 1, "x").unwrap();
        assert_eq!(d.verdict, Separation::Worse);
    }

    #[test]
    fn means_of_differences_have_students_interval() {
        let pairs = (0..9).map(|k| (f64::from(k), 10.0 + 2.0 * f64::from(k % 3)));
        let d = paired_mean(pairs, Better::Less).unwrap();
        assert_eq!((d.pairs, d.estimate, d.verdict), (9, -8.0, Separation::Better));
        assert!(d.interval.contains(-8.0) && d.interval.high < 0.0, "{d:?}");
        let few = paired_mean([(1.0, 9.0); 4], Better::Less).unwrap();
        assert_eq!(few.verdict, Separation::NotSeparable);
        assert_eq!(paired_mean([], Better::Less), None);
    }

    #[test]
    fn few_or_no_pairs_say_nothing() {
        let five = paired_median([(1.0, 9.0); 5], Better::Less, 1, "x").unwrap();
        assert_eq!((five.estimate, five.verdict), (-8.0, Separation::NotSeparable));
        assert_eq!(paired_median([(1.0, f64::NAN)], Better::Less, 1, "x"), None);
        assert_eq!(paired_share([], Better::More), None);
        let one = paired_share([(true, false)], Better::More).unwrap();
        assert_eq!((one.estimate, one.verdict), (1.0, Separation::NotSeparable));
        assert!(one.interval.high <= 1.0);
    }
}
