//! Go To Point With Heading: the path, and how the vehicle follows it.

mod arc;
mod follower;
mod path;

pub use arc::Pose;
pub(super) use follower::Follower;
pub use path::DubinsPath;
