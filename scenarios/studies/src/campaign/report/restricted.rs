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

/// By when a success counts, and how near a declaration has to be for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SuccessTime {
    /// The limit, s.
    pub limit_s: f64,
    /// Largest distance of a declaration from a true source, m, where success asks for declarations.
    pub within_m: Option<f64>,
}

impl SuccessTime {
    /// Time to success, at most the limit, s; `None` for a failed run.
    pub(crate) fn of(&self, row: &RunRow) -> Option<f64> {
        let t_s = match (&row.error, row.success) {
            (Some(_), _) => return None,
            (None, false) => self.limit_s,
            (None, true) => self.success_s(row),
        };
        Some(t_s.min(self.limit_s))
    }

    /// When a successful run had its success: at the declaration that brought it, which is the last one near a source
    /// if it takes several; without any such declaration, at its end.
    fn success_s(&self, row: &RunRow) -> f64 {
        let near = |error_m: Option<f64>| self.within_m.zip(error_m).is_none_or(|(most, error_m)| error_m <= most);
        let mut kept = (row.declarations.iter()).filter(|d| d.stands() && near(d.error_m)).map(|d| d.t_s);
        let at = if row.sources_declared > 1 { kept.next_back() } else { kept.next() };
        at.or(row.declared_s.filter(|_| near(row.error_m))).unwrap_or(row.mission_s)
    }
}

/// From the rows of an arm.
pub(crate) fn restricted(rows: &[&RunRow], success: SuccessTime) -> RestrictedMean {
    let limit_s = success.limit_s;
    let times: Vec<f64> = rows.iter().filter_map(|r| success.of(r)).collect();
    let n = times.len() as u64;
    let at_limit = times.iter().filter(|t| **t >= limit_s).count() as u64;
    // Where all runs are at the limit, nothing shows how far another one could be from it.
    let interval = positive_mean_interval(&times)
        .filter(|_| at_limit < n)
        .map(|i| Interval { low: i.low, high: i.high.min(limit_s) });
    RestrictedMean { limit_s, n, at_limit, mean_s: (n > 0).then(|| times.iter().sum::<f64>() / n as f64), interval }
}

#[cfg(test)]
mod tests {
    use super::super::sample::row;
    use super::*;
    use crate::campaign::DeclarationRow;

    fn by(limit_s: f64) -> SuccessTime {
        SuccessTime { limit_s, within_m: Some(20.0) }
    }

    #[test]
    fn failures_count_as_the_limit_and_errors_not_at_all() {
        let found = row(0, Some((1.0, 1.0))); // declares at 900 s
        let wrong = row(1, Some((500.0, 0.0)));
        let none = row(2, None);
        let error = RunRow { error: Some("x".into()), ..row(3, None) };
        let r = restricted(&[&found, &wrong, &none, &error], by(1200.0));
        assert_eq!((r.n, r.at_limit, r.mean_s), (3, 2, Some(1100.0)));
        // Three values are too few for an interval.
        assert_eq!(r.interval, None);
        // A success after the limit does not count.
        assert_eq!(by(800.0).of(&found), Some(800.0));
        let many: Vec<RunRow> = (0..10).map(|k| row(k, Some((1.0, 1.0)))).collect();
        let r = restricted(&many.iter().collect::<Vec<_>>(), by(950.0));
        let i = r.interval.unwrap();
        assert!(i.low > 0.0 && i.low < r.mean_s.unwrap() && i.high <= 950.0, "{i:?}");
        assert_eq!(restricted(&[], by(10.0)).mean_s, None);
    }

    #[test]
    fn success_is_at_the_declaration_that_did_it() {
        let at = |t_s, verdict: &str| DeclarationRow { t_s, verdict: verdict.to_string(), ..DeclarationRow::default() };
        let all = vec![at(100.0, "rejected"), at(300.0, "verified"), at(700.0, "unchecked")];
        let one = RunRow { declarations: all, sources_declared: 1, ..row(0, Some((1.0, 1.0))) };
        assert_eq!(by(1e4).of(&one), Some(300.0));
        let mut hasty = one.clone();
        hasty.declarations[1].error_m = Some(130.0);
        hasty.declarations[2].error_m = Some(3.0);
        assert_eq!(by(1e4).of(&hasty), Some(700.0), "not when it declared another place");
        let two = RunRow { sources_declared: 2, ..one };
        assert_eq!(by(1e4).of(&two), Some(700.0));
        let manoeuvre = RunRow { success: true, ..row(4, None) };
        assert_eq!(by(1e4).of(&manoeuvre), Some(1004.0));
    }
}
