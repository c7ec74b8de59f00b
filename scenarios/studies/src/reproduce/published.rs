//! A published figure that says how well it is known.
//!
//! *Source*: standard errors of counts and means.
//!
//! *Parameters*: none.
//!
//! *Deviations*: where a paper prints a mean without its error, the spread of our runs stands for that of its trials.

use super::measure::{Measure, RunEvent};
use super::quantity::Quantity;
use super::row::{Figure, Paper};
use crate::campaign::RunRow;

/// A figure of a paper that says how well it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    /// Its name for people.
    pub name: String,
    /// The figure.
    pub figure: Figure,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// So many of so many.
    Count(RunEvent, u64, u64),
    /// A mean, with its standard error or the number of values that it is taken over.
    Mean(Measure, f64, Error),
    /// At least this mean.
    Least(Measure, f64, u64),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Error {
    Standard(f64),
    Over(u64),
}

impl Published {
    /// The figures of a row's arm that say how well they are known; of a row without arms, all such figures.
    pub fn of(figures: &[Figure], arm: Option<&str>) -> Vec<Self> {
        let of_arm = |f: &&Figure| arm.is_none() || f.arm.as_deref() == arm;
        figures.iter().filter(of_arm).filter_map(Self::new).collect()
    }

    fn new(figure: &Figure) -> Option<Self> {
        let kind = match (figure.quantity, figure.paper?) {
            (Quantity::Share(event), Paper::Count(k, n)) => Kind::Count(event, k, n),
            (Quantity::Mean(m), Paper::Measured(value, error)) => Kind::Mean(m, value, Error::Standard(error)),
            (Quantity::Mean(m), Paper::MeanOf(value, n)) => Kind::Mean(m, value, Error::Over(n)),
            (Quantity::Mean(m), Paper::AtLeast(value, n)) => Kind::Least(m, value, n),
            _ => return None,
        };
        let name = figure.arm.as_ref().and_then(|arm| figure.name.strip_prefix(&format!("{arm}: ")));
        Some(Self { name: name.unwrap_or(&figure.name).to_string(), figure: figure.clone(), kind })
    }

    /// The paper's value, and its standard error where the runs of an experiment differ by `spread`.
    pub(crate) fn value_and_error(&self, spread: f64) -> (f64, f64) {
        let over = |n: u64| spread / (n as f64).sqrt();
        match self.kind {
            Kind::Count(_, k, n) => {
                let p = k as f64 / n as f64;
                (p, (p * (1.0 - p) / n as f64).sqrt())
            }
            Kind::Mean(_, value, Error::Standard(error)) => (value, error),
            Kind::Mean(_, value, Error::Over(n)) | Kind::Least(_, value, n) => (value, over(n)),
        }
    }

    /// Whether it is a count.
    pub(crate) fn is_count(&self) -> bool {
        matches!(self.kind, Kind::Count(..))
    }

    /// Whether the paper says only that it is at least so much.
    pub(crate) fn is_bound(&self) -> bool {
        matches!(self.kind, Kind::Least(..))
    }

    /// What counts of each of these runs: 1 or 0 for a share.
    pub(crate) fn by_run(&self, runs: &[RunRow]) -> Vec<Option<f64>> {
        let value = |r: &RunRow| match self.kind {
            _ if self.figure.among.is_some_and(|event| event.happened(r) != Some(true)) => None,
            Kind::Count(event, ..) => event.happened(r).map(|yes| f64::from(u8::from(yes))),
            Kind::Mean(m, ..) | Kind::Least(m, ..) => m.value(r),
        };
        runs.iter().map(value).collect()
    }

    fn values(&self, runs: &[RunRow]) -> Vec<f64> {
        self.by_run(runs).into_iter().flatten().collect()
    }

    /// Standard deviation of single runs, within draws.
    pub(crate) fn usual_spread<'a>(&self, draws: impl Iterator<Item = &'a [RunRow]>) -> f64 {
        let (mut sum, mut freedom) = (0.0, 0.0);
        for runs in draws {
            let (n, _, squares) = moments(&self.values(runs));
            if n >= 2.0 {
                (sum, freedom) = (sum + squares, freedom + n - 1.0);
            }
        }
        if freedom > 0.0 { (sum / freedom).sqrt() } else { 0.0 }
    }

    /// Its value over these runs; `None` if none of them has it.
    pub(crate) fn mean(&self, runs: &[RunRow]) -> Option<f64> {
        let (n, mean, _) = moments(&self.values(runs));
        (n > 0.0).then_some(mean)
    }

    /// By how much a value of ours is below the paper's; above a bound it is not.
    pub(crate) fn short_by(&self, ours: f64) -> f64 {
        let (papers, _) = self.value_and_error(0.0);
        if self.is_bound() { (papers - ours).max(0.0) } else { papers - ours }
    }
}

/// Number, mean and sum of squared differences from it.
fn moments(values: &[f64]) -> (f64, f64, f64) {
    let n = values.len() as f64;
    let mean = if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / n };
    (n, mean, values.iter().map(|v| (v - mean) * (v - mean)).sum())
}
