//! What the guidance commands the autopilot, and the autopilot the actuators.

use super::{DriveCommand, MOST_DRIVES, RateCommand, Vertical};
use bevy_ecs::prelude::Component;
use nalgebra::Vector2;
use smart_default::SmartDefault;
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

/// Guidance output for a vehicle that can hover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveSetpoint {
    /// Heading to hold.
    pub heading: Heading,
    /// Velocity over ground (east, north), m/s.
    pub over_ground_m_s: Vector2<f64>,
    /// Vertical part.
    pub vertical: Vertical,
}

impl MoveSetpoint {
    /// The same for a vehicle that cannot hover: heading and speed of the velocity.
    pub fn steered(&self) -> Setpoint {
        let speed = self.over_ground_m_s.norm();
        Setpoint {
            heading: if speed > 0.0 { Heading::from_vector(self.over_ground_m_s) } else { self.heading },
            water_speed_m_s: speed,
            vertical: self.vertical,
        }
    }
}

/// What the guidance hands to the stage `actuate`.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// For the autopilot.
    Steer(Setpoint),
    /// For the autopilot of a vehicle that can hover.
    Move(MoveSetpoint),
    /// Straight to rudder, stern plane and propeller.
    Direct(ActuatorCommand),
    /// Straight to the vehicle's own drives, in their order.
    Drives(DriveCommand),
}

/// What a vehicle's own drives are set to.
#[derive(Component, Clone, Copy, Debug, SmartDefault, PartialEq)]
pub enum Actuation {
    /// Of a vehicle with fins and a propeller.
    #[default]
    Fins(ActuatorCommand),
    /// Of a kinematic vehicle.
    Rates(RateCommand),
    /// Of a vehicle of a folder.
    Drives(DriveCommand),
}

impl Actuation {
    /// The set-point of a drive by its place in [`NamedDrive`](super::NamedDrive)'s order; `None` without such a drive.
    pub fn drive(&self, place: usize) -> Option<f64> {
        match self {
            Self::Fins(set) => [set.rudder_rad, set.stern_rad, set.rpm].get(place).copied(),
            Self::Rates(_) => None,
            Self::Drives(set) => set.all().get(place).copied(),
        }
    }

    /// The same with another set-point of that drive.
    #[must_use]
    pub fn with_drive(self, place: usize, value: f64) -> Self {
        match self {
            Self::Fins(set) => Self::Fins(match place {
                0 => ActuatorCommand { rudder_rad: value, ..set },
                1 => ActuatorCommand { stern_rad: value, ..set },
                _ => ActuatorCommand { rpm: value, ..set },
            }),
            Self::Rates(set) => Self::Rates(set),
            Self::Drives(set) => Self::Drives(set.with(place, value)),
        }
    }

    /// The set-points with their names and units; the drives of a folder's vehicle have numbers.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        let names: &[&'static str] = match self {
            Self::Fins(_) => &["rudder_rad", "stern_rad", "rpm"],
            Self::Rates(_) => &["turn_rad_s", "climb_m_s", "speed_m_s"],
            Self::Drives(_) => &DRIVES,
        };
        let value = move |place: usize| match self {
            Self::Rates(set) => [set.turn_rad_s, set.climb_m_s, set.speed_m_s].get(place).copied(),
            _ => self.drive(place),
        };
        let values = (0..).map_while(value);
        names.iter().copied().zip(values)
    }
}

/// Names of the drives in files and topics.
const DRIVES: [&str; MOST_DRIVES] = [
    "drive_1", "drive_2", "drive_3", "drive_4", "drive_5", "drive_6", "drive_7", "drive_8", "drive_9", "drive_10",
    "drive_11", "drive_12", "drive_13", "drive_14", "drive_15", "drive_16",
];

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
