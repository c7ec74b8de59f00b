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
use bevy_ecs::prelude::Component;
use nalgebra::Vector2;
use robots::handoff::{Capabilities, ChemicalReading};
use robots::map::Mapper;
use robots::vehicles::Vehicle;
use world::area::Area;
use world::physics::BodyId;

/// A robot's vehicle and its body in the physics.
#[derive(Component)]
pub struct Hull {
    /// How it moves.
    pub vehicle: Box<Vehicle>,
    /// The body that it moves.
    pub body: BodyId,
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
