//! The report's tables for the screen and the page, and every number as CSV.

use super::arms::{ArmFigures, ConditionFigures};
use super::curves::Curve;
use super::pairs::{Compares, Comparison};
use super::unit::Unit;
use crate::campaign::stats::{Difference, Interval, LEAST_VALUES};
use output::files::{csv_number, csv_text};

fn shown(unit: Unit, value: Option<f64>) -> String {
    value.map_or("-".to_string(), |v| unit.show(v))
}

/// The interval of a figure of `n` values; for too few values there is none.
pub(crate) fn range(unit: Unit, interval: Option<Interval>, n: u64) -> String {
    match interval {
        Some(i) if n >= LEAST_VALUES as u64 => unit.show_interval(i),
        _ if n == 0 => "-".to_string(),
        _ => format!("too few (n = {n})"),
    }
}

pub(super) const SUCCESS: [&str; 7] = [
    "arm",
    "runs",
    "failed",
    "success",
    "95 % interval",
    "declared",
    "95 % interval",
];

pub(super) fn success(arms: &[ArmFigures]) -> Vec<[String; 7]> {
    let one = |a: &ArmFigures| {
        [
            a.arm.clone(),
            a.success.n.to_string(),
            a.failed.to_string(),
            shown(Unit::Share, a.success.value()),
            Unit::Share.show_interval(a.success.interval()),
            shown(Unit::Share, a.declared.value()),
            Unit::Share.show_interval(a.declared.interval()),
        ]
    };
    arms.iter().map(one).collect()
}

pub(super) const MEASURED: [&str; 7] = [
    "arm",
    "of a run",
    "n",
    "median",
    "95 % interval",
    "90 % quantile",
    "95 % interval",
];

pub(super) fn measured(arms: &[ArmFigures]) -> Vec<[String; 7]> {
    let rows = arms
        .iter()
        .flat_map(|a| a.measured.iter().map(move |m| (a, m)));
    rows.map(|(a, m)| {
        let unit = m.measure.unit();
        [
            a.arm.clone(),
            m.measure.words().to_string(),
            m.n.to_string(),
            shown(unit, m.median),
            range(unit, m.median_interval, m.n),
            shown(unit, m.q90),
            range(unit, m.q90_interval, m.n),
        ]
    })
    .collect()
}

pub(super) const RESTRICTED: [&str; 5] = [
    "arm",
    "n",
    "of them without success",
    "mean time to success, at most the limit",
    "95 % interval",
];

pub(super) fn restricted(arms: &[ArmFigures]) -> Vec<[String; 5]> {
    let one = |a: &ArmFigures| {
        let r = a.restricted;
        [
            a.arm.clone(),
            r.n.to_string(),
            r.at_limit.to_string(),
            shown(Unit::Seconds, r.mean_s),
            range(Unit::Seconds, r.interval, r.n),
        ]
    };
    arms.iter().map(one).collect()
}

pub(super) const PAIRS: [&str; 8] = [
    "first",
    "second",
    "by",
    "pairs",
    "first - second",
    "95 % interval",
    "first is",
    "rests on",
];

/// For a share, the interval is exact however few the pairs are; for a quantity, there must be enough pairs.
fn sound_interval(c: &Comparison) -> Option<Interval> {
    let enough = |d: &Difference| c.by == Compares::Success || d.pairs >= LEAST_VALUES;
    c.difference.filter(enough).map(|d| d.interval)
}

pub(super) fn pairs(comparisons: &[Comparison]) -> Vec<[String; 8]> {
    let one = |c: &Comparison| {
        let d = c.difference;
        [
            c.first.clone(),
            c.second.clone(),
            c.by.words().to_string(),
            d.map_or(0, |d| d.pairs).to_string(),
            shown(c.by.unit(), d.map(|d| d.estimate)),
            match (c.by, d) {
                (Compares::Success, Some(d)) => Unit::Share.show_interval(d.interval),
                (by, d) => range(
                    by.unit(),
                    sound_interval(c),
                    d.map_or(0, |d| d.pairs as u64),
                ),
            },
            d.map_or("not separable: no pairs", |d| d.verdict.words())
                .to_string(),
            c.rests_on.clone(),
        ]
    };
    comparisons.iter().map(one).collect()
}

pub(super) const CONDITIONS: [&str; 5] = ["condition", "arm", "runs", "success", "95 % interval"];

pub(super) fn conditions(conditions: &[ConditionFigures]) -> Vec<[String; 5]> {
    let one = |c: &ConditionFigures| {
        [
            c.condition.clone(),
            c.arm.clone(),
            c.success.n.to_string(),
            shown(Unit::Share, c.success.value()),
            Unit::Share.show_interval(c.success.interval()),
        ]
    };
    conditions.iter().map(one).collect()
}

/// Value, lower and upper end, as fields.
fn fields(value: Option<f64>, interval: Option<Interval>) -> [String; 3] {
    [value, interval.map(|i| i.low), interval.map(|i| i.high)].map(csv_number)
}

pub(super) fn arms_csv(arms: &[ArmFigures]) -> String {
    let of_arm = |a: &ArmFigures| {
        let line = |what: &str, n: u64, count: Option<u64>, value, interval| {
            let [value, low, high] = fields(value, interval);
            let count = count.map_or_else(String::new, |k| k.to_string());
            let what = what.to_string();
            [a.arm.clone(), what, n.to_string(), count, value, low, high]
        };
        let mut lines: Vec<[String; 7]> = [("success", a.success), ("declared", a.declared)]
            .map(|(what, s)| line(what, s.n, Some(s.count), s.value(), Some(s.interval())))
            .to_vec();
        lines.push(line("failed", a.success.n, Some(a.failed), None, None));
        let r = a.restricted;
        let what = format!("time to success at most {} s mean", r.limit_s);
        let in_time = Some(r.n - r.at_limit);
        lines.push(line(&what, r.n, in_time, r.mean_s, r.interval));
        for m in &a.measured {
            let what = format!("{} median", m.measure.words());
            lines.push(line(&what, m.n, None, m.median, m.median_interval));
            let what = format!("{} 90 % quantile", m.measure.words());
            lines.push(line(&what, m.n, None, m.q90, m.q90_interval));
        }
        lines
    };
    csv_text(
        "arm,quantity,n,count,value,low,high",
        arms.iter().flat_map(of_arm),
    )
}

pub(super) fn pairs_csv(comparisons: &[Comparison]) -> String {
    let one = |c: &Comparison| {
        let d = c.difference;
        let [value, low, high] = fields(d.map(|d| d.estimate), sound_interval(c));
        [
            c.first.clone(),
            c.second.clone(),
            c.by.words().to_string(),
            d.map_or(0, |d| d.pairs).to_string(),
            value,
            low,
            high,
            d.map_or("", |d| d.verdict.words()).to_string(),
            c.rests_on.clone(),
            c.warning.clone().unwrap_or_default(),
        ]
    };
    csv_text(
        "first,second,by,pairs,difference,low,high,first_is,rests_on,warning",
        comparisons.iter().map(one),
    )
}

pub(super) fn conditions_csv(conditions: &[ConditionFigures]) -> String {
    let one = |c: &ConditionFigures| {
        let s = c.success;
        let [value, low, high] = fields(s.value(), Some(s.interval()));
        let (n, count) = (s.n.to_string(), s.count.to_string());
        [
            c.condition.clone(),
            c.arm.clone(),
            n,
            count,
            value,
            low,
            high,
        ]
    };
    csv_text(
        "condition,arm,runs,successes,share,low,high",
        conditions.iter().map(one),
    )
}

pub(super) fn curves_csv(x: &str, curves: &[Curve]) -> String {
    let points = curves.iter().flat_map(|c| {
        c.points.iter().map(|p| {
            let [share, low, high] = fields(Some(p.y), Some(p.interval));
            [c.arm.clone(), p.x.to_string(), share, low, high]
        })
    });
    csv_text(&format!("arm,{x},share,low,high"), points)
}
