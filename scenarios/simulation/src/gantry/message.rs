//! The messages of a gantry, one for each row of [`TOPICS`](super::topics::TOPICS).

use super::topics::{GantryBehaviourMessage, GantryDeclarationMessage, JointsMessage, ProbesMessage, SpikesMessage};
use crate::frame::GantryFrame;
use crate::topic::{Said, chunk};

/// All messages of a gantry in a frame.
pub(crate) fn messages(t_s: f64, g: &GantryFrame) -> Said {
    let mut said = Said::below(format!("gantry/{}", chunk(&g.id)));
    let joints = JointsMessage {
        t_s,
        name: g.joint_names.to_vec(),
        position_m: g.joints.iter().map(|j| j.position_m).collect(),
        velocity_m_s: g.joints.iter().map(|j| j.speed_m_s).collect(),
        effort_n: g.joints.iter().map(|j| j.force_N).collect(),
        head_m: g.head_W.into(),
        encoder_m: g.readings.position_m.into(),
        target_m: g.goal.target_m.into(),
        arrived: g.readings.arrived,
        blocked: g.readings.blocked,
        touching: g.touching.clone(),
    };
    said.add("joints", &joints);
    if let Some(scan) = &g.scan {
        let position_m = g.tips_W.iter().map(|p| (*p).into()).collect();
        said.add("probes", &ProbesMessage { t_s: scan.t_s, position_m, volts: scan.volts[..scan.count].to_vec() });
    }
    let n = g.tips_W.len();
    let w = &g.shown;
    let spikes = SpikesMessage {
        t_s,
        threshold_v: w.threshold_v[..n].to_vec(),
        spike: w.spike[..n].to_vec(),
        spike_hz: w.spike_hz,
        magnitude_v: w.magnitude_v,
        predicted_v: w.predicted_v,
        contrast: w.contrast,
    };
    said.add("spikes", &spikes);
    let (behaviour, r#move, found) = (g.behaviour.name(), g.goal.id, g.stopped());
    let doing = GantryBehaviourMessage { t_s, behaviour, r#move, found };
    said.add("behaviour", &doing);
    if let Some(d) = g.declarations.first() {
        let declared = GantryDeclarationMessage { t_s: d.t_s, position_m: d.position.into(), rule: d.rule };
        said.add("declaration", &declared);
    }
    said
}
