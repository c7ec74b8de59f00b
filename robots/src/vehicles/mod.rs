//! Bodies that move; the only place that touches urdf-rs.

mod actuators;
mod coefficients;
mod hydrodynamics;
#[cfg(test)]
mod hydrodynamics_tests;
mod mesh;
mod motion;
mod spec;
mod surface;
mod urdf;
#[cfg(test)]
mod urdf_tests;
mod vehicle;

pub use coefficients::{Coefficients, Inflow, ParameterSet};
pub use hydrodynamics::Actuators;
pub use spec::{CATALOGUE, RemusSpec, VehicleSpec};
pub use vehicle::Vehicle;
