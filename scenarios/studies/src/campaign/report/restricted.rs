//! Time to success when some runs have none: the restricted mean.
//!
//! *Source*: restricted mean survival time, Royston & Parmar, BMC Med. Res. Methodol. 13 (2013) 152: the mean of the
//! time to the event or to a limit, whichever comes first; it is the area under the survival curve. It covers all runs,
//! so an arm that fails more does not look faster because its failures are left out.
//! *Parameters*: the limit: the scenario's time limit, or the shortest one if arms or conditions set it.
//! *Deviations*: there is no censoring. A run that ended early without success never has any, and counts as the limit.
//! Success is what the scenario defines; failed runs have no time and are left out.

use crate::campaign::RunRow;
use crate::campaign::stats::{Interval, positive_mean_interval};

/// The restricted mean of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestrictedMean {
    /// The limit, s.
    pub limit_s: f64,
    /// Number of runs.
    pub n: u64,
    /// Number of runs without success by the limit.
    pub at_limit: u64,
    /// Mean time to success, at most the limit, s.
    pub mean_s: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<Interval>,
}

/// Time to success, at most the limit, s; `None` for a failed run.
pub(crate) fn time_s(row: &RunRow, limit_s: f64) -> Option<f64> {
    let t_s = match (&row.error, row.success) {
        (Some(_), _) => return None,
        (None, false) => limit_s,
        (None, true) => success_s(row),
    };
    Some(t_s.min(limit_s))
}

/// When a successful run had its success: at the declaration that brought it, which is the last one if it takes
/// several; without any declaration, at its end.
fn success_s(row: &RunRow) -> f64 {
    let mut kept = (row.declarations.iter()).filter(|d| d.stands()).map(|d| d.t_s);
    let at = if row.sources_declared > 1 { kept.next_back() } else { kept.next() };
    at.or(row.declared_s).unwrap_or(row.mission_s)
}

/// From the rows of an arm.
pub(crate) fn restricted(rows: &[&RunRow], limit_s: f64) -> RestrictedMean {
    let times: Vec<f64> = rows.iter().filter_map(|r| time_s(r, limit_s)).collect();
    let n = times.len() as u64;
    let at_limit = times.iter().filter(|t| **t >= limit_s).count() as u64;
    let interval = positive_mean_interval(&times).map(|i| Interval { low: i.low, high: i.high.min(limit_s) });
    RestrictedMean { limit_s, n, at_limit, mean_s: (n > 0).then(|| times.iter().sum::<f64>() / n as f64), interval }
}

#[cfg(test)]
mod tests {
    use super::super::sample::row;
    use super::*;
    use crate::campaign::DeclarationRow;

    #[test]
    fn failures_count_as_the_limit_and_errors_not_at_all() {
        let found = row(0, Some((1.0, 1.0))); // declares at 900 s
        let wrong = row(1, Some((500.0, 0.0)));
        let none = row(2, None);
        let error = RunRow { error: Some("x".into()), ..row(3, None) };
        let r = restricted(&[&found, &wrong, &none, &error], 1200.0);
        assert_eq!((r.n, r.at_limit, r.mean_s), (3, 2, Some(1100.0)));
        // Three values are too few for an interval.
        assert_eq!(r.interval, None);
        // A success after the limit does not count.
        assert_eq!(time_s(&found, 800.0), Some(800.0));
        let many: Vec<RunRow> = (0..10).map(|k| row(k, Some((1.0, 1.0)))).collect();
        let r = restricted(&many.iter().collect::<Vec<_>>(), 950.0);
        let i = r.interval.unwrap();
        assert!(i.low > 0.0 && i.low < r.mean_s.unwrap() && i.high <= 950.0, "{i:?}");
        assert_eq!(restricted(&[], 10.0).mean_s, None);
    }

    #[test]
    fn success_is_at_the_declaration_that_did_it() {
        let at = |t_s, verdict: &str| DeclarationRow { t_s, verdict: verdict.to_string(), ..DeclarationRow::default() };
        let all = vec![at(100.0, "rejected"), at(300.0, "verified"), at(700.0, "unchecked")];
        let one = RunRow { declarations: all, sources_declared: 1, ..row(0, Some((1.0, 1.0))) };
        assert_eq!(time_s(&one, 1e4), Some(300.0));
        let two = RunRow { sources_declared: 2, ..one };
        assert_eq!(time_s(&two, 1e4), Some(700.0));
        let manoeuvre = RunRow { success: true, ..row(4, None) };
        assert_eq!(time_s(&manoeuvre, 1e4), Some(1004.0));
    }
}
