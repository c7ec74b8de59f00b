//! Turns commands into set-points of the vehicle's drives.

mod autopilot;
mod helm;
mod pilot;
mod spec;

pub use autopilot::Autopilot;
pub use helm::Helm;
pub use pilot::Pilot;
pub use spec::{AutopilotSpec, CATALOGUE};
