//! Rigid bodies and contacts. Only this module uses rapier3d.

mod course;
mod gantry;
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

pub use gantry::{AxisDrive, AxisSpec, GantryBodySpec, GantryId, JointState};
pub use gantry_report::{GantryContact, Solid};
pub use ground::Bed;
pub use shape::{Inside, Shape};
pub use solid::{BodyId, BodySpec, ContactReport, Physics, Solver};
