//! Go To Point With Heading: the path, and how it is followed.

mod follower;
mod path;

pub(super) use follower::{Follower, FollowerLimits};
pub use path::{DubinsPath, Pose};
