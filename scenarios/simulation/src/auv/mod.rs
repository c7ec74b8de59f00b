//! A robot that moves freely in the water: its components, its systems, its topics.

mod assemble;
pub(crate) mod message;
mod own;
mod report;
mod shown;
pub(crate) mod system;
pub mod topics;
mod vehicle_pool;

pub(crate) use own::RobotOwn;
pub(crate) use vehicle_pool::VehiclePool;

pub use crate::frame::{PictureFrame, PingFrame, RobotFrame};

use crate::frame::NewestReadings;
use bevy_ecs::prelude::{Component, Entity, Resource};
use nalgebra::Vector2;
use robots::handoff::{Bounds, Capabilities, ChemicalReading};
use robots::map::Mapper;
use robots::strategy::Strategy;
use robots::vehicles::Vehicle;
use world::area::Area;
use world::clock::Clock;
use world::physics::BodyId;
use world::seeds::Stream;

/// The time aboard: the clock, which is nearer at hand here than among the resources. The instruments set it at the
/// beginning of each tick.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct OnboardTime(pub(crate) Clock);

/// All robots, in the scenario's order.
#[derive(Resource, Clone, Debug, Default)]
pub struct Robots(pub Vec<Entity>);

/// A robot's vehicle and its body in the physics.
#[derive(Component)]
pub struct Hull {
    /// How it moves.
    pub vehicle: Vehicle,
    /// The body that it moves.
    pub body: BodyId,
}

/// A robot's strategy and its random numbers.
#[derive(Component)]
pub struct SearcherParts {
    /// The strategy.
    pub strategy: Box<dyn Strategy>,
    /// Its name in scenarios.
    pub name: &'static str,
    /// Within what its numbers must lie.
    pub bounds: Bounds,
    /// Its random numbers. Apart, because few strategies draw any.
    pub rng: Box<Stream>,
}

/// What a robot is told before its mission.
#[derive(Component, Clone, Copy, Debug)]
pub struct Briefing {
    /// The operating area.
    pub area: Area,
    /// Where it was launched, according to its navigation (east, north), m.
    pub home: Vector2<f64>,
    /// What the vehicle can do.
    pub able: Capabilities,
}

/// A robot's map of where the source may be, if it keeps one.
#[derive(Component)]
pub struct Mapping {
    /// The map.
    pub mapper: Box<dyn Mapper>,
    /// How many updates it had when the digest saw it last; `None` before the first time.
    pub(crate) digested: Option<u64>,
}

/// What happened to a robot between two frames.
#[derive(Component, Clone, Debug, Default)]
pub(crate) struct Log {
    /// What the other instruments reported.
    readings: NewestReadings,
    /// Newest chemical reading; it stays until there is another.
    chemical: Option<ChemicalReading>,
    /// Whether there was a detection.
    detected: bool,
    /// The largest shift by a position fix, m.
    fix_m: Option<f64>,
}
