//! Recordings: what a run's frames hold, as ROS 2 messages in an MCAP file.

mod map_record;
mod recorder;
mod recorder_gantry;

pub use recorder::Recorder;
