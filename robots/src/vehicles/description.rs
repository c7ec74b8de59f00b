//! What others need to draw a vehicle or a gantry: its URDF as one text, the frames of its links, their shapes, and
//! what moves them.
//!
//! *Source:* ROS URDF, XML specification of `robot`, `link` and `joint`.
//!
//! *Parameters:* none.
//!
//! *Deviations:* the text is written anew, for readers that know URDF 1.0 only: a capsule becomes the cylinder of the
//! same length, a link without `<visual>` shows what it collides with, and a mesh file gets its whole path.

use super::files::Files;
use super::folder::{TermsSpec, VehicleSource, urdf_of};
use super::gantry::{CRAB_GANTRY, GantrySpec};
use super::looks::{DrivenJoint, JointKind, LinkLook, Motion, looks, of_drives, of_fins};
use super::spec::VehicleSpec;
use super::urdf_parts::{UrdfText, check_tree, parse, place, pose_of, root};
use crate::error::RobotError;
use nalgebra::{Unit, UnitQuaternion, Vector3};
use urdf_rs::{Collision, Geometry, Visual};
use world::frames::Pose;

/// A URDF to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The text.
    pub urdf: String,
    /// Name of the link that is the body or the base.
    pub root: String,
    /// All joints.
    pub joints: Vec<Mount>,
    /// All links, with their shapes as the URDF has them.
    pub links: Vec<LinkLook>,
    /// The joints that its drives move; none of a vehicle without drives, or of a gantry, whose slides have the names
    /// of their joints.
    pub moved: Vec<DrivenJoint>,
}

/// A joint: how a link is fitted to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Mount {
    /// Name of the joint.
    pub joint: String,
    /// The link that carries the other.
    pub parent: String,
    /// The other.
    pub child: String,
    /// Pose of the other in the first one's axes, with the joint at zero.
    pub pose: Pose,
    /// How it moves.
    pub kind: JointKind,
    /// Direction in which it slides, or about which it turns, in its own axes; unit vector.
    pub axis: Vector3<f64>,
}

impl Mount {
    /// The pose with the joint slid to a position, m.
    pub fn slid(&self, position_m: f64) -> Pose {
        Pose { p_WB: self.pose.point(self.axis * position_m), ..self.pose }
    }

    /// The pose with the joint turned by an angle, rad.
    pub fn turned(&self, angle_rad: f64) -> Pose {
        let axis = Unit::new_normalize(self.axis);
        Pose { R_WB: self.pose.R_WB * UnitQuaternion::from_axis_angle(&axis, angle_rad), ..self.pose }
    }
}

impl Description {
    /// Of a vehicle that can be built.
    ///
    /// # Errors
    /// If its URDF cannot be read.
    pub fn of_vehicle(spec: &VehicleSpec, files: &dyn Files) -> Result<Self, RobotError> {
        if let VehicleSpec::Kinematic(spec) = spec {
            return Self::from_urdf(&urdf_of(spec.urdf.as_deref(), files)?, &[]);
        }
        let source = VehicleSource::new(spec, files)?;
        let moves = match source.file.hydrodynamics.terms {
            TermsSpec::Torpedo(_) => of_fins(),
            TermsSpec::Blocks => of_drives(&source.file.drives),
        };
        Self::from_urdf(&source.urdf, &moves)
    }

    /// Of a gantry that can be built.
    ///
    /// # Errors
    /// If its URDF cannot be read.
    pub fn of_gantry(spec: &GantrySpec, files: &dyn Files) -> Result<Self, RobotError> {
        let GantrySpec::CrabGantry(spec) = spec;
        let text = UrdfText::open(spec.urdf.as_deref(), files, CRAB_GANTRY)?;
        Self::from_urdf(&text, &[])
    }

    fn from_urdf(text: &UrdfText, moves: &[Motion]) -> Result<Self, RobotError> {
        let fail = |problem: String| text.fault(problem);
        let mut robot = parse(&text.text).map_err(fail)?;
        check_tree(&robot).map_err(fail)?;
        let base = root(&robot).map_err(fail)?.name.clone();
        let poses = place(&robot, &base).map_err(fail)?;
        let look = |link: &urdf_rs::Link| LinkLook {
            name: link.name.clone(),
            pose: poses[&link.name],
            shapes: looks(&robot, link, text),
        };
        let links = robot.links.iter().map(look).collect();
        for link in &mut robot.links {
            let collisions = link.collision.iter_mut().map(|c| &mut c.geometry);
            let visuals = link.visual.iter_mut().map(|v| &mut v.geometry);
            for geometry in collisions.chain(visuals) {
                simplify(geometry, text);
            }
            if link.visual.is_empty() {
                link.visual = link.collision.iter().map(seen).collect();
            }
        }
        let mount = |joint: &urdf_rs::Joint| Mount {
            joint: joint.name.clone(),
            parent: joint.parent.link.clone(),
            child: joint.child.link.clone(),
            pose: pose_of(&joint.origin),
            kind: JointKind::from_urdf(&joint.joint_type),
            axis: (Vector3::from(joint.axis.xyz.0).try_normalize(0.0)).unwrap_or_else(Vector3::x),
        };
        let mut joints: Vec<Mount> = robot.joints.iter().map(mount).collect();
        let mut moved = Vec::new();
        for motion in moves {
            // What sits on the body itself moves no joint.
            if let Some(joint) = joints.iter_mut().find(|j| j.child == motion.link) {
                if !motion.by_joint || joint.kind == JointKind::Fixed {
                    joint.axis = motion.axis;
                }
                joint.kind = motion.kind;
                moved.push(DrivenJoint {
                    joint: joint.joint.clone(),
                    actuator: motion.actuator.clone(),
                    unit: motion.unit,
                });
            }
        }
        Ok(Self {
            root: base,
            joints,
            links,
            moved,
            urdf: urdf_rs::write_to_string(&robot).map_err(|e| fail(e.to_string()))?,
        })
    }
}

/// Replaces what readers of URDF 1.0 do not know, and names of files that they cannot find.
fn simplify(geometry: &mut Geometry, text: &UrdfText) {
    match geometry {
        Geometry::Capsule { radius, length } => {
            *geometry = Geometry::Cylinder { radius: *radius, length: *length + 2.0 * *radius };
        }
        Geometry::Mesh { filename, .. } => *filename = text.mesh_url(filename),
        _ => {}
    }
}

/// A collision shape to look at.
fn seen(collision: &Collision) -> Visual {
    Visual { name: None, origin: collision.origin.clone(), geometry: collision.geometry.clone(), material: None }
}

#[cfg(test)]
mod tests {
    use super::super::files::InMemory;
    use super::*;
    use crate::vehicles::SHIPPED;
    use std::path::Path;

    #[test]
    fn every_vehicle_and_gantry_is_described_as_it_is_built() {
        let files = InMemory::default();
        let remus = Description::of_vehicle(&VehicleSpec::default(), &files).unwrap();
        assert_eq!(remus.root, "base_link");
        let camera = remus.joints.iter().find(|j| j.child == "camera").unwrap();
        assert_eq!(camera.parent, "base_link");
        assert_eq!(camera.pose.p_WB, Vector3::new(0.6, 0.0, -0.1));
        // The text can be read again, and a reader of URDF 1.0 finds what it knows.
        assert!(!remus.urdf.contains("capsule"), "{}", remus.urdf);
        assert_eq!(parse(&remus.urdf).unwrap().joints.len(), remus.joints.len());

        let crab = Description::of_gantry(&GantrySpec::default(), &files).unwrap();
        assert_eq!(crab.root, "base");
        assert_eq!(crab.urdf.matches("<visual").count(), 6);
        let across = (crab.joints.iter().find(|j| j.joint == "across_stream")).unwrap();
        let at = across.slid(0.25).p_WB;
        assert!((at - Vector3::new(0.0, 0.25, -0.475)).norm() < 1e-12);
        assert!(!SHIPPED.is_empty());
    }

    #[test]
    fn a_mesh_is_found_from_anywhere() {
        let text = r#"<robot name="a"><link name="b"><collision><geometry>
            <mesh filename="hull.stl"/></geometry></collision></link></robot>"#;
        let files = InMemory::default().with("hulls/a.urdf", text.as_bytes());
        let text = UrdfText::open_at(Path::new("hulls/a.urdf"), &files).unwrap();
        let urdf = Description::from_urdf(&text, &[]).unwrap().urdf;
        let here = std::env::current_dir().unwrap();
        let path = here.join("hulls/hull.stl");
        let url = format!("filename=\"file://{}\"", path.display());
        assert_eq!(urdf.matches(&url).count(), 2, "{urdf}");
    }
}
