//! A gantry's part of a recording: joints, probes, and the data and decisions of its searcher.

use super::WORLD;
use crate::mcap::{McapFile, RecordError};
use crate::ros::{MessageKind, Transform, declared, float64, nanoseconds, slides, text};
use crate::scene::frames::transform;
use nalgebra::UnitQuaternion;
use rheotaxis::gantry::GantryFrame;
use world::frames::Pose;
use world::math;

/// What was recorded of a gantry so far. Behaviours and the declaration are written when they change.
#[derive(Debug, Default)]
pub(super) struct GantryRecorder {
    behaviour: Option<&'static str>,
    declared: bool,
    scanned_s: Option<f64>,
}

impl GantryRecorder {
    /// Records one frame under `/<id>/`: `joint_states`; `probes/<n>`, `thresholds/<n>` (V) and `spikes/<n>` (0 or 1)
    /// in the order of the URDF, one message for each scan; `spike_hz`, `behaviour`, `declaration`.
    pub(super) fn record(&mut self, file: &mut McapFile, t: u64, g: &GantryFrame) -> Result<(), RecordError> {
        let id = &g.id;
        let mut put =
            |name: &str, kind: MessageKind, t: u64, cdr: &[u8]| file.write(&format!("/{id}/{name}"), kind, t, cdr);
        put("joint_states", MessageKind::JointState, t, &slides(t, WORLD, g))?;
        let w = &g.shown;
        if let Some(scan) = g.scan.filter(|s| self.scanned_s != Some(s.t_s)) {
            self.scanned_s = Some(scan.t_s);
            let at = nanoseconds(scan.t_s);
            for (n, volts) in scan.volts[..scan.count].iter().enumerate() {
                let spike = f64::from(u8::from(w.spike[n]));
                for (name, v) in [("probes", *volts), ("thresholds", w.threshold_v[n]), ("spikes", spike)] {
                    put(&format!("{name}/{n}"), MessageKind::Float64, at, &float64(v))?;
                }
            }
            put("spike_hz", MessageKind::Float64, at, &float64(w.spike_hz))?;
        }
        let behaviour = g.behaviour.name();
        if self.behaviour != Some(behaviour) {
            self.behaviour = Some(behaviour);
            put("behaviour", MessageKind::Text, t, &text(behaviour))?;
        }
        if let (Some(d), false) = (g.declarations.first(), self.declared) {
            self.declared = true;
            put("declaration", MessageKind::PoseStamped, t, &declared(WORLD, d, g.head_W.z))?;
        }
        Ok(())
    }
}

/// Frames of its head and of its probes' tips, all in the direction of the gantry.
pub(super) fn frames_of(t: u64, g: &GantryFrame) -> impl Iterator<Item = Transform> {
    let R_WB = UnitQuaternion::from_euler_angles(0.0, 0.0, math::atan2(g.forward.y, g.forward.x));
    let here = move |name: String, p_WB| transform(t, WORLD, format!("{}/{name}", g.id), &Pose { p_WB, R_WB });
    let tips = (g.tips_W.iter().enumerate()).map(move |(n, p)| here(format!("probe_{n}"), *p));
    std::iter::once(here("head".to_owned(), g.head_W)).chain(tips)
}
