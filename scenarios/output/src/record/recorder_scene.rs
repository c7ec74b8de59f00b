//! A scene's part of a recording: the document, surfaces, URDFs, frames of links, and the joints that move.

use super::{AREA, WORLD};
use crate::mcap::{McapFile, RecordError};
use crate::ros::{MessageKind, Transform, marker_array, text, transforms};
use crate::scene::frames::{BODY, Names, fixed, slid, transform};
use crate::scene::{Machine, Scene};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rheotaxis::frame::Frame;
use robots::handoff::Actuation;
use robots::vehicles::JointKind;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::sync::Arc;
use world::frames::Pose;

/// Steps of an angle in `/tf`, rad: equal transforms take next to no room in the file, and none of them is seen.
const STEP_RAD: f64 = 0.005;
/// Steps of a propeller's angle: at these periods its turns are not seen anyhow.
const BLADES: f64 = 24.0;
/// Turns of a propeller per second with a thruster's input at 1 N or 1: only to look at.
const TURNS_PER_INPUT: f64 = 0.1;

/// The scene of a recording; without one nothing is recorded of it.
#[derive(Debug, Default)]
pub(super) struct SceneRecorder {
    scene: Arc<Scene>,
    /// Angle of each propeller, turns, and the time of its last frame, ns.
    turns: BTreeMap<(usize, usize), f64>,
    last_ns: Option<u64>,
}

impl SceneRecorder {
    /// Records what does not move.
    pub(super) fn begin(scene: &Arc<Scene>, file: &mut McapFile, seed: u64) -> Result<Self, RecordError> {
        let document = scene.document(seed);
        file.attach("scene.json", "application/json", document.as_bytes())?;
        let surfaces = marker_array(0, WORLD, &scene.markers());
        file.write("/scene", MessageKind::MarkerArray, 0, &surfaces)?;
        let mut still = vec![scene.area_frame(WORLD, AREA)];
        for machine in &scene.machines {
            let names = names(machine);
            let moved = moved(machine, &names);
            if machine.base.is_none() {
                // The frame of a robot is that of its body.
                let here = Pose { p_WB: Vector3::zeros(), R_WB: UnitQuaternion::identity() };
                still.push(transform(0, &machine.id, names.frame(BODY), &here));
            }
            let fixed = fixed(machine, &names).into_iter();
            still.extend(fixed.filter(|t| !moved.contains(&t.child)));
            let topic = format!("/{}/robot_description", machine.id);
            let urdf = text(&machine.description.urdf);
            file.write(&topic, MessageKind::Text, 0, &urdf)?;
        }
        let still = transforms(&still);
        file.write("/tf_static", MessageKind::TfMessage, 0, &still)?;
        Ok(Self { scene: Arc::clone(scene), turns: BTreeMap::new(), last_ns: None })
    }

    /// Centre of the area (east, north), m.
    pub(super) fn centre(&self) -> Vector2<f64> {
        self.scene.centre()
    }

    /// Adds the joints of a frame that move. A link that has a frame of its own in the URDF replaces one of that name.
    pub(super) fn moving(&mut self, t_ns: u64, frame: &Frame, tf: &mut Vec<Transform>) {
        let dt_s = self.last_ns.map_or(0.0, |last| 1e-9 * (t_ns - last) as f64);
        self.last_ns = Some(t_ns);
        let scene = Arc::clone(&self.scene);
        for g in &frame.gantries {
            let Some(machine) = scene.machine(&g.id) else {
                continue;
            };
            let names = names(machine);
            let links: BTreeSet<String> = (machine.description.links.iter()).map(|l| names.frame(&l.name)).collect();
            tf.retain(|t| !links.contains(&t.child));
            let positions: Vec<f64> = g.joints.iter().map(|j| j.position_m).collect();
            tf.extend(slid(t_ns, machine, &names, &positions));
        }
        for r in &frame.robots {
            let at = scene.machines.iter().position(|m| m.id == r.id);
            if let Some((k, machine)) = at.map(|k| (k, &scene.machines[k])) {
                self.driven(t_ns, k, machine, &r.actuators, dt_s, tf);
            }
        }
    }

    /// The joints that the drives of a robot move.
    fn driven(
        &mut self,
        t_ns: u64,
        machine_number: usize,
        machine: &Machine,
        set: &Actuation,
        dt_s: f64,
        tf: &mut Vec<Transform>,
    ) {
        let values: BTreeMap<&str, f64> = set.named().collect();
        let (names, described) = (names(machine), &machine.description);
        for (n, moved) in described.moved.iter().enumerate() {
            let joint = (described.joints.iter()).find(|j| j.joint == moved.joint);
            let (Some(joint), Some(value)) = (joint, values.get(moved.actuator.as_str())) else {
                continue;
            };
            let pose = match joint.kind {
                JointKind::Prismatic => joint.slid(*value),
                JointKind::Revolute => joint.turned((value / STEP_RAD).round() * STEP_RAD),
                JointKind::Continuous => {
                    let per_s = match moved.unit {
                        "rpm" => value / 60.0,
                        _ => value * TURNS_PER_INPUT,
                    };
                    let turns = self.turns.entry((machine_number, n)).or_default();
                    *turns = (*turns + per_s * dt_s).fract();
                    joint.turned(TAU * (*turns * BLADES).round() / BLADES)
                }
                JointKind::Fixed => continue,
            };
            let (parent, child) = (names.frame(&joint.parent), names.frame(&joint.child));
            tf.push(transform(t_ns, &parent, child, &pose));
        }
    }
}

/// Frames in a recording have the machine's id before them.
fn names(machine: &Machine) -> Names<'_> {
    Names { world: WORLD, own: &machine.id }
}

/// Frames of the links that drives move.
fn moved(machine: &Machine, names: &Names) -> BTreeSet<String> {
    let d = &machine.description;
    let joints =
        d.joints.iter().filter(|j| j.kind != JointKind::Fixed && d.moved.iter().any(|moved| moved.joint == j.joint));
    joints.map(|j| names.frame(&j.child)).collect()
}
