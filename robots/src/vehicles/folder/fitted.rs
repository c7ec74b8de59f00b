//! Puts the drives of a vehicle's file on the links of its URDF.
//!
//! *Source:* none.
//!
//! *Parameters:* [`DriveSpec`].
//!
//! *Deviations:* none.

use crate::handoff::MOST_DRIVES;
use crate::vehicles::drives::{Drive, DriveSpec, Fin, Follows, Kind, Thruster, table};
use crate::vehicles::dynamics::flip;
use nalgebra::Vector3;
use std::collections::BTreeMap;
use world::frames::Pose;
use world::spelling::choose;

/// The drives on their links.
pub(super) fn drives(
    specs: &[DriveSpec],
    links: &BTreeMap<String, Pose>,
) -> Result<Vec<Drive>, String> {
    if specs.len() > MOST_DRIVES {
        return Err(format!(
            "drives: at most {MOST_DRIVES}, got {}",
            specs.len()
        ));
    }
    specs
        .iter()
        .enumerate()
        .map(|(k, spec)| drive(spec, links).map_err(|problem| format!("drives[{k}].{problem}")))
        .collect()
}

fn drive(spec: &DriveSpec, links: &BTreeMap<String, Pose>) -> Result<Drive, String> {
    let at = |link: &str| {
        links.get(link).copied().ok_or_else(|| {
            let near: Vec<&str> = links.keys().map(String::as_str).collect();
            let hint = choose(link, &near, "links");
            format!("link: no link \"{link}\" in the URDF; {hint}")
        })
    };
    let axis = |pose: &Pose, axis: Vector3<f64>| flip(pose.R_WB * axis);
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
                    axis: axis(&pose, Vector3::x()),
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
            Drive {
                link: f.link.clone(),
                limits: [-limit, limit],
                follows: Follows::Lag(f.lag_s.get()),
                kind: Kind::Fin(Fin {
                    r: flip(pose.p_WB),
                    chord: axis(&pose, Vector3::x()),
                    lift: axis(&pose, Vector3::z()),
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
                kind: Kind::Mass(axis(&pose, Vector3::x()), m.mass_kg.get(), m.power_w.get()),
            }
        }
    })
}
