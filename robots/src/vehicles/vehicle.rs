//! A vehicle with fins: hull, instruments' places, actuators and its equation of motion.

use super::coefficients::Coefficients;
use super::files::Files;
use super::hydrodynamics::{Actuators, Hydrodynamics};
use super::remus::REMUS100;
use super::spec::RemusSpec;
use super::urdf::{self, Hull};
use super::urdf_parts::UrdfText;
use crate::error::RobotError;
use crate::handoff::ActuatorCommand;
use bevy_ecs::prelude::Component;
use nalgebra::{Matrix6, Vector3, Vector6};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::physics::BodySpec;

/// A vehicle and the state of its actuators; pose and velocity belong to the physics.
#[derive(Component, Clone, Debug)]
pub struct Vehicle {
    hull: Hull,
    dynamics: Hydrodynamics,
    actuators: Actuators,
}

impl Vehicle {
    /// Builds the vehicle that a scenario asks for; `files` gives the URDF and its meshes, if it names one.
    ///
    /// # Errors
    /// If a file cannot be read, or if the URDF is wrong or does not fit the hydrodynamic parameters.
    pub fn load(spec: &RemusSpec, files: &dyn Files) -> Result<Self, RobotError> {
        let coefficients = Coefficients::of(spec.parameters);
        let text = UrdfText::open(spec.urdf.as_deref(), files, REMUS100)?;
        let hull = urdf::read(&text, &coefficients)?;
        Ok(Self {
            dynamics: Hydrodynamics::new(hull.coefficients.clone()),
            hull,
            actuators: Actuators::default(),
        })
    }

    /// The hull's numbers.
    #[must_use]
    pub fn coefficients(&self) -> &Coefficients {
        &self.dynamics.c
    }

    /// Where the URDF's mass differs from that of the hydrodynamic parameters, and what is done about it.
    #[must_use]
    pub fn told(&self) -> &[String] {
        &self.hull.told
    }

    /// Pose of an instrument (a link of the URDF), in body axes.
    #[must_use]
    pub fn mount(&self, name: &str) -> Option<Pose> {
        self.hull.links.get(name).copied()
    }

    /// Present state of fins and propeller.
    #[must_use]
    pub fn actuators(&self) -> Actuators {
        self.actuators
    }

    /// Sets the state of fins and propeller at a start.
    pub fn set_actuators(&mut self, actuators: Actuators) {
        self.actuators = actuators;
    }

    /// The body for the physics.
    #[must_use]
    pub fn body_spec(&self, id: &str, truth: Truth) -> BodySpec {
        let c = &self.dynamics.c;
        // FRD to FLU: a half turn about x.
        let flip = Matrix6::from_diagonal(&Vector6::new(1.0, -1.0, -1.0, 1.0, -1.0, -1.0));
        BodySpec {
            id: id.to_string(),
            truth,
            shapes: self.hull.shapes.clone(),
            p_BG: Vector3::new(0.0, 0.0, -c.z_g_m),
            mass: flip * (c.rigid_mass() + c.added_mass()) * flip,
        }
    }

    /// The state after `dt_s` if the vehicle touches nothing, for `Physics::push`; also moves the actuators.
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
