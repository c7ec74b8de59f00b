//! A robot that moves freely in the water: its parts, its systems, what is seen of it.

pub(crate) mod assemble;
mod frame;
pub(crate) mod system;

pub(crate) use frame::Log;
pub use frame::{PictureFrame, PingFrame, RobotFrame};

use bevy_ecs::prelude::Component;
use nalgebra::Vector2;
use robots::actuate::Autopilot;
use robots::estimate::Estimator;
use robots::guide::Guidance;
use robots::map::Mapper;
use robots::sense::SensorSuite;
use robots::strategy::Strategy;
use robots::vehicles::Vehicle;
use world::physics::BodyId;
use world::seeds::Stream;

/// Its vehicle and its body in the physics.
#[derive(Component)]
pub struct Hull {
    /// Dynamics and actuators.
    pub vehicle: Vehicle,
    /// Body it moves.
    pub body: BodyId,
}

/// Its instruments.
#[derive(Component)]
pub struct Instruments(pub SensorSuite);

/// Its navigation.
#[derive(Component)]
pub struct Navigation(pub Estimator);

/// Its strategy with the random stream it holds.
#[derive(Component)]
pub struct Searching {
    /// What decides.
    pub strategy: Box<dyn Strategy>,
    /// Its random numbers.
    pub rng: Stream,
    /// Where it was launched, as its navigation had it (east, north), m.
    pub home: Vector2<f64>,
}

/// Its map of where the source may be, if it keeps one.
#[derive(Component)]
pub struct Mapping(pub Box<dyn Mapper>);

/// Its guidance.
#[derive(Component)]
pub struct Guiding(pub Guidance);

/// Its autopilot.
#[derive(Component)]
pub struct Steering(pub Autopilot);
