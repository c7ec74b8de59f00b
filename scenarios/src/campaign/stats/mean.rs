//! Interval of a mean.
//!
//! *Source*: Student's t: mean plus or minus t(n - 1) s / √n; the quantile of t by bisection of its distribution
//! function, a finite sum for whole degrees of freedom (Abramowitz & Stegun 1964, 26.7.3 and 26.7.4).
//! *Parameters*: none; 95 %.
//! *Deviations*: none.

use super::Interval;
use world::math;

/// 95 % interval of the mean; none of fewer than two values.
#[must_use]
pub fn mean_interval(values: &[f64]) -> Option<Interval> {
    let n = values.len();
    if n < 2 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n as f64;
    let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1) as f64;
    let half = quantile_of_t(n - 1) * (variance / n as f64).sqrt();
    Some(Interval {
        low: mean - half,
        high: mean + half,
    })
}

/// The value that |t| exceeds in 5 % of cases.
fn quantile_of_t(freedom: usize) -> f64 {
    // The quantile changes by less than 1e-3 of itself beyond; more terms would buy nothing.
    const MANY: usize = 2000;
    let (mut low, mut high) = (1.9, 13.0);
    for _ in 0..60 {
        let t = 0.5 * (low + high);
        if within(t, freedom.min(MANY)) < 0.95 {
            low = t;
        } else {
            high = t;
        }
    }
    0.5 * (low + high)
}

/// Chance that |t| is at most this.
fn within(t: f64, freedom: usize) -> f64 {
    let theta = math::atan2(t, (freedom as f64).sqrt());
    let (sine, cosine) = math::sin_cos(theta);
    let c2 = cosine * cosine;
    if freedom % 2 == 1 {
        let mut term = cosine;
        let mut sum = if freedom > 1 { term } else { 0.0 };
        for k in (3..freedom).step_by(2) {
            term *= (k - 1) as f64 / k as f64 * c2;
            sum += term;
        }
        (theta + sine * sum) / std::f64::consts::FRAC_PI_2
    } else {
        let (mut term, mut sum) = (1.0, 1.0);
        for k in (2..freedom).step_by(2) {
            term *= (k - 1) as f64 / k as f64 * c2;
            sum += term;
        }
        sine * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // Abramowitz & Stegun, Table 26.10.
        for (freedom, t) in [
            (1, 12.706),
            (2, 4.303),
            (3, 3.182),
            (10, 2.228),
            (30, 2.042),
            (120, 1.980),
        ] {
            assert!(
                (quantile_of_t(freedom) - t).abs() < 6e-4,
                "{freedom}: {}",
                quantile_of_t(freedom)
            );
        }
        assert!((quantile_of_t(100_000) - 1.96).abs() < 2e-3);
    }

    #[test]
    fn of_one_value_there_is_none() {
        assert_eq!(mean_interval(&[3.0]), None);
        let i = mean_interval(&[1.0, 2.0, 3.0]).unwrap();
        // s = 1, n = 3: 4.3027 / sqrt(3).
        assert!(
            (i.half_width() - 2.4841).abs() < 1e-3 && i.contains(2.0),
            "{i:?}"
        );
    }
}
