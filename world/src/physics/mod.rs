//! Rigid bodies and contacts, the only place that touches rapier3d.

mod convert;
mod ground;
mod shape;
mod solid;
#[cfg(test)]
mod solid_tests;

pub use shape::Shape;
pub use solid::{BodyId, BodySpec, ContactReport, Physics, Solver};
