//! What every way to move has in common: hulls with blocks of damping and drives, hulls with terms of their own, and
//! vehicles without dynamics.

use super::dynamics::Equation;
use super::torpedo::Coefficients;
use crate::handoff::{Actuation, Capabilities, Control, DriveEffect, NamedDrive};
use dyn_clone::DynClone;
use nalgebra::{Matrix6, Vector3};
use std::fmt::Debug;
use world::fields::WaterSample;
use world::frames::Truth;

/// How a vehicle moves, with the state of its drives; pose and velocity belong to the physics.
pub trait Motion: DynClone + Debug + Send + Sync {
    /// What its autopilot knows of it.
    fn control(&self) -> Control;

    /// What it can do; `turn_radius_m` is that under the guidance, for those who know none of their own.
    fn capabilities(&self, turn_radius_m: f64) -> Capabilities;

    /// Greatest speed with the propeller at `rpm`, or at its own limit, m/s: through still water, or over ground if
    /// the water does not carry it.
    fn top_speed_m_s(&self, rpm: f64) -> f64;

    /// Set-points at which nothing moves it.
    fn idle(&self) -> Actuation;

    /// Its drives, in the order of their set-points; none of a kinematic vehicle, which moves as its helm asks.
    fn drives(&self) -> Vec<VehicleDrive> {
        Vec::new()
    }

    /// Its drives that can fail.
    fn named_drives(&self) -> Vec<NamedDrive> {
        self.drives().into_iter().map(|drive| drive.named).collect()
    }

    /// Present state of each drive: thrusters' inputs, rpm, angles (rad), volumes (m³), places (m).
    fn states(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Electric power of its drives now, W.
    fn power_w(&self) -> f64 {
        0.0
    }

    /// What it feels of the water.
    fn feels(&self) -> WaterInput {
        WaterInput::Sample
    }

    /// Whether the water carries it.
    fn is_carried(&self) -> bool {
        self.feels() != WaterInput::Nothing
    }

    /// Mass for the physics.
    fn inertia(&self) -> Inertia;

    /// Weight, buoyancy and mass; `None` of a kinematic vehicle.
    fn statics(&self) -> Option<Statics> {
        None
    }

    /// The numbers of a torpedo-shaped hull with terms of its own.
    fn coefficients(&self) -> Option<&Coefficients> {
        None
    }

    /// Whether steps can be cut finely enough for its motion at rest and up to a speed through the water, m/s.
    ///
    /// # Errors
    /// Why not: whoever takes such steps gets numbers that are none.
    fn follows(&self, _step_s: f64, _speed_m_s: f64) -> Result<(), String> {
        Ok(())
    }

    /// The state after `dt_s` in water that is known, if the vehicle touches nothing; also moves the drives.
    ///
    /// # Panics
    /// If the set-points are those of a vehicle of another kind.
    fn step_in(&mut self, truth: &Truth, water: &WaterSample, set: &Actuation, dt_s: f64) -> Truth;
}

dyn_clone::clone_trait_object!(Motion);

/// Refuses set-points of another kind.
pub(super) fn foreign(set: &Actuation) -> ! {
    panic!("a vehicle was given {set:?}; build its pilot with what the vehicle tells")
}

/// What a vehicle feels of the water: what it does not feel need not be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WaterInput {
    /// Velocity with its slopes, and density.
    Sample,
    /// Its velocity alone.
    Velocity,
    /// Nothing: it moves over ground.
    Nothing,
}

/// Mass of a vehicle for the physics, FLU.
#[derive(Clone, Debug, PartialEq)]
pub struct Inertia {
    /// Centre of gravity, m.
    pub p_BG: Vector3<f64>,
    /// Mass with the water that moves along.
    pub mass: Matrix6<f64>,
    /// Whether contacts only stop it.
    pub without_momentum: bool,
}

/// A drive on a vehicle, FLU.
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleDrive {
    /// Its name, that of its link, and its unit.
    pub named: NamedDrive,
    /// Least and greatest set-point.
    pub limits: [f64; 2],
    /// Direction in which it acts for a positive set-point: a moving mass along its way, a buoyancy engine upwards.
    pub way: Vector3<f64>,
    /// What it does.
    pub does: DriveEffect,
}

/// Weight, buoyancy and mass of a hull, FLU.
#[derive(Clone, Debug, PartialEq)]
pub struct Statics {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Mass with the water that moves along.
    pub whole_mass: Matrix6<f64>,
    /// Volume, m³.
    pub volume_m3: f64,
    /// Centres of gravity and of buoyancy, m.
    pub centres: [Vector3<f64>; 2],
    /// Weight less buoyancy in the water of its file, N.
    pub heavy_n: f64,
    /// Moment at 1 rad of roll or pitch, N m: weight times the distance of the centre of gravity below that of buoyancy.
    pub righting_n_m: f64,
}

impl Statics {
    /// Those of a hull in water of a density. What floats carries itself at its draught.
    pub(super) fn new(equation: &Equation, density_kg_m3: f64, floats: bool) -> Self {
        let body = &equation.body;
        let weight = body.mass.kg * body.gravity_m_s2;
        let buoyancy = density_kg_m3 * body.volume_m3 * body.gravity_m_s2;
        Self {
            mass_kg: body.mass.kg,
            whole_mass: equation.whole_mass_flu(),
            volume_m3: body.volume_m3,
            centres: [body.mass.r_G, body.r_B].map(|r| Vector3::new(r.x, -r.y, -r.z)),
            heavy_n: if floats { 0.0 } else { weight - buoyancy },
            righting_n_m: (body.mass.r_G.z * weight - body.r_B.z * buoyancy).max(0.0),
        }
    }
}
