//! Planners: from the vehicle's place to a destination, around what the vehicle knows to be solid. One file each.

mod a_star;
mod beam;
mod buckets;
mod catalogue;
mod clearance;
mod ends;
mod follow;
mod free_space;
mod neighbours;
mod octile;
mod paper_cost;
mod planner;
mod potential_field;
mod revision;
mod search;
mod smooth;
#[cfg(test)]
pub(crate) mod testing;

pub use a_star::{AStar, Cost, Params as AStarParams};
pub use catalogue::{PlannerSpec, Planners};
pub use follow::Follow;
pub use free_space::FreeSpace;
pub use planner::{NoPath, Path, PathStart, Planner, PlannerParams, Reach};
pub use potential_field::{Params as PotentialFieldParams, PotentialField};
pub use revision::Revision;
