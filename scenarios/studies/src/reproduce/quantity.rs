//! What is computed from the rows of many runs for comparison with a paper's figure.

use super::measure::{Measure, RunEvent};
use crate::campaign::RunRow;
use crate::campaign::report::Unit;
use crate::campaign::stats::{
    Interval, LEAST_VALUES, finite_sorted, mean_interval, middle, positive_mean_interval, quantile, quantile_interval,
    wilson,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A quantity of many runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Quantity {
    /// Share of runs in which something happened.
    Share(RunEvent),
    /// Mean of a measure over the runs that have it.
    Mean(Measure),
    /// Median of a measure over the runs that have it.
    Median(Measure),
    /// Quantile of a measure over the runs that have it; the share from 0 to 1.
    Quantile(Measure, f64),
}

/// A quantity computed from our runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Number of values.
    pub n: u64,
    /// For a share: the number of values that count.
    pub count: Option<u64>,
    /// The figure; `None` if there are no values.
    pub value: Option<f64>,
    /// Its 95 % interval: Wilson's for shares and bootstrap for quantiles. For means, Student's on the logarithm's
    /// scale, or on the plain scale for quantities of either sign. With fewer than 5 values there is none, except for
    /// shares.
    pub interval: Option<Interval>,
    /// Where 95 % of single runs lie (2.5 % to 97.5 % quantile); not for shares.
    pub spread: Option<Interval>,
}

impl Quantity {
    /// Its unit.
    pub fn unit(self) -> Unit {
        match self {
            Quantity::Share(_) => Unit::Share,
            Quantity::Mean(m) | Quantity::Median(m) | Quantity::Quantile(m, _) => m.unit(),
        }
    }

    /// From rows of runs. In a failed run, nothing happened and nothing was measured.
    pub fn estimate(self, rows: &[RunRow]) -> Estimate {
        let quantile_of = |m: Measure, p: f64| {
            of_values(rows, m, |sorted| {
                let enough = sorted.len() >= LEAST_VALUES;
                let interval = || quantile_interval(sorted, p, SEED, "reproduce");
                (quantile(sorted, p), enough.then(interval).flatten())
            })
        };
        match self {
            Quantity::Share(event) => {
                let asked: Vec<bool> = rows.iter().filter_map(|r| event.happened(r)).collect();
                let k = asked.iter().filter(|yes| **yes).count() as u64;
                share(k, asked.len() as u64)
            }
            Quantity::Mean(m) => of_values(rows, m, |sorted| {
                let mean = sorted.iter().sum::<f64>() / sorted.len() as f64;
                let interval = if m.is_signed() { mean_interval(sorted) } else { positive_mean_interval(sorted) };
                ((!sorted.is_empty()).then_some(mean), interval)
            }),
            Quantity::Median(m) => quantile_of(m, 0.5),
            Quantity::Quantile(m, p) => quantile_of(m, p),
        }
    }

    /// What is wrong with its numbers, if anything.
    pub(super) fn fault(self) -> Option<String> {
        match self {
            Quantity::Quantile(_, p) if !(p > 0.0 && p < 1.0) => {
                Some(format!("quantity: a quantile's share must be above 0 and below 1, got {p}"))
            }
            _ => None,
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

/// Seed of the bootstrap, fixed so that a table of the same runs is always the same.
const SEED: u64 = 1;

fn of_values(
    rows: &[RunRow],
    measure: Measure,
    figure: impl Fn(&[f64]) -> (Option<f64>, Option<Interval>),
) -> Estimate {
    let sorted = finite_sorted(rows.iter().filter_map(|r| measure.value(r)));
    let (value, interval) = figure(&sorted);
    Estimate { n: sorted.len() as u64, count: None, value, interval, spread: middle(&sorted) }
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
            RunRow { error: Some("x".into()), ..row(3, None) },
        ];
        let declared = Quantity::Share(RunEvent::Declared).estimate(&rows);
        assert_eq!((declared.count, declared.n), (Some(2), 4));
        let success = Quantity::Share(RunEvent::Success).estimate(&rows);
        assert_eq!((success.count, success.interval), (Some(1), Some(wilson(1, 4))));
        let along = Quantity::Share(RunEvent::MostlyAlong).estimate(&rows);
        assert_eq!((along.count, along.n), (Some(0), 2));
        let median = |m| Quantity::Median(m).estimate(&rows).value;
        assert_eq!(median(Measure::ErrorM), Some(27.5));
        assert_eq!(median(Measure::ErrorAlongM), Some(16.5));
        assert_eq!(median(Measure::ErrorAcrossM), Some(22.0));
        assert_eq!(Quantity::Median(Measure::TravelledM).estimate(&rows).n, 3);
        let mean = Quantity::Mean(Measure::ErrorM).estimate(&rows);
        assert_eq!(mean.value, Some(27.5));
        // Two values say nothing about their spread: Student's interval of them would reach from -258 to 313 m.
        assert_eq!((mean.n, mean.interval), (2, None));
        assert_eq!(Quantity::Median(Measure::ErrorM).estimate(&rows).interval, None);
    }

    #[test]
    fn intervals_of_positive_quantities_are_positive() {
        let gained = |k: u64, gain: f64| RunRow {
            near_speed_m_s: Some(0.03 + gain),
            far_speed_m_s: Some(0.03),
            ..row(k, Some((if k == 0 { 5000.0 } else { 1.0 }, 0.0)))
        };
        let rows: Vec<RunRow> = (0..5).map(|k| gained(k, 0.01 * (k as f64 - 2.0))).collect();
        let interval = |m| Quantity::Mean(m).estimate(&rows).interval.unwrap();
        // One of five values is a thousand times the others: Student's interval would begin at -1775 m.
        assert!(interval(Measure::ErrorM).low > 0.0);
        // A gain may be a loss: the interval about 0 is equally wide on both sides.
        let gain = interval(Measure::NearGainMS);
        assert!((gain.low + gain.high).abs() < 1e-12 && gain.low < 0.0, "{gain:?}");
    }

    #[test]
    fn of_no_run_there_is_no_figure() {
        for q in [
            Quantity::Share(RunEvent::Success),
            Quantity::Median(Measure::ErrorM),
            Quantity::Mean(Measure::ErrorM),
            Quantity::Share(RunEvent::MostlyAlong),
        ] {
            let e = q.estimate(&[]);
            assert_eq!((e.n, e.value, e.interval), (0, None, None));
        }
    }
}
