//! What is computed from the rows of a campaign to stand beside a paper's figure.

use crate::campaign::RunRow;
use crate::campaign::report::Unit;
use crate::campaign::stats::{Interval, finite_sorted, quantile, quantile_interval, wilson};
use serde::{Deserialize, Serialize};

/// A quantity of many runs. Errors are of declarations, against the nearest true source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Share of runs that succeed as the scenario defines it.
    SuccessRate,
    /// Share of runs that declare a source, wherever.
    ShareDeclared,
    /// Share of declarations whose error is more along the flow than across.
    ShareMostlyAlong,
    /// Median error, m.
    MedianErrorM,
    /// 90 % quantile of the error, m.
    Q90ErrorM,
    /// Median of the error's size along the flow, m.
    MedianErrorAlongM,
    /// 90 % quantile of the error's size along the flow, m.
    Q90ErrorAlongM,
    /// Median of the error's size across the flow, m.
    MedianErrorAcrossM,
    /// 90 % quantile of the error's size across the flow, m.
    Q90ErrorAcrossM,
    /// Median way from the first detection to the declared source, m.
    MedianTracedM,
    /// Median time of the declaration, s.
    MedianDeclaredS,
    /// Median way travelled, m, over all runs that did not fail.
    MedianTravelledM,
}

/// A quantity as our runs have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Values behind it.
    pub n: u64,
    /// Of them counted, for a share.
    pub count: Option<u64>,
    /// The figure; none where nothing is behind it.
    pub value: Option<f64>,
    /// Its 95 % interval: Wilson's for shares, bootstrap's for quantiles.
    pub interval: Option<Interval>,
    /// Where 95 % of single runs lie (2.5 % to 97.5 % quantile), for quantiles.
    pub spread: Option<Interval>,
}

impl Quantity {
    /// Its unit.
    #[must_use]
    pub fn unit(self) -> Unit {
        match self {
            Quantity::SuccessRate | Quantity::ShareDeclared | Quantity::ShareMostlyAlong => {
                Unit::Share
            }
            Quantity::MedianDeclaredS => Unit::Seconds,
            _ => Unit::Metres,
        }
    }

    /// From rows of runs. A failed run is one that neither declared nor succeeded.
    #[must_use]
    pub fn of(self, rows: &[RunRow]) -> Estimate {
        let all = rows.len() as u64;
        let count = |what: fn(&RunRow) -> bool| rows.iter().filter(|r| what(r)).count() as u64;
        match self {
            Quantity::SuccessRate => share(count(|r| r.success), all),
            Quantity::ShareDeclared => share(count(|r| r.declared_s.is_some()), all),
            Quantity::ShareMostlyAlong => {
                let parts = |r: &RunRow| r.error_along_m.zip(r.error_across_m);
                let along = (rows.iter().filter_map(parts)).filter(|(a, b)| a.abs() > b.abs());
                let of = rows.iter().filter_map(parts).count() as u64;
                share(along.count() as u64, of)
            }
            Quantity::MedianErrorM => of_values(rows, 0.5, |r| r.error_m),
            Quantity::Q90ErrorM => of_values(rows, 0.9, |r| r.error_m),
            Quantity::MedianErrorAlongM => of_values(rows, 0.5, |r| r.error_along_m.map(f64::abs)),
            Quantity::Q90ErrorAlongM => of_values(rows, 0.9, |r| r.error_along_m.map(f64::abs)),
            Quantity::MedianErrorAcrossM => {
                of_values(rows, 0.5, |r| r.error_across_m.map(f64::abs))
            }
            Quantity::Q90ErrorAcrossM => of_values(rows, 0.9, |r| r.error_across_m.map(f64::abs)),
            Quantity::MedianTracedM => of_values(rows, 0.5, |r| r.traced_m),
            Quantity::MedianDeclaredS => of_values(rows, 0.5, |r| r.declared_s),
            Quantity::MedianTravelledM => {
                of_values(rows, 0.5, |r| r.error.is_none().then_some(r.travelled_m))
            }
        }
    }
}

fn share(k: u64, n: u64) -> Estimate {
    Estimate {
        n,
        count: Some(k),
        value: (n > 0).then(|| k as f64 / n as f64),
        interval: (n > 0).then(|| wilson(k, n)),
        spread: None,
    }
}

/// Seed of the bootstrap: a table made again from the same runs is the same.
const SEED: u64 = 1;

fn of_values(rows: &[RunRow], p: f64, of: impl Fn(&RunRow) -> Option<f64>) -> Estimate {
    let sorted = finite_sorted(rows.iter().filter_map(of));
    Estimate {
        n: sorted.len() as u64,
        count: None,
        value: quantile(&sorted, p),
        interval: quantile_interval(&sorted, p, SEED, "reproduce"),
        spread: quantile(&sorted, 0.025)
            .zip(quantile(&sorted, 0.975))
            .map(|(low, high)| Interval { low, high }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::report::sample::row;

    #[test]
    fn counts_failures_as_neither_declared_nor_found() {
        let rows = vec![
            row(0, Some((3.0, -4.0))),
            row(1, Some((-30.0, 40.0))),
            row(2, None),
            RunRow {
                error: Some("x".into()),
                ..row(3, None)
            },
        ];
        let declared = Quantity::ShareDeclared.of(&rows);
        assert_eq!((declared.count, declared.n), (Some(2), 4));
        let success = Quantity::SuccessRate.of(&rows);
        assert_eq!(
            (success.count, success.interval),
            (Some(1), Some(wilson(1, 4)))
        );
        let along = Quantity::ShareMostlyAlong.of(&rows);
        assert_eq!((along.count, along.n), (Some(0), 2));
        assert_eq!(Quantity::MedianErrorM.of(&rows).value, Some(27.5));
        assert_eq!(Quantity::MedianErrorAlongM.of(&rows).value, Some(16.5));
        assert_eq!(Quantity::MedianErrorAcrossM.of(&rows).value, Some(22.0));
        assert_eq!(Quantity::MedianTravelledM.of(&rows).n, 3);
    }

    #[test]
    fn of_no_run_there_is_no_figure() {
        for q in [
            Quantity::SuccessRate,
            Quantity::MedianErrorM,
            Quantity::ShareMostlyAlong,
        ] {
            let e = q.of(&[]);
            assert_eq!((e.n, e.value, e.interval), (0, None, None));
        }
    }
}
