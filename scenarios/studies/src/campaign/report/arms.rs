//! The figures of each arm, over all conditions and under each.

use super::restricted::{RestrictedMean, SuccessTime, restricted};
use super::unit::Unit;
use crate::campaign::RunRow;
use crate::campaign::stats::{Interval, LEAST_VALUES, finite_sorted, quantile, quantile_interval, wilson};

/// Seed of the bootstrap, fixed so that a report of the same rows is always the same.
pub(super) const SEED: u64 = 1;

/// A quantity measured in each run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArmMeasure {
    /// Time of the first declaration, for runs that declared.
    Time,
    /// Distance travelled by all robots, for runs that did not fail.
    Path,
    /// Distance of the declaration from the nearest true source, for runs that declared.
    Error,
}

impl ArmMeasure {
    /// All measures, in the order of the tables.
    pub const ALL: [ArmMeasure; 3] = [ArmMeasure::Time, ArmMeasure::Path, ArmMeasure::Error];

    /// Its name for people.
    pub fn label(self) -> &'static str {
        match self {
            ArmMeasure::Time => "time to declaration",
            ArmMeasure::Path => "path",
            ArmMeasure::Error => "error",
        }
    }

    /// Its unit.
    pub fn unit(self) -> Unit {
        match self {
            ArmMeasure::Time => Unit::Seconds,
            ArmMeasure::Path | ArmMeasure::Error => Unit::Metres,
        }
    }

    /// The value for one run; `None` if there is nothing to measure.
    pub fn value(self, row: &RunRow) -> Option<f64> {
        match self {
            ArmMeasure::Time => row.declared_s,
            ArmMeasure::Path => row.error.is_none().then_some(row.travelled_m),
            ArmMeasure::Error => row.error_m,
        }
    }
}

/// A measure over many runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureSummary {
    /// The measure.
    pub measure: ArmMeasure,
    /// Number of runs.
    pub n: u64,
    /// Median.
    pub median: Option<f64>,
    /// Its 95 % bootstrap interval; `None` for too few values.
    pub median_interval: Option<Interval>,
    /// 90 % quantile.
    pub q90: Option<f64>,
    /// Its 95 % bootstrap interval.
    pub q90_interval: Option<Interval>,
}

/// A share and the counts behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Share {
    pub(super) count: u64,
    pub(super) n: u64,
}

impl Share {
    pub(super) fn count(rows: &[&RunRow], what: impl Fn(&RunRow) -> bool) -> Self {
        Self { count: rows.iter().filter(|r| what(r)).count() as u64, n: rows.len() as u64 }
    }

    pub(super) fn value(self) -> Option<f64> {
        (self.n > 0).then(|| self.count as f64 / self.n as f64)
    }

    pub(super) fn interval(self) -> Interval {
        wilson(self.count, self.n)
    }
}

/// The figures of an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmFigures {
    /// Its name.
    pub arm: String,
    /// Runs that failed; they count as neither declared nor successful.
    pub failed: u64,
    pub(super) success: Share,
    pub(super) declared: Share,
    /// Mean time to success; failures count as the limit.
    pub restricted: RestrictedMean,
    /// Time, path and error.
    pub measured: Vec<MeasureSummary>,
}

/// The figures of an arm under one condition.
#[derive(Clone, Debug, PartialEq)]
pub struct ConditionFigures {
    /// The condition.
    pub condition: String,
    /// The arm.
    pub arm: String,
    pub(super) success: Share,
}

/// The arms in the order asked for, then any others in the order of their rows.
pub(super) fn arm_names(asked: &[String], rows: &[RunRow]) -> Vec<String> {
    let mut names = asked.to_vec();
    for r in rows {
        if !names.contains(&r.arm) {
            names.push(r.arm.clone());
        }
    }
    names
}

pub(super) fn of_arm<'a>(rows: &'a [RunRow], arm: &str) -> Vec<&'a RunRow> {
    rows.iter().filter(|r| r.arm == arm).collect()
}

pub(super) fn figures(arm: &str, rows: &[&RunRow], success: SuccessTime) -> ArmFigures {
    ArmFigures {
        arm: arm.to_string(),
        failed: rows.iter().filter(|r| r.error.is_some()).count() as u64,
        success: Share::count(rows, |r| r.success),
        declared: Share::count(rows, |r| r.declared_s.is_some()),
        restricted: restricted(rows, success),
        measured: ArmMeasure::ALL.map(|m| measured(m, rows)).to_vec(),
    }
}

fn measured(measure: ArmMeasure, rows: &[&RunRow]) -> MeasureSummary {
    let sorted = finite_sorted(rows.iter().filter_map(|r| measure.value(r)));
    let interval = |p| {
        let enough = sorted.len() >= LEAST_VALUES;
        enough.then(|| quantile_interval(&sorted, p, SEED, measure.label()))?
    };
    MeasureSummary {
        measure,
        n: sorted.len() as u64,
        median: quantile(&sorted, 0.5),
        median_interval: interval(0.5),
        q90: quantile(&sorted, 0.9),
        q90_interval: interval(0.9),
    }
}

/// Success of each arm under each condition, in the order of the rows; empty if there is only one condition.
pub(super) fn conditions(arms: &[String], rows: &[RunRow]) -> Vec<ConditionFigures> {
    use std::collections::BTreeMap;
    let mut order: Vec<&str> = Vec::new();
    let mut counts: BTreeMap<(&str, &str), Share> = BTreeMap::new();
    let mut known: std::collections::BTreeSet<&str> = std::collections::BTreeSet::new();
    for r in rows {
        if known.insert(&r.condition) {
            order.push(&r.condition);
        }
        let share = (counts.entry((&r.condition, &r.arm))).or_insert(Share { count: 0, n: 0 });
        share.n += 1;
        share.count += u64::from(r.success);
    }
    if order.len() < 2 {
        return Vec::new();
    }
    let one = |condition: &str, arm: &str| {
        counts.get(&(condition, arm)).map(|success| ConditionFigures {
            condition: condition.to_string(),
            arm: arm.to_string(),
            success: *success,
        })
    };
    (order.iter()).flat_map(|c| arms.iter().filter_map(|a| one(c, a)).collect::<Vec<_>>()).collect()
}
