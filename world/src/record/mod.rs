//! What remains of a run: the digest of its whole state sequence, and the recording.

mod cdr;
mod digest;
mod mcap;
mod ros_messages;
mod ros_schemas;

pub use cdr::Cdr;
pub use digest::Digest;
pub use mcap::{FLUSH_NS, McapFile, RecordError, nanoseconds};
pub use ros_messages::{
    Joint, Kind, Odometry, clock, compressed_image, float64, joint_state, point_cloud,
    pose_stamped, text, transforms, vector3_stamped,
};
