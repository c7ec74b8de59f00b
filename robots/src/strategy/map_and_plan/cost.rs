//! Predicts the memory and time of map and plan; the unit costs are measured as `world::cost` says.

use super::spec::MapAndPlanSpec;
use world::area::Area;
use world::cost::{Cost, Part, Times};

/// Memory of a cell of a planner's room, with the planner's own, bytes; time to chart a cell, and for each obstacle,
/// s.
const CELL_BYTES: f64 = 60.0;
/// See above.
const CHART_S: [f64; 2] = [50e-9, 100e-9];
/// Memory of a cell's distance from a solid one, bytes.
const NEAR_BYTES: f64 = 16.0;
/// Time of a plan per cell of the room, s: most plans open a small part of it.
const PLAN_S: f64 = 8e-9;
/// Time for a step of looking ahead on a few courses, s.
const LOOK_S: f64 = 120e-9;

impl MapAndPlanSpec {
    /// Its memory and time; paths below `strategy`.
    pub(super) fn work(&self, area: &Area, depth_m: f64, obstacles: usize, times: &Times) -> Cost {
        let (counts, sides_m) = self.room.counts(area, depth_m);
        let cells: f64 = counts.iter().product();
        let plans = times.mission_s / self.replan_s.get().max(1.0);
        let chart_s = CHART_S[0] + obstacles as f64 * CHART_S[1];
        let room = Part::new("room.cell_m", format!("{cells:.1e} cells of the planner's room"))
            .holds(cells * CELL_BYTES)
            .takes(cells * (chart_s + plans * PLAN_S))
            .by(sides_m[0], -2.0);
        let mut cost = Cost::single(room);
        let (field, beyond_m) = self.planner.reach();
        let reach_m = beyond_m + self.hull_m.get();
        let near = |a: usize| 2.0 * (reach_m / sides_m[a] + 2.0).min(counts[a]) + 1.0;
        let round: f64 = (0..3).map(near).product();
        let kept = Part::new(format!("planner.{field}"), format!("{round:.1e} cells within reach of a solid one"));
        cost.parts.push(kept.holds(round * NEAR_BYTES));
        let narrowest_m = sides_m.iter().copied().fold(f64::INFINITY, f64::min);
        let way_m = area.length_m + area.width_m + depth_m;
        cost.add(self.planner.cost(way_m, plans).under("planner"));
        if let Some(evade) = &self.evade {
            let steps = 2.0 * evade.look_m.get().min(area.length_m + area.width_m) / narrowest_m;
            let part = Part::new("evade.look_m", format!("{steps:.1e} steps of looking ahead"))
                .takes(times.mission_s / times.step_s * steps * LOOK_S)
                .by(evade.look_m.get(), 1.0);
            cost.parts.push(part);
        }
        cost
    }
}
