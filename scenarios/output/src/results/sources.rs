//! The true sources, and declarations compared with them.

use super::summary::{DeclarationSummary, DeclaredKind, Position, SourceError};
use nalgebra::{Vector2, Vector3};
use rheotaxis::trial::{RunEnd, Trial};
use robots::handoff::{Declaration, region_name};

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
    #[must_use]
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
    #[must_use]
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
