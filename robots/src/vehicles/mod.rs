//! Bodies that move; the only place that touches urdf-rs.

mod craft;
mod description;
mod drives;
mod dynamics;
mod energy;
mod extensions;
mod files;
mod folder;
mod gantry;
mod kinematic;
mod kinematic_spec;
mod looks;
mod mesh;
mod remus100;
mod spec;
mod top_speed;
mod urdf;
mod urdf_form;
mod urdf_mass;
mod urdf_parts;
#[cfg(test)]
mod urdf_tests;
mod vehicle;

pub use craft::Vehicle;
pub use description::{Description, Mount};
pub use drives::{BuoyancyEngineSpec, CurveSpec, DriveSpec, FinSpec, MovingMassSpec, ThrusterSpec};
pub use energy::{Battery, EnergySpec};
pub use files::{Files, InMemory};
pub use folder::{Axes, Block, FolderVehicle, HydrodynamicsSpec, Row, Rows, SHIPPED, ShippedVehicle, VehicleFile};
pub use gantry::{CRAB_GANTRY, CrabGantrySpec, Gantry, GantrySpec};
pub use kinematic::Kinematic;
pub use kinematic_spec::{KinematicSpec, Moves, RadiusSpec, RateSpec, TurnSpec};
pub use looks::{DrivenJoint, Form, JointKind, LinkLook, Look};
pub use remus100::{Actuators, Coefficients, Inflow, ParameterSet};
pub use spec::{CATALOGUE, RemusSpec, VehicleSpec};
pub use vehicle::Remus100;
