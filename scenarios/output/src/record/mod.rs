//! Recordings: what a run's frames hold, as ROS 2 messages in an MCAP file.

mod growing_path;
mod map_record;
mod recorder;
mod recorder_clouds;
mod recorder_gantry;
mod recorder_log;
mod recorder_robot;
mod recorder_scene;
mod recorder_ways;

pub use recorder::Recorder;

/// Frame of all poses.
const WORLD: &str = "world";
/// Frame of clouds, at the centre of the area: their numbers of single precision would be coarse far from the datum.
const AREA: &str = "world/area";
