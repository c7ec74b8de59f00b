//! Steers a glider: a sawtooth by its buoyancy engine, pitch by its moving mass, heading by a fin.
//!
//! *Source:* Leonard & Graver, "Model-based feedback control of autonomous underwater gliders", IEEE J. Oceanic Eng. 26,
//! 2001; Graver 2005, "Underwater gliders: dynamics, control and design", section 2.
//!
//! *Parameters:* [`GliderSpec`].
//!
//! ```text
//! x_mass = (W z tan θ_d + ρ g V x_engine)/(m g) + K ∫(θ_d − θ)      K = W z/(m g)/40 s
//! rudder = K_r (r_d − r),   r_d = clamp(0.05/s e_ψ, ±r_max)
//! ```
//!
//! *Deviations:* the depth that the guidance asks for is not held: the glider goes between the two depths of its file,
//! and turns up when the bed comes near. Its speed is what the glide gives. Between glides the rudder has no effect.

use crate::handoff::{Command, DriveCommand, DriveEffect, Estimate, GliderSpec, Plant};
use nalgebra::Vector3;
use world::math;
use world::units::{GRAVITY_M_S2, SEA_WATER_KG_M3};

/// Commanded turn rate for each rad of heading error, 1/s.
const HEADING_1_S: f64 = 0.05;
/// Rudder for each rad/s of error in turn rate, s.
const RUDDER_S: f64 = 4.0;
/// Time in which the pitch's integral would move the mass as far as the pitch itself, s.
const TRIM_S: f64 = 40.0;

/// The autopilot.
#[derive(Clone, Debug, PartialEq)]
pub struct GliderPilot {
    spec: GliderSpec,
    plant: Plant,
    down: bool,
    /// ∫ pitch error, rad s.
    sum: f64,
}

impl GliderPilot {
    /// From what is known of the vehicle; it begins downwards.
    pub fn new(plant: &Plant, spec: &GliderSpec) -> Self {
        Self { spec: spec.clone(), plant: plant.clone(), down: true, sum: 0.0 }
    }

    /// Set-points of all drives for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, e: &Estimate, dt_s: f64) -> DriveCommand {
        let s = &self.spec;
        let near = e.altitude_m.is_some_and(|m| m < s.altitude_m.get());
        if self.down && (e.depth_m > s.deep_m.get() || near) {
            (self.down, self.sum) = (false, 0.0);
        } else if !self.down && e.depth_m < s.shallow_m.get() {
            (self.down, self.sum) = (true, 0.0);
        }
        let way = if self.down { -1.0 } else { 1.0 };
        let pitch = way * s.pitch_deg.get().to_radians();
        let error = pitch - e.attitude.pitch_rad;
        self.sum = (self.sum + error * dt_s).clamp(-2.0 * TRIM_S, 2.0 * TRIM_S);
        let turn = match command {
            // FLU: to starboard is negative.
            Command::Steer(set) => -HEADING_1_S * e.attitude.heading.turn_to(set.heading),
            Command::Move(set) => -HEADING_1_S * e.attitude.heading.turn_to(set.heading),
            Command::Direct(_) | Command::Drives(_) => 0.0,
        };
        let most = s.heading_rate_deg_s.get().to_radians();
        let helm = RUDDER_S * (turn.clamp(-most, most) - e.attitude.rates_rad_s.z);
        let volume = |k: usize| way * s.volume_share.get().min(1.0) * self.plant.drives[k].limits[1];
        let engine: Vector3<f64> = (self.plant.drives.iter().enumerate())
            .map(|(k, d)| match d.does {
                DriveEffect::Swells(at) => at * volume(k),
                _ => Vector3::zeros(),
            })
            .sum();
        let set = self.plant.drives.iter().enumerate().map(|(k, d)| {
            let [least, most] = d.limits;
            match &d.does {
                DriveEffect::Swells(_) => volume(k),
                DriveEffect::Shifts(way, kg) => {
                    let weight = kg * GRAVITY_M_S2;
                    let (sin, cos) = math::sin_cos(pitch);
                    let righting = self.plant.righting_n_m;
                    let lift = SEA_WATER_KG_M3 * GRAVITY_M_S2 * engine.x;
                    // A mass ahead puts the nose down.
                    let x = (lift - righting * sin / cos) / weight - righting / weight / TRIM_S * self.sum;
                    (x * way.x.signum()).clamp(least, most)
                }
                DriveEffect::Lifts(arm) if arm[5].abs() > arm[4].abs() => (helm * arm[5].signum()).clamp(least, most),
                DriveEffect::Lifts(_) | DriveEffect::Pushes(..) => d.idle,
            }
        });
        DriveCommand::new(&set.collect::<Vec<_>>())
    }
}
