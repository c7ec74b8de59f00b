//! The report's tables for the screen and the page, and every number as CSV.

use super::arms::{ArmFigures, ConditionFigures};
use super::curves::Curve;
use super::pairs::{Compares, Comparison};
use super::text::csv_field;
use super::unit::Unit;
use crate::campaign::stats::{Difference, Interval, LEAST_VALUES};
use std::fmt::Write as _;

const TEXT: &str = "writing to a String succeeds";

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

fn number(value: Option<f64>) -> String {
    value.map_or(String::new(), |v| v.to_string())
}

fn ends(interval: Option<Interval>) -> String {
    format!(
        "{},{}",
        number(interval.map(|i| i.low)),
        number(interval.map(|i| i.high))
    )
}

pub(super) fn arms_csv(arms: &[ArmFigures]) -> String {
    let mut out = String::from("arm,quantity,n,count,value,low,high\n");
    for a in arms {
        let arm = csv_field(&a.arm);
        for (name, share) in [("success", a.success), ("declared", a.declared)] {
            let (value, i) = (number(share.value()), ends(Some(share.interval())));
            writeln!(out, "{arm},{name},{},{},{value},{i}", share.n, share.count).expect(TEXT);
        }
        writeln!(out, "{arm},failed,{},{},,,", a.success.n, a.failed).expect(TEXT);
        let r = a.restricted;
        let (value, i) = (number(r.mean_s), ends(r.interval));
        let what = format!("time to success at most {} s mean", r.limit_s);
        writeln!(out, "{arm},{what},{},{},{value},{i}", r.n, r.n - r.at_limit).expect(TEXT);
        for m in &a.measured {
            let what = m.measure.words();
            let (value, i) = (number(m.median), ends(m.median_interval));
            writeln!(out, "{arm},{what} median,{},,{value},{i}", m.n).expect(TEXT);
            let (value, i) = (number(m.q90), ends(m.q90_interval));
            writeln!(out, "{arm},{what} 90 % quantile,{},,{value},{i}", m.n).expect(TEXT);
        }
    }
    out
}

pub(super) fn pairs_csv(comparisons: &[Comparison]) -> String {
    let mut out =
        String::from("first,second,by,pairs,difference,low,high,first_is,rests_on,warning\n");
    for c in comparisons {
        let d = c.difference;
        writeln!(
            out,
            "{},{},{},{},{},{},{},{},{}",
            csv_field(&c.first),
            csv_field(&c.second),
            c.by.words(),
            d.map_or(0, |d| d.pairs),
            number(d.map(|d| d.estimate)),
            ends(sound_interval(c)),
            d.map_or("", |d| d.verdict.words()),
            csv_field(&c.rests_on),
            csv_field(c.warning.as_deref().unwrap_or_default())
        )
        .expect(TEXT);
    }
    out
}

pub(super) fn conditions_csv(conditions: &[ConditionFigures]) -> String {
    let mut out = String::from("condition,arm,runs,successes,share,low,high\n");
    for c in conditions {
        let s = c.success;
        let (condition, arm) = (csv_field(&c.condition), csv_field(&c.arm));
        let (value, i) = (number(s.value()), ends(Some(s.interval())));
        writeln!(out, "{condition},{arm},{},{},{value},{i}", s.n, s.count).expect(TEXT);
    }
    out
}

pub(super) fn curves_csv(x: &str, curves: &[Curve]) -> String {
    let mut out = format!("arm,{x},share,low,high\n");
    for c in curves {
        for p in &c.points {
            let i = ends(Some(p.interval));
            writeln!(out, "{},{},{},{i}", csv_field(&c.arm), p.x, p.y).expect(TEXT);
        }
    }
    out
}
