//! Whoever steers: the autopilot of the REMUS, that of a vehicle of a folder, or the helm of a kinematic one.

use super::autopilot::Autopilot;
use super::drives::DrivePilot;
use super::helm::Helm;
use super::spec::AutopilotSpec;
use crate::handoff::{Actuation, Command, Control, DriveCommand, Estimate, Plant};
use bevy_ecs::prelude::Component;

/// What steers a vehicle.
#[derive(Component, Clone, Debug, PartialEq)]
pub enum Pilot {
    /// Fins and a propeller.
    Fins(Autopilot),
    /// Rates.
    Rates(Helm),
    /// Drives of a vehicle of a folder, which is known beforehand.
    Drives(Box<DrivePilot>, Box<Plant>),
}

impl Pilot {
    /// What steers a vehicle, which sets out at a speed, m/s.
    pub fn new(spec: &AutopilotSpec, control: &Control, speed_m_s: f64) -> Self {
        match control {
            Control::Rates(limits) => Self::Rates(Helm::new(*limits, spec, speed_m_s)),
            Control::Fins => Self::Fins(Autopilot::new(spec)),
            Control::Drives(plant) => Self::Drives(Box::new(DrivePilot::new(plant)), plant.clone()),
        }
    }

    /// Whether a thruster was at its limit in the last step; `None` without an allocation among thrusters.
    pub fn saturated(&self) -> Option<bool> {
        match self {
            Self::Drives(pilot, _) => pilot.saturated(),
            Self::Fins(_) | Self::Rates(_) => None,
        }
    }

    /// Set-points of the drives for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, estimate: &Estimate, dt_s: f64) -> Actuation {
        match self {
            Self::Fins(pilot) => Actuation::Fins(pilot.step(command, estimate, dt_s)),
            Self::Rates(helm) => Actuation::Rates(helm.step(command, estimate, dt_s)),
            Self::Drives(pilot, plant) => Actuation::Drives(match command {
                Command::Drives(set) => {
                    // Sums that the autopilot has kept are of no use after a time of drives set from outside.
                    **pilot = DrivePilot::new(plant);
                    held(plant, set)
                }
                _ => pilot.step(command, estimate, dt_s),
            }),
        }
    }
}

/// Set-points within the limits of the drives; a drive without one is idle.
fn held(plant: &Plant, asked: &DriveCommand) -> DriveCommand {
    let held = plant.drives.iter().enumerate().map(|(k, drive)| {
        let [least, most] = drive.limits;
        (asked.all().get(k)).map_or(drive.idle, |set| set.clamp(least, most))
    });
    DriveCommand::new(&held.collect::<Vec<_>>())
}
