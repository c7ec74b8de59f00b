//! Gathers a summary from the frames of a run.

use super::recorder::RunInfo;
use super::summary::{
    DeclarationSummary, Position, RobotSummary, RunOutcome, RunSummary, SourceError, SourceSummary,
    Summary, Totals,
};
use crate::frame::{Frame, RobotFrame};
use crate::gantry::GantryPath;
use nalgebra::{Vector2, Vector3};
use robots::handoff::{Behaviour, BeliefGrid, Declaration};
use std::sync::Arc;
use world::units::Heading;

/// A true source and the flow there.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceTruth {
    /// Its id in the scenario.
    pub id: String,
    /// Where it is (ENU), m.
    pub position: Vector3<f64>,
    /// Mean flow there (east, north), m/s: where the water goes.
    pub flow: Vector2<f64>,
}

/// Flow too slow to have a direction, m/s.
const STILL_M_S: f64 = 1e-6;

impl SourceTruth {
    fn direction(&self) -> Option<Vector2<f64>> {
        let speed = self.flow.norm();
        (speed > STILL_M_S).then(|| self.flow / speed)
    }

    fn error_of(&self, declared: Vector2<f64>) -> SourceError {
        let d = declared - self.position.xy();
        let u = self.direction();
        SourceError {
            source: self.id.clone(),
            position: self.position.xy().into(),
            total_m: d.norm(),
            along_flow_m: u.map(|u| d.dot(&u)),
            across_flow_m: u.map(|u| d.dot(&Vector2::new(u.y, -u.x))),
            east_m: d.x,
            north_m: d.y,
        }
    }
}

/// A place against the true source nearest to it.
fn nearest(place: Vector2<f64>, sources: &[SourceTruth]) -> Option<SourceError> {
    (sources.iter())
        .map(|s| s.error_of(place))
        .min_by(|a, b| a.total_m.total_cmp(&b.total_m))
}

impl DeclarationSummary {
    /// A declaration against the true sources.
    #[must_use]
    pub fn of(d: &Declaration, sources: &[SourceTruth]) -> Self {
        Self {
            t_s: d.t_s,
            rule: d.rule.to_owned(),
            position: d.position.into(),
            error: nearest(d.position, sources),
            verdict: d.verdict,
            surveyed: d.surveyed.map(Position::from),
            surveyed_error: d.surveyed.and_then(|p| nearest(p, sources)),
        }
    }
}

impl From<Vector2<f64>> for Position {
    fn from(p: Vector2<f64>) -> Self {
        Self {
            east_m: p.x,
            north_m: p.y,
        }
    }
}

/// What is known only when a run is over.
#[derive(Clone, Debug, PartialEq)]
pub struct RunEnd {
    /// How it ended.
    pub outcome: RunOutcome,
    /// The error that ended it.
    pub error: Option<String>,
    /// Digest of the state sequence.
    pub digest: String,
    /// Times and counts.
    pub totals: Totals,
}

#[derive(Debug)]
struct Robot {
    id: String,
    last: Vector3<f64>,
    last_t_s: f64,
    behaviour: Behaviour,
    travelled_m: f64,
    first_detection: Option<(f64, Vector2<f64>)>,
    detections: u64,
    declaration: Option<Declaration>,
    error_m: f64,
    greatest_error_m: f64,
    behaviour_s: Vec<(Behaviour, f64)>,
    /// The likeliest cell of its map and since when, with the map's cells.
    best: Option<(f64, usize, Arc<BeliefGrid>)>,
}

impl Robot {
    fn new(t_s: f64, r: &RobotFrame) -> Self {
        Self {
            id: r.id.clone(),
            last: r.truth.pose.p_WB,
            last_t_s: t_s,
            behaviour: r.behaviour,
            travelled_m: 0.0,
            first_detection: None,
            detections: 0,
            declaration: None,
            error_m: 0.0,
            greatest_error_m: 0.0,
            behaviour_s: Vec::new(),
            best: None,
        }
    }

    fn observe(&mut self, t_s: f64, r: &RobotFrame) {
        let p = r.truth.pose.p_WB;
        self.travelled_m += (p - self.last).norm();
        let spent = t_s - self.last_t_s;
        match self
            .behaviour_s
            .iter_mut()
            .find(|(b, _)| *b == self.behaviour)
        {
            Some((_, s)) => *s += spent,
            None => self.behaviour_s.push((self.behaviour, spent)),
        }
        self.last = p;
        self.last_t_s = t_s;
        self.behaviour = r.behaviour;
        if r.detected {
            self.detections += 1;
            self.first_detection.get_or_insert((t_s, p.xy()));
        }
        if let Some(b) = r.belief.as_ref().filter(|b| b.informed)
            && self
                .best
                .as_ref()
                .is_none_or(|(_, cell, _)| *cell != b.best)
        {
            self.best = Some((b.t_s, b.best, b.grid.clone()));
        }
        self.declaration = r.declaration.or(self.declaration);
        self.error_m = (r.estimate.position - p.xy()).norm();
        self.greatest_error_m = self.greatest_error_m.max(self.error_m);
    }

    fn summary(&self, sources: &[SourceTruth]) -> RobotSummary {
        let declaration = (self.declaration.as_ref()).map(|d| DeclarationSummary::of(d, sources));
        let traced_m = self
            .first_detection
            .zip(self.declaration)
            .map(|((_, from), d)| (d.position - from).norm());
        RobotSummary {
            id: self.id.clone(),
            declaration,
            first_detection_s: self.first_detection.map(|d| d.0),
            first_detection: self.first_detection.map(|d| d.1.into()),
            detections: self.detections,
            traced_m,
            correct_cell_s: (self.best.as_ref())
                .filter(|(_, best, grid)| {
                    sources
                        .iter()
                        .any(|s| grid.cell(&s.position) == Some(*best))
                })
                .map(|(since_s, ..)| *since_s),
            travelled_m: self.travelled_m,
            final_position_error_m: self.error_m,
            greatest_position_error_m: self.greatest_error_m,
            last_behaviour: self.behaviour.name().to_owned(),
            behaviour_s: self
                .behaviour_s
                .iter()
                .filter(|(_, s)| *s > 0.0)
                .map(|(b, s)| (b.name().to_owned(), *s))
                .collect(),
        }
    }
}

/// Gathers what a [`Summary`] says; feed it every frame, in order.
#[derive(Debug)]
pub struct SummaryBuilder {
    scenario: String,
    seed: u64,
    version: String,
    robots: Vec<Robot>,
    gantries: Vec<GantryPath>,
}

impl SummaryBuilder {
    /// For a run that has not begun.
    #[must_use]
    pub fn new(run: &RunInfo) -> Self {
        Self {
            scenario: run.scenario_name.clone(),
            seed: run.seed,
            version: run.version.clone(),
            robots: Vec::new(),
            gantries: Vec::new(),
        }
    }

    /// Takes in a frame.
    pub fn observe(&mut self, frame: &Frame) {
        if self.robots.is_empty() {
            let new = |r| Robot::new(frame.t_s, r);
            self.robots = frame.robots.iter().map(new).collect();
        }
        for (known, r) in self.robots.iter_mut().zip(&frame.robots) {
            debug_assert_eq!(known.id, r.id, "frames list the robots in one order");
            known.observe(frame.t_s, r);
        }
        if self.gantries.is_empty() {
            self.gantries = frame.gantries.iter().map(GantryPath::new).collect();
        }
        for (known, g) in self.gantries.iter_mut().zip(&frame.gantries) {
            known.observe(frame.t_s, g);
        }
    }

    /// The summary of the run, against the true sources.
    #[must_use]
    pub fn finish(&self, end: RunEnd, sources: &[SourceTruth]) -> Summary {
        let t = end.totals;
        let ratio = |wall: f64| (wall > 0.0).then(|| t.mission_s / wall);
        Summary {
            scenario: self.scenario.clone(),
            seed: self.seed,
            version: self.version.clone(),
            digest: end.digest,
            outcome: end.outcome,
            error: end.error,
            sources: sources
                .iter()
                .map(|s| SourceSummary {
                    id: s.id.clone(),
                    position: s.position.xy().into(),
                    depth_m: -s.position.z,
                    flow_heading_deg: s.direction().map(|u| Heading::of(u).deg()),
                })
                .collect(),
            robots: self.robots.iter().map(|r| r.summary(sources)).collect(),
            gantries: self.gantries.iter().map(|g| g.summary(sources)).collect(),
            run: RunSummary {
                totals: t,
                real_time_factor: ratio(t.mission_wall_s),
                real_time_factor_with_spin_up: ratio(t.mission_wall_s + t.spin_up_wall_s),
            },
        }
    }
}
