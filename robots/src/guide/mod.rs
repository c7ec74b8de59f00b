//! Turns goals into commands of heading, speed and depth.

mod cage;
mod catalogue;
mod dubins;
mod flow_compensation;
mod follow_line;
mod go_to_point;
mod guidance;
mod hover;
mod known;
mod rate_filter;
mod spec;

pub use catalogue::CATALOGUE;
pub use dubins::{DubinsPath, Pose};
pub use guidance::Guidance;
pub use spec::GuidanceSpec;
