//! A REMUS in its water.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use robots::handoff::ActuatorCommand;
use robots::vehicles::{InMemory, ParameterSet, RemusSpec, Vehicle, VehicleSpec};
use world::fields::WaterSample;
use world::frames::Truth;

/// The usual step, s.
pub(super) const STEP_S: f64 = 0.02;

/// The vehicle that is built in, with these parameters.
pub(super) fn remus(parameters: ParameterSet) -> Vehicle {
    let spec = VehicleSpec::Remus100(RemusSpec { parameters, ..RemusSpec::default() });
    Vehicle::load(&spec, &InMemory::default()).expect("built-in vehicle")
}

/// Even water that moves.
pub(super) fn water(velocity: Vector3<f64>) -> WaterSample {
    WaterSample { velocity, gradient: Matrix3::zeros(), rate: Vector3::zeros(), density_kg_m3: 1026.0 }
}

pub(super) fn command(rudder_deg: f64, stern_deg: f64, rpm: f64) -> ActuatorCommand {
    ActuatorCommand { rudder_rad: rudder_deg.to_radians(), stern_rad: stern_deg.to_radians(), rpm }
}

/// FLU and FRD, either way.
pub(super) fn flip(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

pub(super) fn join(a: Vector3<f64>, b: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

/// Its velocities, FRD.
pub(super) fn nu(t: &Truth) -> Vector6<f64> {
    join(flip(t.v_WB_B), flip(t.w_WB_B))
}

/// Its mass with the water's.
pub(super) fn mass(vehicle: &Vehicle) -> Matrix6<f64> {
    let c = vehicle.coefficients().expect("terms of its own");
    c.rigid_mass() + c.added_mass()
}

/// Kinetic energy with the water's, and that of the low centre of gravity, J.
pub(super) fn energy(vehicle: &Vehicle, t: &Truth) -> f64 {
    let c = vehicle.coefficients().expect("terms of its own");
    let upright = (t.pose.R_WB * Vector3::z()).z;
    0.5 * nu(t).dot(&(mass(vehicle) * nu(t))) + c.mass_kg * 9.81 * c.z_g_m * (1.0 - upright)
}
