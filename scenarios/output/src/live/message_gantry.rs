//! A gantry's state as messages.

use super::message::{Message, with};
use super::options::chunk;
use rheotaxis::gantry::GantryFrame;
use serde_json::{Value, json};

pub(super) fn gantry(t_s: f64, g: &GantryFrame) -> Vec<Message> {
    let id = chunk(&g.id);
    let mut out = Vec::with_capacity(5);
    let mut say =
        |topic: &str, value: Value| out.push(Message::json(format!("gantry/{id}/{topic}"), &value));
    let d = &g.decision;

    let mut joints = json!({
        "t_s": t_s,
        "name": g.joint_names,
        "position_m": g.joints.map(|j| j.position_m),
        "velocity_m_s": g.joints.map(|j| j.speed_m_s),
        "effort_n": g.joints.map(|j| j.force_N),
        "head_m": g.head_W.as_slice(),
        "encoder_m": g.readings.position_m.as_slice(),
        "target_m": d.target_m.as_slice(),
        "arrived": g.readings.arrived,
        "blocked": g.readings.blocked,
    });
    if let Some(what) = &g.touching {
        joints["touching"] = json!(what);
    }
    say("joints", joints);
    if let Some(scan) = &g.scan {
        let tips: Vec<&[f64]> = g.tips_W.iter().map(|p| p.as_slice()).collect();
        say(
            "probes",
            json!({"t_s": scan.t_s, "position_m": tips, "volts": &scan.volts[..scan.count]}),
        );
    }
    let n = g.tips_W.len();
    let w = &d.working;
    say(
        "spikes",
        with(
            json!({
                "t_s": t_s,
                "threshold_v": &w.threshold_v[..n],
                "spike": &w.spike[..n],
                "spike_hz": w.spike_hz,
                "magnitude_v": w.magnitude_v,
                "contrast": w.contrast,
            }),
            "predicted_v",
            w.predicted_v,
        ),
    );
    let mut doing = json!({"t_s": t_s, "behaviour": d.behaviour.name(), "move": d.id});
    if let Some(found) = d.stopped {
        doing["found"] = json!(found);
    }
    say("behaviour", doing);
    if let Some(d) = &g.declaration {
        say(
            "declaration",
            json!({"t_s": d.t_s, "position_m": d.position.as_slice(), "rule": d.rule}),
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample_gantry as sample;
    use robots::handoff::{GantryBehaviour, ProbeScan};

    fn said(g: &GantryFrame, topic: &str) -> Option<Value> {
        let key = format!("gantry/crab0/{topic}");
        let all = gantry(2.5, g);
        let message = all.iter().find(|m| m.key == key)?;
        Some(serde_json::from_slice(&message.payload).unwrap())
    }

    #[test]
    fn only_the_probes_there_are_speak_and_only_once_they_were_read() {
        let mut g = sample::gantry(1.0, 0.2, GantryBehaviour::Cast);
        assert_eq!(said(&g, "probes"), None);
        g.scan = Some(ProbeScan {
            t_s: 2.4,
            volts: [-4.5, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0],
            count: 1,
        });
        let probes = said(&g, "probes").unwrap();
        assert_eq!(
            probes,
            json!({"t_s": 2.4, "position_m": [[1.0, 0.2, -0.125]], "volts": [-4.5]})
        );
        let spikes = said(&g, "spikes").unwrap();
        assert_eq!(spikes["spike"], json!([false]));
        assert!(spikes.get("predicted_v").is_none());
        let doing = said(&g, "behaviour").unwrap();
        assert_eq!(doing, json!({"t_s": 2.5, "behaviour": "cast", "move": 1}));
        assert_eq!(said(&g, "declaration"), None);
    }
}
