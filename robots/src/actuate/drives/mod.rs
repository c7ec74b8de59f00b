//! Autopilots of vehicles of a folder: each is built from what it knows of its vehicle.

mod allocation;
mod glider;
mod thrusters;
mod torpedo;
mod torpedo_gains;

pub use allocation::{Allocation, ThrusterCommands};
use glider::GliderPilot;
use thrusters::ThrusterPilot;
use torpedo::TorpedoPilot;

use crate::handoff::{Command, DriveCommand, Estimate, PilotSpec, Plant};

/// The autopilot of a vehicle of a folder.
#[derive(Clone, Debug, PartialEq)]
pub enum DrivePilot {
    /// Fins and propellers.
    Torpedo(TorpedoPilot),
    /// Thrusters.
    Thrusters(ThrusterPilot),
    /// Buoyancy engine and moving mass.
    Glider(GliderPilot),
}

impl DrivePilot {
    /// The autopilot that the vehicle's file asks for.
    pub fn new(plant: &Plant) -> Self {
        match &plant.pilot {
            PilotSpec::Torpedo(spec) => Self::Torpedo(TorpedoPilot::new(plant, spec)),
            PilotSpec::Thrusters(spec) => Self::Thrusters(ThrusterPilot::new(plant, spec)),
            PilotSpec::Glider(spec) => Self::Glider(GliderPilot::new(plant, spec)),
        }
    }

    /// Whether a thruster was at its limit in the last step; `None` without an allocation among thrusters.
    pub fn saturated(&self) -> Option<bool> {
        match self {
            Self::Thrusters(pilot) => Some(pilot.saturated()),
            Self::Torpedo(_) | Self::Glider(_) => None,
        }
    }

    /// Set-points of the drives for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, estimate: &Estimate, dt_s: f64) -> DriveCommand {
        match self {
            Self::Torpedo(pilot) => pilot.step(command, estimate, dt_s),
            Self::Thrusters(pilot) => pilot.step(command, estimate, dt_s),
            Self::Glider(pilot) => pilot.step(command, estimate, dt_s),
        }
    }
}
