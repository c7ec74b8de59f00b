//! Searches for the plume: moves across the flow, leaning a little up-flow or down-flow, and turns back at the area's
//! edges.
//!
//! *Source*: Pang 2009, section 5.2.
//!
//! *Parameters*: angle off the cross-flow direction, `off_across_deg`, °, 20; distance at which an edge counts as
//! reached, `edge_m`, m (not printed), 20: (1 + sin 45°) · 11.5 m, which a vehicle with a turning radius of 11.5 m (2
//! m/s at 10 °/s) needs to turn about in a corner.
//!
//! *Deviations*: the search starts at the vehicle's place (`start: Here`) or first goes to the most down-flow corner
//! (`DownFlowCorner`, the paper's plan). It begins with the one of the two up-flow leaning directions that runs
//! longer before it meets an edge. If several directions satisfy the rule at an edge, the one nearest to a mirror
//! reflection is taken. The paper says that there is a solution in every corner. In an area that is turned against
//! the flow there may be none: the vehicle then moves along the newly met edge. As long as no flow is known, the
//! vehicle keeps its heading and turns at edges like a mirror reflection; the actual search begins with the first
//! flow estimate.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::{RobotError, require};
use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use crate::places::inside;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::FRAC_PI_2;
use world::area::Area;
use world::catalogue::Entry;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// A course runs against an edge if its outward component is greater than this (half a degree).
const OUTWARD: f64 = 0.01;

/// Where the search begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum From {
    /// At the vehicle's place.
    #[default]
    Here,
    /// At the most down-flow corner of the area, whenever the search begins.
    DownFlowCorner,
}

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "ZigZagParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Where the search begins.
    #[default(From::Here)]
    pub start: From,
    /// Angle off the cross-flow direction, °, less than 90.
    #[default(NonNegative::new(20.0))]
    pub off_across_deg: NonNegative,
    /// An edge counts as reached at this distance, m.
    #[default(Positive::new(20.0))]
    pub edge_m: Positive,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// No goal given yet.
    Begin,
    /// On the way to the corner.
    ToCorner,
    /// No flow known yet.
    Blind(Heading),
    /// On one of the four directions.
    Leg(Heading),
    /// Moving along an edge until one of the four directions satisfies the rule for `before`, the course that met the
    /// edge.
    Along { course: Heading, before: Heading },
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "ZigZag",
        what: "find: crosses the flow at 70 or 110 degrees to it, and turns back at the area's edges",
        source: "Pang 2009, section 5.2",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(ZigZag::new(self)?))
    }
}

/// State of the behaviour.
#[derive(Clone, Debug)]
pub struct ZigZag {
    start: From,
    off_rad: f64,
    edge_m: f64,
    phase: Phase,
}

impl ZigZag {
    /// # Errors
    /// [`RobotError::Invalid`] if the angle does not lead across the flow.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        require(
            params.off_across_deg.get() < 90.0,
            "find.ZigZag.off_across_deg",
            format!("must be < 90, got {}", params.off_across_deg.get()),
        )?;
        Ok(Self {
            start: params.start,
            off_rad: params.off_across_deg.get().to_radians(),
            edge_m: params.edge_m.get(),
            phase: Phase::Begin,
        })
    }

    /// The four directions; the two that lean up-flow first.
    fn four(&self, up_flow: Heading) -> [Heading; 4] {
        let (a, b) = (FRAC_PI_2 - self.off_rad, FRAC_PI_2 + self.off_rad);
        [a, -a, b, -b].map(|turn| up_flow.turned(turn))
    }

    /// Outward normals of the edges within reach, nearest first. In a small area the reach is a quarter of the area,
    /// so that opposite edges are never reached together.
    fn reached(&self, area: &Area, p: Vector2<f64>) -> Vec<Vector2<f64>> {
        let reach_m = self.edge_m.min(area.length_m.min(area.width_m) / 4.0);
        let mut near: Vec<_> = area.sides().edges(p).into_iter().filter(|(d, _)| *d < reach_m).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.into_iter().map(|(_, n)| n).collect()
    }

    /// The one of the four directions that keeps the velocity along the edge and turns inward; in a corner, inward of
    /// both edges.
    fn rule(&self, up_flow: Heading, before: Heading, near: &[Vector2<f64>]) -> Option<Heading> {
        let was = before.unit();
        let mirror = reflected(was, near);
        let mut best: Option<(f64, Heading)> = None;
        for candidate in self.four(up_flow) {
            let c = candidate.unit();
            let inward = near.iter().all(|n| c.dot(n) < 0.0);
            let keeps = match near {
                [n] => {
                    let along = Vector2::new(-n.y, n.x);
                    c.dot(&along) * was.dot(&along) >= 0.0
                }
                _ => true,
            };
            let likeness = c.dot(&mirror);
            if inward && keeps && best.is_none_or(|(b, _)| likeness > b) {
                best = Some((likeness, candidate));
            }
        }
        best.map(|(_, h)| h)
    }

    /// The reaction to the edges `near`, reached on `course`.
    fn react(&self, up_flow: Heading, course: Heading, near: &[Vector2<f64>]) -> Phase {
        if let Some(leg) = self.rule(up_flow, course, near) {
            return Phase::Leg(leg);
        }
        let c = course.unit();
        // The newly met edge is the one that the course runs against most.
        let met = near.iter().copied().max_by(|a, b| c.dot(a).total_cmp(&c.dot(b))).unwrap_or_else(Vector2::zeros);
        let along = Vector2::new(-met.y, met.x);
        let pull = near.iter().filter(|n| n.dot(&met).abs() < 0.5).map(|n| -n.dot(&along)).sum::<f64>();
        let sign = if pull.abs() > 0.5 { pull } else { c.dot(&along) };
        Phase::Along { course: Heading::from_vector(along * if sign < 0.0 { -1.0 } else { 1.0 }), before: course }
    }

    fn begin(&self, seen: &Observation, up_flow: Option<Heading>) -> Phase {
        let p = seen.estimate.position;
        let Some(up_flow) = up_flow else {
            return Phase::Blind(seen.estimate.attitude.heading);
        };
        let [right, left, _, _] = self.four(up_flow);
        let (r, l) = (run_m(&seen.area, p, right), run_m(&seen.area, p, left));
        Phase::Leg(if r >= l { right } else { left })
    }
}

impl Behave for ZigZag {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.phase = Phase::Begin;
    }

    fn step(&mut self, seen: &Observation, arrived: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        let p = seen.estimate.position;
        let near = self.reached(&seen.area, p);
        let against = |c: Heading| near.iter().any(|n| c.unit().dot(n) > OUTWARD);
        let next = match (self.phase, memory.up_flow) {
            (Phase::Begin | Phase::Blind(_), Some(up)) if self.start == From::DownFlowCorner => {
                self.phase = Phase::ToCorner;
                return Stride::Start(Manoeuvre::GoToPoint {
                    point: down_flow_corner(&seen.area, up, self.edge_m),
                    radius_m: None,
                });
            }
            (Phase::ToCorner, _) if !arrived => return Stride::Keep,
            (Phase::Begin | Phase::ToCorner, up) => self.begin(seen, up),
            (Phase::Blind(_), up @ Some(_)) => self.begin(seen, up),
            (Phase::Blind(c), None) if against(c) => Phase::Blind(Heading::from_vector(reflected(c.unit(), &near))),
            (Phase::Leg(c), Some(up)) if against(c) => self.react(up, c, &near),
            (Phase::Along { course, .. }, Some(up)) if against(course) => self.react(up, course, &near),
            (Phase::Along { before, .. }, Some(up)) if !near.is_empty() => {
                self.rule(up, before, &near).map_or(self.phase, Phase::Leg)
            }
            (same, _) => same,
        };
        let begins = matches!(self.phase, Phase::Begin);
        if next == self.phase && !begins {
            return Stride::Keep;
        }
        self.phase = next;
        let course = match next {
            Phase::Blind(c) | Phase::Leg(c) | Phase::Along { course: c, .. } => c,
            Phase::Begin | Phase::ToCorner => seen.estimate.attitude.heading,
        };
        Stride::Start(Manoeuvre::Course { course })
    }
}

/// Reflected at every edge that it runs against.
fn reflected(course: Vector2<f64>, near: &[Vector2<f64>]) -> Vector2<f64> {
    near.iter().fold(course, |c, n| {
        let out = c.dot(n);
        if out > 0.0 { c - n * (2.0 * out) } else { c }
    })
}

/// How far a course runs before it meets an edge, m.
fn run_m(area: &Area, p: Vector2<f64>, course: Heading) -> f64 {
    let c = course.unit();
    area.sides()
        .edges(p)
        .into_iter()
        .filter(|(_, n)| c.dot(n) > 1e-9)
        .map(|(d, n)| d / c.dot(&n))
        .fold(f64::INFINITY, f64::min)
}

/// The corner farthest down-flow, moved inside the reach of the edges.
fn down_flow_corner(area: &Area, up_flow: Heading, margin_m: f64) -> Vector2<f64> {
    let down = up_flow.opposite().unit();
    let far = |p: &Vector2<f64>| (p - area.centre).dot(&down);
    let corner = area.corners().into_iter().max_by(|a, b| far(a).total_cmp(&far(b)));
    inside(area, corner.unwrap_or(area.centre), margin_m)
}

#[cfg(test)]
mod tests;
