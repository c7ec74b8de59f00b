//! From what a value of a scenario is drawn: in conditions and arms of a campaign, and anew for each seed of a row.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::math;

/// The distribution of a value, in the unit of the field that varies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Distribution {
    /// Uniform between two numbers.
    Uniform(f64, f64),
    /// Its logarithm is uniform between the logarithms of two positive numbers.
    LogUniform(f64, f64),
    /// One of these values, all equally likely.
    Choice(Vec<String>),
}

impl Distribution {
    /// The value at `u` in [0, 1), in RON; numbers as `shown` writes them.
    pub(crate) fn value(&self, u: f64, shown: impl Fn(f64) -> String) -> String {
        match self {
            Self::Uniform(a, b) => shown(a + (b - a) * u),
            Self::LogUniform(a, b) => {
                let (a, b) = (math::ln(*a), math::ln(*b));
                shown(math::exp(a + (b - a) * u))
            }
            Self::Choice(values) => values[((u * values.len() as f64) as usize).min(values.len() - 1)].clone(),
        }
    }

    /// What is wrong with it, if anything.
    pub(crate) fn fault(&self) -> Option<String> {
        match self {
            Self::Uniform(a, b) if !(a.is_finite() && b.is_finite() && a < b) => {
                Some(format!("needs two finite numbers, the smaller first, got {a}, {b}"))
            }
            Self::LogUniform(a, b) if !(*a > 0.0 && b.is_finite() && a < b) => {
                Some(format!("needs two positive numbers, the smaller first, got {a}, {b}"))
            }
            Self::Choice(values) if values.is_empty() => Some("there must be at least one value".to_string()),
            _ => None,
        }
    }

    /// Numbers from 0 to 1 that together meet all that it can be: its ends, or all its values.
    pub(crate) fn extremes(&self) -> Vec<f64> {
        match self {
            Self::Uniform(..) | Self::LogUniform(..) => vec![0.0, 1.0],
            Self::Choice(all) => {
                let n = all.len() as f64;
                (0..all.len()).map(|k| (k as f64 + 0.5) / n).collect()
            }
        }
    }
}
