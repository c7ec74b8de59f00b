//! Ways and marks in a recording: where machines went and believed they went, what they plan, where they lost the plume,
//! the zone that this makes for the declaration rule, and what they declared.

use super::WORLD;
use super::growing_path::GrowingPath;
use crate::mcap::{McapFile, RecordError};
use crate::ros::{Balls, MessageKind, balls, path};
use crate::scene::Scene;
use nalgebra::{Vector2, Vector3};
use rheotaxis::frame::Frame;
use robots::handoff::Zone;
use std::collections::BTreeMap;

/// How far a recorded way may be off, as a share of the area's diagonal; and without an area, m.
const TOLERANCE: f64 = 0.001;
const TOLERANCE_M: f64 = 0.5;
/// Diameter of a mark, as a share of the area's diagonal; and without an area, m.
const MARK: f64 = 0.006;
const MARK_M: f64 = 2.0;
/// The marks with their colours: red, green, blue, opacity.
const MARKS: [(&str, [f32; 4]); 3] = [
    ("lost points", [0.80, 0.47, 0.65, 1.0]),
    ("points of the zone", [0.90, 0.62, 0.0, 1.0]),
    ("declared", [0.94, 0.89, 0.26, 1.0]),
];

/// The ways and marks of a run.
#[derive(Debug, Default)]
pub(super) struct WayRecorder {
    diagonal_m: Option<f64>,
    /// By topic.
    ways: BTreeMap<String, GrowingPath>,
    /// Newest marks and plan, by topic: they are recorded when they change.
    marks: BTreeMap<String, [Vec<Vector3<f64>>; 3]>,
    plans: BTreeMap<String, Vec<Vector3<f64>>>,
    zones: BTreeMap<String, Zone>,
}

impl WayRecorder {
    /// Of a scene.
    pub(super) fn from_scene(scene: &Scene) -> Self {
        let diagonal = |c: &[Vector2<f64>]| Some((c.get(2)? - c.first()?).norm());
        Self { diagonal_m: diagonal(&scene.corners), ..Self::default() }
    }

    /// Notes where all are, and records plans and marks that are new.
    pub(super) fn frame(&mut self, file: &mut McapFile, t_ns: u64, frame: &Frame) -> Result<(), RecordError> {
        for r in &frame.robots {
            let believed = r.estimate.p_WB();
            self.pass(["/", &r.id, "/truth/path"].concat(), r.truth.pose.p_WB);
            self.pass(["/", &r.id, "/estimate/path"].concat(), believed);
            let plan = ["/", &r.id, "/plan"].concat();
            let known = self.plans.get(&plan);
            // Without a plan there is no topic; one that is given up leaves an empty path.
            if known.map_or(!r.shown.planned.is_empty(), |k| *k != r.shown.planned) {
                let cdr = path(t_ns, WORLD, &r.shown.planned);
                file.write(&plan, MessageKind::Path, t_ns, &cdr)?;
                self.plans.insert(plan, r.shown.planned.clone());
            }
            let places = r.declarations.iter().map(|d| d.position);
            let declared: Vec<_> = places.collect();
            let flat = [&r.shown.lost_points, &r.shown.zone.points, &declared].map(Vec::as_slice);
            self.mark(file, t_ns, &r.id, believed.z, flat)?;
            self.zone(file, t_ns, &r.id, believed.z, &r.shown.zone)?;
        }
        for g in &frame.gantries {
            self.pass(["/", &g.id, "/head/path"].concat(), g.head_W);
            let declared: Vec<_> = g.declarations.iter().map(|d| d.position).collect();
            self.mark(file, t_ns, &g.id, g.head_W.z, [&[], &[], &declared])?;
        }
        Ok(())
    }

    fn pass(&mut self, topic: String, p_W: Vector3<f64>) {
        let tolerance_m = self.diagonal_m.map_or(TOLERANCE_M, |m| TOLERANCE * m);
        let way = self.ways.entry(topic);
        way.or_insert_with(|| GrowingPath::new(tolerance_m)).push(p_W);
    }

    /// The outline of what the declaration rule looked at, closed, at the height of its machine.
    fn zone(&mut self, file: &mut McapFile, t_ns: u64, id: &str, z: f64, zone: &Zone) -> Result<(), RecordError> {
        let topic = ["/", id, "/zone"].concat();
        let known = self.zones.get(&topic);
        if known.map_or(zone.corners.is_empty(), |k| k == zone) {
            return Ok(());
        }
        let corners = zone.corners.iter().chain(zone.corners.first());
        let outline: Vec<_> = corners.map(|p| p.push(z)).collect();
        let cdr = path(t_ns, WORLD, &outline);
        file.write(&topic, MessageKind::Path, t_ns, &cdr)?;
        self.zones.insert(topic, zone.clone());
        Ok(())
    }

    /// Lost points and declarations are flat; they get the height of their machine when they are new.
    fn mark(
        &mut self,
        file: &mut McapFile,
        t_ns: u64,
        id: &str,
        z: f64,
        flat: [&[Vector2<f64>]; 3],
    ) -> Result<(), RecordError> {
        let topic = ["/", id, "/marks"].concat();
        let none = [const { Vec::new() }; 3];
        let told = self.marks.get(&topic);
        let known = told.unwrap_or(&none);
        let same = |known: &[Vector3<f64>], now: &[Vector2<f64>]| {
            known.len() == now.len() && known.iter().zip(now).all(|(k, n)| k.xy() == *n)
        };
        // The first one is recorded even if it is empty, so that each recording has the topic.
        if told.is_some() && (known.iter().zip(flat)).all(|(k, now)| same(k, now)) {
            return Ok(());
        }
        let raised = [0, 1, 2].map(|k| {
            let places = flat[k].iter().map(|p| {
                let before = known[k].iter().find(|q| q.xy() == *p);
                before.copied().unwrap_or_else(|| p.push(z))
            });
            places.collect::<Vec<_>>()
        });
        let diameter_m = self.diagonal_m.map_or(MARK_M, |m| MARK * m);
        let shown: Vec<Balls> = (MARKS.into_iter().zip(&raised))
            .map(|((name, colour), places)| Balls { name, colour, diameter_m, places })
            .collect();
        let cdr = balls(t_ns, WORLD, &shown);
        file.write(&topic, MessageKind::MarkerArray, t_ns, &cdr)?;
        self.marks.insert(topic, raised);
        Ok(())
    }

    /// Records the whole ways up to now.
    pub(super) fn whole(&self, file: &mut McapFile, t_ns: u64) -> Result<(), RecordError> {
        for (topic, way) in &self.ways {
            let cdr = path(t_ns, WORLD, &way.points());
            file.write(topic, MessageKind::Path, t_ns, &cdr)?;
        }
        Ok(())
    }
}
