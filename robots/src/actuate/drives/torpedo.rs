//! Steers a torpedo of a folder: the autopilot of the REMUS with gains from the hull, mixed to its fins.
//!
//! *Source:* as `autopilot.rs`; gains in `torpedo_gains.rs`.
//!
//! *Parameters:* [`TorpedoSpec`].
//!
//! *Deviations:* a fin turns for the rudder and for the stern plane in proportion to what it does in yaw and in pitch,
//! so crosses and X tails are steered alike. The propeller's number is a share of full thrust: 1000 is full thrust
//! ahead, and thrust goes with its square. It is never steered slower than the fins can steer it.

use super::super::autopilot::Autopilot;
use super::torpedo_gains::{FULL_RPM, gains};
use crate::handoff::{Command, DriveCommand, DriveEffect, Estimate, Plant, Setpoint, ThrustTable, TorpedoSpec};

/// A fin's part of the mix.
#[derive(Clone, Debug, PartialEq)]
struct FinShare {
    drive: usize,
    limit_rad: f64,
    /// Deflection for 1 rad of rudder and of stern plane.
    rudder: f64,
    stern: f64,
}

/// The autopilot.
#[derive(Clone, Debug, PartialEq)]
pub struct TorpedoPilot {
    autopilot: Autopilot,
    least_m_s: f64,
    idle: Vec<f64>,
    fins: Vec<FinShare>,
    propellers: Vec<(usize, f64, ThrustTable)>,
}

impl TorpedoPilot {
    /// From what is known of the vehicle.
    pub fn new(plant: &Plant, spec: &TorpedoSpec) -> Self {
        let arms = plant.drives.iter().filter_map(|d| match &d.does {
            DriveEffect::Lifts(arm) => Some(*arm),
            _ => None,
        });
        let (yaw, pitch) = arms.fold((1e-12f64, 1e-12f64), |(y, p), arm| (y.max(arm[5].abs()), p.max(arm[4].abs())));
        let mut fins = Vec::new();
        let mut propellers = Vec::new();
        for (k, drive) in plant.drives.iter().enumerate() {
            match &drive.does {
                DriveEffect::Lifts(arm) => fins.push(FinShare {
                    drive: k,
                    limit_rad: drive.limits[1],
                    // FLU: to starboard is a negative moment about z, nose down a positive one about y.
                    rudder: -arm[5] / yaw,
                    stern: arm[4] / pitch,
                }),
                DriveEffect::Pushes(arm, table) if arm[0].abs() > 0.5 => {
                    propellers.push((k, arm[0].signum(), table.clone()));
                }
                _ => {}
            }
        }
        Self {
            autopilot: Autopilot::new(&gains(plant, spec)),
            least_m_s: spec.least_speed_m_s(),
            idle: plant.drives.iter().map(|d| d.idle).collect(),
            fins,
            propellers,
        }
    }

    /// Set-points of all drives for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, estimate: &Estimate, dt_s: f64) -> DriveCommand {
        let command = match *command {
            Command::Steer(set) => {
                Command::Steer(Setpoint { water_speed_m_s: set.water_speed_m_s.max(self.least_m_s), ..set })
            }
            other => other,
        };
        let asked = self.autopilot.step(&command, estimate, dt_s);
        let mut set = self.idle.clone();
        for fin in &self.fins {
            let angle = fin.rudder * asked.rudder_rad + fin.stern * asked.stern_rad;
            set[fin.drive] = angle.clamp(-fin.limit_rad, fin.limit_rad);
        }
        let share = (asked.rpm / FULL_RPM).clamp(-1.0, 1.0);
        for (k, way, table) in &self.propellers {
            let [astern, ahead] = table.thrusts_n();
            let push = way * share * share.abs();
            set[*k] = table.input(if push < 0.0 { -push * astern } else { push * ahead });
        }
        DriveCommand::new(&set)
    }
}
