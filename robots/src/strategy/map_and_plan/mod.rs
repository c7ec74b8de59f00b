//! Map and plan: a source map, a planner that leads to its likeliest cell, a rule that declares.

mod cost;
mod evade;
mod machine;
mod pilot;
mod spec;
#[cfg(test)]
mod tests;

pub use machine::MapAndPlan;
pub use spec::{AtTarget, CrossSpec, MapAndPlanSpec, PlaneSpec, RoomSpec, SpaceSpec};
