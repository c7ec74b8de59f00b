//! Turns commands into set-points of the vehicle's drives.

mod autopilot;
mod drives;
mod helm;
mod pilot;
mod spec;

pub use autopilot::Autopilot;
pub use drives::{Allocation, DrivePilot, ThrusterCommands};
pub use helm::Helm;
pub use pilot::Pilot;
pub use spec::{AutopilotSpec, CATALOGUE};
