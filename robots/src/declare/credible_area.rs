//! Declares when the source is believed to lie within a small enough area.
//!
//! *Source*: highest-density credible regions, Box & Tiao 1973, Bayesian Inference in Statistical Analysis, section
//! 2.8.
//!
//! *Parameters*: greatest size of the smallest set of cells with 95 % of the probability, `below`: m² in a map of the
//! plane, m³ in a map of space, 50 (five of the cells of Wang & Pang); how long it must have been so small, `for_s`,
//! s, 5.
//!
//! *Deviations*: none of the papers has this rule.

use super::held::HeldCondition;
use super::rule::{BeliefRule, BeliefRuleParams};
use crate::handoff::Belief;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// The rule's parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "CredibleAreaParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Greatest size of the 95 % region, m² (m³ in a map of space).
    #[default(Positive::new(50.0))]
    pub below: Positive,
    /// How long it must have been so, s.
    #[default(NonNegative::new(5.0))]
    pub for_s: NonNegative,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "CredibleArea",
        what: "the likeliest cell of the map, when 95 % of the probability lie in a small enough area",
        source: "Box & Tiao 1973, section 2.8",
    };
}

impl BeliefRuleParams for Params {
    fn build(&self) -> Box<dyn BeliefRule> {
        Box::new(CredibleArea::new(self))
    }
}

/// State of the rule.
#[derive(Clone, Debug)]
pub struct CredibleArea {
    params: Params,
    held: HeldCondition,
}

impl CredibleArea {
    /// The rule before its first tick.
    pub fn new(params: &Params) -> Self {
        Self { params: params.clone(), held: HeldCondition::default() }
    }
}

impl BeliefRule for CredibleArea {
    /// The source's place (ENU, m), if the map shows it at `t_s`: the likeliest cell. A mean over the cells near it
    /// could mix separate peaks.
    fn step(&mut self, t_s: f64, belief: &Belief) -> Option<Vector3<f64>> {
        let small = belief.informed && belief.credible_95 <= self.params.below.get();
        let declared = self.held.for_s(small, t_s, self.params.for_s.get());
        declared.then(|| belief.grid.centre(belief.best))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::testing::belief;

    #[test]
    fn small_for_long_enough() {
        let mut rule = CredibleArea::new(&Params::default());
        assert_eq!(rule.step(0.0, &belief(4, false, 10.0)), None);
        assert_eq!(rule.step(1.0, &belief(4, true, 50.1)), None);
        assert_eq!(rule.step(2.0, &belief(4, true, 50.0)), None);
        assert_eq!(rule.step(6.0, &belief(4, true, 60.0)), None);
        assert_eq!(rule.step(7.0, &belief(5, true, 40.0)), None);
        let b = belief(3, true, 30.0);
        assert_eq!(rule.step(12.0, &b), Some(b.grid.centre(3)));
    }
}
