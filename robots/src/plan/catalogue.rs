//! The planners by name.

use super::{AStar, Planner, PotentialField};
use super::{a_star, potential_field};
use crate::error::RobotError;
use crate::handoff::BeliefGrid;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;

/// The planners a scenario can ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum PlannerSpec {
    /// Cheapest way over the cells.
    AStar(a_star::Params),
    /// Downhill in an artificial potential.
    PotentialField(potential_field::Params),
}

impl Default for PlannerSpec {
    fn default() -> Self {
        Self::AStar(a_star::Params::default())
    }
}

impl PlannerSpec {
    /// The planner.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] when a parameter makes no sense.
    pub fn build(&self) -> Result<Box<dyn Planner>, RobotError> {
        Ok(match self {
            PlannerSpec::AStar(p) => Box::new(AStar::new(p)?),
            PlannerSpec::PotentialField(p) => Box::new(PotentialField::new(p)?),
        })
    }

    /// That it fits the room that it shall plan in.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] when its steps are too small for the room's cells.
    pub fn check(&self, cells: &BeliefGrid, plane: bool) -> Result<(), RobotError> {
        match self {
            PlannerSpec::AStar(_) => Ok(()),
            PlannerSpec::PotentialField(p) => p.fits(cells, plane),
        }
    }

    /// It plans in the plane only.
    #[must_use]
    pub fn plane_only(&self) -> bool {
        matches!(self, PlannerSpec::AStar(p) if p.cost == a_star::Cost::Paper)
    }

    /// Clearance beyond the hull's own that it tells apart, m.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        match self {
            PlannerSpec::AStar(p) => AStar::reach_m(p),
            PlannerSpec::PotentialField(p) => PotentialField::reach_m(p),
        }
    }
}

/// Planners.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "AStar",
        what: "cheapest way by length and clearance, smoothed to the turning circle; the paper's costs on request",
        source: "Wang & Pang, section II-D, eq. 7-9; Hart, Nilsson & Raphael 1968",
    },
    Entry {
        name: "PotentialField",
        what: "downhill between the goal's pull and the solids' push; caught in local minima",
        source: "Khatib 1986; Pang & Zhu 2009 (reconstructed)",
    },
];
