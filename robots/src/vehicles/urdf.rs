//! Reads a vehicle's URDF: mass, collision shapes, and the places of its instruments.
//!
//! *Source:* ROS URDF, XML specification of `robot`, `link` and `joint`.
//!
//! *Parameters:* none.
//!
//! *Deviations:* the first link without a parent is the body; moving parts (fins, propeller) do not move, and their
//! forces are in the hydrodynamics. Cylinders and capsules lie along z.

use super::urdf_mass::Ballast;
use super::urdf_parts::{
    Carrier, UrdfText, carriers, check_tree, colour, finite, joined, parse, place, pose_of, root, shape,
};
use crate::error::RobotError;
use std::collections::BTreeMap;
use world::frames::Pose;
use world::physics::Shape;

/// What a vehicle takes from its URDF.
#[derive(Clone, Debug)]
pub(super) struct Shell {
    /// Collision shapes in body axes.
    pub(super) shapes: Vec<(Pose, Shape)>,
    /// Pose of each link in body axes.
    pub(super) links: BTreeMap<String, Pose>,
    /// The joint that carries each link but the first.
    pub(super) carriers: BTreeMap<String, Carrier>,
    /// Name of the link that is its body.
    pub(super) body: String,
    /// Its mass.
    pub(super) ballast: Ballast,
    /// Shapes to look at, in body axes, with their colours (`#rrggbb`).
    pub(super) visuals: Vec<(Pose, Shape, String)>,
}

/// No part of a hull of some 1.6 m may lie farther from its middle than this, m.
const FURTHEST_M: f64 = 10.0;

/// Reads the text of a vehicle's URDF, and the mesh files that it names.
pub(super) fn shell(urdf: &UrdfText) -> Result<Shell, RobotError> {
    let fail = |problem: String| urdf.fault(problem);
    let robot = parse(&urdf.text).map_err(fail)?;
    check_tree(&robot).map_err(fail)?;
    let body = root(&robot).map_err(fail)?.name.clone();
    let links = place(&robot, &body).map_err(fail)?;
    let ballast = Ballast::from_links(&robot, &links).map_err(fail)?;
    let mut shapes = Vec::new();
    for link in &robot.links {
        let pose = &links[&link.name];
        for (i, collision) in link.collision.iter().enumerate() {
            let place = format!("link \"{}\", collision {}", link.name, i + 1);
            let shape = shape(&collision.geometry, urdf).map_err(|problem| fail(format!("{place}: {problem}")))?;
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
    let mut visuals = Vec::new();
    for link in &robot.links {
        for (i, visual) in link.visual.iter().enumerate() {
            // A mesh of many corners is looked at by what it collides with.
            if matches!(visual.geometry, urdf_rs::Geometry::Mesh { .. }) {
                continue;
            }
            let place = format!("link \"{}\", visual {}", link.name, i + 1);
            finite(&visual.origin, &place).map_err(fail)?;
            let shape = shape(&visual.geometry, urdf).map_err(|problem| fail(format!("{place}: {problem}")))?;
            let at = joined(&links[&link.name], &pose_of(&visual.origin));
            visuals.push((at, shape, web_colour(&robot, visual)));
        }
    }
    if visuals.is_empty() {
        let plain = |(pose, shape): &(Pose, Shape)| (*pose, shape.clone(), GREY.to_string());
        visuals = shapes.iter().map(plain).collect();
    }
    if shapes.is_empty() {
        return Err(fail("no link has a <collision>: the hull could not touch anything".into()));
    }
    Ok(Shell { shapes, links, carriers: carriers(&robot), body, ballast, visuals })
}

/// Colour of what has none.
const GREY: &str = "#9a9a9a";

/// Colour of a visual as a web page names it.
fn web_colour(robot: &urdf_rs::Robot, visual: &urdf_rs::Visual) -> String {
    colour(robot, visual).map_or_else(
        || GREY.into(),
        |rgba| {
            let [r, g, b, _] = rgba.map(|v| (255.0 * v + 0.5) as u8);
            format!("#{r:02x}{g:02x}{b:02x}")
        },
    )
}
