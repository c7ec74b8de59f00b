//! A vehicle with fins: hull, instruments' places, actuators and its equation of motion.

use super::dynamics::Equation;
use super::energy::REMUS_SHARE;
use super::files::Files;
use super::remus100::{Actuators, Coefficients, REMUS100, RemusTerms};
use super::spec::RemusSpec;
use super::urdf::{self, Hull};
use super::urdf_parts::UrdfText;
use crate::error::RobotError;
use crate::handoff::ActuatorCommand;
use bevy_ecs::prelude::Component;
use nalgebra::Vector3;
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::physics::BodySpec;

/// A vehicle and the state of its actuators; pose and velocity belong to the physics.
#[derive(Component, Clone, Debug)]
pub struct Remus100 {
    hull: Hull,
    equation: Equation,
    actuators: Actuators,
    /// State, velocity (ENU) and density of the water at the beginning of the last step.
    last: Option<(Truth, Vector3<f64>, f64)>,
}

impl Remus100 {
    /// Builds the vehicle that a scenario asks for; `files` gives the URDF and its meshes, if it names one.
    ///
    /// # Errors
    /// If a file cannot be read, or if the URDF is wrong or does not fit the hydrodynamic parameters.
    pub fn load(spec: &RemusSpec, files: &dyn Files) -> Result<Self, RobotError> {
        let coefficients = Coefficients::from_set(spec.parameters);
        let text = UrdfText::open(spec.urdf.as_deref(), files, REMUS100)?;
        let hull = urdf::read(&text, &coefficients)?;
        Ok(Self {
            equation: Equation::new(hull.coefficients.body())
                .expect("the mass of a REMUS is near that of its parameters"),
            hull,
            actuators: Actuators::default(),
            last: None,
        })
    }

    /// The hull's numbers.
    pub fn coefficients(&self) -> &Coefficients {
        &self.hull.coefficients
    }

    /// Where the URDF's mass differs from that of the hydrodynamic parameters, and what is done about it.
    pub fn doubts(&self) -> &[String] {
        &self.hull.told
    }

    /// Pose of an instrument (a link of the URDF), in body axes.
    pub fn mount(&self, name: &str) -> Option<Pose> {
        self.hull.links.get(name).copied()
    }

    /// Present state of fins and propeller.
    pub fn actuators(&self) -> Actuators {
        self.actuators
    }

    /// Electric power of its propeller in the last step, W.
    pub fn power_w(&self) -> f64 {
        let Some((truth, water_m_s, density_kg_m3)) = &self.last else {
            return 0.0;
        };
        let through = truth.v_WB_B - truth.pose.R_WB.inverse() * water_m_s;
        let [v_ground, v] = [truth.v_WB_B, through].map(|v| Vector3::new(v.x, -v.y, -v.z));
        let terms = RemusTerms { c: &self.hull.coefficients, asked: self.actuators };
        let shaft_w = terms.shaft_w(&v_ground, &v, *density_kg_m3, self.actuators.rpm);
        shaft_w / REMUS_SHARE
    }

    /// Sets the state of fins and propeller at a start.
    pub fn set_actuators(&mut self, actuators: Actuators) {
        self.actuators = actuators;
    }

    /// The body for the physics.
    pub fn body_spec(&self, id: &str, truth: Truth) -> BodySpec {
        let c = &self.hull.coefficients;
        BodySpec {
            id: id.to_string(),
            truth,
            shapes: self.hull.shapes.clone(),
            p_BG: Vector3::new(0.0, 0.0, -c.z_g_m),
            mass: self.equation.whole_mass_flu(),
            without_momentum: false,
        }
    }

    /// The state after `dt_s` if the vehicle touches nothing, for `Physics::push`; also moves the actuators.
    pub fn step(&mut self, truth: &Truth, water: &WaterSample, command: &ActuatorCommand, dt_s: f64) -> Truth {
        let c = &self.hull.coefficients;
        let terms = RemusTerms { c, asked: Actuators::asked(command, c) };
        let (free, actuators) = self.equation.advance(&terms, truth, &self.actuators, water, dt_s);
        self.actuators = actuators;
        self.last = Some((*truth, water.velocity, water.density_kg_m3));
        free
    }
}
