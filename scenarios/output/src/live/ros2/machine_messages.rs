//! Messages of a robot or a gantry, with the names of their topics and frames.

use super::MAP;
use super::topics::RosTopic;
use crate::scene::Machine;
use crate::scene::frames::Names;

/// Names of a machine's frames.
pub(super) fn names(machine: &Machine) -> Names<'_> {
    Names { world: MAP, own: &machine.name }
}

/// A message for a topic of a name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Message {
    pub(super) topic: &'static RosTopic,
    pub(super) name: String,
    pub(super) cdr: Vec<u8>,
}

/// The messages of one machine.
pub(super) struct MachineMessages<'a> {
    pub(super) machine: &'a Machine,
    pub(super) t_ns: u64,
    pub(super) out: Vec<Message>,
}

impl<'a> MachineMessages<'a> {
    pub(super) fn new(machine: &'a Machine, t_ns: u64) -> Self {
        let out = Vec::new();
        Self { machine, t_ns, out }
    }

    /// Adds a message on a topic of this machine.
    pub(super) fn add(&mut self, topic: &'static RosTopic, cdr: Vec<u8>) {
        self.put_named(topic, "", cdr);
    }

    /// The same with the name of one of its probes.
    pub(super) fn put_named(&mut self, topic: &'static RosTopic, probe: &str, cdr: Vec<u8>) {
        let own = self.machine.name.as_str();
        let name = (topic.name.replace("<robot>", own)).replace("<gantry>", own).replace("<probe>", probe);
        self.out.push(Message { topic, name, cdr });
    }
}
