//! Frames, and the transforms between them.

use super::scene::Machine;
use crate::ros::Transform;
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::FRAC_PI_2;
use world::frames::Pose;

/// The frame of the world: east, north, up; z = 0 at the still surface.
pub(super) const MAP: &str = "map";

/// Name of a robot's body frame.
pub(super) const BODY: &str = "base_link";

/// A pose as a transform.
pub(super) fn transform(t_ns: u64, parent: &str, child: String, pose: &Pose) -> Transform {
    Transform {
        t_ns,
        parent: parent.to_owned(),
        child,
        position: pose.p_WB,
        attitude: pose.R_WB,
    }
}

/// All that does not move: links of the URDFs, beams, and where gantries stand.
pub(super) fn fixed(machine: &Machine) -> Vec<Transform> {
    let mut all = Vec::new();
    let name = |link: &str| machine.frame(link);
    let root = name(&machine.description.root);
    let here = Pose {
        p_WB: Vector3::zeros(),
        R_WB: UnitQuaternion::identity(),
    };
    match &machine.base {
        Some(base) => all.push(transform(0, MAP, root, base)),
        None if machine.description.root != BODY => {
            all.push(transform(0, &name(BODY), root, &here));
        }
        None => {}
    }
    for joint in &machine.description.joints {
        if !machine.slides.contains(&joint.joint) {
            all.push(transform(
                0,
                &name(&joint.parent),
                name(&joint.child),
                &joint.pose,
            ));
        }
    }
    if machine.altimeter_m.is_some() {
        // A range is along x, and the altimeter looks along the body's down axis.
        let down = UnitQuaternion::from_euler_angles(0.0, FRAC_PI_2, 0.0);
        let beam = Pose { R_WB: down, ..here };
        all.push(transform(
            0,
            &name("altimeter"),
            name("altimeter_beam"),
            &beam,
        ));
    }
    all
}

/// A gantry's slides at their positions, m.
pub(super) fn slid(t_ns: u64, machine: &Machine, positions_m: &[f64]) -> Vec<Transform> {
    let all = machine.slides.iter().zip(positions_m);
    all.filter_map(|(slide, position_m)| {
        let joint = (machine.description.joints.iter()).find(|j| j.joint == *slide)?;
        let (parent, child) = (machine.frame(&joint.parent), machine.frame(&joint.child));
        Some(transform(t_ns, &parent, child, &joint.slid(*position_m)))
    })
    .collect()
}
