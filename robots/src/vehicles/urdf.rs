//! Reads a vehicle's URDF: mass, collision shapes, and where its instruments sit.
//!
//! *Source:* ROS URDF, XML specification of `robot`, `link` and `joint`.
//!
//! *Parameters:* none.
//!
//! *Deviations:* the first link without a parent is the body; moving parts (fins, propeller) are massless
//! there, their forces are in the hydrodynamics. Cylinders and capsules lie along z.

use super::coefficients::Coefficients;
use super::mesh;
use crate::error::RobotError;
use nalgebra::{UnitQuaternion, Vector3};
use std::collections::BTreeMap;
use std::path::Path;
use urdf_rs::{Geometry, Link, Robot};
use world::frames::Pose;
use world::physics::Shape;

/// What a URDF says of a vehicle.
#[derive(Clone, Debug)]
pub(super) struct Hull {
    /// Collision shapes in body axes.
    pub(super) shapes: Vec<(Pose, Shape)>,
    /// Pose of each link in body axes.
    pub(super) links: BTreeMap<String, Pose>,
}

/// Links that a vehicle with a rudder, a stern plane and a propeller must have.
const NEEDED: [&str; 3] = ["rudder", "stern_plane", "propeller"];

/// By how much mass and inertia may differ from the hydrodynamic parameters, which were fitted to one hull.
const MASS_TOLERANCE: f64 = 0.01;

/// Reads URDF text; `path` is for messages and for mesh files beside it.
pub(super) fn read(text: &str, path: &Path, c: &Coefficients) -> Result<Hull, RobotError> {
    let fail = |problem: String| RobotError::File {
        path: path.display().to_string(),
        problem,
    };
    let robot: Robot =
        urdf_rs::read_from_string(text).map_err(|e| fail(format!("not a URDF file: {e}")))?;
    let body = root(&robot).map_err(fail)?;
    let links = place(&robot, &body.name).map_err(fail)?;
    for needed in NEEDED {
        if !links.contains_key(needed) {
            return Err(fail(format!(
                "link \"{needed}\" is missing (or not joined to \"{}\")",
                body.name
            )));
        }
    }
    check_mass(body, c).map_err(fail)?;
    let mut shapes = Vec::new();
    for link in &robot.links {
        let Some(pose) = links.get(&link.name) else {
            continue;
        };
        for (i, collision) in link.collision.iter().enumerate() {
            let place = format!("link \"{}\", collision {}", link.name, i + 1);
            let beside = path.parent().unwrap_or(Path::new(""));
            let shape = shape(&collision.geometry, beside)
                .map_err(|problem| fail(format!("{place}: {problem}")))?;
            shapes.push((joined(pose, &pose_of(&collision.origin)), shape));
        }
    }
    if shapes.is_empty() {
        return Err(fail(
            "no link has a <collision>: the hull could not touch anything".into(),
        ));
    }
    Ok(Hull { shapes, links })
}

fn root(robot: &Robot) -> Result<&Link, String> {
    let is_child = |l: &Link| robot.joints.iter().any(|j| j.child.link == l.name);
    robot
        .links
        .iter()
        .find(|l| !is_child(l))
        .ok_or_else(|| "every link is the child of a joint: there is no body".into())
}

/// Pose of every link that hangs on `body`, joints at zero.
fn place(robot: &Robot, body: &str) -> Result<BTreeMap<String, Pose>, String> {
    let mut links = BTreeMap::new();
    links.insert(body.to_string(), pose_of(&urdf_rs::Pose::default()));
    for joint in &robot.joints {
        for end in [&joint.parent.link, &joint.child.link] {
            if !robot.links.iter().any(|l| &l.name == end) {
                return Err(format!("joint \"{}\": no link \"{end}\"", joint.name));
            }
        }
    }
    // Each round places at least one link more, or the rest does not hang on the body.
    for _ in &robot.joints {
        for joint in &robot.joints {
            if let Some(parent) = links.get(&joint.parent.link).copied() {
                let pose = joined(&parent, &pose_of(&joint.origin));
                links.entry(joint.child.link.clone()).or_insert(pose);
            }
        }
    }
    Ok(links)
}

fn check_mass(body: &Link, c: &Coefficients) -> Result<(), String> {
    let name = &body.name;
    let inertial = &body.inertial;
    let mass = inertial.mass.value;
    if !(mass > 0.0 && mass.is_finite()) {
        return Err(format!(
            "link \"{name}\": <mass> must be > 0 kg, got {mass}"
        ));
    }
    let near = |have: f64, want: f64| (have - want).abs() <= MASS_TOLERANCE * want;
    if !near(mass, c.mass_kg) {
        return Err(format!(
            "link \"{name}\": <mass> is {mass} kg, but the hydrodynamic parameters are for {:.3} kg",
            c.mass_kg
        ));
    }
    let i = &inertial.inertia;
    let want = c.inertia_kg_m2;
    for (have, want, axis) in [
        (i.ixx, want.x, "ixx"),
        (i.iyy, want.y, "iyy"),
        (i.izz, want.z, "izz"),
    ] {
        if !near(have, want) {
            return Err(format!(
                "link \"{name}\": {axis} is {have} kg m2, but the hydrodynamic parameters are for {want:.5} kg m2"
            ));
        }
    }
    let z = inertial.origin.xyz[2];
    if !near(-z, c.z_g_m) {
        return Err(format!(
            "link \"{name}\": the centre of gravity is at z = {z} m, but the hydrodynamic parameters are for {} m",
            -c.z_g_m
        ));
    }
    Ok(())
}

fn shape(geometry: &Geometry, beside: &Path) -> Result<Shape, String> {
    let positive = |v: f64, what: &str| {
        if v > 0.0 && v.is_finite() {
            Ok(v)
        } else {
            Err(format!("{what} must be > 0, got {v}"))
        }
    };
    Ok(match geometry {
        Geometry::Box { size } => {
            for v in size.iter() {
                positive(*v, "box size")?;
            }
            Shape::Box {
                size_m: Vector3::from(size.0),
            }
        }
        Geometry::Cylinder { radius, length } => Shape::Cylinder {
            radius_m: positive(*radius, "cylinder radius")?,
            length_m: positive(*length, "cylinder length")?,
        },
        Geometry::Capsule { radius, length } => Shape::Capsule {
            radius_m: positive(*radius, "capsule radius")?,
            length_m: positive(*length, "capsule length")?,
        },
        Geometry::Sphere { radius } => Shape::Sphere {
            radius_m: positive(*radius, "sphere radius")?,
        },
        Geometry::Mesh { filename, scale } => {
            let file = filename.strip_prefix("file://").unwrap_or(filename);
            let points = mesh::points(&beside.join(file))
                .map_err(|problem| format!("mesh \"{filename}\": {problem}"))?;
            let scale = scale.map_or(Vector3::repeat(1.0), |s| Vector3::from(s.0));
            let hull = Shape::Hull {
                points_m: points.iter().map(|p| p.component_mul(&scale)).collect(),
            };
            if !hull.is_solid() {
                return Err(format!("mesh \"{filename}\": its corners span no volume"));
            }
            hull
        }
    })
}

fn pose_of(p: &urdf_rs::Pose) -> Pose {
    let [roll, pitch, yaw] = p.rpy.0;
    Pose {
        p_WB: Vector3::from(p.xyz.0),
        R_WB: UnitQuaternion::from_euler_angles(roll, pitch, yaw),
    }
}

/// `inner`, given in the axes of `outer`, in those in which `outer` is given.
fn joined(outer: &Pose, inner: &Pose) -> Pose {
    Pose {
        p_WB: outer.point(inner.p_WB),
        R_WB: outer.R_WB * inner.R_WB,
    }
}
