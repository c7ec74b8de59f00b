//! Messages of a frame. What is latched is said when it changes.

use super::machine_messages::{MachineMessages, Message, names};
use super::{MAP, readings, topics};
use crate::ros::{
    Transform, believed_flow, believed_odometry, believed_pose, declared, float64, nanoseconds, path, slides, text,
    transforms, true_odometry,
};
use crate::scene::Scene;
use crate::scene::frames::{BODY, slid, transform};
use rheotaxis::frame::{Frame, GantryFrame, RobotFrame};
use robots::handoff::Declaration;
use std::collections::BTreeMap;

/// What was said last on each latched topic, so that it is said again only when it is new.
#[derive(Debug, Default)]
pub(super) struct LatchedTopics {
    latched: BTreeMap<String, Vec<u8>>,
}

impl LatchedTopics {
    /// All messages of a frame except the time.
    pub(super) fn messages(&mut self, scene: &Scene, frame: &Frame) -> Vec<Message> {
        let t_ns = nanoseconds(frame.t_s);
        let mut out = Vec::new();
        let mut tf = Vec::new();
        for robot in &frame.robots {
            if let Some(machine) = scene.machine(&robot.id) {
                let mut of = MachineMessages::new(machine, t_ns);
                self.robot(&mut of, robot, &mut tf);
                out.append(&mut of.out);
            }
        }
        for gantry in &frame.gantries {
            if let Some(machine) = scene.machine(&gantry.id) {
                let mut of = MachineMessages::new(machine, t_ns);
                self.gantry(&mut of, gantry, &mut tf);
                out.append(&mut of.out);
            }
        }
        let (topic, name) = (&topics::TF, topics::TF.name.to_owned());
        let cdr = transforms(&tf);
        // First, so that a node that has a message also has the frame that it is in.
        out.insert(0, Message { topic, name, cdr });
        out
    }

    fn robot(&mut self, of: &mut MachineMessages, r: &RobotFrame, tf: &mut Vec<Transform>) {
        // The estimate is older than the truth: it holds for the time of the readings in it.
        let (t_ns, believed_ns) = (of.t_ns, nanoseconds(r.estimate.t_s));
        let (body, truth) = (of.machine.frame(BODY), of.machine.frame("ground_truth"));
        of.add(&topics::ODOM, believed_odometry(believed_ns, [MAP, &body], &r.estimate));
        of.add(&topics::TRUTH, true_odometry(t_ns, [MAP, &truth], &r.truth));
        tf.push(transform(believed_ns, MAP, body, &believed_pose(&r.estimate)));
        tf.push(transform(t_ns, MAP, truth, &r.truth.pose));
        readings::add_readings(of, &r.readings);
        if let Some(c) = r.chemical {
            of.add(&topics::CHEMICAL, float64(c.volts));
        }
        if let Some(flow) = &r.estimate.flow {
            of.add(&topics::FLOW, believed_flow(believed_ns, MAP, flow));
        }
        self.behaviour(of, r.behaviour.name());
        if !r.shown.planned.is_empty() || self.latched.contains_key(&plan_of(of)) {
            // The stamp is that of the start, so that the same path is the same message.
            let same = path(0, MAP, &r.shown.planned);
            if self.is_new(plan_of(of), same) {
                of.add(&topics::PLAN, path(t_ns, MAP, &r.shown.planned));
            }
        }
        for d in &r.declarations {
            self.declaration(of, d, 0.0);
        }
    }

    fn gantry(&mut self, of: &mut MachineMessages, g: &GantryFrame, tf: &mut Vec<Transform>) {
        let positions: Vec<f64> = g.joints.iter().map(|j| j.position_m).collect();
        tf.extend(slid(of.t_ns, of.machine, &names(of.machine), &positions));
        of.add(&topics::JOINTS, slides(of.t_ns, "", g));
        if let Some(scan) = &g.scan {
            let probes = of.machine.probes.iter().zip(&scan.volts[..scan.count]);
            for (probe, volts) in probes {
                of.put_named(&topics::PROBE, probe, float64(*volts));
            }
        }
        self.behaviour(of, g.behaviour.name());
        for d in &g.declarations {
            self.declaration(of, d, g.head_W.z);
        }
    }

    fn behaviour(&mut self, of: &mut MachineMessages, name: &str) {
        let cdr = text(name);
        if self.is_new(format!("{}/behaviour", of.machine.name), cdr.clone()) {
            of.add(&topics::BEHAVIOUR, cdr);
        }
    }

    /// A declaration that was not said before: of its region, if the area is divided.
    fn declaration(&mut self, of: &mut MachineMessages, d: &Declaration, z: f64) {
        let cdr = declared(MAP, d, z);
        let which = format!("{}/declaration/{:?}", of.machine.name, d.region);
        if self.is_new(which, cdr.clone()) {
            of.add(&topics::DECLARATION, cdr);
        }
    }

    fn is_new(&mut self, which: String, cdr: Vec<u8>) -> bool {
        let before = self.latched.insert(which, cdr.clone());
        before != Some(cdr)
    }
}

fn plan_of(of: &MachineMessages) -> String {
    format!("{}/plan", of.machine.name)
}
