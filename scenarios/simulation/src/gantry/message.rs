//! The messages of a gantry, one for each row of [`TOPICS`](super::topics::TOPICS).

use crate::frame::GantryFrame;
use crate::topic::{chunk, with};
use serde_json::{Value, json};

/// All messages of a gantry in a frame.
pub(crate) fn messages(t_s: f64, g: &GantryFrame) -> Vec<(String, Value)> {
    let id = chunk(&g.id);
    let mut out = Vec::with_capacity(5);
    let mut say = |topic: &str, value: Value| out.push((format!("gantry/{id}/{topic}"), value));
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
        say("probes", json!({"t_s": scan.t_s, "position_m": tips, "volts": &scan.volts[..scan.count]}));
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
        say("declaration", json!({"t_s": d.t_s, "position_m": d.position.as_slice(), "rule": d.rule}));
    }
    out
}
