//! Artificial potential field: moves downhill under the goal's attraction and the solids' repulsion; may be caught
//! where they balance.
//!
//! *Source*: Khatib 1986, Int. J. Robotics Research 5, 90, as Pang & Zhu 2009 (IROS, 4375) use it to lead a
//! plume-tracing robot to the likeliest cell; Wang & Pang (sections I and V) compare A* with its local minimum behind
//! an obstacle.
//!
//! *Parameters*: `pull`, slope of the attraction, 1 per m, constant beyond `near_m`, 5 m, and a bowl within; `push`,
//! η of the repulsion ½ η (1/ρ − 1/ρ₀)², 20; its reach `push_m`, ρ₀, m, 10; step of the descent, `step_m`, m, 0.5.
//!
//! *Deviations*: Pang & Zhu's own constants are not known to us (reconstructed from Khatib's form). Every plan
//! follows the descent from the start to its end, rather than one step at a time. The descent ends at the goal. It
//! also ends if thirty steps bring it no farther than three should: then it is in a minimum, where the path ends and
//! says so.

use super::planner::PlannerParams;
use super::{FreeSpace, NoPath, Path, PathStart, Planner, Reach};
use crate::error::{RobotError, require};
use crate::handoff::BeliefGrid;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::cost::{Cost, Part};
use world::limits::shown;
use world::ranges::Positive;
use world::registry::Listed;

/// Number of steps over which progress is judged, and the number of steps that count as progress.
const JUDGED: (usize, f64) = (30, 3.0);
/// The repulsion grows no further when a solid is nearer than this, m.
const NEAREST_M: f64 = 0.1;
/// Most steps per narrowest side of a cell.
const STEPS_A_CELL: f64 = 20.0;
/// Most steps for each cell side of the room's circumference.
const STEPS: f64 = 8.0;

/// Time for a step of a descent, s (see `world::cost`).
const STEP_S: f64 = 300e-9;

/// Parameters of the planner.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "PotentialFieldParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Slope of the attraction.
    #[default(Positive::new(1.0))]
    pub pull: Positive,
    /// Within this distance of the goal the attraction is a bowl, m.
    #[default(Positive::new(5.0))]
    pub near_m: Positive,
    /// Strength of the repulsion, η.
    #[default(Positive::new(20.0))]
    pub push: Positive,
    /// Reach of the repulsion, ρ₀, m.
    #[default(Positive::new(10.0))]
    pub push_m: Positive,
    /// Step of the descent, m.
    #[default(Positive::new(0.5))]
    pub step_m: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "PotentialField",
        what: "moves downhill under the goal's attraction and the solids' repulsion; can be caught in local minima",
        source: "Khatib 1986; Pang & Zhu 2009 (reconstructed)",
    };
}

impl PlannerParams for Params {
    fn build(&self) -> Result<Box<dyn Planner>, RobotError> {
        Ok(Box::new(PotentialField::new(self)?))
    }

    fn check(&self, cells: &BeliefGrid, plane: bool) -> Result<(), RobotError> {
        let axes = if plane { 2 } else { 3 };
        let sides = cells.cell_m[..axes].iter();
        let narrowest_m = sides.fold(f64::INFINITY, |least, side| side.min(least));
        let (step, least) = (self.step_m.get(), narrowest_m / STEPS_A_CELL);
        let problem = format!(
            "must be at least {} (a {STEPS_A_CELL}th of the room's narrowest cell), got {}",
            shown(least),
            shown(step)
        );
        require(step >= least, "strategy.MapAndPlan.planner.PotentialField.step_m", problem)
    }

    fn reach(&self) -> (&'static str, f64) {
        ("push_m", self.push_m.get())
    }

    fn cost(&self, way_m: f64, plans: f64) -> Cost {
        let steps = way_m / self.step_m.get();
        let descent = Part::new("step_m", format!("{steps:.1e} steps of a descent"))
            .holds(8.0 * steps * 24.0)
            .takes(plans * steps * STEP_S)
            .by(self.step_m.get(), -1.0);
        Cost::single(descent)
    }
}

/// The planner.
#[derive(Clone, Debug)]
pub struct PotentialField {
    params: Params,
}

impl PotentialField {
    /// # Errors
    /// [`RobotError::Invalid`] if a step is longer than the distances that it has to resolve.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        let (step, reach) = (params.step_m.get(), params.push_m.get());
        require(
            step <= reach / 2.0,
            "strategy.MapAndPlan.planner.PotentialField.step_m",
            format!("must be at most half of push_m, {reach} m, got {step}"),
        )?;
        Ok(Self { params: params.clone() })
    }

    /// Downhill direction of the potential (not a unit vector).
    fn downhill(&self, room: &FreeSpace, p: &Vector3<f64>, goal: &Vector3<f64>) -> Vector3<f64> {
        let k = &self.params;
        let to = goal - p;
        let pull = to * (k.pull.get() / to.norm().max(k.near_m.get()));
        let (clearance, slope) = field(room, p);
        let rho = (clearance - (room.needed_m() - room.half_diagonal_m())).max(NEAREST_M);
        let reach = k.push_m.get();
        if rho >= reach {
            return pull;
        }
        pull + slope * (k.push.get() * (1.0 / rho - 1.0 / reach) / (rho * rho))
    }
}

/// Clearance and its slope at a point, by linear interpolation between the middles of cells.
fn field(room: &FreeSpace, p: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let g = room.lattice();
    let d = p.xy() - g.corner.xy();
    let local = [d.dot(&g.axes[0]), d.dot(&g.axes[1]), p.z - g.corner.z];
    let (mut low, mut part) = ([0; 3], [0.0; 3]);
    for a in 0..3 {
        let most = (g.n[a] - 1) as f64;
        let q = (local[a] / g.cell_m[a] - 0.5).clamp(0.0, most);
        low[a] = (q as usize).min(g.n[a].saturating_sub(2));
        part[a] = if g.n[a] == 1 { 0.0 } else { q - low[a] as f64 };
    }
    let (mut value, mut slope) = (0.0, [0.0; 3]);
    for corner in 0..8_usize {
        let hi = [0, 1, 2].map(|a| corner >> a & 1);
        if (0..3).any(|a| hi[a] == 1 && g.n[a] == 1) {
            continue;
        }
        let cell = g.index([low[0] + hi[0], low[1] + hi[1], low[2] + hi[2]]);
        let c = room.clearance_m(cell);
        let w = [0, 1, 2].map(|a| if hi[a] == 1 { part[a] } else { 1.0 - part[a] });
        value += c * w[0] * w[1] * w[2];
        for a in 0..3 {
            if g.n[a] > 1 {
                let others = (0..3).filter(|b| *b != a).map(|b| w[b]).product::<f64>();
                let sign = if hi[a] == 1 { 1.0 } else { -1.0 };
                slope[a] += sign * c * others / g.cell_m[a];
            }
        }
    }
    let flat = g.axes[0] * slope[0] + g.axes[1] * slope[1];
    (value, Vector3::new(flat.x, flat.y, slope[2]))
}

impl Planner for PotentialField {
    fn plan(&mut self, room: &FreeSpace, start: &PathStart, goal: &Vector3<f64>) -> Result<Path, NoPath> {
        if !(0..room.lattice().len()).any(|c| room.free(c)) {
            return Err(NoPath::Full);
        }
        let mut goal = *goal;
        if room.plane() {
            goal.z = start.p_W.z;
        }
        let step = self.params.step_m.get();
        let g = room.lattice();
        let around: f64 = (0..3).map(|a| g.n[a] as f64 * g.cell_m[a]).sum();
        let most = (STEPS * around / step).ceil() as usize;
        let mut way = vec![start.p_W];
        let mut p = start.p_W;
        let mut arrived = false;
        for _ in 0..most {
            if (goal - p).norm() <= step {
                arrived = true;
                way.push(goal);
                break;
            }
            let down = self.downhill(room, &p, &goal);
            if down.norm() < 1e-9 {
                break;
            }
            let next = p + down.normalize() * step;
            if room.solid(room.nearest_cell(&next)) && !room.solid(room.nearest_cell(&p)) {
                break;
            }
            p = next;
            way.push(p);
            let (n, progress) = JUDGED;
            if way.len() > n && (way[way.len() - 1 - n] - p).norm() < progress * step {
                way.truncate(way.len() - n);
                break;
            }
        }
        let left = (goal - way[way.len() - 1]).norm();
        Ok(Path {
            points: thinned(&way, step),
            reach: if arrived { Reach::Goal } else { Reach::Caught(left) },
            leaves_solid: room.solid(room.nearest_cell(&start.p_W)),
            tightest_m: 0.0,
        })
    }
}

/// The points at which a chain of steps turns: all others lie within a fifth of a step of the line.
fn thinned(way: &[Vector3<f64>], step_m: f64) -> Vec<Vector3<f64>> {
    let mut kept = vec![way[0]];
    let mut from = 0;
    for to in 2..way.len() {
        let along = (way[to] - way[from]).normalize();
        let off = |p: &Vector3<f64>| {
            let v = p - way[from];
            (v - along * v.dot(&along)).norm()
        };
        if way[from + 1..to].iter().any(|p| off(p) > 0.2 * step_m) {
            kept.push(way[to - 1]);
            from = to - 1;
        }
    }
    kept.push(way[way.len() - 1]);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::{block, from, room};

    fn plan(room: &FreeSpace, start: PathStart, goal: Vector3<f64>) -> Path {
        PotentialField::new(&Params::default()).unwrap().plan(room, &start, &goal).unwrap()
    }

    #[test]
    fn open_water_is_a_straight_line() {
        let path = plan(&room([60, 60, 1], [1.0; 3], vec![]), from(50.0, 10.0, 270.0), Vector3::new(10.0, 40.0, -4.0));
        assert_eq!(path.reach, Reach::Goal);
        assert_eq!(path.points.len(), 2);
    }

    #[test]
    fn slips_past_a_block_that_lies_aside() {
        let one = room([60, 60, 1], [1.0; 3], vec![block("b", 30.0, 24.0, [6.0, 6.0, 8.0])]);
        let path = plan(&one, from(52.0, 32.0, 270.0), Vector3::new(10.0, 32.0, -4.0));
        assert_eq!(path.reach, Reach::Goal);
        assert!(path.points.windows(2).all(|w| one.line(&w[0], &w[1], |c| !one.solid(c))));
    }
}
