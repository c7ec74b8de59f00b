//! Gains of a torpedo's autopilot from its hull: inertia, righting moment, damping, fins.
//!
//! *Source:* pole placement for heading and pitch, Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control",
//! 2nd ed. 2021, section 15.3; the ratios of the loops are those of the shipped REMUS's autopilot.
//!
//! *Parameters:* [`TorpedoSpec`]: speed U_0, ω_ψ `heading_rad_s`, ω_θ `pitch_rad_s`.
//!
//! ```text
//! N_δ, M_δ: moments of rudder and stern plane at U_0      rudder for a rate: from a steady turn in sway and yaw
//! K_h = ω_ψ   K_r = 1.8 ω_ψ I_z/N_δ   K_θ = (ω_θ² I_y − W z)/M_δ   K_q = ω_θ I_y/(2 M_δ)   K_θff = W z/M_δ
//! K_z = 0.21/U_0   K_zi = K_z/30 s
//! ```
//!
//! *Deviations:* the steady turn is that of the blocks, the Munk moment and the fins' incidence, level and without roll.

use super::super::spec::AutopilotSpec;
use crate::handoff::{DriveEffect, Plant, TorpedoSpec};
use nalgebra::{Matrix2, Vector2, Vector3, Vector6};
use world::ranges::{NonNegative, Positive};
use world::units::SEA_WATER_KG_M3;

/// The propeller's number at full thrust.
pub(super) const FULL_RPM: f64 = 1000.0;
/// Turn rate of the steady turn, rad/s.
const TURN_RAD_S: f64 = 0.05;
/// Loop of depth at the design speed, 1/s, and time of its integral, s: those of the REMUS.
const DEPTH_1_S: f64 = 0.21;
const DEPTH_S: f64 = 30.0;

/// The gains.
pub(super) fn gains(plant: &Plant, spec: &TorpedoSpec) -> AutopilotSpec {
    let u = spec.design_speed_m_s.get();
    let (yaw, pitch) = (wrench(plant, 5, u), wrench(plant, 4, u));
    let (N, M) = (yaw[5].abs().max(1e-9), pitch[4].abs().max(1e-9));
    let (iz, iy) = (plant.mass[(5, 5)], plant.mass[(4, 4)]);
    let (wh, wp) = (spec.heading_rad_s.get(), spec.pitch_rad_s.get());
    let stiff = wp * wp * iy;
    let rudder = turning(plant, u, &yaw).max(0.0);
    let per_m_s = FULL_RPM / plant.top_speed_m_s.max(0.1);
    let fin = plant.drives.iter().filter_map(|d| match d.does {
        DriveEffect::Lifts(_) => Some(d.limits[1]),
        _ => None,
    });
    let fin_deg = fin.fold(f64::INFINITY, f64::min).to_degrees();
    let positive = |v: f64| Positive::new(v.max(1e-6));
    let depth_deg_m = (DEPTH_1_S / u).to_degrees();
    AutopilotSpec {
        heading_gain_1_s: positive(wh),
        heading_rate_deg_s: spec.heading_rate_deg_s,
        rudder_per_rate_s: NonNegative::new(rudder),
        rate_gain_s: positive(1.8 * wh * iz / N),
        heading_integral_1_s: NonNegative::new(0.04 * 1.8 * wh * wh * iz / N),
        heading_trim_limit_deg: Positive::new(2.0),
        depth_gain_deg_m: positive(depth_deg_m),
        depth_integral_deg_m_s: NonNegative::new(depth_deg_m / DEPTH_S),
        pitch_limit_deg: spec.pitch_limit_deg,
        stern_per_pitch: NonNegative::new(plant.righting_n_m / M),
        pitch_gain: positive((stiff - plant.righting_n_m).max(0.2 * stiff) / M),
        pitch_rate_gain_s: NonNegative::new(0.5 * wp * iy / M),
        rpm_per_speed: positive(per_m_s),
        speed_integral_rpm_m: NonNegative::new(0.05 * per_m_s),
        design_speed_m_s: spec.design_speed_m_s,
        fin_limit_deg: positive(fin_deg.min(90.0)),
        rpm_limit: Positive::new(FULL_RPM),
    }
}

/// Force and moment of 1 rad of the mix that turns about an axis, at a speed.
fn wrench(plant: &Plant, axis: usize, u: f64) -> Vector6<f64> {
    let arms = || {
        plant.drives.iter().filter_map(|d| match &d.does {
            DriveEffect::Lifts(arm) => Some(arm),
            _ => None,
        })
    };
    let most = arms().map(|a| a[axis].abs()).fold(1e-12, f64::max);
    arms().map(|a| a * (a[axis] / most)).sum::<Vector6<f64>>() * (SEA_WATER_KG_M3 * u * u)
}

/// Rudder, rad, for each rad/s of a steady turn.
fn turning(plant: &Plant, u: f64, yaw: &Vector6<f64>) -> f64 {
    let rest = |v: f64, rudder: f64| {
        let nu = Vector6::new(u, v, 0.0, 0.0, 0.0, TURN_RAD_S);
        let force = free(plant, &nu) + yaw * rudder;
        Vector2::new(force[1], force[5])
    };
    let (mut v, mut rudder) = (0.0, 0.0);
    for _ in 0..20 {
        let now = rest(v, rudder);
        let h = 1e-6;
        let jacobian = Matrix2::from_columns(&[(rest(v + h, rudder) - now) / h, (rest(v, rudder + h) - now) / h]);
        let Some(step) = jacobian.lu().solve(&now) else {
            return 0.0;
        };
        v -= step.x;
        rudder -= step.y;
    }
    // The mix turns to port for a positive angle; its size is what counts.
    let per_rate = (rudder / TURN_RAD_S).abs();
    if per_rate.is_finite() { per_rate } else { 0.0 }
}

/// Force on a hull that moves steadily, with fins at zero.
fn free(plant: &Plant, nu: &Vector6<f64>) -> Vector6<f64> {
    let part = |a: &Vector6<f64>, k: usize| Vector3::new(a[k], a[k + 1], a[k + 2]);
    let v = part(nu, 0);
    let coriolis = plant.coriolis(&v, &part(nu, 3));
    let [linear, quadratic, forward] = &plant.damping;
    let squared = nu.map(|v| v * v.abs());
    let mut all = -coriolis - linear * nu - quadratic * squared - forward * nu * nu.x.abs();
    let speed = v.norm();
    for drive in &plant.drives {
        if let DriveEffect::Lifts(arm) = &drive.does {
            // The power of its force at 1 rad is that force times the water's speed across it.
            let size = part(arm, 0).norm().max(1e-12);
            all -= arm * (SEA_WATER_KG_M3 * speed * arm.dot(nu) / size);
        }
    }
    all
}
