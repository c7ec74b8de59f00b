//! What happened, as lines of a log: `/rosout` of the recording. Names are those of the robots and gantries.

use crate::mcap::{McapFile, RecordError};
use crate::ros::{LogLevel, MessageKind, log_line};
use nalgebra::Vector2;
use rheotaxis::frame::{Frame, GantryFrame, RobotFrame};
use robots::handoff::{Declaration, Verdict, region_name};
use std::collections::BTreeMap;

/// A detection after so long a time without one is told, s.
const SILENCE_S: f64 = 10.0;

/// What was told so far.
#[derive(Debug, Default)]
pub(super) struct LogRecorder {
    told: BTreeMap<String, LogState>,
    abnormal: usize,
}

/// What was told of one machine.
#[derive(Debug, Default)]
struct LogState {
    behaviour: Option<&'static str>,
    layer: Option<&'static str>,
    region: Option<u32>,
    detected_s: Option<f64>,
    lost: usize,
    declared: Vec<Declaration>,
    touching: Option<String>,
}

impl LogRecorder {
    /// Tells what is new in a frame.
    pub(super) fn frame(&mut self, file: &mut McapFile, t_ns: u64, frame: &Frame) -> Result<(), RecordError> {
        let mut lines: Vec<(LogLevel, &str, String)> = Vec::new();
        for r in &frame.robots {
            let told = self.told.entry(r.id.clone()).or_default();
            let new = told.robot(frame.t_s, r);
            lines.extend(new.into_iter().map(|line| (LogLevel::Info, r.id.as_str(), line)));
        }
        for g in &frame.gantries {
            let told = self.told.entry(g.id.clone()).or_default();
            lines.extend(told.gantry(g).map(|(level, line)| (level, g.id.as_str(), line)));
        }
        for a in frame.abnormal.iter().skip(self.abnormal) {
            lines.push((LogLevel::Warn, &a.robot, a.describe()));
        }
        self.abnormal = self.abnormal.max(frame.abnormal.len());
        for (level, name, line) in lines {
            let cdr = log_line(t_ns, level, name, &line);
            file.write("/rosout", MessageKind::Log, t_ns, &cdr)?;
        }
        Ok(())
    }
}

impl LogState {
    fn robot(&mut self, t_s: f64, r: &RobotFrame) -> Vec<String> {
        let mut lines = Vec::new();
        if r.detected {
            let before = self.detected_s.replace(t_s);
            if before.is_none_or(|before| t_s - before > SILENCE_S) {
                let volts = r.chemical.map_or(f64::NAN, |c| c.volts);
                lines.push(format!("detects the plume: {volts:.2} V"));
            }
        }
        if self.region != r.shown.regions.now {
            self.region = r.shown.regions.now;
            lines.extend(self.region.map(|k| format!("subregion {}", region_name(k))));
        }
        if r.shown.lost_points.len() > self.lost
            && let Some(p) = r.shown.lost_points.last()
        {
            lines.push(format!("lost the plume at {}", place(p)));
        }
        self.lost = r.shown.lost_points.len();
        lines.extend(self.behaves(r.behaviour.name()));
        if self.layer != r.holding_layer() {
            self.layer = r.holding_layer();
            lines.extend(self.layer.map(|name| format!("layer: {name}")));
        }
        for d in &r.declarations {
            lines.extend(self.declares(d));
        }
        lines
    }

    fn gantry(&mut self, g: &GantryFrame) -> impl Iterator<Item = (LogLevel, String)> {
        let mut lines = Vec::new();
        lines.extend(self.behaves(g.behaviour.name()));
        lines.extend(g.declarations.iter().filter_map(|d| self.declares(d)));
        let mut lines: Vec<_> = lines.into_iter().map(|l| (LogLevel::Info, l)).collect();
        if self.touching != g.touching {
            self.touching.clone_from(&g.touching);
            let touched = g.touching.iter();
            lines.extend(touched.map(|what| (LogLevel::Warn, format!("touches {what}"))));
        }
        lines.into_iter()
    }

    fn behaves(&mut self, name: &'static str) -> Option<String> {
        (self.behaviour.replace(name) != Some(name)).then(|| format!("behaviour: {name}"))
    }

    /// A declaration that is new, or that was looked at since.
    fn declares(&mut self, d: &Declaration) -> Option<String> {
        let number = d.number + 1;
        let known = self.declared.iter_mut().find(|k| k.number == d.number);
        let Some(known) = known else {
            self.declared.push(*d);
            let at = place(&d.position);
            return Some(format!("declares source {number} at {at}, by {}", d.rule));
        };
        let looked = known.verdict != d.verdict && d.verdict != Verdict::Unchecked;
        *known = *d;
        looked.then(|| format!("source {number}: {}", d.verdict.name()))
    }
}

fn place(p: &Vector2<f64>) -> String {
    format!("east {:.1} m, north {:.1} m", p.x, p.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::frames;

    #[test]
    fn a_mission_is_told_in_its_order() {
        let mut told = LogState::default();
        let lines: Vec<String> = (frames(100).iter()).flat_map(|f| told.robot(f.t_s, &f.robots[0])).collect();
        let find = |beginning: &str| {
            let found = lines.iter().position(|l| l.starts_with(beginning));
            found.unwrap_or_else(|| panic!("{beginning}: {lines:#?}"))
        };
        let order = [
            "behaviour: go_to",
            "behaviour: find",
            "detects the plume: ",
            "lost the plume at east ",
            "declares source 1 at east ",
            "behaviour: go_home",
        ];
        let places = order.map(find);
        assert!(places[0] < places[1] && places[1] < places[2], "{lines:#?}");
        assert!(places[3] < places[4], "{lines:#?}");
        assert!(lines.len() < 60, "{}", lines.len());
        let declared = lines.iter().filter(|l| l.starts_with("declares"));
        assert_eq!(declared.count(), 1);
    }

    #[test]
    fn a_verdict_is_told_once() {
        let mut told = LogState::default();
        let mut d = Declaration::first(1.0, Vector2::new(2.0, 3.0), "along_flow");
        let first = told.declares(&d);
        assert_eq!(first.as_deref(), Some("declares source 1 at east 2.0 m, north 3.0 m, by along_flow"));
        assert_eq!(told.declares(&d), None);
        d.verdict = Verdict::Verified;
        assert_eq!(told.declares(&d).as_deref(), Some("source 1: verified"));
        assert_eq!(told.declares(&d), None);
    }
}
