//! Drives of a vehicle described by a folder: thrusters, fins, buoyancy engines, moving masses.
//!
//! Each sits on a link of the URDF, has one number as its set-point and its state, and gives a force and a moment.

mod curve;
mod drive;
mod fin;
mod spec;
mod thruster;

pub(in crate::vehicles) use curve::table;
pub(in crate::vehicles) use drive::{Drive, Follows, Kind};
pub(in crate::vehicles) use fin::Fin;
pub use spec::{BuoyancyEngineSpec, CurveSpec, DriveSpec, FinSpec, MovingMassSpec, ThrusterSpec};
pub(in crate::vehicles) use thruster::Thruster;
