//! The planners by name.

use super::planner::PlannerParams;
use super::{a_star, potential_field};
use world::kind;

kind! {
    /// Planners, which turn the map of the source and the charted obstacles into a path for the vehicle.
    pub PlannerSpec = Planners of PlannerParams {
        heading: "Planners",
        rows: [a_star::Params, potential_field::Params],
        standard: a_star::Params,
    }
}
