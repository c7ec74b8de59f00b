//! What an autopilot knows of a vehicle of a folder, and what the vehicle can do.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, section 11.2 (control
//! allocation: the columns of the configuration matrix).
//!
//! *Parameters:* none.
//!
//! *Deviations:* a vehicle pushes in a direction if its thrusters, within their limits, can give a share
//! [`WORTH`] of the force of their sum there. Speeds are where thrust balances the drag of the blocks, in a straight
//! line.

use super::blocks::Damping;
use crate::handoff::{Capabilities, DriveEffect, PilotSpec, Plant, PlantDrive};
use crate::vehicles::drives::{Drive, Fin, Kind};
use crate::vehicles::dynamics::{turned, wrench};
use crate::vehicles::motion::Statics;
use nalgebra::{DMatrix, Vector3, Vector6};
use world::ranges::Positive;
use world::units::{GRAVITY_M_S2, SEA_WATER_KG_M3};

/// Least share of the thrusters' summed force that counts as a push in a direction.
const WORTH: f64 = 0.05;

/// What the autopilot knows.
pub(super) fn plant(statics: &Statics, damping: &Damping, drives: &[Drive], pilot: &PilotSpec) -> Plant {
    let flu = |r: &Vector3<f64>| Vector3::new(r.x, -r.y, -r.z);
    let each = drives.iter().map(|drive| PlantDrive {
        limits: drive.limits,
        idle: drive.idle(),
        does: match &drive.kind {
            Kind::Thruster(t) => DriveEffect::Pushes(wrench(t.arm()), t.curve.clone()),
            Kind::Fin(fin) => DriveEffect::Lifts(lifts(fin)),
            Kind::Buoyancy(r, _) => DriveEffect::Swells(flu(r)),
            Kind::Mass(way, kg, _) => DriveEffect::Shifts(flu(way), *kg),
        },
    });
    let mut plant = Plant {
        mass: statics.whole_mass,
        damping: [&damping.linear, &damping.quadratic, &damping.forward].map(turned),
        righting_n_m: statics.righting_n_m,
        heavy_n: statics.heavy_n,
        volume_m3: statics.volume_m3,
        drives: each.collect(),
        pushes: [false; 6],
        top_speed_m_s: 0.0,
        pilot: pilot.clone(),
    };
    plant.top_speed_m_s = top_speed_m_s(&plant, drives);
    plant.pushes = pushes(&plant);
    plant
}

/// Force of 1 rad at 1 m/s and 1 kg/m³.
fn lifts(fin: &Fin) -> Vector6<f64> {
    let force = fin.lift * (-0.5 * fin.area_m2 * fin.slope);
    wrench((force, fin.r.cross(&force)))
}

/// Where all thrusters, together ahead, balance the drag.
fn top_speed_m_s(plant: &Plant, drives: &[Drive]) -> f64 {
    let drag = |u: f64| {
        let d = &plant.damping;
        (d[0][(0, 0)] + (d[1][(0, 0)] + d[2][(0, 0)]) * u) * u
    };
    let thrust = |u: f64| -> f64 {
        let each = drives.iter().filter_map(|d| match &d.kind {
            Kind::Thruster(t) => Some(t),
            _ => None,
        });
        each.map(|t| {
            let [astern, ahead] = t.curve.thrusts_n();
            // Used in the direction in which it pushes ahead.
            let full = if t.axis.x > 0.0 { ahead } else { astern };
            let inflow = (t.axis.x.abs() * u).max(0.0);
            let left = t.runs_free_m_s.map_or(1.0, |free| (1.0 - inflow / free).max(0.0));
            full * t.axis.x * left
        })
        .sum()
    };
    let (mut slow, mut fast) = (0.0, 50.0);
    for _ in 0..60 {
        let middle = (slow + fast) / 2.0;
        if thrust(middle) > drag(middle) {
            slow = middle;
        } else {
            fast = middle;
        }
    }
    slow
}

/// Directions (surge, sway, heave, roll, pitch, yaw) in which thrusters push, each without the others.
fn pushes(plant: &Plant) -> [bool; 6] {
    let columns: Vec<Vector6<f64>> = plant
        .drives
        .iter()
        .filter_map(|d| match &d.does {
            DriveEffect::Pushes(arm, _) => Some(*arm),
            _ => None,
        })
        .collect();
    let mut pushes = [false; 6];
    if columns.is_empty() {
        return pushes;
    }
    let B = DMatrix::from_fn(6, columns.len(), |i, j| columns[j][i]);
    let arm = B.rows(3, 3).amax().max(1e-9);
    let scale = |i: usize| if i < 3 { 1.0 } else { arm };
    let scaled = DMatrix::from_fn(6, columns.len(), |i, j| B[(i, j)] / scale(i));
    let Ok(inverse) = scaled.clone().pseudo_inverse(1e-6) else {
        return pushes;
    };
    // The part of each pure direction that the thrusters can give.
    let given = &scaled * inverse;
    for (k, push) in pushes.iter_mut().enumerate() {
        let alone = scaled.row(k).amax() > WORTH;
        *push = alone && given[(k, k)] > 0.5;
    }
    pushes
}

/// What the vehicle can do.
pub(super) fn capabilities(plant: &Plant, pilot: &PilotSpec) -> Capabilities {
    let top_speed_m_s = plant.top_speed_m_s;
    match pilot {
        PilotSpec::Thrusters(spec) => {
            let [_, sway, heave, ..] = plant.pushes;
            Capabilities {
                least_speed_m_s: 0.0,
                top_speed_m_s: top_speed_m_s.min(spec.speed_m_s.get()),
                turning_radius_m: 0.0,
                hovers: sway,
                sideways: sway,
                dives: heave,
                holds_depth: heave,
            }
        }
        PilotSpec::Torpedo(spec) => Capabilities {
            least_speed_m_s: spec.least_speed_m_s(),
            top_speed_m_s,
            turning_radius_m: turning_m(spec.turn_radius_m, spec.design_speed_m_s.get(), spec.heading_rate_deg_s),
            ..Capabilities::default()
        },
        PilotSpec::Glider(spec) => {
            let speed = glide_m_s(plant, spec.pitch_deg.get(), spec.volume_share.get());
            Capabilities {
                least_speed_m_s: 0.5 * speed,
                top_speed_m_s: speed,
                turning_radius_m: turning_m(spec.turn_radius_m, speed, spec.heading_rate_deg_s),
                holds_depth: false,
                ..Capabilities::default()
            }
        }
    }
}

/// Radius of the tightest turn, m: as stated, or that of a speed, m/s, and the greatest rate.
fn turning_m(stated: Option<Positive>, speed_m_s: f64, rate_deg_s: Positive) -> f64 {
    stated.map_or(speed_m_s / rate_deg_s.get().to_radians(), Positive::get)
}

/// Horizontal speed of a steady glide, m/s: the weight along the path balances the drag ahead.
fn glide_m_s(plant: &Plant, pitch_deg: f64, share: f64) -> f64 {
    let volume = plant.drives.iter().map(|d| match d.does {
        DriveEffect::Swells(_) => d.limits[1],
        _ => 0.0,
    });
    let force = SEA_WATER_KG_M3 * GRAVITY_M_S2 * volume.sum::<f64>() * share;
    let (sin, cos) = world::math::sin_cos(pitch_deg.to_radians());
    let d = &plant.damping;
    let (linear, quadratic) = (d[0][(0, 0)], d[1][(0, 0)] + d[2][(0, 0)]);
    let along = force * sin;
    let u = if quadratic > 0.0 {
        (-linear + (linear * linear + 4.0 * quadratic * along).sqrt()) / (2.0 * quadratic)
    } else {
        along / linear.max(1e-9)
    };
    u * cos
}

/// Refuses drives with which the autopilot cannot steer, and tells what is doubtful.
pub(super) fn doubts(
    pilot: &PilotSpec,
    plant: &Plant,
    capabilities: &Capabilities,
    told: &mut Vec<String>,
) -> Result<(), String> {
    let has = |what: fn(&DriveEffect) -> bool| plant.drives.iter().any(|d| what(&d.does));
    let thruster = has(|d| matches!(d, DriveEffect::Pushes(..)));
    let fin = has(|d| matches!(d, DriveEffect::Lifts(..)));
    let lacks = |what: &str| Err(format!("autopilot: needs {what}, and `drives` has none"));
    match pilot {
        PilotSpec::Torpedo(_) => {
            if !thruster {
                return lacks("a thruster");
            }
            if !fin {
                return lacks("fins");
            }
            let moments = |k: usize| {
                plant.drives.iter().any(|d| match &d.does {
                    DriveEffect::Lifts(arm) => arm[k].abs() > 1e-12,
                    _ => false,
                })
            };
            if !moments(5) || !moments(4) {
                return lacks("fins that turn it in yaw and in pitch");
            }
        }
        PilotSpec::Thrusters(spec) => {
            if !thruster {
                return lacks("thrusters");
            }
            let [surge, _, heave, _, _, yaw] = plant.pushes;
            if !surge || !yaw {
                return lacks("thrusters that push ahead and turn it");
            }
            if spec.speed_m_s.get() > 1.05 * plant.top_speed_m_s {
                told.push(format!(
                    "autopilot.speed_m_s: {} m/s is more than its thrusters can do, {:.2} m/s",
                    spec.speed_m_s.get(),
                    plant.top_speed_m_s
                ));
            }
            if heave {
                let up: f64 = plant
                    .drives
                    .iter()
                    .map(|d| match &d.does {
                        DriveEffect::Pushes(arm, curve) => {
                            let [astern, ahead] = curve.thrusts_n();
                            (arm[2] * ahead).abs().min((arm[2] * astern).abs())
                        }
                        _ => 0.0,
                    })
                    .sum();
                if plant.heavy_n.abs() > up {
                    told.push(format!(
                        "its thrusters push {up:.1} N up or down, and it is {:.1} N {}: they cannot hold its depth",
                        plant.heavy_n.abs(),
                        if plant.heavy_n > 0.0 { "heavy" } else { "light" }
                    ));
                }
            }
        }
        PilotSpec::Glider(_) => {
            if !has(|d| matches!(d, DriveEffect::Swells(_))) {
                return lacks("a buoyancy engine");
            }
            if !has(|d| matches!(d, DriveEffect::Shifts(..))) {
                return lacks("a moving mass");
            }
            if !fin {
                return lacks("a fin as rudder");
            }
        }
    }
    if capabilities.top_speed_m_s < 0.05 {
        told.push("it can hardly move ahead".into());
    }
    Ok(())
}
