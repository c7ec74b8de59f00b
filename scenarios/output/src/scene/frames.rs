//! Frames, and the transforms between them.

use super::Machine;
use crate::ros::Transform;
use nalgebra::{UnitQuaternion, Vector3};
use robots::vehicles::LinkLook;
use std::f64::consts::FRAC_PI_2;
use world::frames::Pose;

/// Name of a robot's body frame.
pub const BODY: &str = "base_link";

/// Names of frames: in ROS live and in a recording they differ.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a> {
    /// The frame of the world: east, north, up; z = 0 at the still surface.
    pub world: &'a str,
    /// What stands before the names of a machine's links.
    pub own: &'a str,
}

impl Names<'_> {
    /// Frame of a link.
    pub fn frame(&self, link: &str) -> String {
        [self.own, "/", link].concat()
    }
}

/// A pose as a transform.
pub fn transform(t_ns: u64, parent: &str, child: String, pose: &Pose) -> Transform {
    Transform { t_ns, parent: parent.to_owned(), child, position: pose.p_WB, attitude: pose.R_WB }
}

/// All links of a machine but its slides, its altimeter's beam, and where a gantry stands; joints with drives at zero.
pub fn fixed(machine: &Machine, names: &Names) -> Vec<Transform> {
    let mut all = Vec::new();
    let name = |link: &str| names.frame(link);
    let root = name(&machine.description.root);
    let here = Pose { p_WB: Vector3::zeros(), R_WB: UnitQuaternion::identity() };
    match &machine.base {
        Some(base) => all.push(transform(0, names.world, root, base)),
        None if machine.description.root != BODY => {
            all.push(transform(0, &name(BODY), root, &here));
        }
        None => {}
    }
    for joint in &machine.description.joints {
        if !machine.slides.contains(&joint.joint) {
            all.push(transform(0, &name(&joint.parent), name(&joint.child), &joint.pose));
        }
    }
    let sounds = |l: &LinkLook| l.name == "altimeter";
    if machine.altimeter_m.is_some() && machine.description.links.iter().any(sounds) {
        // A range is along x, and the altimeter looks along the body's down axis.
        let down = UnitQuaternion::from_euler_angles(0.0, FRAC_PI_2, 0.0);
        let beam = Pose { R_WB: down, ..here };
        all.push(transform(0, &name("altimeter"), name("altimeter_beam"), &beam));
    }
    all
}

/// A gantry's slides at their positions, m.
pub fn slid(t_ns: u64, machine: &Machine, names: &Names, positions_m: &[f64]) -> Vec<Transform> {
    let all = machine.slides.iter().zip(positions_m);
    all.filter_map(|(slide, position_m)| {
        let joint = (machine.description.joints.iter()).find(|j| j.joint == *slide)?;
        let (parent, child) = (names.frame(&joint.parent), names.frame(&joint.child));
        Some(transform(t_ns, &parent, child, &joint.slid(*position_m)))
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::super::Scene;
    use super::*;
    use nalgebra::Vector2;
    use rheotaxis::scenario::{FolderFiles, Loaded, load};
    use robots::vehicles::Gantry;
    use std::collections::BTreeMap;
    use std::path::Path;
    use world::physics::JointState;

    const MAP: &str = "map";

    fn names(machine: &Machine) -> Names<'_> {
        Names { world: MAP, own: &machine.name }
    }

    fn machine(loaded: &Loaded) -> Machine {
        Scene::from_scenario(loaded).unwrap().machines.remove(0)
    }

    /// Pose of a frame in `map`, by the chain of its parents.
    fn in_map(all: &[Transform], frame: &str) -> Pose {
        let by: BTreeMap<&str, &Transform> = all.iter().map(|t| (t.child.as_str(), t)).collect();
        let mut pose = Pose { p_WB: Vector3::zeros(), R_WB: UnitQuaternion::identity() };
        let mut at = frame;
        while at != MAP {
            let t = by[at];
            pose.p_WB = t.position + t.attitude * pose.p_WB;
            pose.R_WB = t.attitude * pose.R_WB;
            at = &t.parent;
        }
        pose
    }

    #[test]
    fn a_gantry_s_head_and_tips_are_where_it_carries_them() {
        let loaded = load(Path::new("flume_crab")).unwrap();
        let block = &loaded.scenario.gantries[0];
        let gantry = Gantry::load(&block.gantry, &FolderFiles(&loaded.base_dir)).unwrap();
        let machine = machine(&loaded);
        let joints = [0.75, -0.25].map(|position_m| JointState { position_m, ..JointState::default() });
        let mut all = fixed(&machine, &names(&machine));
        all.extend(slid(5, &machine, &names(&machine), &joints.map(|j| j.position_m)));
        let base = machine.base.unwrap();
        let head = in_map(&all, "crab0/head").p_WB;
        assert!((head - gantry.head_W(&base, &joints)).norm() < 1e-12);
        for (probe, tip) in machine.probes.iter().zip(gantry.tips_W(&base, &joints)) {
            let shown = in_map(&all, &machine.frame(probe)).p_WB;
            assert!((shown - tip).norm() < 1e-12, "{probe}");
        }
        let forward = (in_map(&all, "crab0/head").R_WB * Vector3::x()).xy();
        assert!((forward - Vector2::new(-1.0, 0.0)).norm() < 1e-12, "{forward}");
    }

    #[test]
    fn the_altimeter_s_beam_looks_down() {
        let machine = machine(&load(Path::new("harbour_3d")).unwrap());
        let mut all = fixed(&machine, &names(&machine));
        let level = Pose { p_WB: Vector3::new(1.0, 2.0, -3.0), R_WB: UnitQuaternion::identity() };
        all.push(transform(0, MAP, machine.frame(BODY), &level));
        let beam = in_map(&all, "auv0/altimeter_beam");
        assert!((beam.R_WB * Vector3::x() + Vector3::z()).norm() < 1e-12);
        assert!((beam.p_WB - Vector3::new(1.3, 2.0, -3.09)).norm() < 1e-12);
    }
}
