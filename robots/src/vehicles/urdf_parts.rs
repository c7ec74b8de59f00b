//! What every reader of a URDF needs: its text, links and joints, poses, shapes.
//!
//! *Source:* ROS URDF, XML specification of `robot`, `link` and `joint`.
//!
//! *Parameters:* none.
//!
//! *Deviations:* none.

use super::files::Files;
use super::{mesh, urdf_form};
use crate::error::{RobotError, ensure};
use nalgebra::{UnitQuaternion, Vector3};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use urdf_rs::{Geometry, Joint, JointType, Link, Robot};
use world::frames::Pose;
use world::physics::Shape;

/// Colour of a visual, each part within 0 to 1: its own, or that of the material of its name.
pub(super) fn colour(robot: &Robot, visual: &urdf_rs::Visual) -> Option<[f64; 4]> {
    let own = visual.material.as_ref()?;
    let named = || robot.materials.iter().find(|m| m.name == own.name)?.color.as_ref();
    let colour = own.color.as_ref().or_else(named)?;
    Some(colour.rgba.0.map(|v| v.clamp(0.0, 1.0)))
}

/// Longest file read, bytes: a robot is text of some kilobytes.
const LONGEST: u64 = 16 << 20;

/// The text of a URDF, and where it and its meshes come from.
pub(super) struct UrdfText<'a> {
    /// The text.
    pub(super) text: String,
    /// Path for messages.
    path: String,
    /// Folder of the URDF; names of mesh files are relative to it.
    folder: PathBuf,
    files: &'a dyn Files,
}

impl<'a> UrdfText<'a> {
    /// The URDF that a scenario names, or the one built in, given as its name and text.
    pub(super) fn open(name: Option<&str>, files: &'a dyn Files, built_in: (&str, &str)) -> Result<Self, RobotError> {
        let Some(name) = name.map(Path::new) else {
            let (name, text) = built_in;
            return Ok(Self { text: text.into(), path: format!("built-in {name}"), folder: PathBuf::new(), files });
        };
        Self::open_at(name, files)
    }

    /// The URDF of a path.
    pub(super) fn open_at(name: &Path, files: &'a dyn Files) -> Result<Self, RobotError> {
        let path = files.path(name).display().to_string();
        match files.text(name, LONGEST) {
            Ok(text) => Ok(Self { text, path, folder: name.parent().unwrap_or(Path::new("")).into(), files }),
            Err(problem) => Err(RobotError::File { path, problem }),
        }
    }

    /// A problem in this file.
    pub(super) fn fault(&self, problem: String) -> RobotError {
        RobotError::File { path: self.path.clone(), problem }
    }

    /// A mesh file beside the URDF as a URL, with its whole path.
    pub(super) fn mesh_url(&self, name: &str) -> String {
        let name = name.strip_prefix("file://").unwrap_or(name);
        // Who draws it may know other addresses than we do.
        if name.contains("://") {
            return name.to_string();
        }
        let path = self.files.path(&self.folder.join(name));
        let whole = std::path::absolute(&path).unwrap_or(path);
        format!("file://{}", whole.display())
    }

    /// Triangles of a mesh file beside the URDF.
    pub(super) fn triangles(&self, name: &str) -> Result<Vec<[Vector3<f64>; 3]>, String> {
        let name = name.strip_prefix("file://").unwrap_or(name);
        mesh::triangles(&self.folder.join(name), self.files)
    }

    /// Corners of a mesh file beside the URDF.
    fn mesh(&self, name: &str) -> Result<Vec<Vector3<f64>>, String> {
        mesh::points(&self.folder.join(name), self.files)
    }
}

/// A text as if it stood in a file of that path, with the given files beside it.
#[cfg(test)]
pub(super) fn as_file<'a>(text: &str, path: &str, files: &'a dyn Files) -> UrdfText<'a> {
    UrdfText { text: text.into(), path: path.into(), folder: PathBuf::new(), files }
}

/// Most links of a vehicle.
const MOST_LINKS: usize = 1000;

/// Parses links and joints, and checks that the links of every joint exist.
pub(super) fn parse(text: &str) -> Result<Robot, String> {
    urdf_form::refuse(text).map_err(|why| format!("not a URDF file: {why}"))?;
    let robot = urdf_rs::read_from_string(text).map_err(|e| {
        // In all these cases the XML reader reports only that it finds nothing.
        let why = if !text.contains("<robot") {
            "there is no <robot> in it".to_string()
        } else if !text.contains("</robot>") {
            format!("it ends at line {}, before </robot>", text.lines().count())
        } else {
            e.to_string()
        };
        format!("not a URDF file: {why}")
    })?;
    if robot.links.len() > MOST_LINKS {
        let got = robot.links.len();
        return Err(format!("a vehicle has at most {MOST_LINKS} links, got {got}"));
    }
    for joint in &robot.joints {
        for end in [&joint.parent.link, &joint.child.link] {
            ensure(robot.links.iter().any(|l| &l.name == end), || {
                format!("joint \"{}\": no link \"{end}\"", joint.name)
            })?;
        }
    }
    Ok(robot)
}

/// The first link that is no joint's child.
pub(super) fn root(robot: &Robot) -> Result<&Link, String> {
    let is_child = |l: &Link| robot.joints.iter().any(|j| j.child.link == l.name);
    robot
        .links
        .iter()
        .find(|l| !is_child(l))
        .ok_or_else(|| "every link is the child of a joint, so there is no body".into())
}

/// Pose of every link connected to `body`, with joints at zero.
pub(super) fn place(robot: &Robot, body: &str) -> Result<BTreeMap<String, Pose>, String> {
    let mut links = BTreeMap::new();
    links.insert(body.to_string(), pose_of(&urdf_rs::Pose::default()));
    // Each round places at least one more link, until the rest is not connected to the body.
    let mut rest: Vec<&Joint> = robot.joints.iter().collect();
    loop {
        let before = rest.len();
        rest.retain(|joint| {
            let Some(parent) = links.get(&joint.parent.link).copied() else {
                return true;
            };
            let pose = joined(&parent, &pose_of(&joint.origin));
            links.entry(joint.child.link.clone()).or_insert(pose);
            false
        });
        if rest.len() == before {
            return Ok(links);
        }
    }
}

/// The joint that carries a link.
#[derive(Clone, Debug)]
pub(super) struct Carrier {
    /// Its name.
    pub(super) joint: String,
    /// Its `<axis>` as given, in the axes of the link with the joint at zero; URDF's default is x.
    pub(super) axis: Vector3<f64>,
    /// Whether it turns or slides, so that its axis counts.
    pub(super) moves: bool,
}

/// The joint that carries each link but the first.
pub(super) fn carriers(robot: &Robot) -> BTreeMap<String, Carrier> {
    use JointType::{Continuous, Prismatic, Revolute};
    let carrier = |joint: &Joint| Carrier {
        joint: joint.name.clone(),
        axis: Vector3::from(joint.axis.xyz.0),
        moves: matches!(joint.joint_type, Continuous | Prismatic | Revolute),
    };
    let all = robot.joints.iter();
    all.map(|j| (j.child.link.clone(), carrier(j))).collect()
}

/// Checks that every link but one is the child of exactly one joint, that names are unique, and that numbers are
/// finite.
pub(super) fn check_tree(robot: &Robot) -> Result<(), String> {
    for (i, link) in robot.links.iter().enumerate() {
        ensure(!robot.links[..i].iter().any(|l| l.name == link.name), || {
            format!("link \"{}\" occurs twice", link.name)
        })?;
    }
    let base = &root(robot)?.name;
    for (i, joint) in robot.joints.iter().enumerate() {
        let child = &joint.child.link;
        finite(&joint.origin, &format!("joint \"{}\"", joint.name))?;
        if let Some(other) = robot.joints[..i].iter().find(|j| &j.child.link == child) {
            return Err(format!(
                "link \"{child}\" is the child of two joints, \"{}\" and \"{}\"",
                other.name, joint.name
            ));
        }
    }
    let links = place(robot, base)?;
    match robot.links.iter().find(|l| !links.contains_key(&l.name)) {
        Some(link) => Err(format!("link \"{}\" is not joined to \"{base}\"", link.name)),
        None => Ok(()),
    }
}

/// Checks that an `<origin>` consists of finite numbers.
pub(super) fn finite(origin: &urdf_rs::Pose, whose: &str) -> Result<(), String> {
    let all = origin.xyz.iter().chain(origin.rpy.iter());
    match all.into_iter().find(|v| !v.is_finite()) {
        Some(v) => Err(format!("{whose}: <origin> must be finite, got {v}")),
        None => Ok(()),
    }
}

/// A collision shape of a URDF.
pub(super) fn shape(geometry: &Geometry, urdf: &UrdfText) -> Result<Shape, String> {
    let positive = |v: f64, what: &str| {
        if v > 0.0 && v.is_finite() { Ok(v) } else { Err(format!("{what} must be > 0, got {v}")) }
    };
    Ok(match geometry {
        Geometry::Box { size } => {
            for v in size.iter() {
                positive(*v, "box size")?;
            }
            Shape::Box { size_m: Vector3::from(size.0) }
        }
        Geometry::Cylinder { radius, length } => Shape::Cylinder {
            radius_m: positive(*radius, "cylinder radius")?,
            length_m: positive(*length, "cylinder length")?,
        },
        Geometry::Capsule { radius, length } => Shape::Capsule {
            radius_m: positive(*radius, "capsule radius")?,
            length_m: positive(*length, "capsule length")?,
        },
        Geometry::Sphere { radius } => Shape::Sphere { radius_m: positive(*radius, "sphere radius")? },
        Geometry::Mesh { filename, scale } => {
            let file = filename.strip_prefix("file://").unwrap_or(filename);
            if let Some((scheme, _)) = file.split_once("://") {
                let name = file.rsplit('/').next().unwrap_or_default();
                return Err(format!(
                    "mesh \"{filename}\": {scheme}:// is not looked up, for there is no ROS or Gazebo here: put the \
                     file beside the URDF, and write filename=\"{name}\""
                ));
            }
            let points = (urdf.mesh(file)).map_err(|problem| format!("mesh \"{filename}\": {problem}"))?;
            let scale = scale.map_or(Vector3::repeat(1.0), |s| Vector3::from(s.0));
            let hull = Shape::Hull { points_m: points.iter().map(|p| p.component_mul(&scale)).collect() };
            ensure(hull.is_solid(), || format!("mesh \"{filename}\": its corners span no volume"))?;
            hull
        }
    })
}

/// An `<origin>` as a pose.
pub(super) fn pose_of(p: &urdf_rs::Pose) -> Pose {
    let [roll, pitch, yaw] = p.rpy.0;
    Pose { p_WB: Vector3::from(p.xyz.0), R_WB: UnitQuaternion::from_euler_angles(roll, pitch, yaw) }
}

/// Converts `inner`, given in the axes of `outer`, to the axes in which `outer` is given.
pub(super) fn joined(outer: &Pose, inner: &Pose) -> Pose {
    Pose { p_WB: outer.point(inner.p_WB), R_WB: outer.R_WB * inner.R_WB }
}
