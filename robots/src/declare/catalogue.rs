//! The declaration rules by name.

use super::along_flow::AlongFlow;
use super::credible_area::{self, CredibleArea};
use super::siz_f::SizF;
use super::siz_t::SizT;
use super::unchanged::{self, Unchanged};
use crate::error::RobotError;
use crate::handoff::{Belief, Declaration, Evidence, PlumeMemory};
use nalgebra::{Vector2, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;
use world::catalogue::Entry;
use world::units::Heading;

/// The rules a scenario can ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum DeclareSpec {
    /// The most up-flow lost points lie close together along the flow.
    AlongFlow(AlongFlow),
    /// The newest last detection points lie close together.
    SizT(SizT),
    /// Enough of all last detection points lie close together.
    SizF(SizF),
}

impl Default for DeclareSpec {
    fn default() -> Self {
        Self::AlongFlow(AlongFlow::default())
    }
}

impl DeclareSpec {
    /// The source's place (east, north), m, if the places where the plume was lost say so: the short list for
    /// `AlongFlow`, all last detection points for the others.
    #[must_use]
    pub fn declare(&self, memory: &PlumeMemory, up_flow: Heading) -> Option<Vector2<f64>> {
        self.identify(memory, up_flow).map(|(place, _)| place)
    }

    /// The same as a declaration made at `t_s`, with the points it rests on.
    #[must_use]
    pub fn declaration(
        &self,
        t_s: f64,
        memory: &PlumeMemory,
        up_flow: Heading,
    ) -> Option<Declaration> {
        let (place, evidence) = self.identify(memory, up_flow)?;
        Some(Declaration {
            evidence: Some(evidence),
            ..Declaration::first(t_s, place, self.name())
        })
    }

    fn identify(&self, memory: &PlumeMemory, up_flow: Heading) -> Option<(Vector2<f64>, Evidence)> {
        let fix_m = memory.fixes.scale_m();
        match self {
            DeclareSpec::AlongFlow(rule) => rule.declare(memory.lost.all(), up_flow),
            DeclareSpec::SizT(rule) => rule.declare(memory.lcdps.all(), up_flow, fix_m),
            DeclareSpec::SizF(rule) => rule.declare(memory.lcdps.all(), up_flow, fix_m),
        }
    }

    /// Whether the parameters make sense, of a searcher that remembers so many lost points and last detection points.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] when bounds contradict each other, or more points are asked for than are remembered.
    pub fn check(&self, lost_points: NonZeroUsize, lcdps: NonZeroUsize) -> Result<(), RobotError> {
        let (points, most, list) = match self {
            DeclareSpec::AlongFlow(rule) => (rule.points, lost_points, "lost_points"),
            DeclareSpec::SizT(rule) => (rule.points.max(rule.initial), lcdps, "lcdps"),
            DeclareSpec::SizF(rule) => (rule.points.max(rule.initial), lcdps, "lcdps"),
        };
        if points > most {
            return Err(RobotError::Invalid {
                field: format!("declare.{}.points", self.name()),
                problem: format!(
                    "must be at most {list}, {most}, got {points}: it would never declare"
                ),
            });
        }
        match self {
            DeclareSpec::AlongFlow(_) => Ok(()),
            DeclareSpec::SizT(rule) => rule.size.check("declare.SizT.size"),
            DeclareSpec::SizF(rule) => rule.size.check("declare.SizF.size"),
        }
    }

    /// Name of the rule, as in the catalogue.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            DeclareSpec::AlongFlow(_) => "AlongFlow",
            DeclareSpec::SizT(_) => "SizT",
            DeclareSpec::SizF(_) => "SizF",
        }
    }
}

/// The rules on a map of the source that a scenario can ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
        name: "SizT",
        what: "the mean of the six newest last detection points, when they lie within 4 m",
        source: "Tian et al. 2013, section 3, algorithm 1",
    },
    Entry {
        name: "SizF",
        what: "the most up-flow of six or more last detection points within 6 m of their mean, the others left aside",
        source: "Tian et al. 2013, section 3, algorithm 2",
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
