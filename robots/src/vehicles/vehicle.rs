//! A vehicle: hull, instruments' places, actuators and its equation of motion.

use super::coefficients::Coefficients;
use super::hydrodynamics::{Actuators, Hydrodynamics};
use super::spec::VehicleSpec;
use super::urdf::{self, Hull};
use super::urdf_parts;
use crate::error::RobotError;
use crate::handoff::ActuatorCommand;
use bevy_ecs::prelude::Component;
use nalgebra::{Matrix3, Vector3};
use std::path::Path;
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::physics::BodySpec;

/// The REMUS's URDF as built in.
const REMUS100: &str = include_str!("../../urdf/remus100.urdf");

/// A vehicle and the state of its actuators; pose and velocity belong to the physics.
#[derive(Component, Clone, Debug)]
pub struct Vehicle {
    hull: Hull,
    dynamics: Hydrodynamics,
    actuators: Actuators,
}

impl Vehicle {
    /// Reads what a scenario in `base_dir` asks for.
    pub fn load(spec: &VehicleSpec, base_dir: &Path) -> Result<Self, RobotError> {
        let VehicleSpec::Remus100(remus) = spec;
        let coefficients = Coefficients::of(remus.parameters);
        let built_in = ("remus100.urdf", REMUS100);
        let (text, path) = urdf_parts::open(remus.urdf.as_deref(), base_dir, built_in)?;
        let hull = urdf::read(&text, &path, &coefficients)?;
        Ok(Self {
            hull,
            dynamics: Hydrodynamics::new(coefficients),
            actuators: Actuators::default(),
        })
    }

    /// The hull's numbers.
    #[must_use]
    pub fn coefficients(&self) -> &Coefficients {
        &self.dynamics.c
    }

    /// Where an instrument (a link of the URDF) sits, in body axes.
    #[must_use]
    pub fn mount(&self, name: &str) -> Option<Pose> {
        self.hull.links.get(name).copied()
    }

    /// Fins and propeller as they stand.
    #[must_use]
    pub fn actuators(&self) -> Actuators {
        self.actuators
    }

    /// Sets fins and propeller: a beginning, not a motion.
    pub fn set_actuators(&mut self, actuators: Actuators) {
        self.actuators = actuators;
    }

    /// The body for the physics.
    #[must_use]
    pub fn body_spec(&self, id: &str, truth: Truth) -> BodySpec {
        let c = &self.dynamics.c;
        let a = &c.added;
        BodySpec {
            id: id.to_string(),
            truth,
            shapes: self.hull.shapes.clone(),
            p_BG: Vector3::new(0.0, 0.0, -c.z_g_m),
            mass_kg: c.mass_kg + (a[0] + a[1] + a[2]) / 3.0,
            inertia_kg_m2: Matrix3::from_diagonal(
                &(c.inertia_kg_m2 + Vector3::new(a[3], a[4], a[5])),
            ),
        }
    }

    /// Where the vehicle gets in `dt_s` if it touches nothing, for `Physics::push`; moves the actuators.
    pub fn step(
        &mut self,
        truth: &Truth,
        water: &WaterSample,
        command: &ActuatorCommand,
        dt_s: f64,
    ) -> Truth {
        let asked = Actuators::asked(command, &self.dynamics.c);
        let (free, actuators) = self
            .dynamics
            .advance(truth, &self.actuators, &asked, water, dt_s);
        self.actuators = actuators;
        free
    }
}
