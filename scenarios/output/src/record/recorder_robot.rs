//! A robot's part of a recording: where it is and believes it is, its readings, commands and decisions, and its map.

use super::map_record::{self, MapTimes};
use super::{AREA, WORLD};
use crate::mcap::{McapFile, RecordError};
use crate::ros::{
    MessageKind, Transform, believed_flow, believed_odometry, believed_pose, declared, echo_cloud, float64,
    nanoseconds, point_cloud, text, true_odometry,
};
use crate::scene::frames::transform;
use nalgebra::Vector2;
use rheotaxis::frame::{RobotFrame, TimedReading};
use robots::handoff::{Belief, Command, Declaration, Layer, Vertical, region_name};

/// What was recorded of a robot so far. Behaviours, layers, regions and declarations are written when they change.
#[derive(Debug, Default)]
pub(super) struct RobotRecorder {
    id: String,
    behaviour: &'static str,
    layers: Vec<Layer>,
    region: Option<u32>,
    declared: Vec<Declaration>,
    map: MapTimes,
}

impl RobotRecorder {
    /// Of a robot that nothing is recorded of yet.
    pub(super) fn new(robot: &RobotFrame) -> Self {
        Self { id: robot.id.clone(), ..Self::default() }
    }

    /// Records one frame under `/<id>/`.
    pub(super) fn record(&mut self, file: &mut McapFile, t: u64, r: &RobotFrame) -> Result<(), RecordError> {
        let id = &self.id;
        let mut put = |name: &str, kind: MessageKind, cdr: &[u8]| file.write(&format!("/{id}/{name}"), kind, t, cdr);
        put("truth", MessageKind::Odometry, &true_odometry(t, [WORLD, id], &r.truth))?;
        put("estimate", MessageKind::Odometry, &believed_odometry(t, [WORLD, &believed(id)], &r.estimate))?;
        put("altitude", MessageKind::Float64, &float64(r.altitude_m))?;
        if let Some(c) = r.chemical {
            put("chemical", MessageKind::Float64, &float64(c.volts))?;
        }
        if let Some(TimedReading { t_s, value: scan }) = &r.readings.ranging {
            put("ranging", MessageKind::PointCloud2, &echo_cloud(nanoseconds(*t_s), id, scan))?;
        }
        for (name, reading) in &r.readings.other {
            put(&format!("readings/{name}"), MessageKind::Float64, &float64(reading.value))?;
        }
        if let Some(flow) = &r.estimate.flow {
            put("flow", MessageKind::Vector3Stamped, &believed_flow(t, WORLD, flow))?;
        }
        for (name, v) in r.actuators.named() {
            put(&format!("actuators/{name}"), MessageKind::Float64, &float64(v))?;
        }
        for (name, v) in asked(r) {
            put(&format!("command/{name}"), MessageKind::Float64, &float64(v))?;
        }
        if self.behaviour != r.behaviour.name() {
            self.behaviour = r.behaviour.name();
            put("behaviour", MessageKind::Text, &text(self.behaviour))?;
        }
        if self.layers != r.shown.layers {
            self.layers.clone_from(&r.shown.layers);
            put("layers", MessageKind::Text, &text(&layers_line(&self.layers)))?;
            put("layer", MessageKind::Text, &text(r.holding_layer().unwrap_or("")))?;
        }
        for d in &r.declarations {
            if !self.declared.contains(d) {
                d.join(&mut self.declared);
                put("declaration", MessageKind::PoseStamped, &declared(WORLD, d, 0.0))?;
            }
        }
        if self.region != r.shown.regions.now {
            self.region = r.shown.regions.now;
            put("region", MessageKind::Text, &text(&self.region.map_or_else(String::new, region_name)))?;
        }
        Ok(())
    }

    /// Records its map if one is due; `centre` is that of the area.
    pub(super) fn map(
        &mut self,
        file: &mut McapFile,
        centre: Vector2<f64>,
        [t_s, period_s]: [f64; 2],
        r: &RobotFrame,
    ) -> Result<(), RecordError> {
        let due = r.belief.as_ref().and_then(|belief| self.map.due(t_s, period_s, belief));
        due.map_or(Ok(()), |due| self.write_map(file, centre, &due))
    }

    /// Records its last map, if that was not due.
    pub(super) fn last_map(&mut self, file: &mut McapFile, centre: Vector2<f64>) -> Result<(), RecordError> {
        let last = self.map.last();
        last.map_or(Ok(()), |last| self.write_map(file, centre, &last))
    }

    fn write_map(&self, file: &mut McapFile, centre: Vector2<f64>, belief: &Belief) -> Result<(), RecordError> {
        let t = nanoseconds(belief.t_s);
        let cloud = point_cloud(t, AREA, map_record::FIELDS, &map_record::points(belief, centre));
        file.write(&format!("/{}/map", self.id), MessageKind::PointCloud2, t, &cloud)
    }
}

/// What its guidance asks for, with names and units.
fn asked(r: &RobotFrame) -> Vec<(&'static str, f64)> {
    let mut all = match r.command {
        Some(Command::Steer(s)) => {
            vec![("heading_rad", s.heading.rad()), ("water_speed_m_s", s.water_speed_m_s)]
        }
        Some(Command::Move(s)) => {
            let v = s.over_ground_m_s;
            vec![("heading_rad", s.heading.rad()), ("east_m_s", v.x), ("north_m_s", v.y)]
        }
        Some(Command::Direct(_) | Command::Drives(_)) | None => Vec::new(),
    };
    all.extend(r.asked_height().map(|vertical| match vertical {
        Vertical::Altitude(m) => ("altitude_m", m),
        Vertical::Depth(m) => ("depth_m", m),
    }));
    all
}

/// Frames of a robot: where it is, and where it believes it is.
pub(super) fn frames_of(t: u64, r: &RobotFrame) -> [Transform; 2] {
    [
        transform(t, WORLD, r.id.clone(), &r.truth.pose),
        transform(t, WORLD, believed(&r.id), &believed_pose(&r.estimate)),
    ]
}

fn believed(id: &str) -> String {
    [id, "/estimate"].concat()
}

/// `find suppressed, maintain holds, ...`, the lowest layer first.
fn layers_line(layers: &[Layer]) -> String {
    let words: Vec<String> = (layers.iter()).map(|l| format!("{} {}", l.name, l.state.name())).collect();
    words.join(", ")
}
