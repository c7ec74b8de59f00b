//! MCAP files of ROS 2 messages.

mod file;
mod read;

pub use file::{FLUSH_NS, McapFile, RecordError};
pub use read::{CONTROL, ReadError, RecordedRun, read_recording};
