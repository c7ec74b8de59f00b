//! The planners by name.

use super::{Planner, a_star, potential_field};
use crate::error::RobotError;
use crate::handoff::BeliefGrid;
use world::cost::Cost;
use world::kind;
use world::registry::Spec;

/// Parameters of a planner.
pub trait PlannerParams: Spec {
    /// Builds the planner.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if a parameter makes no sense.
    fn build(&self) -> Result<Box<dyn Planner>, RobotError>;

    /// Checks that it fits the room in which it will plan.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if its steps are too small for the room's cells.
    fn check(&self, _cells: &BeliefGrid, _plane: bool) -> Result<(), RobotError> {
        Ok(())
    }

    /// Whether it plans in the plane only.
    fn plane_only(&self) -> bool {
        false
    }

    /// Clearance beyond the hull's own up to which it distinguishes cells, m, and the field that sets it.
    fn reach(&self) -> (&'static str, f64);

    /// Its cost besides the room, for so many plans over a way of a length, m; paths below `planner`.
    fn cost(&self, _way_m: f64, _plans: f64) -> Cost {
        Cost::default()
    }
}

kind! {
    /// Planners, which turn the map of the source and the charted obstacles into a path for the vehicle.
    pub PlannerSpec = Planners of PlannerParams {
        heading: "Planners",
        rows: [a_star::Params, potential_field::Params],
        standard: a_star::Params,
    }
}
