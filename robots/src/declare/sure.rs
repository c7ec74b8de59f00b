//! Declares when the map states a high enough probability that the source is within a distance of its likeliest cell.
//!
//! *Source*: stopping when the posterior probability of a hypothesis passes a threshold: Wald 1947, Sequential
//! Analysis, section 3; Berger 1985, Statistical Decision Theory and Bayesian Analysis, section 7.
//!
//! *Parameters*: least probability, `probability`, 0.9; distance from the likeliest cell's centre, `within_m`, m, 5;
//! how long it must have been so, `for_s`, s, 5.
//!
//! *Deviations*: none of the papers has this rule. What it declares is as sure as it says only if the map is: see the
//! maps' `doubt`.

use super::held::HeldCondition;
use super::rule::{BeliefRule, BeliefRuleParams};
use crate::handoff::Belief;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::{Fraction, NonNegative, Positive};
use world::registry::Listed;

/// The rule's parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "SureParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Least probability of a source within the distance.
    #[default(Fraction::new(0.9))]
    pub probability: Fraction,
    /// Horizontal distance from the likeliest cell's centre, m.
    #[default(Positive::new(5.0))]
    pub within_m: Positive,
    /// How long it must have been so, s.
    #[default(NonNegative::new(5.0))]
    pub for_s: NonNegative,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Sure",
        what: "the likeliest cell of the map, when the source is within 5 m of it with probability 0.9",
        source: "Wald 1947, section 3",
    };
}

impl BeliefRuleParams for Params {
    fn build(&self) -> Box<dyn BeliefRule> {
        Box::new(Sure::new(self))
    }
}

/// State of the rule.
#[derive(Clone, Debug)]
pub struct Sure {
    params: Params,
    held: HeldCondition,
    /// The map and the cell of the last look, and what was stated then: a map changes seldom.
    stated: Option<(u64, usize, f64)>,
}

impl Sure {
    /// The rule before its first tick.
    pub fn new(params: &Params) -> Self {
        Self { params: params.clone(), held: HeldCondition::default(), stated: None }
    }

    fn probability(&mut self, belief: &Belief) -> f64 {
        match self.stated {
            Some((updates, best, p)) if (updates, best) == (belief.updates, belief.best) => p,
            _ => {
                let place = belief.grid.centre(belief.best).xy();
                let p = belief.within(place, self.params.within_m.get());
                self.stated = Some((belief.updates, belief.best, p));
                p
            }
        }
    }
}

impl BeliefRule for Sure {
    /// The source's place (ENU, m), if the map shows it at `t_s`: the likeliest cell.
    fn step(&mut self, t_s: f64, belief: &Belief) -> Option<Vector3<f64>> {
        let sure = belief.informed && self.probability(belief) >= self.params.probability.get();
        let declared = self.held.for_s(sure, t_s, self.params.for_s.get());
        declared.then(|| belief.grid.centre(belief.best))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::testing::likely;

    #[test]
    fn sure_for_long_enough() {
        let mut rule = Sure::new(&Params::default());
        let of = |updates: u64, informed: bool, p: f64| Belief { updates, informed, ..likely(4, p) };
        let near = of(1, true, 1.0).within(of(1, true, 1.0).grid.centre(4).xy(), 5.0);
        let enough = 0.91 / near;
        assert!(enough <= 1.0, "the cell is too large for this test: {near}");
        assert_eq!(rule.step(0.0, &of(1, false, enough)), None);
        assert_eq!(rule.step(1.0, &of(2, true, 0.5)), None);
        assert_eq!(rule.step(2.0, &of(3, true, enough)), None);
        assert_eq!(rule.step(6.9, &of(3, true, enough)), None);
        // Unsure for a moment: the count begins anew.
        assert_eq!(rule.step(6.95, &of(4, true, 0.5)), None);
        assert_eq!(rule.step(7.0, &of(5, true, enough)), None);
        let b = of(5, true, enough);
        assert_eq!(rule.step(12.0, &b), Some(b.grid.centre(4)));
    }
}
