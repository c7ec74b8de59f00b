//! Bodies that move; the only place that touches urdf-rs.

mod actuators;
mod coefficients;
mod craft;
mod files;
mod gantry;
mod hydrodynamics;
#[cfg(test)]
mod hydrodynamics_tests;
mod kinematic;
mod kinematic_spec;
mod mesh;
mod motion;
mod remus;
mod spec;
mod surface;
mod top_speed;
mod urdf;
mod urdf_mass;
mod urdf_parts;
#[cfg(test)]
mod urdf_tests;
mod vehicle;

pub use coefficients::{Coefficients, Inflow, ParameterSet};
pub use craft::Craft;
pub use files::{Files, InMemory};
pub use gantry::{CrabGantrySpec, Gantry, GantrySpec};
pub use hydrodynamics::Actuators;
pub use kinematic::Kinematic;
pub use kinematic_spec::{KinematicSpec, Moves, RadiusSpec, RateSpec, TurnSpec};
pub use spec::{CATALOGUE, RemusSpec, VehicleSpec};
pub use vehicle::Vehicle;
