//! What the guidance commands the autopilot, and the autopilot the actuators.

use super::Vertical;
use bevy_ecs::prelude::Component;
use world::units::Heading;

/// Guidance output, within the vehicle's limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setpoint {
    /// Heading to steer.
    pub heading: Heading,
    /// Speed through the water, m/s.
    pub water_speed_m_s: f64,
    /// Vertical part.
    pub vertical: Vertical,
}

/// What the guidance hands to the stage `actuate`.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// For the autopilot.
    Steer(Setpoint),
    /// Straight to the actuators.
    Direct(ActuatorCommand),
}

/// Actuator set-points.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct ActuatorCommand {
    /// Rudder, rad (positive turns to starboard).
    pub rudder_rad: f64,
    /// Stern plane, rad (positive pitches the nose down).
    pub stern_rad: f64,
    /// Propeller, rpm.
    pub rpm: f64,
}
