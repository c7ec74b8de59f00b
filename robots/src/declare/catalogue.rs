//! The declaration rules by name.

use super::along_flow::AlongFlow;
use nalgebra::Vector2;
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

/// Declaration rules.
pub const CATALOGUE: &[Entry] = &[Entry {
    name: "AlongFlow",
    what: "the most up-flow lost point, when the first three differ by under 4 m along the flow",
    source: "Pang 2009, section 5.6",
}];
