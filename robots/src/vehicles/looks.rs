//! Shapes of a URDF to look at, and which drive moves which of its joints.
//!
//! *Source:* ROS URDF, XML specification of `visual` and `joint`.
//!
//! *Parameters:* none.
//!
//! *Deviations:* a link without `<visual>` shows what it collides with; so does one whose `<visual>` names a mesh file
//! that cannot be read (other formats than STL and OBJ). A fixed joint that a drive moves gets the drive's axis, and so
//! do all of a vehicle with rudder, stern plane and propeller, so that a positive set-point turns it the right way.

use super::drives::{CurveSpec, DriveSpec};
use super::urdf_parts::{UrdfText, colour, pose_of, shape};
use nalgebra::Vector3;
use strum::IntoStaticStr;
use urdf_rs::{Geometry, JointType, Link, Robot};
use world::frames::Pose;
use world::physics::Shape;

/// A link with its shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkLook {
    /// Name of the link.
    pub name: String,
    /// Its pose in the axes of the root link, with all joints at zero.
    pub pose: Pose,
    /// Its shapes; none for a link that is only a place.
    pub shapes: Vec<Look>,
}

/// A shape to look at.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// What it is.
    pub form: Form,
    /// Its pose in the axes of its link.
    pub pose: Pose,
    /// Red, green, blue, opacity, 0 to 1; `None` if the URDF says nothing.
    pub colour: Option<[f32; 4]>,
}

/// What a shape is. Long shapes lie along their own z axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A box, cylinder, capsule or ball.
    Solid(Shape),
    /// A surface of triangles (m), each anticlockwise seen from outside.
    Mesh(Vec<[Vector3<f64>; 3]>),
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum JointKind {
    /// Not at all.
    Fixed,
    /// It turns within limits.
    Revolute,
    /// It turns without limits.
    Continuous,
    /// It slides.
    Prismatic,
}

impl JointKind {
    /// The word of URDF.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Of a joint of a URDF. Kinds that nothing here moves count as fixed.
    pub(super) fn from_urdf(kind: &JointType) -> Self {
        match kind {
            JointType::Revolute => Self::Revolute,
            JointType::Continuous => Self::Continuous,
            JointType::Prismatic => Self::Prismatic,
            _ => Self::Fixed,
        }
    }
}

/// A joint that a drive moves.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenJoint {
    /// Name of the joint.
    pub joint: String,
    /// Name of the set-point, as [`Actuation::named`](crate::handoff::Actuation::named) says it.
    pub actuator: String,
    /// Unit of the set-point: `rad`, `rpm`, `m`, `N`, or `input` of a thruster with a curve of its own.
    pub unit: &'static str,
}

/// What a drive does to the link on which it sits.
pub(super) struct Motion {
    pub(super) link: String,
    pub(super) actuator: String,
    pub(super) unit: &'static str,
    pub(super) kind: JointKind,
    pub(super) axis: Vector3<f64>,
    /// Whether the axis of a joint that moves counts instead.
    pub(super) by_joint: bool,
}

/// Those of a vehicle with a rudder, a stern plane and a propeller. The trailing edge of the rudder goes to starboard
/// and that of the stern plane down with a positive set-point.
pub(super) fn of_fins() -> Vec<Motion> {
    let motion = |link: &str, actuator: &str, unit, kind, axis| Motion {
        link: link.into(),
        actuator: actuator.into(),
        unit,
        kind,
        axis,
        by_joint: false,
    };
    use JointKind::{Continuous, Revolute};
    vec![
        motion("rudder", "rudder_rad", "rad", Revolute, Vector3::z()),
        motion("stern_plane", "stern_rad", "rad", Revolute, -Vector3::y()),
        motion("propeller", "rpm", "rpm", Continuous, Vector3::x()),
    ]
}

/// Those of a vehicle of a folder, in their order. A pump moves nothing that can be seen.
pub(super) fn of_drives(drives: &[DriveSpec]) -> Vec<Motion> {
    use JointKind::{Continuous, Prismatic, Revolute};
    let motion = |(k, drive): (usize, &DriveSpec)| {
        let (link, unit, kind, axis) = match drive {
            DriveSpec::Thruster(t) => {
                let unit = match t.curve {
                    CurveSpec::Newtons(_) => "N",
                    CurveSpec::Table(_) | CurveSpec::Polynomial(_) => "input",
                };
                (&t.link, unit, Continuous, Vector3::x())
            }
            DriveSpec::Fin(f) => (&f.link, "rad", Revolute, Vector3::y()),
            DriveSpec::MovingMass(m) => (&m.link, "m", Prismatic, Vector3::x()),
            DriveSpec::BuoyancyEngine(_) => return None,
        };
        Some(Motion { link: link.clone(), actuator: format!("drive_{}", k + 1), unit, kind, axis, by_joint: true })
    };
    drives.iter().enumerate().filter_map(motion).collect()
}

/// The shapes of a link.
pub(super) fn looks(robot: &Robot, link: &Link, urdf: &UrdfText) -> Vec<Look> {
    let form = |geometry: &Geometry| match geometry {
        Geometry::Mesh { filename, scale } => {
            let scale = scale.map_or(Vector3::repeat(1.0), |s| Vector3::from(s.0));
            triangles(filename, &scale, urdf).map(Form::Mesh)
        }
        other => shape(other, urdf).ok().map(Form::Solid),
    };
    let seen = link.visual.iter().filter_map(|visual| {
        let colour = colour(robot, visual).map(|c| c.map(|v| v as f32));
        Some(Look { form: form(&visual.geometry)?, pose: pose_of(&visual.origin), colour })
    });
    let seen: Vec<Look> = seen.collect();
    if !seen.is_empty() {
        return seen;
    }
    let touched = link.collision.iter().filter_map(|collision| {
        Some(Look { form: form(&collision.geometry)?, pose: pose_of(&collision.origin), colour: None })
    });
    touched.collect()
}

/// The triangles of a mesh file; `None` if it cannot be read.
fn triangles(name: &str, scale: &Vector3<f64>, urdf: &UrdfText) -> Option<Vec<[Vector3<f64>; 3]>> {
    let mut all = urdf.triangles(name).ok()?;
    for corner in all.as_flattened_mut() {
        *corner = corner.component_mul(scale);
    }
    // A mirrored mesh is inside out.
    if scale.product() < 0.0 {
        all.iter_mut().for_each(|t| t.swap(1, 2));
    }
    Some(all)
}
