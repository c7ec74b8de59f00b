//! The true sources, and declarations compared with them.

use nalgebra::{Vector2, Vector3};
use rheotaxis::trial::{RunEnd, Trial};
use robots::handoff::{Declaration, Evidence, PictureEvidence, Verdict, region_name};
use serde::Serialize;

/// A horizontal position in the world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Position {
    /// East of the datum, m.
    pub east_m: f64,
    /// North of the datum, m.
    pub north_m: f64,
}

/// A declared position compared with the nearest true source.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SourceError {
    /// The nearest true source.
    pub source: String,
    /// Its position.
    pub position: Position,
    /// Horizontal distance, m.
    pub total_m: f64,
    /// Component along the mean flow at the source, m; positive if declared too far down-flow.
    pub along_flow_m: Option<f64>,
    /// Component across it, m; positive if declared too far to the right, looking down-flow.
    pub across_flow_m: Option<f64>,
    /// Declared minus true, east, m.
    pub east_m: f64,
    /// Declared minus true, north, m.
    pub north_m: f64,
}

impl SourceError {
    /// The distance from its source, and its parts along and across the flow, in a unit of which `per_m` make a metre.
    pub(super) fn in_words(&self, per_m: f64, unit: &str) -> String {
        let parts = match (self.along_flow_m, self.across_flow_m) {
            (Some(a), Some(b)) => {
                let (a, b) = (per_m * a, per_m * b);
                format!(": {a:+.1} {unit} along the flow (down-flow positive), {b:+.1} {unit} across")
            }
            _ => String::new(),
        };
        format!("{:.1} {unit} from {}{parts}", per_m * self.total_m, self.source)
    }
}

/// What was declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DeclaredKind {
    /// A source at the declared place.
    Source,
    /// A plume that was traced to the up-flow edge of a subregion; its source is beyond.
    UpFlowEdge,
}

/// A declaration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeclarationSummary {
    /// Its number among the robot's declarations, from 0, including edges.
    pub number: u32,
    /// Whether it declares a source or an edge.
    pub kind: DeclaredKind,
    /// Its name in report and pictures: `source 1` and so on, without counting edges, or `edge of A`.
    pub name: String,
    /// Subregion in which it was made, from 0; `None` if the area is not divided.
    pub region: Option<u32>,
    /// That subregion's name: a letter.
    pub region_name: Option<String>,
    /// Mission time, s.
    pub t_s: f64,
    /// Name of the rule that declared it.
    pub rule: String,
    /// Declared position.
    pub position: Position,
    /// Its error, or the distance of an edge from the nearest source; `None` in a scenario without a source.
    pub error: Option<SourceError>,
    /// The last detection points on which it rests, if its rule uses them.
    pub evidence: Option<Evidence>,
    /// The verdict of a look at it.
    pub verdict: Verdict,
    /// The pictures its verdict rests on, if they were added up.
    pub looked: Option<PictureEvidence>,
    /// Where the sidescan, or pictures added up, found the source, in the vehicle's believed coordinates.
    pub surveyed: Option<Position>,
    /// The error of that place.
    pub surveyed_error: Option<SourceError>,
    /// Straight distance from the first detection in this area or subregion to it, m.
    pub traced_m: Option<f64>,
    /// The largest shift by a position fix of what the robot believed, in the minute before, m; `None` without a fix.
    pub fix_m: Option<f64>,
}

/// A true source and the flow there.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceTruth {
    /// Its id in the scenario.
    pub id: String,
    /// Its position (ENU), m.
    pub position: Vector3<f64>,
    /// Mean flow there (east, north), m/s: where the water goes.
    pub flow: Vector2<f64>,
}

/// Slower flow has no direction, m/s.
const STILL_M_S: f64 = 1e-6;

impl SourceTruth {
    /// The sources of a run that has ended.
    pub fn from_run(trial: &Trial, ended: &RunEnd) -> Vec<Self> {
        let plume = trial.simulation.ocean().plume();
        (plume.sources().iter().zip(&ended.flow_at_sources))
            .map(|(s, flow)| Self { id: s.id.clone(), position: s.p_W, flow: flow.xy() })
            .collect()
    }

    /// Where the flow there goes; `None` in still water.
    pub(super) fn direction(&self) -> Option<Vector2<f64>> {
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

/// Compares a place with the true source nearest to it.
fn nearest(place: Vector2<f64>, sources: &[SourceTruth]) -> Option<SourceError> {
    (sources.iter()).map(|s| s.error_of(place)).min_by(|a, b| a.total_m.total_cmp(&b.total_m))
}

impl DeclarationSummary {
    /// A declaration compared with the true sources.
    pub fn compare(d: &Declaration, sources: &[SourceTruth]) -> Self {
        let region_name = d.region.map(region_name);
        let (kind, name) = if d.at_edge() {
            let of = region_name.as_deref().unwrap_or("the area");
            (DeclaredKind::UpFlowEdge, format!("edge of {of}"))
        } else {
            (DeclaredKind::Source, "source".to_owned())
        };
        Self {
            number: d.number,
            kind,
            name,
            region: d.region,
            region_name,
            t_s: d.t_s,
            rule: d.rule.to_owned(),
            position: d.position.into(),
            error: nearest(d.position, sources),
            verdict: d.verdict,
            looked: d.looked,
            surveyed: d.surveyed.map(Position::from),
            surveyed_error: d.surveyed.and_then(|p| nearest(p, sources)),
            traced_m: None,
            fix_m: None,
            evidence: d.evidence,
        }
    }
}

impl From<Vector2<f64>> for Position {
    fn from(p: Vector2<f64>) -> Self {
        Self { east_m: p.x, north_m: p.y }
    }
}
