//! What a strategy will hold and do; the unit costs are measured as `world::cost` says.

use super::map_and_plan::MapAndPlanSpec;
use super::spec::StrategySpec;
use crate::plan::PlannerSpec;
use world::area::Area;
use world::cost::{Cost, Part, Times};

/// Memory of a cell of a planner's room with the planner's own, bytes; time to chart it, and for each obstacle, s.
const CELL_BYTES: f64 = 60.0;
/// See above.
const CHART_S: [f64; 2] = [50e-9, 100e-9];
/// Memory of a cell's distance from a solid one, bytes.
const NEAR_BYTES: f64 = 16.0;
/// Time of a plan for each cell of the room, s: most plans open a small part of it.
const PLAN_S: f64 = 8e-9;
/// Time of a step of a descent, and of one looking ahead on a few courses, s.
const STEP_S: [f64; 2] = [300e-9, 120e-9];

impl StrategySpec {
    /// What it takes; paths below `strategy`.
    #[must_use]
    pub fn cost(&self, area: &Area, depth_m: f64, obstacles: usize, times: &Times) -> Cost {
        match self {
            StrategySpec::MapAndPlan(spec) => spec.cost(area, depth_m, obstacles, times),
            StrategySpec::Subregions(spec) => {
                (spec.search.cost(area, depth_m, obstacles, times)).under("search")
            }
            StrategySpec::Amp(_) | StrategySpec::Subsumption(_) | StrategySpec::OpenLoop(_) => {
                Cost::default()
            }
        }
    }
}

impl MapAndPlanSpec {
    fn cost(&self, area: &Area, depth_m: f64, obstacles: usize, times: &Times) -> Cost {
        let (counts, sides_m) = self.room.counts(area, depth_m);
        let cells: f64 = counts.iter().product();
        let plans = times.mission_s / self.replan_s.get().max(1.0);
        let chart_s = CHART_S[0] + obstacles as f64 * CHART_S[1];
        let room = Part::new(
            "room.cell_m",
            format!("{cells:.1e} cells of the planner's room"),
        )
        .holds(cells * CELL_BYTES)
        .takes(cells * (chart_s + plans * PLAN_S))
        .by(sides_m[0], -2.0);
        let mut cost = Cost::of(room);
        let reach_m = self.planner.reach_m() + self.hull_m.get();
        let near = |a: usize| 2.0 * (reach_m / sides_m[a] + 2.0).min(counts[a]) + 1.0;
        let round: f64 = (0..3).map(near).product();
        let path = match &self.planner {
            PlannerSpec::AStar(_) => "planner.clearance_m",
            PlannerSpec::PotentialField(_) => "planner.push_m",
        };
        let kept = Part::new(
            path,
            format!("{round:.1e} cells that a solid one is near to"),
        );
        cost.parts.push(kept.holds(round * NEAR_BYTES));
        let narrowest_m = sides_m.iter().copied().fold(f64::INFINITY, f64::min);
        if let PlannerSpec::PotentialField(p) = &self.planner {
            let steps = (area.length_m + area.width_m + depth_m) / p.step_m.get();
            let part = Part::new("planner.step_m", format!("{steps:.1e} steps of a descent"))
                .holds(8.0 * steps * 24.0)
                .takes(plans * steps * STEP_S[0])
                .by(p.step_m.get(), -1.0);
            cost.parts.push(part);
        }
        if let Some(evade) = &self.evade {
            let steps = 2.0 * evade.look_m.get().min(area.length_m + area.width_m) / narrowest_m;
            let part = Part::new("evade.look_m", format!("{steps:.1e} steps looked ahead"))
                .takes(times.mission_s / times.step_s * steps * STEP_S[1])
                .by(evade.look_m.get(), 1.0);
            cost.parts.push(part);
        }
        cost
    }
}
