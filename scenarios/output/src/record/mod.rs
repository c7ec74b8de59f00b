//! Recordings: ROS 2 messages of a run's frames in an MCAP file.

mod cdr;
mod map_record;
mod mcap;
mod recorder;
mod recorder_gantry;
mod ros_messages;
mod ros_schemas;

pub use cdr::Cdr;
pub use mcap::{FLUSH_NS, McapFile, RecordError, nanoseconds};
pub use recorder::Recorder;
pub use ros_messages::{
    Joint, Kind, Odometry, clock, compressed_image, float64, joint_state, point_cloud,
    pose_stamped, text, transforms, vector3_stamped,
};
