//! Says through the node what the publishing thread hands over.

use super::machine_messages::{Message, names};
use super::node::Node;
use super::state::LatchedTopics;
use super::topics::{self, RosTopic};
use super::{AREA, MAP, Ros2};
use crate::live::slots::CountedValue;
use crate::ros::{clock, compressed_image, marker_array, nanoseconds, plume_cloud, text, transforms};
use crate::scene::Scene;
use crate::scene::frames::{fixed, transform};
use rheotaxis::frame::{Frame, PictureFrame, PlumeFrame};
use std::sync::Arc;
use world::frames::Pose;
use zenoh::{Result, Session};

/// A run's node in the ROS graph.
pub(in crate::live) struct Door<'a> {
    node: Node<'a>,
    scene: Arc<Scene>,
    spoken: LatchedTopics,
}

impl<'a> Door<'a> {
    /// Joins the graph and says what is known before the run.
    pub(in crate::live) fn open(session: &'a Session, ros2: &Ros2) -> Result<Self> {
        let mut door = Self {
            node: Node::join(session, ros2.domain)?,
            scene: Arc::clone(&ros2.scene),
            spoken: LatchedTopics::default(),
        };
        let scene = Arc::clone(&ros2.scene);
        let machines = scene.machines.iter();
        let mut still = vec![scene.area_frame(MAP, AREA)];
        still.extend(machines.flat_map(|m| fixed(m, &names(m))));
        let fixed =
            [(&topics::TF_STATIC, transforms(&still)), (&topics::SCENE, marker_array(0, MAP, &scene.markers()))];
        for (topic, cdr) in fixed {
            door.node.say(topic, topic.name, cdr)?;
        }
        for machine in &scene.machines {
            let name = format!("/{}/robot_description", machine.name);
            let cdr = text(&machine.description.urdf);
            door.node.say(&topics::DESCRIPTION, &name, cdr)?;
        }
        Ok(door)
    }

    /// Says a state; its time last, so that a node that has the time also has the state that belongs to it.
    pub(in crate::live) fn state(&mut self, frame: &Frame) {
        for message in self.spoken.messages(&self.scene, frame) {
            self.say(message);
        }
        self.world(&topics::CLOCK, clock(nanoseconds(frame.t_s)));
    }

    /// Says a plume.
    pub(in crate::live) fn plume(&mut self, plume: &PlumeFrame) {
        self.world(&topics::PLUME, plume_cloud(plume, AREA));
    }

    /// Says a picture that is already a JPEG file.
    pub(in crate::live) fn picture(&mut self, newest: &CountedValue<PictureFrame>, jpeg: &[u8]) {
        let taken = &newest.value;
        let scene = Arc::clone(&self.scene);
        let Some(machine) = scene.machine(&taken.robot) else {
            return;
        };
        let (t, p) = (nanoseconds(taken.t_s), &taken.picture);
        let (body, camera) = (machine.frame("base_link"), machine.frame("camera_optical"));
        let pose = Pose { p_WB: p.p_BC, R_WB: p.R_BC };
        let mount = transforms(&[transform(t, &body, camera.clone(), &pose)]);
        self.world(&topics::TF, mount);
        self.say(Message {
            topic: &topics::CAMERA,
            name: format!("/{}/camera/compressed", machine.name),
            cdr: compressed_image(t, &camera, "jpeg", jpeg),
        });
    }

    fn world(&mut self, topic: &'static RosTopic, cdr: Vec<u8>) {
        self.say(Message { topic, name: topic.name.to_owned(), cdr });
    }

    /// What cannot be said is lost, like what did not fit into a queue; the run continues.
    fn say(&mut self, message: Message) {
        let Message { topic, name, cdr } = message;
        drop(self.node.say(topic, &name, cdr));
    }
}
