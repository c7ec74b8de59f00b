//! The declaration rules by name.

use super::along_flow::AlongFlow;
use super::credible_area::{self, CredibleArea};
use super::unchanged::{self, Unchanged};
use crate::handoff::Belief;
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::units::Heading;

/// The rules a scenario can ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum DeclareSpec {
    /// The most up-flow lost points lie close together along the flow.
    AlongFlow(AlongFlow),
}

impl Default for DeclareSpec {
    fn default() -> Self {
        Self::AlongFlow(AlongFlow::default())
    }
}

impl DeclareSpec {
    /// The source's place (east, north), m, if the lost points say so.
    #[must_use]
    pub fn declare(&self, points: &[Vector2<f64>], up_flow: Heading) -> Option<Vector2<f64>> {
        match self {
            DeclareSpec::AlongFlow(rule) => rule.declare(points, up_flow),
        }
    }

    /// Name of the rule, as in the catalogue.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            DeclareSpec::AlongFlow(_) => "AlongFlow",
        }
    }
}

/// The rules on a map of the source that a scenario can ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum BeliefRuleSpec {
    /// The likeliest cell has stayed the same.
    Unchanged(unchanged::Params),
    /// The 95 % region is small.
    CredibleArea(credible_area::Params),
}

impl Default for BeliefRuleSpec {
    fn default() -> Self {
        Self::Unchanged(unchanged::Params::default())
    }
}

/// A rule on a map with its state.
#[derive(Clone, Debug)]
pub enum BeliefRule {
    /// See `unchanged.rs`.
    Unchanged(Unchanged),
    /// See `credible_area.rs`.
    CredibleArea(CredibleArea),
}

impl BeliefRule {
    /// The rule of a scenario.
    #[must_use]
    pub fn new(spec: &BeliefRuleSpec) -> Self {
        match spec {
            BeliefRuleSpec::Unchanged(p) => Self::Unchanged(Unchanged::new(p)),
            BeliefRuleSpec::CredibleArea(p) => Self::CredibleArea(CredibleArea::new(p)),
        }
    }

    /// The source's place (ENU, m), if the map says so at `t_s`.
    pub fn step(&mut self, t_s: f64, belief: &Belief) -> Option<Vector3<f64>> {
        match self {
            Self::Unchanged(rule) => rule.step(t_s, belief),
            Self::CredibleArea(rule) => rule.step(t_s, belief),
        }
    }

    /// Name of the rule, as in the catalogue.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Unchanged(_) => "Unchanged",
            Self::CredibleArea(_) => "CredibleArea",
        }
    }
}

/// Declaration rules.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "AlongFlow",
        what: "the most up-flow lost point, when the first three differ by under 4 m along the flow",
        source: "Pang 2009, section 5.6",
    },
    Entry {
        name: "Unchanged",
        what: "the likeliest cell of the map, when it has been the same for 30 s",
        source: "Wang & Pang, section II-D",
    },
    Entry {
        name: "CredibleArea",
        what: "the likeliest cell of the map, when 95 % of the probability lie in a small enough area",
        source: "Box & Tiao 1973, section 2.8",
    },
];
