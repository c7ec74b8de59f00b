//! The messages: a state as JSON, a plume as packed numbers.

use super::{LiveCounts, Payload, Topic};
use rheotaxis::frame::{Frame, PlumeFrame, WaterFrame};
use rheotaxis::registry::messages;
use rheotaxis::topic::message_json;
use rheotaxis::topic::run::{
    ClockMessage, DTYPE, DigestMessage, PlumeMessage, ScenarioMessage, VersionMessage, WaterMessage,
};
use serde::Serialize;

/// A message, with its key below `rheotaxis/<run>/`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Message {
    pub(super) key: String,
    pub(super) payload: Vec<u8>,
    pub(super) packed: Payload,
    /// Header of a payload that is not JSON.
    pub(super) attachment: Option<Vec<u8>>,
}

impl Message {
    pub(super) fn json(key: impl Into<String>, message: &impl Serialize) -> Self {
        Self { key: key.into(), payload: bytes(message), packed: Payload::Json, attachment: None }
    }

    /// Packed numbers with a header.
    pub(super) fn numbers(key: impl Into<String>, numbers: impl Iterator<Item = f32>, header: &impl Serialize) -> Self {
        let payload = numbers.flat_map(f32::to_le_bytes).collect();
        Self { key: key.into(), payload, packed: Payload::PackedF32, attachment: Some(bytes(header)) }
    }
}

/// A message or a header as JSON.
pub(super) fn bytes(message: &impl Serialize) -> Vec<u8> {
    message_json(message).expect("numbers, words and lists are JSON").to_string().into_bytes()
}

/// No plume message has more filaments, so that it stays well below 1 MB.
const MOST_FILAMENTS: usize = 10_000;

pub(super) fn clock(t_s: f64, step: u64, ended: bool, counts: LiveCounts) -> Message {
    let LiveCounts { sent, superseded, .. } = counts;
    Message::json("clock", &ClockMessage { t_s, step, ended, sent, superseded })
}

/// All messages of a state except the clock.
pub(super) fn state(frame: &Frame) -> Vec<Message> {
    let all = messages(frame).into_iter();
    all.map(|(key, value)| Message::json(key, &value)).collect()
}

/// A plume, evenly thinned if it is too large for one message.
pub(super) fn plume(p: &PlumeFrame) -> Message {
    let stride = p.points.len().div_ceil(MOST_FILAMENTS).max(1);
    let local = p.local();
    let shown = local.iter().step_by(stride);
    // The filaments that are shown also stand for those omitted here, as they already do for those omitted before.
    let times = p.points.len() as f32 / shown.len().max(1) as f32;
    let shown = shown.map(|&[x, y, z, size, mass, n]| [x, y, z, size, mass * times, n * times]);
    let header = PlumeMessage {
        t_s: p.t_s,
        total: p.total,
        shown: shown.len(),
        origin_m: p.centre.into(),
        fields: vec!["x", "y", "z", "size", "mass", "stands_for"],
        dtype: DTYPE,
    };
    Message::numbers("plume", shown.flatten(), &header)
}

/// The flow of the water.
pub(super) fn water(w: &WaterFrame) -> Message {
    let header = WaterMessage {
        t_s: w.t_s,
        shown: w.points.len(),
        origin_m: w.centre.into(),
        fields: vec!["x", "y", "z", "vx", "vy", "vz"],
        dtype: DTYPE,
    };
    Message::numbers("water", w.local().into_iter().flatten(), &header)
}

/// Messages known before the run starts: scenario, version and schemas of the topics.
pub(super) fn meta(meta: &super::LiveMeta, topics: &[Topic]) -> Vec<Message> {
    let (name, ron) = (meta.scenario_name.clone(), meta.scenario_text.clone());
    let mut out = vec![
        Message::json("meta/scenario", &ScenarioMessage { name, seed: meta.seed, ron }),
        Message::json("meta/version", &VersionMessage { program: "rheotaxis", version: meta.version.clone() }),
    ];
    // The bytes themselves, so that they are those of the recording's attachment.
    out.extend(meta.scene.as_ref().map(|document| Message {
        key: "meta/scene".to_owned(),
        payload: document.clone().into_bytes(),
        packed: Payload::Json,
        attachment: None,
    }));
    let schema = |t: &Topic| Message::json(format!("meta/schema/{}", t.name), &t.schema());
    out.extend(topics.iter().map(schema));
    out
}

pub(super) fn digest(digest: &str) -> Message {
    Message::json("meta/digest", &DigestMessage { digest: digest.to_owned() })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::{sample, sample_gantry};
    use nalgebra::{Vector2, Vector3};
    use rheotaxis::frame::GantryFrame;
    use rheotaxis::topic::TopicValue;
    use robots::handoff::{Behaviour, ProbeScan};
    use serde_json::{Value, json};
    use world::units::Heading;

    /// One robot, heading east at 1 m/s, and a gantry.
    pub(crate) fn frame(step: u64) -> Frame {
        let robot = sample::robot(Vector3::new(1.0, 2.0, -3.0), Heading::from_deg(90.0));
        let gantry = sample_gantry::gantry(1.0, 0.0, Behaviour::StepUp);
        Frame { t_s: 0.1, step, robots: vec![robot], gantries: vec![gantry], ..Frame::default() }
    }

    /// A value of a topic of another crate.
    pub(crate) fn published(key: &str, t_s: f64) -> TopicValue {
        const TOPIC: Topic = Topic::of::<ClockMessage>("own", "own/<id>", "always");
        TopicValue { topic: TOPIC, key: key.to_owned(), t_s, value: json!({ "t_s": t_s }) }
    }

    #[test]
    fn what_systems_publish_comes_under_its_key() {
        let mut frame = frame(0);
        frame.published = vec![published("own/Buoy 1", 2.5)];
        let last = state(&frame).pop().unwrap();
        assert_eq!(last.key, "own/buoy_1");
        let value: Value = serde_json::from_slice(&last.payload).unwrap();
        assert_eq!(value["t_s"], 2.5);
    }

    #[test]
    fn velocities_are_in_world_axes() {
        let messages = state(&frame(0));
        let truth: Value = serde_json::from_slice(&messages[0].payload).unwrap();
        assert_eq!(messages[0].key, "auv/auv0/truth");
        let v: Vec<f64> = serde_json::from_value(truth["velocity_m_s"].clone()).unwrap();
        // East at 1 m/s; a quarter turn in f64 is exact to a few ulp.
        assert!((v[0] - 1.0).abs() < 1e-12 && v[1].abs() < 1e-12 && v[2].abs() < 1e-12, "{v:?}");
    }

    #[test]
    fn a_plume_is_packed_in_order_and_thinned_evenly() {
        let n = 2 * MOST_FILAMENTS + 1;
        let points = (0..n).map(|i| [i as f64 + 1e7, 1.0, 2.0, 3.0, 4.0, 10.0]).collect();
        let message = plume(&PlumeFrame { t_s: 1.5, total: 99_999, points, centre: Vector2::new(1e7, 0.0) });
        let header: Value = serde_json::from_slice(&message.attachment.unwrap()).unwrap();
        let shown = header["shown"].as_u64().unwrap() as usize;
        assert_eq!(shown, n.div_ceil(3));
        assert_eq!(header["total"], 99_999);
        assert_eq!(message.payload.len(), shown * 24);
        let number = |i: usize| f32::from_le_bytes(message.payload[4 * i..4 * i + 4].try_into().unwrap());
        assert_eq!([number(0), number(6), number(7)], [0.0, 3.0, 1.0]);
        // The masses sum to those of all points passed in.
        let mass: f64 = (0..shown).map(|i| f64::from(number(6 * i + 4))).sum();
        assert!((mass / (4.0 * n as f64) - 1.0).abs() < 1e-5, "{mass}");
    }

    fn said(g: &GantryFrame, topic: &str) -> Option<Value> {
        let key = format!("gantry/crab0/{topic}");
        let frame = Frame { t_s: 2.5, gantries: vec![g.clone()], ..Frame::default() };
        let message = state(&frame).into_iter().find(|m| m.key == key)?;
        Some(serde_json::from_slice(&message.payload).unwrap())
    }

    #[test]
    fn only_the_probes_there_are_speak_and_only_once_they_were_read() {
        let mut g = sample_gantry::gantry(1.0, 0.2, Behaviour::Cast);
        assert_eq!(said(&g, "probes"), None);
        g.scan = Some(ProbeScan { t_s: 2.4, volts: [-4.5, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0], count: 1 });
        let probes = said(&g, "probes").unwrap();
        assert_eq!(probes, json!({"t_s": 2.4, "position_m": [[1.0, 0.2, -0.125]], "volts": [-4.5]}));
        let spikes = said(&g, "spikes").unwrap();
        assert_eq!(spikes["spike"], json!([false]));
        assert!(spikes.get("predicted_v").is_none());
        let doing = said(&g, "behaviour").unwrap();
        assert_eq!(doing, json!({"t_s": 2.5, "behaviour": "cast", "move": 1}));
        assert_eq!(said(&g, "declaration"), None);
    }
}
