//! Steers a vehicle that has thrusters only: speeds in all directions in which it can push, heading and depth.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, sections 15.3 (model
//! based speed and position control with integral action) and 11.2 (allocation).
//!
//! *Parameters:* [`ThrustersSpec`]: greatest speeds and turn rate; T `speed_lag_s`; ω `loop_rad_s`.
//!
//! ```text
//! heading: r_d = clamp(ω e_ψ, ±r_max)     depth: w_d = clamp(ω e_z, ±w_max)
//! a_d = (ν_d − ν)/T + ∫(ν_d − ν)/(4 T²)   in surge, sway, heave and yaw (T = 1/(2 ω) in yaw)
//! roll, pitch: a_d = −4 ω² φ − 4 ω p      where thrusters can
//! τ = M a_d + C(ν) ν + D ν_w + D_q |ν_w|∘ν_w + |u| D_u ν_w − weight + buoyancy,   ν_w = ν_d through the water
//! ```
//!
//! C(ν) ν, of the velocities as they are believed, holds against the moment of Munk, which turns a short hull over.
//!
//! *Deviations:* velocities of a [`MoveSetpoint`] are over ground, those of a [`Setpoint`] ahead through the water; the
//! drag is that of the water's speed as it is believed. Without a flow estimate the water counts as at rest, and the
//! integrals take up its drag. Integrals stand still while a thruster is at its limit. Without an altitude the vehicle
//! stays at its depth. A table of fins and propeller (`OpenLoop`) is read as shares: the propeller's of the greatest
//! thrust ahead (of 1000 rpm), the rudder's of the greatest turn rate (of 15 degrees).

use super::allocation::Allocation;
use crate::handoff::{
    Command, DriveCommand, DriveEffect, Estimate, MoveSetpoint, Plant, Setpoint, ThrustTable, ThrustersSpec, Vertical,
};
use nalgebra::{UnitQuaternion, Vector2, Vector3, Vector6};

/// Importance of surge, sway, heave, roll, pitch, yaw when thrusters are at their limits.
const IMPORTANCE: [f64; 6] = [1.0, 1.0, 3.0, 5.0, 5.0, 3.0];
/// Full power and full helm of a table of fins and propeller.
const FULL_RPM: f64 = 1000.0;
const FULL_RAD: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Greatest acceleration that an integral gives, as a share of its direction's speed limit for each T.
const TRIM: f64 = 1.0;

/// The autopilot.
#[derive(Clone, Debug, PartialEq)]
pub struct ThrusterPilot {
    spec: ThrustersSpec,
    plant: Plant,
    allocation: Allocation,
    thrusters: Vec<(usize, ThrustTable)>,
    /// ∫ error of surge, sway, heave (m) and yaw (rad).
    sums: [f64; 4],
    saturated: bool,
}

impl ThrusterPilot {
    /// From what is known of the vehicle.
    pub fn new(plant: &Plant, spec: &ThrustersSpec) -> Self {
        let mut thrusters = Vec::new();
        let (mut arms, mut limits) = (Vec::new(), Vec::new());
        for (k, drive) in plant.drives.iter().enumerate() {
            if let DriveEffect::Pushes(arm, table) = &drive.does {
                arms.push(*arm);
                limits.push(table.thrusts_n());
                thrusters.push((k, table.clone()));
            }
        }
        let longest = arms.iter().map(|a| a.fixed_rows::<3>(3).norm());
        let longest = longest.fold(1e-3, f64::max);
        let weights = Vector6::from_fn(|k, _| {
            let unit = if k < 3 { 1.0 } else { longest };
            if plant.pushes[k] { IMPORTANCE[k] / unit } else { 0.0 }
        });
        Self {
            allocation: Allocation::new(&arms, limits, weights),
            thrusters,
            spec: spec.clone(),
            plant: plant.clone(),
            sums: [0.0; 4],
            saturated: false,
        }
    }

    /// Whether a thruster was at its limit in the last step.
    pub fn saturated(&self) -> bool {
        self.saturated
    }

    /// Set-points of all drives for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, e: &Estimate, dt_s: f64) -> DriveCommand {
        let water = e.flow.map_or(Vector2::zeros(), |f| f.velocity);
        let (water_ahead, water_left) = in_body(e, &water);
        let climb = |vertical: Vertical| match vertical {
            Vertical::Depth(m) => e.depth_m - m,
            Vertical::Altitude(m) => e.altitude_m.map_or(0.0, |now| m - now),
        };
        let s = &self.spec;
        let (wanted, turn, up) = match command {
            // They do not come here: the drives take them as they are.
            Command::Drives(_) => (Vector2::new(water_ahead, water_left), TurnDemand::Rate(0.0), 0.0),
            Command::Direct(table) => {
                let share = |of: f64, full: f64| (of / full).clamp(-1.0, 1.0);
                let ahead = share(table.rpm, FULL_RPM) * s.speed_m_s.get();
                let rate = -share(table.rudder_rad, FULL_RAD) * s.turn_deg_s.get().to_radians();
                (Vector2::new(ahead + water_ahead, water_left), TurnDemand::Rate(rate), 0.0)
            }
            Command::Steer(Setpoint { heading, water_speed_m_s, vertical }) => (
                Vector2::new(water_speed_m_s + water_ahead, water_left),
                TurnDemand::To(-e.attitude.heading.turn_to(*heading)),
                climb(*vertical),
            ),
            Command::Move(MoveSetpoint { heading, over_ground_m_s, vertical }) => {
                let (ahead, left) = in_body(e, over_ground_m_s);
                (Vector2::new(ahead, left), TurnDemand::To(-e.attitude.heading.turn_to(*heading)), climb(*vertical))
            }
        };
        let tau = self.force(e, wanted, Vector2::new(water_ahead, water_left), turn, up, dt_s);
        let allotted = self.allocation.share(&tau);
        self.saturated = allotted.saturated;
        let mut set: Vec<f64> = self.plant.drives.iter().map(|d| d.idle).collect();
        for ((k, table), n) in self.thrusters.iter().zip(&allotted.thrusts_n) {
            set[*k] = table.input(*n);
        }
        DriveCommand::new(&set)
    }

    /// Force and moment, FLU, for velocities over ground (ahead, left), a turn and a height to climb.
    fn force(
        &mut self,
        e: &Estimate,
        wanted: Vector2<f64>,
        water: Vector2<f64>,
        turn: TurnDemand,
        up_m: f64,
        dt_s: f64,
    ) -> Vector6<f64> {
        let s = &self.spec;
        let loop_rad_s = s.loop_rad_s.get();
        let lag_s = s.speed_lag_s.get();
        // Limits hold for the speed through the water.
        let ahead = (wanted.x - water.x).clamp(-s.speed_m_s.get(), s.speed_m_s.get());
        let left = (wanted.y - water.y).clamp(-s.sideways_m_s.get(), s.sideways_m_s.get());
        let climb_most = s.climb_m_s.get();
        let climb = (loop_rad_s * up_m).clamp(-climb_most, climb_most);
        let turn_most = s.turn_deg_s.get().to_radians();
        let rate = match turn {
            TurnDemand::To(error) => (loop_rad_s * error).clamp(-turn_most, turn_most),
            TurnDemand::Rate(rate) => rate,
        };
        let rates = e.attitude.rates_rad_s;
        let tilt = UnitQuaternion::from_euler_angles(e.attitude.roll_rad, -e.attitude.pitch_rad, 0.0);
        // Velocity in level axes that turn with the heading.
        let v = tilt * e.v_ground_body;
        let errors = [ahead + water.x - v.x, left + water.y - v.y, climb - v.z, rate - rates.z];
        let lags = [lag_s, lag_s, lag_s, 0.5 / loop_rad_s];
        let most = [s.speed_m_s.get(), s.sideways_m_s.get(), climb_most, turn_most];
        let mut a = [0.0; 4];
        for k in 0..4 {
            let trim = TRIM * most[k] * 4.0 * lags[k];
            if !self.saturated && errors[k].abs() < 0.5 * most[k] {
                self.sums[k] = (self.sums[k] + errors[k] * dt_s).clamp(-trim, trim);
            }
            a[k] = errors[k] / lags[k] + self.sums[k] / (4.0 * lags[k] * lags[k]);
        }
        let stiff = 4.0 * loop_rad_s * loop_rad_s;
        let damped = 4.0 * loop_rad_s;
        let back = tilt.inverse();
        let linear = back * Vector3::new(a[0], a[1], a[2]);
        let pushes = &self.plant.pushes;
        // A direction in which it does not push is not commanded: it would only disturb the others.
        let only = |k: usize, v: f64| if pushes[k] { v } else { 0.0 };
        let roll = -stiff * e.attitude.roll_rad - damped * rates.x;
        // FLU: nose up is a negative turn about y.
        let pitch = stiff * e.attitude.pitch_rad - damped * rates.y;
        let acceleration = Vector6::new(
            only(0, linear.x),
            only(1, linear.y),
            only(2, linear.z),
            only(3, roll),
            only(4, pitch),
            only(5, a[3]),
        );
        let through = back * Vector3::new(ahead, only(1, left), only(2, climb));
        let nu = Vector6::new(through.x, through.y, through.z, 0.0, 0.0, rate);
        let squared = nu.map(|v| v * v.abs());
        let [linear, quadratic, forward] = &self.plant.damping;
        let drag = linear * nu + quadratic * squared + forward * nu * nu.x.abs();
        let carried = back * Vector3::new(0.0, 0.0, self.plant.heavy_n);
        let now = e.v_ground_body - back * Vector3::new(water.x, water.y, 0.0);
        let mut tau = self.plant.mass * acceleration + drag + self.plant.coriolis(&now, &rates);
        for k in 0..3 {
            tau[k] += carried[k];
        }
        // What rights it by itself need not be pushed against: it is held level, not at a tilt.
        tau
    }
}

/// How it is to turn, FLU (to port positive).
#[derive(Clone, Copy, Debug)]
enum TurnDemand {
    /// By an angle, rad.
    To(f64),
    /// At a rate, rad/s.
    Rate(f64),
}

/// A horizontal velocity (east, north) ahead and to the left of the heading.
fn in_body(e: &Estimate, v: &Vector2<f64>) -> (f64, f64) {
    let bow = e.attitude.heading.unit();
    (v.dot(&bow), v.dot(&Vector2::new(-bow.y, bow.x)))
}
