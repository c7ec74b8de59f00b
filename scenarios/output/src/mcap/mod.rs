//! MCAP files of ROS 2 messages.

mod file;
mod read;
mod ros_messages;
mod ros_schemas;

pub use file::{FLUSH_NS, McapFile, RecordError, nanoseconds};
pub use read::{CONTROL, ReadError, Recorded, read_recording};
pub use ros_messages::{
    Joint, MessageKind, Odometry, clock, compressed_image, float64, joint_state, point_cloud,
    pose_stamped, text, transforms, vector3_stamped,
};
