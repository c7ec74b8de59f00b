//! What a strategy commands the guidance, and what the guidance answers.

use super::DriveCommand;
use bevy_ecs::prelude::Component;
use nalgebra::Vector2;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use world::units::Heading;

/// Vertical part of a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Vertical {
    /// Keep this height above the bed, m.
    Altitude(f64),
    /// Keep this depth, m.
    Depth(f64),
}

/// Horizontal part of a goal: the guidance modes of Pang 2009, a plain course, or none. Those that a goal from outside
/// the program may ask for can be read and written.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Manoeuvre {
    /// Head for a point (east, north); arrived within `radius_m`.
    GoToPoint {
        /// Destination, m.
        #[serde(rename = "point_m", with = "east_north")]
        point: Vector2<f64>,
        /// Arrival radius, m; `None` for the guidance's own.
        radius_m: Option<f64>,
    },
    /// Reach the start with the line's heading, then track the line to its end.
    FollowLine {
        /// Start, m.
        #[serde(rename = "from_m", with = "east_north")]
        from: Vector2<f64>,
        /// End, m.
        #[serde(rename = "to_m", with = "east_north")]
        to: Vector2<f64>,
    },
    /// Reach a point with a heading along a Dubins path.
    GoToPointWithHeading {
        /// Destination, m.
        #[serde(rename = "point_m", with = "east_north")]
        point: Vector2<f64>,
        /// Heading on arrival.
        #[serde(rename = "heading_rad")]
        heading: Heading,
    },
    /// Stay at a point. A vehicle that cannot hover goes round it.
    Hold {
        /// Place (east, north), m.
        #[serde(rename = "point_m", with = "east_north")]
        point: Vector2<f64>,
        /// Heading to hold; `None` for that of the way there.
        #[serde(rename = "heading_rad")]
        heading: Option<Heading>,
    },
    /// Go to a point with a heading held. A vehicle that cannot go sideways goes to it nose first.
    SlideTo {
        /// Destination (east, north), m.
        #[serde(rename = "point_m", with = "east_north")]
        point: Vector2<f64>,
        /// Arrival radius, m; `None` for the guidance's own.
        radius_m: Option<f64>,
        /// Heading to hold.
        #[serde(rename = "heading_rad")]
        heading: Heading,
    },
    /// Move over ground in a direction, without end.
    Course {
        /// Direction over ground.
        #[serde(rename = "heading_rad")]
        course: Heading,
    },
    /// Steer a heading through the water, with neither cage nor compensation of the flow.
    #[serde(skip)]
    Steer {
        /// Heading.
        heading: Heading,
    },
    /// Move over ground with a heading held. A vehicle that cannot hover steers along the velocity.
    #[serde(skip)]
    Slide {
        /// Heading to hold.
        heading: Heading,
        /// Velocity over ground (east, north), m/s.
        over_ground_m_s: Vector2<f64>,
    },
    /// Set the vehicle's own drives, bypassing guidance and autopilot.
    #[serde(skip)]
    Drives(DriveCommand),
    /// Drive rudder, stern plane and propeller directly, bypassing guidance and autopilot.
    Direct {
        /// Rudder angle, rad (positive turns to starboard, as in the reference data).
        rudder_rad: f64,
        /// Stern plane angle, rad (positive pitches the nose down).
        stern_rad: f64,
        /// Propeller speed, rpm.
        rpm: f64,
    },
}

/// A place as a list of two numbers.
mod east_north {
    use super::{Deserialize, Deserializer, Serialize, Serializer, Vector2};

    pub(super) fn serialize<S: Serializer>(place: &Vector2<f64>, to: S) -> Result<S::Ok, S::Error> {
        <[f64; 2]>::from(*place).serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vector2<f64>, D::Error> {
        <[f64; 2]>::deserialize(from).map(Into::into)
    }
}

/// A goal; the guidance restarts the manoeuvre when `id` changes.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Number of the goal; each new goal has the next number.
    pub id: u32,
    /// Horizontal part.
    pub manoeuvre: Manoeuvre,
    /// Vertical part.
    pub vertical: Vertical,
    /// Speed over ground wished for, m/s.
    pub speed_m_s: f64,
}

impl Goal {
    /// The goal before the first one is given.
    pub fn none_yet(vertical: Vertical, speed_m_s: f64) -> Self {
        Self { id: 0, manoeuvre: Manoeuvre::GoToPoint { point: Vector2::zeros(), radius_m: None }, vertical, speed_m_s }
    }
}

/// Where a gantry's head is to go, in the gantry's own frame; the drives begin a motion when `id` changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeadGoal {
    /// Number of the motion; each new motion has the next number, 0 is none yet.
    pub id: u32,
    /// Destination of the head's reference point (forward, left), m.
    pub target_m: Vector2<f64>,
    /// Speed of each axis (forward, left), m/s.
    pub speed_m_s: Vector2<f64>,
}

/// How the guidance stands with a goal.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct GuidanceStatus {
    /// Which goal.
    pub goal_id: u32,
    /// It has been reached.
    pub done: bool,
    /// The guidance aborted the mission because the vehicle was too far outside the area.
    pub aborted: bool,
}
