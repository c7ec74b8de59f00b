//! A vehicle of any kind that a scenario can choose for a robot.

use super::files::Files;
use super::folder::{DrivenHull, TermsSpec, VehicleFile, VehicleSource, urdf_of};
use super::kinematic::Kinematic;
use super::motion::{Motion, WaterInput};
use super::spec::VehicleSpec;
use super::torpedo::TorpedoHull;
use super::urdf::{self, Shell};
use crate::error::RobotError;
use crate::handoff::Actuation;
use nalgebra::{Matrix3, Vector3};
use std::ops::{Deref, DerefMut};
use world::fields::{Flow, WaterSample};
use world::frames::{Pose, Truth};
use world::physics::{BodySpec, Shape};

/// A vehicle: its shape by its URDF, and how it moves. Pose and velocity belong to the physics.
#[derive(Clone, Debug)]
pub struct Vehicle {
    name: String,
    shell: Shell,
    told: Vec<String>,
    motion: Box<dyn Motion>,
}

impl Vehicle {
    /// Builds the vehicle that a scenario asks for; `files` gives its files, if it names any.
    ///
    /// # Errors
    /// If a file cannot be read, or if the vehicle cannot be one.
    pub fn load(spec: &VehicleSpec, files: &dyn Files) -> Result<Self, RobotError> {
        let VehicleSpec::Kinematic(kinematic) = spec else {
            return Self::build(&VehicleSource::new(spec, files)?);
        };
        let urdf = urdf_of(kinematic.urdf.as_deref(), files)?;
        let shell = urdf::shell(&urdf)?;
        let motion = Kinematic::new(kinematic, &shell).map_err(|problem| urdf.fault(problem))?;
        Ok(Self { name: "Kinematic".into(), shell, told: Vec::new(), motion: Box::new(motion) })
    }

    /// Builds a vehicle from what its `vehicle.ron` says, which stands in a folder of `files`.
    ///
    /// # Errors
    /// If a file cannot be read, or if the vehicle cannot be one.
    pub fn of_file(folder: &str, file: &VehicleFile, files: &dyn Files) -> Result<Self, RobotError> {
        Self::build(&VehicleSource::in_folder(folder.as_ref(), file.clone(), files)?)
    }

    fn build(source: &VehicleSource) -> Result<Self, RobotError> {
        let shell = urdf::shell(&source.urdf)?;
        let mut told = Vec::new();
        let motion: Box<dyn Motion> = match &source.file.hydrodynamics.terms {
            TermsSpec::Blocks => Box::new(DrivenHull::build(source, &shell, &mut told)?),
            TermsSpec::Torpedo(hull) => Box::new(TorpedoHull::build(source, hull, &shell, &mut told)?),
        };
        Ok(Self { name: source.file.name.clone(), shell, told, motion })
    }

    /// Its name for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What is doubtful about it, one sentence each.
    pub fn doubts(&self) -> &[String] {
        &self.told
    }

    /// Shapes to look at, in body axes, with their colours (`#rrggbb`).
    pub fn visuals(&self) -> &[(Pose, Shape, String)] {
        &self.shell.visuals
    }

    /// Pose of an instrument or drive (a link of the URDF), in body axes.
    pub fn mount(&self, name: &str) -> Option<Pose> {
        self.shell.links.get(name).copied()
    }

    /// The body for the physics.
    pub fn body_spec(&self, id: &str, truth: Truth) -> BodySpec {
        let inertia = self.inertia();
        BodySpec {
            id: id.to_string(),
            truth,
            shapes: self.shell.shapes.clone(),
            p_BG: inertia.p_BG,
            mass: inertia.mass,
            without_momentum: inertia.without_momentum,
        }
    }

    /// The state after `dt_s` if the vehicle touches nothing, for `Physics::push`; `t_s` is the time in the water.
    ///
    /// # Panics
    /// If the set-points are those of a vehicle of another kind.
    pub fn step(&mut self, truth: &Truth, water: &dyn Flow, t_s: f64, set: &Actuation, dt_s: f64) -> Truth {
        let uniform = |velocity| WaterSample {
            velocity,
            gradient: Matrix3::zeros(),
            rate: Vector3::zeros(),
            density_kg_m3: world::units::SEA_WATER_KG_M3,
        };
        let sample = match self.feels() {
            WaterInput::Sample => water.sample(&truth.pose.p_WB, t_s),
            WaterInput::Velocity => uniform(water.velocity(&truth.pose.p_WB, t_s)),
            WaterInput::Nothing => uniform(Vector3::zeros()),
        };
        self.step_in(truth, &sample, set, dt_s)
    }
}

/// What every way to move can do.
impl Deref for Vehicle {
    type Target = dyn Motion;

    fn deref(&self) -> &Self::Target {
        &*self.motion
    }
}

impl DerefMut for Vehicle {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut *self.motion
    }
}
