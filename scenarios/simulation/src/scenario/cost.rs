//! Estimates what a run takes, part by part, before anything is built.

use super::fault::UnplacedFault;
use super::schema::{RobotSpec, Scenario, TerrainSpec};
use world::cost::{Cost, Part, Times, memory};
use world::limits::shown;
use world::registry::Registry;

/// Memory that a run may use unless another limit is given, bytes. It is half of what a common machine has.
pub const MEMORY: f64 = 4e9;
/// A longer run gets a warning, s.
const LONG_S: f64 = 7200.0;
/// Parts named in an estimate.
const NAMED: usize = 3;
/// Memory of the program with fonts and figures, bytes; time to start and to draw, s.
const PROGRAM: (f64, f64) = (50e6, 0.2);
/// Time of a step of a vehicle with instruments and strategy, of each surface wave in that step, and of a gantry, s.
const VEHICLE_S: [f64; 3] = [9e-6, 1e-6, 15e-6];
/// Time to write a frame of a robot to all files, s.
const FRAME_S: f64 = 60e-6;
/// Memory of a frame's row, bytes, and the most rows that are kept.
const ROWS: (f64, f64) = (400.0, 40_000.0);
/// Time of a filament in a picture of the plume, s.
const POINT_S: f64 = 0.3e-6;

struct Limit(f64);

/// The registry, under which a run may use so much memory, bytes.
#[must_use]
pub fn with_limit(registry: Registry, bytes: f64) -> Registry {
    registry.carrying(Limit(bytes))
}

/// Memory that a run of a scenario which is read under this registry may use, bytes.
pub fn limit(registry: &Registry) -> f64 {
    registry.carried::<Limit>().last().map_or(MEMORY, |limit| limit.0)
}

/// The durations and steps of a run.
pub fn times(scenario: &Scenario) -> Times {
    let t = &scenario.time;
    Times {
        step_s: t.step_s.get(),
        spin_up_s: t.spin_up_s.get(),
        spin_up_period_s: t.spin_up_period_s.get(),
        mission_s: t.limit_s.get(),
        drift_period_s: t.drift_period_s.get(),
        flow_period_s: t.flow_period_s.get(),
    }
}

/// The cost of a run, computed from its fields.
pub fn cost(scenario: &Scenario) -> Cost {
    let mut cost = of_ocean(scenario);
    cost.add(of_lane(scenario));
    cost
}

/// The part of the cost that runs in the same ocean share: the program, water and plume.
fn of_ocean(scenario: &Scenario) -> Cost {
    let (area, times) = (scenario.area.build(), times(scenario));
    let program = Part::new("", "the program and its figures");
    let mut cost = Cost::single(program.holds(PROGRAM.0).takes(PROGRAM.1));
    cost.add(scenario.water.cost(&area, depth_m(scenario), &times));
    let carries_m_s = scenario.water.carries_m_s();
    for (i, source) in scenario.sources.iter().enumerate() {
        let own = source.release.cost(&area, carries_m_s, &times);
        cost.add(own.under(&format!("sources[{i}].release")));
    }
    cost
}

/// Depth of the deepest water, m.
fn depth_m(scenario: &Scenario) -> f64 {
    match &scenario.terrain {
        TerrainSpec::Level(level) => level.depth_m.get(),
        TerrainSpec::Slope(slope) => slope.deep_m.get().max(slope.shallow_m.get()),
    }
}

/// The part of the cost that each run has for itself, also in an ocean shared with others: its searchers and what is
/// recorded of it.
pub fn of_lane(scenario: &Scenario) -> Cost {
    let times = times(scenario);
    let (depth_m, waves) = (depth_m(scenario), scenario.water.waves());
    let mut cost = Cost::default();
    for (i, robot) in scenario.robots.iter().enumerate() {
        let path = format!("robots[{i}]");
        cost.add(robot_cost(robot, scenario, depth_m, waves, &times).under(&path));
    }
    let steps = times.mission_s / times.step_s;
    for i in 0..scenario.gantries.len() {
        let part = Part::new(format!("gantries[{i}]"), "its steps");
        cost.parts.push(part.takes(steps * VEHICLE_S[2]));
    }
    cost.parts.extend(recording(scenario, &times));
    cost
}

fn robot_cost(robot: &RobotSpec, scenario: &Scenario, depth_m: f64, waves: f64, times: &Times) -> Cost {
    let area = scenario.area.build();
    let steps = times.mission_s / times.step_s;
    let hull = Part::new("", format!("{steps:.1e} steps of a vehicle"));
    let mut cost = Cost::single(hull.takes(steps * (VEHICLE_S[0] + waves * VEHICLE_S[1])));
    let needs = robot.strategy.about().needs;
    let looks = needs.iter().any(|n| ["sidescan", "camera"].contains(&n.instrument));
    let obstacles = scenario.obstacles.len();
    cost.add(robots::sense::cost(&robot.sensors, obstacles, looks, times).under("sensors"));
    if let Some(map) = &robot.map {
        cost.add(map.cost(times).under("map"));
    }
    let charted = robot.chart.len();
    let own = robot.strategy.cost(&area, depth_m, charted, times);
    cost.add(own.under("strategy"));
    cost
}

/// The cost of recorded frames and of recorded plumes.
fn recording(scenario: &Scenario, times: &Times) -> [Part; 2] {
    let r = &scenario.record;
    let n = (scenario.robots.len() + scenario.gantries.len()) as f64;
    let frames = n * times.mission_s / r.frame_period_s.get();
    let shown = times.mission_s / r.plume_period_s.get();
    let points = f64::from(r.plume_points);
    [
        Part::new("record.frame_period_s", format!("{frames:.1e} frames"))
            .holds(frames.min(n * ROWS.1) * ROWS.0)
            .takes(frames * FRAME_S)
            .by(r.frame_period_s.get(), -1.0),
        Part::new("record.plume_period_s", format!("{shown:.1e} pictures of the plume"))
            .takes(shown * points.min(1e6) * POINT_S)
            .by(r.plume_period_s.get(), -1.0),
    ]
}

/// The parts that take most time or memory, largest first, as in "1.6e4 nodes of the plume's flow (area): 2 MB".
pub fn greatest(cost: &Cost) -> Vec<String> {
    let share = |p: &Part| (p.seconds / cost.seconds().max(1e-9)).max(p.bytes / cost.bytes().max(1.0));
    let mut parts: Vec<&Part> = cost.parts.iter().filter(|p| share(p) > 0.05).collect();
    parts.sort_by(|a, b| share(b).total_cmp(&share(a)));
    let said = |p: &&Part| {
        let path = if p.path.is_empty() { String::new() } else { format!(" ({})", p.path) };
        let memory = match p.bytes > 0.0 {
            true => format!(": {}", memory(p.bytes)),
            false => String::new(),
        };
        format!("{}{path}{memory}", p.what)
    };
    parts.iter().take(NAMED).map(said).collect()
}

/// Reports memory beyond `limit` as an error. Returns whether the scenario may be built.
pub(super) fn judge(cost: &Cost, limit: f64, found: &mut Vec<UnplacedFault>) -> bool {
    if !cost.fits(limit) {
        let Some(part) = cost.largest() else {
            return false;
        };
        let room = limit - (cost.bytes() - part.bytes);
        let room = if room.is_nan() { 0.5 * limit } else { room };
        let legal = (room > 0.0).then(|| part.legal(room)).flatten();
        let problem = format!(
            "{}would take {} ({}), and the whole run {}; at most {} are allowed",
            legal.map_or_else(String::new, |l| {
                let got = part.rule.map_or(f64::NAN, |r| r.value);
                format!("{l}, got {}: ", shown(got))
            }),
            memory(part.bytes),
            part.what,
            memory(cost.bytes()),
            memory(limit)
        );
        found.push(UnplacedFault::error(&part.path, problem).hint("or allow more memory, as in `--memory 16G`"));
        return false;
    }
    true
}

/// Warns of a run that takes hours.
pub(super) fn patience(cost: &Cost, found: &mut Vec<UnplacedFault>) {
    // This form also finds what is not a number.
    if !(cost.seconds() <= LONG_S)
        && let Some(part) = cost.slowest()
    {
        let problem = format!("the run will take hours, most of them for {}", part.what);
        found.push(UnplacedFault::warning(&part.path, problem));
    }
}
