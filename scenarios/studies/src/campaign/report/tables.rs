//! The report's tables for the screen and the page, and every number as CSV.

use super::arms::{ArmFigures, ArmMeasure, ConditionFigures, MeasureSummary};
use super::curves::Curve;
use super::pairs::{Compares, Comparison};
use super::text::Table;
use super::unit::{Scale, Unit};
use crate::campaign::stats::{Difference, Interval, LEAST_VALUES};
use output::files::{csv_number, csv_text};

/// A column's values that are there, with the ends of their intervals.
fn values<'a>(all: impl IntoIterator<Item = (Option<f64>, Option<Interval>)> + 'a) -> impl Iterator<Item = f64> + 'a {
    (all.into_iter()).flat_map(|(v, i)| [v, i.map(|i| i.low), i.map(|i| i.high)].into_iter().flatten())
}

fn shown(scale: &Scale, value: Option<f64>) -> String {
    value.map_or("-".to_string(), |v| scale.number(v))
}

/// The interval of a figure of `n` values; for too few values there is none.
pub(crate) fn range(n: u64, interval: Option<Interval>, show: impl Fn(Interval) -> String) -> String {
    match interval {
        Some(i) if n >= LEAST_VALUES as u64 => show(i),
        _ if n == 0 => "-".to_string(),
        _ => format!("too few (n = {n})"),
    }
}

const INTERVAL: &str = "95 % interval";

pub(super) fn success(arms: &[ArmFigures]) -> Table {
    let share = Unit::Share.scale([]);
    let interval = share.head(INTERVAL);
    let one = |a: &ArmFigures| {
        [
            a.arm.clone(),
            a.success.n.to_string(),
            a.failed.to_string(),
            shown(&share, a.success.value()),
            share.numbers(a.success.interval()),
            shown(&share, a.declared.value()),
            share.numbers(a.declared.interval()),
        ]
    };
    let head = [
        "arm".to_string(),
        "runs".to_string(),
        "failed".to_string(),
        share.head("success"),
        interval.clone(),
        share.head("declared"),
        interval,
    ];
    Table::new(head, arms.iter().map(one))
}

/// A table for each measure, with what it is of.
pub(super) fn measured(arms: &[ArmFigures]) -> Vec<(String, Table)> {
    let of = |measure: ArmMeasure| {
        let all = || (arms.iter()).flat_map(|a| a.measured.iter().map(move |m| (a, m)));
        let rows = || all().filter(|(_, m)| m.measure == measure);
        let both = |m: &MeasureSummary| [(m.median, m.median_interval), (m.q90, m.q90_interval)];
        let scale = measure.unit().scale(values(rows().flat_map(|(_, m)| both(m))));
        let one = |(a, m): (&ArmFigures, &MeasureSummary)| {
            let interval = |i| range(m.n, i, |i| scale.numbers(i));
            [
                a.arm.clone(),
                m.n.to_string(),
                shown(&scale, m.median),
                interval(m.median_interval),
                shown(&scale, m.q90),
                interval(m.q90_interval),
            ]
        };
        let head = [
            "arm".to_string(),
            "n".to_string(),
            scale.head("median"),
            scale.head(INTERVAL),
            scale.head("90 % quantile"),
            scale.head(INTERVAL),
        ];
        (title(measure.label()), Table::new(head, rows().map(one)))
    };
    ArmMeasure::ALL.into_iter().map(of).collect()
}

/// With a capital, as a title.
fn title(words: &str) -> String {
    let mut rest = words.chars();
    rest.next().map_or(String::new(), |first| first.to_uppercase().chain(rest).collect())
}

pub(super) fn restricted(arms: &[ArmFigures]) -> Table {
    let all = arms.iter().map(|a| (a.restricted.mean_s, a.restricted.interval));
    let scale = Unit::Seconds.scale(values(all));
    let one = |a: &ArmFigures| {
        let r = a.restricted;
        [
            a.arm.clone(),
            r.n.to_string(),
            r.at_limit.to_string(),
            shown(&scale, r.mean_s),
            range(r.n, r.interval, |i| scale.numbers(i)),
        ]
    };
    let head = [
        "arm".to_string(),
        "n".to_string(),
        "without success".to_string(),
        scale.head("mean time to success"),
        scale.head(INTERVAL),
    ];
    Table::new(head, arms.iter().map(one))
}

/// For a share, the interval is exact however few the pairs are; for a quantity, there must be enough pairs.
fn sound_interval(c: &Comparison) -> Option<Interval> {
    let enough = |d: &Difference| c.by == Compares::Success || d.pairs >= LEAST_VALUES;
    c.difference.filter(enough).map(|d| d.interval)
}

/// A table for each quantity by which arms are compared, with what it is.
pub(super) fn pairs(comparisons: &[Comparison]) -> Vec<(String, Table)> {
    let of = |by: Compares| {
        let rows = || comparisons.iter().filter(|c| c.by == by);
        let all = rows().map(|c| (c.difference.map(|d| d.estimate), sound_interval(c)));
        let scale = by.unit().scale(values(all));
        let one = |c: &Comparison| {
            let d = c.difference;
            let n = d.map_or(0, |d| d.pairs as u64);
            [
                c.first.clone(),
                c.second.clone(),
                n.to_string(),
                shown(&scale, d.map(|d| d.estimate)),
                match (by, d) {
                    (Compares::Success, Some(d)) => scale.numbers(d.interval),
                    _ => range(n, sound_interval(c), |i| scale.numbers(i)),
                },
                d.map_or("not separable: no pairs", |d| d.verdict.label()).to_string(),
                c.rests_on.clone(),
            ]
        };
        let head = [
            "first".to_string(),
            "second".to_string(),
            "pairs".to_string(),
            scale.head("first - second"),
            scale.head(INTERVAL),
            "first is".to_string(),
            "rests on".to_string(),
        ];
        (title(by.label()), Table::new(head, rows().map(one)))
    };
    Compares::ALL.into_iter().map(of).collect()
}

pub(super) fn conditions(conditions: &[ConditionFigures]) -> Table {
    let share = Unit::Share.scale([]);
    let one = |c: &ConditionFigures| {
        [
            c.condition.clone(),
            c.arm.clone(),
            c.success.n.to_string(),
            shown(&share, c.success.value()),
            share.numbers(c.success.interval()),
        ]
    };
    let head =
        ["condition".to_string(), "arm".to_string(), "runs".to_string(), share.head("success"), share.head(INTERVAL)];
    Table::new(head, conditions.iter().map(one))
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
            let what = format!("{} median", m.measure.label());
            lines.push(line(&what, m.n, None, m.median, m.median_interval));
            let what = format!("{} 90 % quantile", m.measure.label());
            lines.push(line(&what, m.n, None, m.q90, m.q90_interval));
        }
        lines
    };
    csv_text("arm,quantity,n,count,value,low,high", arms.iter().flat_map(of_arm))
}

pub(super) fn pairs_csv(comparisons: &[Comparison]) -> String {
    let one = |c: &Comparison| {
        let d = c.difference;
        let [value, low, high] = fields(d.map(|d| d.estimate), sound_interval(c));
        [
            c.first.clone(),
            c.second.clone(),
            c.by.label().to_string(),
            d.map_or(0, |d| d.pairs).to_string(),
            value,
            low,
            high,
            d.map_or("", |d| d.verdict.label()).to_string(),
            c.rests_on.clone(),
            c.warning.clone().unwrap_or_default(),
        ]
    };
    csv_text("first,second,by,pairs,difference,low,high,first_is,rests_on,warning", comparisons.iter().map(one))
}

pub(super) fn conditions_csv(conditions: &[ConditionFigures]) -> String {
    let one = |c: &ConditionFigures| {
        let s = c.success;
        let [value, low, high] = fields(s.value(), Some(s.interval()));
        let (n, count) = (s.n.to_string(), s.count.to_string());
        [c.condition.clone(), c.arm.clone(), n, count, value, low, high]
    };
    csv_text("condition,arm,runs,successes,share,low,high", conditions.iter().map(one))
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
