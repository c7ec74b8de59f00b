//! ROS 2 messages: their types, their definitions, and their bytes. Recordings and live state share them.

mod cdr;
mod drawings;
mod log;
mod machines;
mod messages;
mod plume;
mod schemas;
mod sensors;
mod types;

pub use drawings::{Balls, Marker, balls, marker_array, path};
pub use log::{LogLevel, log_line};
pub use machines::{believed_flow, believed_odometry, believed_pose, declared, slides, true_odometry};
pub use messages::{
    Joint, Transform, clock, compressed_image, echo_cloud, float64, joint_state, odometry, point_cloud, pose_stamped,
    text, transforms, vector3_stamped,
};
pub use plume::{plume_cloud, water_cloud};
pub use sensors::{fluid_pressure, imu, range, twist_stamped};
pub use types::MessageKind;

/// A simulated time in seconds as nanoseconds, never negative.
pub fn nanoseconds(t_s: f64) -> u64 {
    (t_s.max(0.0) * 1e9).round() as u64
}
