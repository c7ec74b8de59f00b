//! What the guidance commands the autopilot, and the autopilot the actuators.

use super::{RateCommand, Vertical};
use bevy_ecs::prelude::Component;
use world::units::Heading;

/// Guidance output, within the vehicle's limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setpoint {
    /// Heading to steer.
    pub heading: Heading,
    /// Speed through the water, m/s; of a vehicle that the water does not carry, speed over ground.
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

/// What a vehicle's own drives are set to.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub enum Actuation {
    /// Of a vehicle with fins and a propeller.
    Fins(ActuatorCommand),
    /// Of a kinematic vehicle.
    Rates(RateCommand),
}

impl Default for Actuation {
    fn default() -> Self {
        Self::Fins(ActuatorCommand::default())
    }
}

impl Actuation {
    /// The set-points with their names and units.
    #[must_use]
    pub fn named(&self) -> [(&'static str, f64); 3] {
        match self {
            Self::Fins(set) => [
                ("rudder_rad", set.rudder_rad),
                ("stern_rad", set.stern_rad),
                ("rpm", set.rpm),
            ],
            Self::Rates(set) => [
                ("turn_rad_s", set.turn_rad_s),
                ("climb_m_s", set.climb_m_s),
                ("speed_m_s", set.speed_m_s),
            ],
        }
    }
}

/// Actuator set-points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ActuatorCommand {
    /// Rudder, rad (positive turns to starboard).
    pub rudder_rad: f64,
    /// Stern plane, rad (positive pitches the nose down).
    pub stern_rad: f64,
    /// Propeller, rpm.
    pub rpm: f64,
}
