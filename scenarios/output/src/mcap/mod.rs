//! MCAP files of ROS 2 messages.

mod file;

pub use file::{FLUSH_NS, McapFile, RecordError};
