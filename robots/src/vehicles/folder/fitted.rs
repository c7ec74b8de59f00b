//! Puts the drives of a vehicle's file on the links of its URDF, along the axes of their joints.
//!
//! *Source:* none.
//!
//! *Parameters:* [`DriveSpec`].
//!
//! *Deviations:* none.

use crate::handoff::MOST_DRIVES;
use crate::vehicles::drives::{Drive, DriveSpec, Fin, Follows, Kind, Thruster, table};
use crate::vehicles::dynamics::flip;
use crate::vehicles::urdf::Shell;
use crate::vehicles::urdf_parts::drive_axis;
use nalgebra::Vector3;
use world::frames::Pose;
use world::spelling::choose;

/// The drives on their links.
pub(super) fn drives(specs: &[DriveSpec], shell: &Shell) -> Result<Vec<Drive>, String> {
    if specs.len() > MOST_DRIVES {
        return Err(format!(
            "drives: at most {MOST_DRIVES}, got {}",
            specs.len()
        ));
    }
    specs
        .iter()
        .enumerate()
        .map(|(k, spec)| drive(spec, shell).map_err(|problem| format!("drives[{k}].{problem}")))
        .collect()
}

fn drive(spec: &DriveSpec, shell: &Shell) -> Result<Drive, String> {
    let at = |link: &str| {
        shell.links.get(link).copied().ok_or_else(|| {
            let near: Vec<&str> = shell.links.keys().map(String::as_str).collect();
            let hint = choose(link, &near, "links");
            format!("link: no link \"{link}\" in the URDF; {hint}")
        })
    };
    let axis = |pose: &Pose, axis: Vector3<f64>| flip(pose.R_WB * axis);
    let along = |link: &str| drive_axis(Vector3::x(), shell.axes.get(link));
    Ok(match spec {
        DriveSpec::Thruster(t) => {
            let pose = at(&t.link)?;
            let curve = table(&t.curve).map_err(|problem| format!("curve: {problem}"))?;
            Drive {
                link: t.link.clone(),
                limits: curve.inputs(),
                follows: Follows::Lag(t.lag_s.get()),
                kind: Kind::Thruster(Thruster {
                    r: flip(pose.p_WB),
                    axis: axis(&pose, along(&t.link)),
                    curve,
                    runs_free_m_s: t.runs_free_m_s.map(|v| v.get()),
                    torque_m: t.torque_m.get(),
                    power_w_n: t.power_w_n.get(),
                }),
            }
        }
        DriveSpec::Fin(f) => {
            let pose = at(&f.link)?;
            let limit = f.limit_deg.get().to_radians();
            let hinge = drive_axis(Vector3::y(), shell.axes.get(&f.link));
            let chord = Vector3::x() - hinge * hinge.x;
            let chord = chord.try_normalize(0.1).ok_or_else(|| {
                format!(
                    "link: the joint of \"{}\" turns it about its chord, x, which does nothing",
                    f.link
                )
            })?;
            Drive {
                link: f.link.clone(),
                limits: [-limit, limit],
                follows: Follows::Lag(f.lag_s.get()),
                kind: Kind::Fin(Fin {
                    r: flip(pose.p_WB),
                    chord: axis(&pose, chord),
                    lift: axis(&pose, chord.cross(&hinge)),
                    area_m2: f.area_m2.get(),
                    slope: f.lift_slope.get(),
                    drag_0: f.drag_0.get(),
                    stall_rad: f.stall_deg.get().to_radians(),
                    plate: f.plate.get(),
                    limit_rad: limit,
                }),
            }
        }
        DriveSpec::BuoyancyEngine(b) => {
            let pose = at(&b.link)?;
            let limit = b.limit_m3.get();
            Drive {
                link: b.link.clone(),
                limits: [-limit, limit],
                follows: Follows::Rate(b.rate_m3_s.get()),
                kind: Kind::Buoyancy(flip(pose.p_WB), b.power_w.get()),
            }
        }
        DriveSpec::MovingMass(m) => {
            let pose = at(&m.link)?;
            let travel = m.travel_m.get();
            Drive {
                link: m.link.clone(),
                limits: [-travel, travel],
                follows: Follows::Rate(m.rate_m_s.get()),
                kind: Kind::Mass(
                    axis(&pose, along(&m.link)),
                    m.mass_kg.get(),
                    m.power_w.get(),
                ),
            }
        }
    })
}
