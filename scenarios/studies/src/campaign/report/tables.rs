//! The report's tables for the screen and the page, and every number as CSV.

use super::arms::{ArmFigures, ArmMeasure, ConditionFigures, MeasureSummary};
use super::curves::Curve;
use super::pairs::{Compares, Comparison};
use super::restricted::RestrictedMean;
use super::text::{Table, TableColumn};
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
    Table::of(
        arms,
        &[
            ("arm", &|a| a.arm.clone()),
            ("runs", &|a| a.success.n.to_string()),
            ("failed", &|a| a.failed.to_string()),
            (&share.head("success"), &|a| shown(&share, a.success.value())),
            (&share.head(INTERVAL), &|a| share.numbers(a.success.interval())),
            (&share.head("declared"), &|a| shown(&share, a.declared.value())),
            (&share.head(INTERVAL), &|a| share.numbers(a.declared.interval())),
        ],
    )
}

/// A table for each measure, with what it is of.
pub(super) fn measured(arms: &[ArmFigures]) -> Vec<(String, Table)> {
    let of = |measure: ArmMeasure| {
        let all = || (arms.iter()).flat_map(|a| a.measured.iter().map(move |m| (a, m)));
        let rows = || all().filter(|(_, m)| m.measure == measure);
        let both = |m: &MeasureSummary| [(m.median, m.median_interval), (m.q90, m.q90_interval)];
        let scale = measure.unit().scale(values(rows().flat_map(|(_, m)| both(m))));
        let interval = |n, i| range(n, i, |i| scale.numbers(i));
        let columns: [TableColumn<'_, (&ArmFigures, &MeasureSummary)>; 6] = [
            ("arm", &|(a, _)| a.arm.clone()),
            ("n", &|(_, m)| m.n.to_string()),
            (&scale.head("median"), &|(_, m)| shown(&scale, m.median)),
            (&scale.head(INTERVAL), &|(_, m)| interval(m.n, m.median_interval)),
            (&scale.head("90 % quantile"), &|(_, m)| shown(&scale, m.q90)),
            (&scale.head(INTERVAL), &|(_, m)| interval(m.n, m.q90_interval)),
        ];
        (title(measure.label()), Table::of(rows(), &columns))
    };
    ArmMeasure::ALL.into_iter().map(of).collect()
}

/// With a capital, as a title.
fn title(words: &str) -> String {
    let mut rest = words.chars();
    rest.next().map_or(String::new(), |first| first.to_uppercase().chain(rest).collect())
}

pub(super) fn restricted(arms: &[ArmFigures]) -> Table {
    let all: Vec<(&str, RestrictedMean)> = arms.iter().map(|a| (a.arm.as_str(), a.restricted)).collect();
    let scale = Unit::Seconds.scale(values(all.iter().map(|(_, r)| (r.mean_s, r.interval))));
    Table::of(
        all,
        &[
            ("arm", &|(arm, _)| (*arm).to_string()),
            ("n", &|(_, r)| r.n.to_string()),
            ("without success", &|(_, r)| r.at_limit.to_string()),
            (&scale.head("mean time to success"), &|(_, r)| shown(&scale, r.mean_s)),
            (&scale.head(INTERVAL), &|(_, r)| range(r.n, r.interval, |i| scale.numbers(i))),
        ],
    )
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
        let n = |c: &Comparison| c.difference.map_or(0, |d| d.pairs as u64);
        let interval = |c: &Comparison| match (by, c.difference) {
            (Compares::Success, Some(d)) => scale.numbers(d.interval),
            _ => range(n(c), sound_interval(c), |i| scale.numbers(i)),
        };
        let verdict = |c: &Comparison| c.difference.map_or("not separable: no pairs", |d| d.verdict.label());
        let columns: [TableColumn<'_, &Comparison>; 7] = [
            ("first", &|c| c.first.clone()),
            ("second", &|c| c.second.clone()),
            ("pairs", &|c| n(c).to_string()),
            (&scale.head("first - second"), &|c| shown(&scale, c.difference.map(|d| d.estimate))),
            (&scale.head(INTERVAL), &|c| interval(c)),
            ("first is", &|c| verdict(c).to_string()),
            ("rests on", &|c| c.rests_on.clone()),
        ];
        (title(by.label()), Table::of(rows(), &columns))
    };
    Compares::ALL.into_iter().map(of).collect()
}

pub(super) fn conditions(conditions: &[ConditionFigures]) -> Table {
    let share = Unit::Share.scale([]);
    Table::of(
        conditions,
        &[
            ("condition", &|c| c.condition.clone()),
            ("arm", &|c| c.arm.clone()),
            ("runs", &|c| c.success.n.to_string()),
            (&share.head("success"), &|c| shown(&share, c.success.value())),
            (&share.head(INTERVAL), &|c| share.numbers(c.success.interval())),
        ],
    )
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
    let estimate = |c: &Comparison| fields(c.difference.map(|d| d.estimate), sound_interval(c));
    let columns: [TableColumn<'_, &Comparison>; 10] = [
        ("first", &|c| c.first.clone()),
        ("second", &|c| c.second.clone()),
        ("by", &|c| c.by.label().to_string()),
        ("pairs", &|c| c.difference.map_or(0, |d| d.pairs).to_string()),
        ("difference", &|c| estimate(c)[0].clone()),
        ("low", &|c| estimate(c)[1].clone()),
        ("high", &|c| estimate(c)[2].clone()),
        ("first_is", &|c| c.difference.map_or("", |d| d.verdict.label()).to_string()),
        ("rests_on", &|c| c.rests_on.clone()),
        ("warning", &|c| c.warning.clone().unwrap_or_default()),
    ];
    Table::of(comparisons, &columns).csv()
}

pub(super) fn conditions_csv(conditions: &[ConditionFigures]) -> String {
    let columns: [TableColumn<'_, &ConditionFigures>; 7] = [
        ("condition", &|c| c.condition.clone()),
        ("arm", &|c| c.arm.clone()),
        ("runs", &|c| c.success.n.to_string()),
        ("successes", &|c| c.success.count.to_string()),
        ("share", &|c| csv_number(c.success.value())),
        ("low", &|c| c.success.interval().low.to_string()),
        ("high", &|c| c.success.interval().high.to_string()),
    ];
    Table::of(conditions, &columns).csv()
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
