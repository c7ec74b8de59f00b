//! A*: the cheapest way by length and clearance, smoothed so that the vehicle can follow it; or the paper's own
//! costs.
//!
//! *Source*: Wang & Pang, section II-D, eq. 7-9; Hart, Nilsson & Raphael 1968, IEEE Trans. Syst. Sci. Cybern. 4, 100.
//!
//! *Parameters*: `cost`, `Metric` or `Paper` (1000 in an obstacle cell, none elsewhere, Manhattan h, five moves); for
//! `Metric` the turning radius `turn_radius_m`, m, 12 (2 m/s at 10 °/s make 11.5), or the vehicle's own if that is
//! greater; the share added to the cost beside a solid, `clearance_weight`, 2, which falls to zero at `clearance_m`,
//! m, 4; the cost of a metre up or down in horizontal metres, `climb`, 3 (a REMUS climbs at less than 20°).
//!
//! *Deviations*: eq. 8 gives free cells no cost, which makes the search greedy: `Paper` keeps it (see
//! `paper_cost.rs`), and the default cost is the length. See `search.rs` for the search, `smooth.rs` for the
//! smoothing.

use super::ends::Ends;
use super::paper_cost::FiveMoves;
use super::planner::PlannerParams;
use super::search::{Costs, Search};
use super::{FreeSpace, NoPath, Path, PathStart, Planner, Reach, smooth};
use crate::error::{RobotError, require};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Which costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Cost {
    /// Length and clearance; 8 moves in the plane, 26 in space; smoothed.
    #[default]
    Metric,
    /// The paper's costs: 1000 in obstacle cells, zero elsewhere; five moves relative to the heading; only in the
    /// plane.
    Paper,
}

/// Parameters of the planner.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "AStarParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Which costs.
    #[default(Cost::Metric)]
    pub cost: Cost,
    /// Turning radius for which the path is smoothed, m; the vehicle's own if that is greater.
    #[serde(with = "world::limits::turn_m")]
    #[default(Positive::new(12.0))]
    pub turn_radius_m: Positive,
    /// Share added to the cost of a step beside a solid; at most 3.9.
    #[default(NonNegative::new(2.0))]
    pub clearance_weight: NonNegative,
    /// Clearance beyond the hull's own at which nothing is added any more, m.
    #[default(NonNegative::new(4.0))]
    pub clearance_m: NonNegative,
    /// Cost of a metre up or down, in horizontal metres; from 1 to 20.
    #[default(Positive::new(3.0))]
    pub climb: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "AStar",
        what: "cheapest way by length and clearance, smoothed for the turning circle; on request with the paper's \
            costs",
        source: "Wang & Pang, section II-D, eq. 7-9; Hart, Nilsson & Raphael 1968",
    };
}

impl PlannerParams for Params {
    fn build(&self) -> Result<Box<dyn Planner>, RobotError> {
        Ok(Box::new(AStar::new(self)?))
    }

    fn plane_only(&self) -> bool {
        self.cost == Cost::Paper
    }

    fn reach(&self) -> (&'static str, f64) {
        ("clearance_m", self.clearance_m.get())
    }
}

/// The planner with its arrays.
#[derive(Clone, Debug)]
pub struct AStar {
    costs: Costs,
    turn_radius_m: f64,
    paper: Option<FiveMoves>,
    search: Search,
    ends: Ends,
}

impl AStar {
    /// # Errors
    /// [`RobotError::Invalid`] if a weight is beyond what the costs can hold.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        let must = |holds: bool, field: &str, says: &str, got: f64| {
            require(holds, format!("strategy.MapAndPlan.planner.AStar.{field}"), format!("must be {says}, got {got}"))
        };
        let (weight, climb) = (params.clearance_weight.get(), params.climb.get());
        must(weight <= 3.9, "clearance_weight", "from 0 to 3.9", weight)?;
        must((1.0..=20.0).contains(&climb), "climb", "from 1 to 20", climb)?;
        let soft_m = params.clearance_m.get();
        let costs = Costs { climb, weight, soft_m };
        Ok(Self {
            costs,
            turn_radius_m: params.turn_radius_m.get(),
            paper: (params.cost == Cost::Paper).then(FiveMoves::default),
            search: Search::new(costs),
            ends: Ends::default(),
        })
    }
}

impl Planner for AStar {
    fn plan(&mut self, room: &FreeSpace, start: &PathStart, goal: &Vector3<f64>) -> Result<Path, NoPath> {
        if let Some(paper) = &mut self.paper {
            return paper.plan(room, start, goal);
        }
        let e = self.ends.resolve(room, |c| room.free(c), &start.p_W, goal)?;
        let (cells, _) = (self.search.run(room, e.start, e.goal, false)).expect(
            "cells of one component are joined by moves through faces: the flood fill and the search \
                disagree, which is an error in the planner",
        );
        let mut points: Vec<_> = cells.iter().map(|c| room.lattice().centre(*c)).collect();
        let plane_z = start.p_W.z;
        if room.plane() {
            points.iter_mut().for_each(|p| p.z = plane_z);
        }
        // The start itself and, if it can be reached, the goal itself replace the middles of their cells.
        let own = *start;
        if !e.leaves_solid {
            points[0] = own.p_W;
        }
        let mut end = *goal;
        if room.plane() {
            end.z = plane_z;
        }
        let reach = if e.at_goal && room.lattice().cell(&end) == Some(e.goal) {
            if points.len() > 1 {
                points.pop();
            }
            points.push(end);
            Reach::Goal
        } else {
            Reach::Nearest((points[points.len() - 1] - end).norm())
        };
        let pulled = smooth::pull(room, &self.costs, &points);
        let radius_m = self.turn_radius_m.max(own.turning_radius_m);
        let (mut points, tightest_m) =
            if e.leaves_solid { (pulled, 0.0) } else { smooth::round(room, &own, &pulled, radius_m) };
        if e.leaves_solid {
            points.insert(0, own.p_W);
        }
        Ok(Path { points, reach, leaves_solid: e.leaves_solid, tightest_m })
    }
}

#[cfg(test)]
mod tests;
