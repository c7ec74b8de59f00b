//! Quantiles of a sample.
//!
//! *Source*: Hyndman & Fan, Am. Stat. 50 (1996) 361-365, definition 7: linear between order statistics, at the position
//! h = (n - 1) p counted from 0 (the default of R and NumPy).
//! *Parameters*: p, from 0 to 1.
//! *Deviations*: none; values that are not finite are left out first.
//! *Written here*: statrs has definition 8, which gives other numbers than R and NumPy.

use super::Interval;

/// The finite values, sorted.
pub fn finite_sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.into_iter().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// The `p` quantile of sorted values; `None` if there are none.
pub fn quantile(sorted: &[f64], p: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let (k, share) = place(last, p);
    Some(between(sorted[k], sorted[(k + 1).min(last)], share))
}

/// Where 95 % of sorted values lie, from their 2.5 % quantile to that of 97.5 %; `None` if there are none.
pub fn middle(sorted: &[f64]) -> Option<Interval> {
    Some(Interval { low: quantile(sorted, 0.025)?, high: quantile(sorted, 0.975)? })
}

/// The order statistic (from 0) below the `p` quantile, and the position of the quantile between it and the next.
pub(super) fn place(last: usize, p: f64) -> (usize, f64) {
    let h = last as f64 * p.clamp(0.0, 1.0);
    let k = (h.floor() as usize).min(last);
    (k, h - k as f64)
}

/// Interpolates between two values; returns exactly one of them if the share is 0, or if both are the same.
pub(super) fn between(a: f64, b: f64, share: f64) -> f64 {
    if share == 0.0 { a } else { a + (b - a) * share }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_definition_seven() {
        let x = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(quantile(&x, 0.5), Some(2.5));
        assert!((quantile(&x, 0.9).unwrap() - 3.7).abs() < 1e-12);
        assert_eq!((quantile(&x, 0.0), quantile(&x, 1.0)), (Some(1.0), Some(4.0)));
        assert_eq!(quantile(&[5.0], 0.9), Some(5.0));
        assert_eq!(quantile(&[], 0.5), None);
    }

    #[test]
    fn leaves_out_what_is_no_number() {
        let got = finite_sorted([2.0, f64::NAN, -1.0, f64::INFINITY]);
        assert_eq!(got, [-1.0, 2.0]);
    }
}
