//! Declares when the likeliest cell of the map has stayed the same for a while.
//!
//! *Source*: Wang & Pang, section II-D: "the estimated source location ... does not change over 30 seconds".
//!
//! *Parameters*: `for_s`, s, 30.
//!
//! *Deviations*: time counts from the first detection on. Before it the map knows nothing and would not change.

use super::rule::{BeliefRule, BeliefRuleParams};
use crate::handoff::Belief;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;

/// The rule's parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "UnchangedParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// The likeliest cell must have stayed the same for this long, s.
    #[default(Positive::new(30.0))]
    pub for_s: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Unchanged",
        what: "the likeliest cell of the map, when it has been the same for 30 s",
        source: "Wang & Pang, section II-D",
    };
}

impl BeliefRuleParams for Params {
    fn build(&self) -> Box<dyn BeliefRule> {
        Box::new(Unchanged::new(self))
    }
}

/// State of the rule.
#[derive(Clone, Debug)]
pub struct Unchanged {
    for_s: f64,
    since: Option<(usize, f64)>,
}

impl Unchanged {
    /// The rule before its first tick.
    pub fn new(params: &Params) -> Self {
        Self { for_s: params.for_s.get(), since: None }
    }
}

impl BeliefRule for Unchanged {
    /// The source's place (ENU, m), if the map shows it at `t_s`.
    fn step(&mut self, t_s: f64, belief: &Belief) -> Option<Vector3<f64>> {
        if !belief.informed {
            self.since = None;
            return None;
        }
        match self.since {
            Some((cell, since_s)) if cell == belief.best => {
                (t_s - since_s >= self.for_s).then(|| belief.grid.centre(cell))
            }
            _ => {
                self.since = Some((belief.best, t_s));
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::testing::belief;

    #[test]
    fn thirty_seconds_of_the_same_cell() {
        let mut rule = Unchanged::new(&Params::default());
        assert_eq!(rule.step(0.0, &belief(4, false, 10.0)), None);
        assert_eq!(rule.step(100.0, &belief(4, true, 10.0)), None);
        assert_eq!(rule.step(129.9, &belief(4, true, 10.0)), None);
        // Another cell for a moment restarts the count.
        assert_eq!(rule.step(129.95, &belief(3, true, 10.0)), None);
        assert_eq!(rule.step(130.0, &belief(4, true, 10.0)), None);
        assert_eq!(rule.step(159.9, &belief(4, true, 10.0)), None);
        let b = belief(4, true, 10.0);
        assert_eq!(rule.step(160.0, &b), Some(b.grid.centre(4)));
    }
}
