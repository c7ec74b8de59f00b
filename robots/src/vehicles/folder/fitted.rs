//! Puts the drives of a vehicle's file on the links of its URDF.
//!
//! *Source:* ROS URDF, XML specification of `joint` (`axis`).
//!
//! *Parameters:* [`DriveSpec`].
//!
//! *Deviations:* a drive acts along the axis of the joint that carries its link, as in gz-sim's Thruster plugin. URDF
//! says that a fixed joint has none: there the drive acts along an axis of the link.

use crate::error::ensure;
use crate::handoff::MOST_DRIVES;
use crate::vehicles::drives::{Drive, DriveSpec, Fin, Follows, Kind, Thruster, table};
use crate::vehicles::dynamics::flip;
use crate::vehicles::urdf::Shell;
use nalgebra::Vector3;
use world::frames::Pose;
use world::spelling::choose;

/// The drives on their links.
pub(super) fn drives(specs: &[DriveSpec], shell: &Shell, told: &mut Vec<String>) -> Result<Vec<Drive>, String> {
    ensure(specs.len() <= MOST_DRIVES, || format!("drives: at most {MOST_DRIVES}, got {}", specs.len()))?;
    let mut all = Vec::new();
    for (k, spec) in specs.iter().enumerate() {
        let mut doubts = Vec::new();
        let built = drive(spec, shell, &mut doubts);
        all.push(built.map_err(|problem| format!("drives[{k}].{problem}"))?);
        told.extend(doubts.into_iter().map(|d| format!("drives[{k}].{d}")));
    }
    Ok(all)
}

fn drive(spec: &DriveSpec, shell: &Shell, doubts: &mut Vec<String>) -> Result<Drive, String> {
    let at = |link: &str| {
        let links = &shell.links;
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
            let along = axle(&t.link, Vector3::x(), shell, doubts)?;
            Drive {
                link: t.link.clone(),
                limits: curve.inputs(),
                follows: Follows::Lag(t.lag_s.get()),
                kind: Kind::Thruster(Thruster {
                    r: flip(pose.p_WB),
                    axis: axis(&pose, along),
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
            let hinge = axle(&f.link, Vector3::y(), shell, doubts)?;
            let chord = chord(&pose, &hinge).ok_or_else(|| {
                format!(
                    "link: the fin on \"{}\" turns about an axis along the hull, so it cannot steer: {}; give the \
                     direction of its hinge, such as <axis xyz=\"0 1 0\"/> (without <axis>, URDF takes 1 0 0)",
                    f.link,
                    carried(&f.link, shell)
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
            let along = axle(&m.link, Vector3::x(), shell, doubts)?;
            Drive {
                link: m.link.clone(),
                limits: [-travel, travel],
                follows: Follows::Rate(m.rate_m_s.get()),
                kind: Kind::Mass(axis(&pose, along), m.mass_kg.get(), m.power_w.get()),
            }
        }
    })
}

/// Axis of a drive in the axes of its link: that of the joint that carries it, or `still` if that joint does not move.
fn axle(link: &str, still: Vector3<f64>, shell: &Shell, doubts: &mut Vec<String>) -> Result<Vector3<f64>, String> {
    let Some(carrier) = shell.carriers.get(link) else {
        return Ok(still);
    };
    let unit = carrier.axis.normalize();
    let is_unit = (unit.norm() - 1.0).abs() < 1e-9;
    match carrier.moves {
        true if is_unit => Ok(unit),
        true => Err(format!("link: {}: <axis> must be a direction", carried(link, shell))),
        false => {
            // Who writes no axis, or writes none of all, or the link's own, means nothing by it.
            let meant = is_unit && unit != Vector3::x() && unit.dot(&still) < ALONG;
            if meant {
                let name = if still.x == 1.0 { "x" } else { "y" };
                doubts.push(format!(
                    "link: {}, which does not count because the joint is fixed: the drive has its link's {name} axis. \
                     If <axis> is meant, make the joint continuous, revolute or prismatic",
                    carried(link, shell)
                ));
            }
            Ok(still)
        }
    }
}

/// Cosine of the angle up to which directions count as the same.
const ALONG: f64 = 0.9999;
/// Sine of the least angle between a hinge and the chord.
const LEAST_ANGLE: f64 = 0.1;

/// Chord of a fin at zero angle, in the axes of its link, square to its hinge: along the link's x axis, or forwards
/// along the hull if the hinge is the link's x axis.
fn chord(pose: &Pose, hinge: &Vector3<f64>) -> Option<Vector3<f64>> {
    let ahead = pose.R_WB.inverse() * Vector3::x();
    let square = [Vector3::x(), ahead].map(|along| along - hinge * hinge.dot(&along));
    let chord = square.into_iter().find(|c| c.norm() > LEAST_ANGLE);
    chord.map(|c| c.normalize())
}

/// A link's joint with its axis, for messages.
fn carried(link: &str, shell: &Shell) -> String {
    shell.carriers.get(link).map_or(String::new(), |c| {
        let [x, y, z] = [c.axis.x, c.axis.y, c.axis.z];
        format!("joint \"{}\" of the URDF has the axis {x} {y} {z}", c.joint)
    })
}
