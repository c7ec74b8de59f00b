//! Live state over zenoh, the only place that touches it.
//!
//! A run publishes what it does under `rheotaxis/<run>/`: JSON (UTF-8), SI units, ENU axes; see
//! [`topics`] for every key with its JSON Schema. zenoh lives in a thread of its own behind a
//! mailbox that keeps the newest state only, so nothing a subscriber does can hold or change a run.
//! Without the feature `live` the same types exist and do nothing.

mod error;
mod options;
mod table;
mod topics;

#[cfg(feature = "live")]
mod look_message;
#[cfg(feature = "live")]
mod mailbox;
#[cfg(feature = "live")]
mod map_message;
#[cfg(feature = "live")]
mod message;
#[cfg(feature = "live")]
mod message_gantry;
#[cfg(feature = "live")]
mod session;
#[cfg(feature = "live")]
mod slots;
#[cfg(feature = "live")]
mod tree;

#[cfg(not(feature = "live"))]
mod off;

pub use error::LiveError;
pub use options::{DEFAULT_PORT, LiveCounts, LiveMeta, LiveOptions, run_id};
pub use topics::{Field, Kind, Payload, Topic, topics};

#[cfg(not(feature = "live"))]
pub use off::Live;
#[cfg(feature = "live")]
pub use session::Live;
