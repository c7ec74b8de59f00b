//! Planners: from where the vehicle is to where it wants to be, round what it knows to be solid. One file each.

mod a_star;
mod beam;
mod catalogue;
mod clearance;
mod ends;
mod follow;
mod paper_cost;
mod planner;
mod potential_field;
mod room;
mod search;
mod smooth;
#[cfg(test)]
pub(crate) mod testing;

pub use a_star::{AStar, Cost, Params as AStarParams};
pub use catalogue::{PlannerParams, PlannerSpec, Planners};
pub use follow::Follow;
pub use planner::{From, NoPath, Path, Planner, Reach};
pub use potential_field::{Params as PotentialFieldParams, PotentialField};
pub use room::Room;
