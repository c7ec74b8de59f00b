//! What every instrument does, and what it is told.

use super::camera::spec::CameraSpec;
use super::on_board::OnBoard;
use super::tools::EchoTarget;
use crate::error::RobotError;
use crate::handoff::{Behaviour, Decision, Readings};
use image::RgbImage;
use nalgebra::Vector3;
use world::clock::Clock;
use world::cost::{Cost, Times};
use world::fields::{Concentration, Flow};
use world::frames::{Pose, Truth};
use world::obstacles::Obstacles;
use world::registry::Spec;
use world::terrain::Terrain;

/// The place where an instrument is fitted.
#[derive(Clone, Copy)]
pub struct Fitting<'a> {
    /// The pose in body axes of a mount of the vehicle, by its name.
    pub mounts: &'a dyn Fn(&str) -> Option<Pose>,
    /// The robot.
    pub robot: OnBoard<'a>,
}

impl Fitting<'_> {
    /// The mount of a name.
    ///
    /// # Errors
    /// If the vehicle has none.
    pub fn mount(&self, name: &str) -> Result<Pose, RobotError> {
        self.mount_for(name, name)
    }

    /// The mount of a name for the instrument `sensor`.
    pub(super) fn mount_for(&self, sensor: &str, name: &str) -> Result<Pose, RobotError> {
        (self.mounts)(name).ok_or_else(|| {
            RobotError::invalid(
                format!("sensors.{sensor}"),
                format!(
                    "the vehicle has no mount \"{name}\": add a link of that name to its URDF, or leave the sensor out"
                ),
            )
        })
    }

    /// Its place in body axes, m.
    ///
    /// # Errors
    /// If the vehicle has none.
    pub fn place(&self, name: &str) -> Result<Vector3<f64>, RobotError> {
        self.mount(name).map(|pose| pose.p_WB)
    }
}

/// Everything that can be sensed in a step.
#[derive(Clone, Copy)]
pub struct Surroundings<'a> {
    /// Time.
    pub clock: &'a Clock,
    /// The vehicle's motion.
    pub truth: &'a Truth,
    /// The water.
    pub flow: &'a dyn Flow,
    /// Dye in it.
    pub dye: &'a dyn Concentration,
    /// The bed.
    pub terrain: &'a Terrain,
    /// Solids in the water.
    pub obstacles: &'a Obstacles,
    /// What makes pictures of it.
    pub imaging: &'a dyn Imaging,
    /// Requests of the strategy.
    pub asked: SensorRequests,
}

impl Surroundings<'_> {
    /// What an echo sounder may hear.
    pub fn below(&self) -> EchoTarget<'_> {
        EchoTarget { terrain: self.terrain, obstacles: self.obstacles }
    }
}

/// Makes pictures by the light in the water.
pub trait Imaging {
    /// The picture of a camera at a pose (its axes: x right in the picture, y down, z into the scene). The sensor's
    /// noise depends only on `noise`.
    fn picture(&self, camera: &CameraSpec, pose_WC: &Pose, around: &Surroundings, noise: u64) -> RgbImage;
}

/// An instrument. It draws from a stream of its own: [`OnBoard::stream`].
pub trait Sensor: std::fmt::Debug + Send + Sync {
    /// Reads its surroundings, and writes its readings of this step.
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings);
}

/// Parameters of an instrument; their name is the field of `sensors`.
pub trait SensorParams: Spec {
    /// Builds the instrument on a vehicle.
    ///
    /// # Errors
    /// If a mount is missing, or if a parameter is out of range.
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError>;

    /// The instruments of the program whose readings it gives, too: an instrument of another crate that says so is one of
    /// those that a strategy may need.
    fn stands_for(&self) -> &'static [&'static str] {
        &[]
    }

    /// The names of the numbers that it gives in [`Readings::other`], each with its unit at the end: those are columns of
    /// tables. One that is not named here is in live state and recording alone.
    fn numbers(&self) -> &'static [&'static str] {
        &[]
    }

    /// Its memory and time among so many obstacles, if it is used for a share `used` of the mission; paths below its
    /// field.
    fn cost(&self, _obstacles: f64, _used: f64, _times: &Times) -> Cost {
        Cost::default()
    }
}

/// Requests of the strategy to the instruments in the step before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SensorRequests {
    /// A picture.
    pub picture: bool,
    /// The vehicle is on a survey.
    pub survey: bool,
}

impl From<&Decision> for SensorRequests {
    fn from(decision: &Decision) -> Self {
        Self { picture: decision.picture, survey: decision.behaviour == Behaviour::Survey }
    }
}
