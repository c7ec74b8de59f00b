//! Limits of what a computer can hold and of what exists at sea, for numbers that are legal one by one.

use super::path::robot_error;
use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::{RobotSpec, Scenario};
use nalgebra::{Vector2, Vector3};
use plumes::error::PlumeError;
use plumes::filaments::examined;
use plumes::flow::{GridShape, Water};
use world::area::Area;
use world::limits::shown;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// Most nodes of the grid from which the plume takes its currents. They need about half a gigabyte.
const MOST_NODES: f64 = 2e7;
/// Most filaments released in a run. If none leaves the area, they need about two gigabytes.
const MOST_FILAMENTS: f64 = 5e7;
/// Longest spin-up and longest mission, s: four months.
const LONGEST_S: f64 = 1e7;
/// Deepest water, m: the Challenger Deep has 10.9 km.
const DEEPEST_M: f64 = 12_000.0;
/// Shallowest water, m.
const SHALLOWEST_M: f64 = 1e-3;
/// Smallest length and width of the area, m.
const NARROWEST_M: f64 = 1e-3;
/// Fastest water, m/s: the strongest tidal streams reach 10 m/s.
const FASTEST_M_S: f64 = 15.0;

/// Checks area, depth, durations and number of filaments. Returns whether all are within their limits.
pub(super) fn sizes(scenario: &Scenario, area: &Area, terrain: &Terrain, found: &mut Vec<UnplacedFault>) -> bool {
    let before = found.len();
    let nodes: f64 = GridShape::fitting(area).nodes(area).iter().product();
    // A blockage checks its own cells.
    if scenario.water.blockage.is_none() && !(nodes <= MOST_NODES) {
        let problem = format!("its currents need a grid of {nodes:.1e} nodes; at most {MOST_NODES:.0e} are allowed");
        found.push(UnplacedFault::error("area", problem).hint("make length_m and width_m smaller"));
    }
    let half = Vector2::new(area.length_m, area.width_m) / 2.0;
    let depth = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(a, b)| area.world(Vector2::new(a * half.x, b * half.y)))
        .map(|p| -terrain.bed_z(p.x, p.y))
        .into_iter()
        .fold(0.0, f64::max);
    if !(depth <= DEEPEST_M) {
        let problem = format!("must be at most {DEEPEST_M} m deep, got {depth}");
        found.push(UnplacedFault::error("terrain", problem));
    } else if depth < SHALLOWEST_M {
        let problem = format!("must be at least {SHALLOWEST_M} m deep, got {}", shown(depth));
        found.push(UnplacedFault::error("terrain", problem));
    }
    for (path, extent) in [("area.length_m", area.length_m), ("area.width_m", area.width_m)] {
        if extent < NARROWEST_M {
            let problem = format!("must be at least {NARROWEST_M} m, got {}", shown(extent));
            found.push(UnplacedFault::error(path, problem));
        }
    }
    let t = &scenario.time;
    let (spin_up_s, limit_s) = (t.spin_up_s.get(), t.limit_s.get());
    for (path, s) in [("time.spin_up_s", spin_up_s), ("time.limit_s", limit_s)] {
        if !(s <= LONGEST_S) {
            let problem = format!("must be at most {LONGEST_S} s, got {s}");
            found.push(UnplacedFault::error(path, problem));
        }
    }
    for (i, source) in scenario.sources.iter().enumerate() {
        let filaments = source.release.settled().rate_hz.get() * (spin_up_s + limit_s);
        if !(filaments <= MOST_FILAMENTS) {
            let problem = format!(
                "releases {filaments:.1e} filaments in spin-up and mission; at most {MOST_FILAMENTS:.0e} are allowed"
            );
            let path = format!("sources[{i}].release");
            found.push(UnplacedFault::error(path, problem).hint("lower rate_hz, or shorten spin-up or mission"));
        }
    }
    found.len() == before
}

/// Checks the sizes of a robot's map and of its planner's space without building them.
pub(super) fn bounds(
    i: usize,
    robot: &RobotSpec,
    area: &Area,
    terrain: &Terrain,
    found: &mut Vec<UnplacedFault>,
) -> bool {
    let path = format!("robots[{i}]");
    let setting = robot.setting(area, terrain, &Obstacles::default());
    let map = robot.map.as_ref().map_or(Ok(()), |map| map.check(area));
    let parts = [("map", map), ("strategy", robot.strategy.check(&setting))];
    let before = found.len();
    for (part, checked) in parts {
        found.extend(checked.err().map(|e| robot_error(&path, part, e)));
    }
    found.len() == before
}

/// The water, unless a current of another crate is wrong where and when the checks ask for it: asked there, it panics.
pub(super) fn sound(scenario: &Scenario, water: Water, area: &Area, terrain: &Terrain) -> Result<Water, PlumeError> {
    let until_s = scenario.time.spin_up_s.get() + scenario.time.limit_s.get();
    let starts = (scenario.robots.iter()).map(|r| (r.start.p_W(terrain).xy(), 0.0));
    match (starts.chain(examined(area, until_s))).find_map(|(p, t_s)| water.fault(p, t_s)) {
        Some(problem) => Err(PlumeError::Invalid { field: "water.currents".to_string(), problem }),
        None => Ok(water),
    }
}

/// Checks the speed of the water at the robots' starts and in the middle of the area.
pub(super) fn speeds(scenario: &Scenario, water: &Water, terrain: &Terrain, found: &mut Vec<UnplacedFault>) {
    let starts = scenario.robots.iter().map(|r| r.start.p_W(terrain));
    let middle = scenario.area.build().centre;
    let middle = Vector3::new(middle.x, middle.y, terrain.bed_z(middle.x, middle.y) / 2.0);
    for p in starts.chain([middle]) {
        let speed = water.velocity_without_eddies(&p, 0.0).norm();
        // This form also refuses what is not a number.
        if !(speed <= FASTEST_M_S) {
            let problem = format!(
                "together they flow at {speed} m/s at east {} m, north {} m; at most {FASTEST_M_S} m/s are allowed",
                p.x, p.y
            );
            found.push(UnplacedFault::error("water.currents", problem));
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{CHANNEL, told};

    #[test]
    fn what_no_computer_could_bear_and_no_sea_has_is_refused_at_its_field() {
        for (path, value, field, says) in [
            ("sources[0].release.rate_hz", "1e12", "sources[0].release", "3.8e15 filaments"),
            ("sources[0].release.rate_hz", "1e12", "sources[0].release", "at most 5e7"),
            ("time.spin_up_s", "1e18", "time.spin_up_s", "at most 10000000 s"),
            ("time.spin_up_period_s", "1e-9", "time.spin_up_period_s", "at least time.step_s, 0.02"),
            ("terrain.depth_m", "1e6", "terrain", "at most 12000 m deep"),
            ("water.currents[0].speed_m_s", "1e6", "water.currents", "at most 15 m/s"),
        ] {
            let said = told(CHANNEL, &[(path, value)]);
            // A long spin-up is told of its filaments, too.
            assert!(said.len() == 1 || path == "time.spin_up_s", "{said:?}");
            assert!(said[0].starts_with(&format!("{field}: ")) && said[0].contains(says), "{said:?}");
        }
    }
}
