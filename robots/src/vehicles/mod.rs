//! Bodies that move; the only place that touches urdf-rs.

mod actuators;
mod coefficients;
mod files;
mod gantry;
mod hydrodynamics;
#[cfg(test)]
mod hydrodynamics_tests;
mod mesh;
mod motion;
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
pub use files::{Files, InMemory};
pub use gantry::{CrabGantrySpec, Gantry, GantrySpec};
pub use hydrodynamics::Actuators;
pub use spec::{CATALOGUE, RemusSpec, VehicleSpec};
pub use vehicle::Vehicle;
