//! Live state over zenoh. Only this module uses zenoh.
//!
//! A run publishes its state under `rheotaxis/<run>/`: JSON (UTF-8), SI units, ENU axes. [`topics`] has every key with
//! its JSON Schema. zenoh runs in its own thread behind a mailbox that keeps only the newest state, so no subscriber
//! can delay or change a run. Nodes of ROS 2 see the same run as topics if [`LiveOptions::ros2`] says so. A [`Listener`]
//! hears what runs publish. Without the feature `live`, the same types exist and do nothing.

mod error;
mod news;
mod options;
mod plane;
mod ros2;
mod topics;

#[cfg(feature = "live")]
mod ask;
#[cfg(feature = "live")]
mod config;
#[cfg(feature = "live")]
mod controller;
#[cfg(feature = "live")]
mod exposed;
#[cfg(feature = "live")]
mod listen;
#[cfg(feature = "live")]
mod look_message;
#[cfg(feature = "live")]
mod mailbox;
#[cfg(feature = "live")]
mod map_message;
#[cfg(feature = "live")]
mod message;
#[cfg(feature = "live")]
mod session;
#[cfg(feature = "live")]
mod slots;
#[cfg(feature = "live")]
mod tree;

#[cfg(not(feature = "live"))]
mod off;

pub use crate::scene::{Machine, Scene};
pub use error::LiveError;
pub use news::{ListenOptions, News};
pub use options::{DEFAULT_PORT, LiveCounts, LiveMeta, LiveOptions, run_id};
pub use plane::Plane;
pub use ros2::{Qos, Ros2, RosTopic, ros_topics};
pub use topics::{Payload, Topic, topics};

#[cfg(feature = "live")]
pub use ask::LiveAsk;
#[cfg(feature = "live")]
pub use controller::{Going, LiveController};
#[cfg(feature = "live")]
pub use listen::Listener;
#[cfg(not(feature = "live"))]
pub use off::{Going, Listener, Live, LiveAsk, LiveController, LiveSession};
#[cfg(feature = "live")]
pub use session::{Live, LiveSession};
