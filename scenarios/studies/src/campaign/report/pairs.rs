//! Comparison of arms on the same seeds and conditions.

use super::arms::{ArmMeasure, SEED, of_arm};
use super::restricted::SuccessTime;
use super::unit::Unit;
use crate::campaign::RunRow;
use crate::campaign::stats::{Better, Difference, Separation, paired_mean, paired_median, paired_share};
use std::collections::BTreeMap;

/// Up to this many arms, each is compared with each; of more arms, each is compared with the first.
pub(super) const EACH_WITH_EACH: usize = 5;

/// The quantity by which two arms are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compares {
    /// Share of successes.
    Success,
    /// Mean time to success; failures count as the limit.
    Restricted,
    /// Median of the differences of a measure, over pairs where both have it.
    Measure(ArmMeasure),
}

impl Compares {
    /// All quantities.
    pub const ALL: [Compares; 5] = [
        Compares::Success,
        Compares::Restricted,
        Compares::Measure(ArmMeasure::Time),
        Compares::Measure(ArmMeasure::Path),
        Compares::Measure(ArmMeasure::Error),
    ];

    /// Its name for people.
    pub fn label(self) -> &'static str {
        match self {
            Compares::Success => "success",
            Compares::Restricted => "restricted time",
            Compares::Measure(m) => m.label(),
        }
    }

    /// Unit of the difference.
    pub fn unit(self) -> Unit {
        match self {
            Compares::Success => Unit::Share,
            Compares::Restricted => Unit::Seconds,
            Compares::Measure(m) => m.unit(),
        }
    }
}

/// First arm minus second.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// First arm.
    pub first: String,
    /// Second arm.
    pub second: String,
    /// The quantity.
    pub by: Compares,
    /// The difference; `None` without a pair.
    pub difference: Option<Difference>,
    /// The pairs on which it rests, in words.
    pub rests_on: String,
    /// What one must know before one believes it.
    pub warning: Option<String>,
}

/// All comparisons of a campaign; `against` names the arm with which each other one is compared.
pub(super) fn comparisons(
    arms: &[String],
    rows: &[RunRow],
    success: SuccessTime,
    against: Option<&str>,
) -> Vec<Comparison> {
    if let Some(second) = against {
        let others = arms.iter().filter(|a| *a != second);
        return (others.flat_map(|first| compared(first, second, rows, success))).collect();
    }
    let mut out = Vec::new();
    for (i, first) in arms.iter().enumerate() {
        for second in arms.iter().skip(i + 1) {
            if i > 0 && arms.len() > EACH_WITH_EACH {
                continue;
            }
            out.extend(compared(first, second, rows, success));
        }
    }
    out
}

type Pair<'a> = (&'a RunRow, &'a RunRow);

fn compared(first: &str, second: &str, rows: &[RunRow], success: SuccessTime) -> Vec<Comparison> {
    type Key<'a> = (&'a str, u64);
    let others: BTreeMap<Key<'_>, &RunRow> =
        of_arm(rows, second).into_iter().map(|r| ((r.condition.as_str(), r.seed_index), r)).collect();
    let pairs: Vec<Pair<'_>> = of_arm(rows, first)
        .into_iter()
        .filter_map(|r| Some((r, *others.get(&(r.condition.as_str(), r.seed_index))?)))
        .collect();
    let restricted = paired_mean((pairs.iter()).filter_map(|(a, b)| success.of(a).zip(success.of(b))), Better::Less);
    let difference = |by: Compares| match by {
        Compares::Success => paired_share(pairs.iter().map(|(a, b)| (a.success, b.success)), Better::More),
        Compares::Restricted => restricted,
        Compares::Measure(m) => {
            paired_median(pairs.iter().filter_map(|(a, b)| m.value(a).zip(m.value(b))), Better::Less, SEED, m.label())
        }
    };
    let n = pairs.len();
    let one = |by: Compares| {
        let difference = difference(by);
        let k = difference.map_or(0, |d| d.pairs);
        Comparison {
            first: first.to_string(),
            second: second.to_string(),
            by,
            difference,
            rests_on: match by {
                Compares::Success => format!("all {n} pairs"),
                Compares::Restricted => {
                    format!("{k} of {n} pairs; no success counts as {:.0} s", success.limit_s)
                }
                Compares::Measure(ArmMeasure::Path) => format!("{k} of {n} pairs: both ran"),
                Compares::Measure(_) => format!("{k} of {n} pairs: both declared"),
            },
            warning: (difference.filter(|_| by == Compares::Measure(ArmMeasure::Time)))
                .and_then(|d| looks_faster([first, second], &pairs, d, restricted)),
        }
    };
    Compares::ALL.map(one).to_vec()
}

/// Among the pairs where both declared, the arm that fails more looks faster: the hard runs, in which only the other
/// arm declared, are not among them.
fn looks_faster(
    names: [&str; 2],
    pairs: &[Pair<'_>],
    by_time: Difference,
    restricted: Option<Difference>,
) -> Option<String> {
    let n = pairs.len();
    let found = [pairs.iter().filter(|(a, _)| a.success).count(), pairs.iter().filter(|(_, b)| b.success).count()];
    let (fast, slow) = if by_time.estimate < 0.0 { (0, 1) } else { (1, 0) };
    if by_time.estimate == 0.0 || found[fast] >= found[slow] {
        return None;
    }
    let verdict = match restricted.map(|d| d.verdict) {
        Some(Separation::Better) => format!("{} is better", names[0]),
        Some(Separation::Worse) => format!("{} is better", names[1]),
        Some(Separation::NotSeparable) | None => "they are not separable at this n".to_string(),
    };
    Some(format!(
        "{} looks faster than {} by the time to declaration: that rests on the {} of {n} pairs where both declared; but it \
         fails more ({} against {} of {n} succeed). Go by the restricted time: by that {verdict}.",
        names[fast], names[slow], by_time.pairs, found[fast], found[slow]
    ))
}
