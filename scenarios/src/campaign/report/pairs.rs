//! Arm against arm on the same seeds and conditions.

use super::arms::{Measure, SEED, of_arm};
use super::unit::Unit;
use crate::campaign::RunRow;
use crate::campaign::stats::{Better, Difference, paired_median, paired_share};
use std::collections::BTreeMap;

/// Up to so many arms each is compared with each; of more, each with the first.
pub(super) const EACH_WITH_EACH: usize = 5;

/// What two arms are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compares {
    /// Share of successes.
    Success,
    /// Median of the differences of a measure, over pairs where both have it.
    Measure(Measure),
}

impl Compares {
    /// All of them.
    pub const ALL: [Compares; 4] = [
        Compares::Success,
        Compares::Measure(Measure::Time),
        Compares::Measure(Measure::Path),
        Compares::Measure(Measure::Error),
    ];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Compares::Success => "success",
            Compares::Measure(m) => m.words(),
        }
    }

    /// Unit of the difference.
    #[must_use]
    pub fn unit(self) -> Unit {
        match self {
            Compares::Success => Unit::Share,
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
    /// By what.
    pub by: Compares,
    /// The difference; none without a pair.
    pub difference: Option<Difference>,
}

/// All comparisons of a campaign.
pub(super) fn comparisons(arms: &[String], rows: &[RunRow]) -> Vec<Comparison> {
    let mut out = Vec::new();
    for (i, first) in arms.iter().enumerate() {
        for (j, second) in arms.iter().enumerate().skip(i + 1) {
            if i > 0 && arms.len() > EACH_WITH_EACH {
                continue;
            }
            debug_assert!(i < j);
            out.extend(compared(first, second, rows));
        }
    }
    out
}

fn compared(first: &str, second: &str, rows: &[RunRow]) -> Vec<Comparison> {
    type Key<'a> = (&'a str, u64);
    let others: BTreeMap<Key<'_>, &RunRow> = of_arm(rows, second)
        .into_iter()
        .map(|r| ((r.condition.as_str(), r.seed_index), r))
        .collect();
    let pairs: Vec<(&RunRow, &RunRow)> = of_arm(rows, first)
        .into_iter()
        .filter_map(|r| Some((r, *others.get(&(r.condition.as_str(), r.seed_index))?)))
        .collect();
    let difference = |by: Compares| match by {
        Compares::Success => paired_share(
            pairs.iter().map(|(a, b)| (a.success, b.success)),
            Better::More,
        ),
        Compares::Measure(m) => paired_median(
            pairs.iter().filter_map(|(a, b)| m.of(a).zip(m.of(b))),
            Better::Less,
            SEED,
            m.words(),
        ),
    };
    Compares::ALL
        .map(|by| Comparison {
            first: first.to_string(),
            second: second.to_string(),
            by,
            difference: difference(by),
        })
        .to_vec()
}
