//! The door to ROS 2: a run's state in the layout of rmw_zenoh, which nodes that run on it see as one node's topics.
//!
//! *Source*: `docs/design.md` of rmw_zenoh (Jazzy from 0.2.4, Kilted from 0.6.0); REP 103 (units and axes), REP 105
//! (frames), REP 117 (ranges), REP 145 (IMU).
//! *Parameters*: the domain, [`Ros2::domain`].
//! *Deviations*: `map` carries each vehicle's body frame without an `odom` between them, because a position fix moves
//! the estimate at once.
//!
//! [`topics`] is the table of what is published; [`scene`](crate::scene) what is known before the run; `state` makes
//! messages of frames, without zenoh; `node` publishes them with `keys` and `attachment`; `commands` hears what nodes
//! of ROS ask a robot to do, if the run allows it.

#[cfg(feature = "live")]
mod attachment;
#[cfg(feature = "live")]
mod commands;
#[cfg(feature = "live")]
mod door;
#[cfg(feature = "live")]
mod keys;
#[cfg(feature = "live")]
mod machine_messages;
#[cfg(feature = "live")]
mod node;
#[cfg(feature = "live")]
mod readings;
#[cfg(feature = "live")]
mod state;
mod topics;

#[cfg(feature = "live")]
pub(super) use commands::RosCommands;
#[cfg(feature = "live")]
pub(super) use door::Door;
pub use topics::{Qos, RosTopic, ros_topics};

use crate::scene::Scene;
use std::sync::Arc;

/// The frame of the world: east, north, up; z = 0 at the still surface.
#[cfg(feature = "live")]
const MAP: &str = "map";
/// The frame of clouds, at the centre of the area: their numbers of single precision would be coarse far from the datum.
#[cfg(feature = "live")]
const AREA: &str = "map/area";

/// How to publish for ROS 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Ros2 {
    /// The domain (`ROS_DOMAIN_ID`).
    pub domain: u32,
    /// What is known before the run.
    pub scene: Arc<Scene>,
}
