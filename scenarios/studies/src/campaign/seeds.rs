//! The seeds of a campaign's runs.

use ron::value::RawValue;
use schemars::{JsonSchema, Schema};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::{Value, json};
use world::seeds::key;

/// Most seeds of a campaign, and most runs.
pub(super) const MOST: u64 = 1 << 40;

/// The seeds under each condition. Every arm runs with each of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = or_number)]
pub enum Seeds {
    /// Consecutive seeds, the same under each condition: those of `rheotaxis run --seed`.
    Literal {
        /// The first seed.
        first: u64,
        /// Number of seeds.
        #[schemars(extend("minimum" = 1, "maximum" = MOST))]
        count: u64,
    },
    /// Each seed is a hash of this seed, the condition and its index. They differ between conditions, and nobody would
    /// give them by hand.
    Hashed {
        /// The seed from which they are made.
        seed: u64,
        /// Number of seeds.
        #[schemars(extend("minimum" = 1, "maximum" = MOST))]
        count: u64,
    },
}

impl Seeds {
    /// Number of seeds under each condition.
    pub fn count(self) -> u64 {
        match self {
            Seeds::Literal { count, .. } | Seeds::Hashed { count, .. } => count,
        }
    }

    /// The seed with an index, from 0, under a condition.
    pub fn seed(self, condition: u64, index: u64) -> u64 {
        match self {
            Seeds::Literal { first, .. } => first + index,
            Seeds::Hashed { seed, .. } => key(seed, &format!("condition {condition}"), &format!("seed {index}")),
        }
    }

    /// The seeds in words.
    pub fn describe(self) -> String {
        match self {
            Seeds::Literal { first, count: 1 } => format!("seed {first}"),
            Seeds::Literal { first, count } => format!("seeds {first} to {}", first + (count - 1)),
            Seeds::Hashed { seed, count } => format!(
                "{count} seed{} hashed from {seed}, others under each condition: the column `seed` holds them",
                if count == 1 { "" } else { "s" }
            ),
        }
    }

    /// What is wrong with its numbers: the field in `seeds`, and the problem.
    pub(super) fn fault(self) -> Option<(&'static str, String)> {
        let count = self.count();
        if !(1..=MOST).contains(&count) {
            let problem = format!("must be from 1 to {MOST}, got {count}");
            return Some(("count", problem));
        }
        match self {
            Seeds::Literal { first, .. } if first.checked_add(count - 1).is_none() => {
                let most = u64::MAX - (count - 1);
                let problem = format!("of {count} seeds must be from 0 to {most}, got {first}");
                Some(("first", problem))
            }
            _ => None,
        }
    }
}

/// Puts the bare number that [`number_or_form`] reads into the schema of the forms.
fn or_number(forms: &mut Schema) {
    if let Some(Value::Array(forms)) = forms.get_mut("oneOf") {
        let what = "`20` is seeds 1 to 20.";
        forms.insert(0, json!({ "type": "integer", "minimum": 1, "maximum": MOST, "description": what }));
    }
}

const FORMS: &str = "must be a number (`20`: seeds 1 to 20), `Literal(first: 101, count: 20)` (101 to 120) or \
    `Hashed(seed: 1, count: 20)`, all of whole numbers";

/// Reads seeds: a number, or one of the forms.
pub(super) fn number_or_form<'de, D: Deserializer<'de>>(from: D) -> Result<Seeds, D::Error> {
    let raw = Box::<RawValue>::deserialize(from)?;
    let text = raw.trim().get_ron();
    if let Ok(count) = ron::from_str::<u64>(text) {
        return Ok(Seeds::Literal { first: 1, count });
    }
    let number = text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    ron::from_str::<Seeds>(text).map_err(|e| match number {
        true => D::Error::custom(format!("{FORMS}, got {text}")),
        false => D::Error::custom(format!("{FORMS}: {}", e.code)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literal_seeds_are_consecutive_and_the_same_under_each_condition() {
        let seeds = Seeds::Literal { first: 101, count: 3 };
        for condition in [0, 7] {
            assert_eq!([0, 1, 2].map(|k| seeds.seed(condition, k)), [101, 102, 103]);
        }
    }

    #[test]
    fn numbers_out_of_range_are_named_with_their_range() {
        let (last, hashed) = (u64::MAX, |count| Seeds::Hashed { seed: 1, count });
        for fine in [Seeds::Literal { first: last, count: 1 }, Seeds::Literal { first: 0, count: MOST }] {
            assert_eq!(fine.fault(), None);
        }
        for (seeds, field, range) in [
            (Seeds::Literal { first: last, count: 2 }, "first", "from 0 to 18446744073709551614"),
            (hashed(0), "count", "from 1 to 1099511627776"),
            (hashed(MOST + 1), "count", "from 1 to 1099511627776"),
        ] {
            let said = seeds.fault().unwrap();
            assert!(said.0 == field && said.1.contains(range), "{said:?}");
        }
    }
}
