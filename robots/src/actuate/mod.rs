//! Turns commands into actuator set-points.

mod autopilot;
mod spec;

pub use autopilot::Autopilot;
pub use spec::{AutopilotSpec, CATALOGUE};
