//! Rigid bodies and contacts. Only this module uses rapier3d.

mod body;
mod course;
mod gantry;
mod gantry_body;
mod gantry_meet;
mod gantry_report;
#[cfg(test)]
mod gantry_tests;
mod gaps;
mod ground;
mod impulses;
mod meet;
#[cfg(test)]
mod meet_tests;
mod shape;
mod solid;
#[cfg(test)]
mod solid_tests;
#[cfg(test)]
mod testing;

pub use body::{BodyId, BodySpec, ContactReport};
pub use gantry_body::{AxisDrive, AxisSpec, GantryBodySpec, GantryContact, GantryId, JointState, Solid};
pub use ground::Bed;
pub use shape::{Inside, Shape};
pub use solid::{Physics, Solver};
