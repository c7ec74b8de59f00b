//! Reads a vehicle's URDF: mass, collision shapes, and where its instruments sit.
//!
//! *Source:* ROS URDF, XML specification of `robot`, `link` and `joint`.
//!
//! *Parameters:* none.
//!
//! *Deviations:* the first link without a parent is the body; moving parts (fins, propeller) are massless
//! there, their forces are in the hydrodynamics. Cylinders and capsules lie along z.

use super::coefficients::Coefficients;
use super::urdf_parts::{check_tree, finite, joined, parse, place, pose_of, root, shape};
use crate::error::RobotError;
use std::collections::BTreeMap;
use std::path::Path;
use urdf_rs::Link;
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

/// No part of a hull of some 1.6 m lies further from its middle, m.
const FURTHEST_M: f64 = 10.0;

/// Reads URDF text; `path` is for messages and for mesh files beside it.
pub(super) fn read(text: &str, path: &Path, c: &Coefficients) -> Result<Hull, RobotError> {
    let fail = |problem: String| RobotError::File {
        path: path.display().to_string(),
        problem,
    };
    let robot = parse(text).map_err(fail)?;
    check_tree(&robot).map_err(fail)?;
    let body = root(&robot).map_err(fail)?;
    let links = place(&robot, &body.name).map_err(fail)?;
    for needed in NEEDED {
        if !links.contains_key(needed) {
            return Err(fail(format!("link \"{needed}\" is missing")));
        }
    }
    check_mass(body, c).map_err(fail)?;
    let mut shapes = Vec::new();
    for link in &robot.links {
        let pose = &links[&link.name];
        for (i, collision) in link.collision.iter().enumerate() {
            let place = format!("link \"{}\", collision {}", link.name, i + 1);
            let beside = path.parent().unwrap_or(Path::new(""));
            let shape = shape(&collision.geometry, beside)
                .map_err(|problem| fail(format!("{place}: {problem}")))?;
            finite(&collision.origin, &place).map_err(fail)?;
            let at = joined(pose, &pose_of(&collision.origin));
            let reach = at.p_WB.norm() + shape.reach_m();
            if reach > FURTHEST_M {
                return Err(fail(format!(
                    "{place}: reaches {reach:.1} m from the body's origin; at most {FURTHEST_M} m"
                )));
            }
            shapes.push((at, shape));
        }
    }
    if shapes.is_empty() {
        return Err(fail(
            "no link has a <collision>: the hull could not touch anything".into(),
        ));
    }
    Ok(Hull { shapes, links })
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
    for (have, axis) in [(i.ixy, "ixy"), (i.ixz, "ixz"), (i.iyz, "iyz")] {
        if !near(want.x + have, want.x) {
            return Err(format!(
                "link \"{name}\": {axis} is {have} kg m2, but the hydrodynamic parameters are for a hull without"
            ));
        }
    }
    let [x, y, z] = inertial.origin.xyz.0;
    if !near(c.z_g_m + x, c.z_g_m) || !near(c.z_g_m + y, c.z_g_m) {
        return Err(format!(
            "link \"{name}\": the centre of gravity is at x = {x} m, y = {y} m, but the hydrodynamic parameters have it under the middle"
        ));
    }
    if !near(-z, c.z_g_m) {
        return Err(format!(
            "link \"{name}\": the centre of gravity is at z = {z} m, but the hydrodynamic parameters are for {} m",
            -c.z_g_m
        ));
    }
    Ok(())
}
