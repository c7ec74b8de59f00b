//! Bodies that move; the only place that touches urdf-rs.

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
mod motion;
mod spec;
mod torpedo;
mod urdf;
mod urdf_form;
mod urdf_mass;
mod urdf_parts;
#[cfg(test)]
mod urdf_tests;
mod vehicle;

pub use description::{Description, Mount};
pub use drives::{BuoyancyEngineSpec, CurveSpec, DriveSpec, FinSpec, MovingMassSpec, ThrusterSpec};
pub use energy::{Battery, EnergySpec};
pub use files::{Files, InMemory};
pub use folder::{Axes, Block, HydrodynamicsSpec, Row, Rows, SHIPPED, ShippedVehicle, TermsSpec, VehicleFile};
pub use gantry::{CRAB_GANTRY, CrabGantrySpec, Gantry, GantrySpec};
pub use kinematic_spec::{KinematicSpec, Moves, RadiusSpec, RateSpec, TurnSpec};
pub use looks::{DrivenJoint, Form, JointKind, LinkLook, Look};
pub use motion::{Inertia, Motion, Statics, VehicleDrive, WaterInput};
pub use spec::{CATALOGUE, ParameterSet, RemusSpec, VehicleSpec};
pub use torpedo::{Coefficients, Inflow, TorpedoFinsSpec, TorpedoHullSpec, TorpedoPropellerSpec};
pub use vehicle::Vehicle;
