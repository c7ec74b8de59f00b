//! Checks of what a scenario means. They find contradictions that reading alone cannot see; each has the field's path.

mod able;
mod berth;
mod faults;
mod fitted;
mod gantry;
mod limits;
mod noise;
mod obstacles;
mod path;
mod resolved;
mod sources;
mod steps;
mod times;
mod view;

use super::cost;
use super::fault::{Severity, UnplacedFault};
use super::folder_files::FolderFiles;
use super::schema::{RobotSpec, Scenario, TerrainSpec};
use eyes::camera::Optics;
use path::{names, robot_error, twins};
use plumes::error::PlumeError;
use robots::error::RobotError;
use robots::sense::{OnBoard, SensorSuite};
use robots::strategy::Setting;
use robots::vehicles::{Vehicle, VehicleSpec};
use std::path::Path;
use world::area::Area;
use world::obstacles::Obstacles;
use world::seeds::Stream;
use world::terrain::Terrain;

/// A hull that starts nearer to an obstacle than this may touch it, m.
const BERTH_M: f64 = 1.0;

/// Finds all errors and warnings. File paths in the scenario are relative to `base_dir`.
pub fn check(scenario: &Scenario, base_dir: &Path) -> Vec<UnplacedFault> {
    check_within(scenario, base_dir, cost::MEMORY)
}

/// The same with a limit for the memory of a run, bytes. What does not fit is not built for the checks either.
pub fn check_within(scenario: &Scenario, base_dir: &Path, memory_bytes: f64) -> Vec<UnplacedFault> {
    let area = scenario.area.build();
    let terrain = scenario.terrain.build(&area);
    let mut found = Vec::new();
    slope(&scenario.terrain, &mut found);
    let mut fits = limits::sizes(scenario, &area, &terrain, &mut found);
    for (i, robot) in scenario.robots.iter().enumerate() {
        fits &= limits::bounds(i, robot, &area, &terrain, &mut found);
    }
    let cost = cost::cost(scenario);
    fits = fits && cost::judge(&cost, memory_bytes, &mut found);
    // Any seed will do, because whether the water can be built does not depend on its random numbers.
    let water = fits.then(|| {
        let water = scenario.water.build(&area, &terrain, 0)?;
        limits::sound(scenario, water, &area, &terrain)
    });
    match &water {
        Some(Ok(water)) => {
            limits::speeds(scenario, water, &terrain, &mut found);
            able::plume(scenario, &area, &terrain, water, &mut found);
            sources::releases(scenario, &area, &terrain, water, &mut found);
        }
        Some(Err(PlumeError::Invalid { field, problem })) => {
            found.push(UnplacedFault::error(field, problem));
        }
        None => {}
    }
    if let Err(RobotError::Invalid { field, problem }) = Optics::new(&scenario.optics) {
        found.push(UnplacedFault::error(field, problem));
    }
    let obstacles = obstacles::obstacles(scenario, &area, &terrain, base_dir, &mut found);
    let solid = obstacles.without(&scenario.permeable);
    if fits {
        obstacles::blockage(scenario, &area, &terrain, &solid, &mut found);
    }
    obstacles::known("permeable", &scenario.permeable, &scenario.obstacles, &mut found);
    sources::sources(scenario, &area, &terrain, &solid, &mut found);
    machines(scenario, &mut found);
    for (i, robot) in scenario.robots.iter().enumerate() {
        start(i, robot, &area, &terrain, &obstacles, &mut found);
        let step_s = scenario.time.step_s.get();
        let vehicle = parts(i, robot, step_s, base_dir, &mut found);
        let limit_s = scenario.time.limit_s.get();
        faults::faults(i, robot, vehicle.as_ref(), limit_s, &mut found);
        if let Some(vehicle) = &vehicle {
            let place = view::RobotSurroundings { area: &area, terrain: &terrain, obstacles: &obstacles };
            if fits {
                view::view(i, robot, vehicle, &place, &mut found);
            }
            let p_W = robot.start.p_W(&terrain);
            let water_m_s = (water.as_ref().and_then(|w| w.as_ref().ok()))
                .map_or(0.0, |w| w.velocity_without_eddies(&p_W, 0.0).norm());
            able::speeds(i, robot, vehicle, water_m_s, &mut found);
            able::capabilities(i, robot, vehicle, step_s, water_m_s, &mut found);
        }
        let setting = robot.setting(&area, &terrain, &obstacles);
        let path = format!("robots[{i}].chart");
        obstacles::known(&path, &robot.chart, &scenario.obstacles, &mut found);
        if fits {
            mind(i, robot, &setting, &mut found);
        }
        fitted::fitted(i, robot, vehicle.as_ref(), &mut found);
        noise::fluorometer(i, robot, &mut found);
    }
    berth::berths(&scenario.robots, &terrain, &mut found);
    for (i, gantry) in scenario.gantries.iter().enumerate() {
        let step_s = scenario.time.step_s.get();
        gantry::check(i, gantry, &area, &terrain, step_s, base_dir, &mut found);
        noise::probes(i, gantry, &mut found);
    }
    able::declarations(scenario, &mut found);
    times::times(scenario, &mut found);
    able::purpose(scenario, &mut found);
    if let Some(Ok(water)) = &water
        && !found.iter().any(|f| f.severity == Severity::Error)
    {
        cost::patience(&cost, &mut found);
        steps::steps(scenario, water, &area, &terrain, &mut found);
        resolved::resolved(scenario, &area, &terrain, &mut found);
    }
    found
}

/// The names of all machines: none is that of another.
fn machines(scenario: &Scenario, found: &mut Vec<UnplacedFault>) {
    let lists: [(&str, Vec<&str>); 3] = [
        ("robots", scenario.robots.iter().map(|r| r.id.as_str()).collect()),
        ("gantries", scenario.gantries.iter().map(|g| g.id.as_str()).collect()),
        ("apparatus", scenario.apparatus.iter().map(|a| a.id()).collect()),
    ];
    names("apparatus", &lists[2].1, found);
    for (k, (list, ids)) in lists.iter().enumerate() {
        twins(list, ids, found);
        for (i, id) in ids.iter().enumerate() {
            for (before, others) in &lists[..k] {
                if let Some(twin) = others.iter().position(|other| other == id) {
                    let problem = format!("\"{id}\" is already the name of {before}[{twin}]");
                    found.push(UnplacedFault::error(format!("{list}[{i}].id"), problem));
                }
            }
        }
    }
}

fn slope(terrain: &TerrainSpec, found: &mut Vec<UnplacedFault>) {
    if let TerrainSpec::Slope(s) = terrain
        && s.shallow_m > s.deep_m
    {
        let (shallow, deep) = (s.shallow_m.get(), s.deep_m.get());
        found.push(
            UnplacedFault::error("terrain.shallow_m", format!("must be at most deep_m, {deep}, got {shallow}"))
                .hint("the water gets shallower towards the shore; to turn the slope, change shoreward_heading_deg"),
        );
    }
}

fn start(
    i: usize,
    robot: &RobotSpec,
    area: &Area,
    terrain: &Terrain,
    obstacles: &Obstacles,
    found: &mut Vec<UnplacedFault>,
) {
    let path = format!("robots[{i}].start");
    let (start, id) = (&robot.start, robot.id.as_str());
    if start.depth_m.is_some() == start.altitude_m.is_some() {
        let given = if start.depth_m.is_some() { "both are" } else { "neither is" };
        found.push(UnplacedFault::error(path, format!("give either depth_m or altitude_m; {given} given")));
        return;
    }
    let p = start.p_W(terrain);
    let (distance, _) = area.edge_distance(p.xy());
    if distance < 0.0 {
        found.push(
            UnplacedFault::error(
                &path,
                format!("robot \"{id}\" at east {} m, north {} m starts {:.1} m outside the area", p.x, p.y, -distance),
            )
            .hint("bring it inside, or make the area larger"),
        );
    }
    let depth = -terrain.bed_z(p.x, p.y);
    if -p.z > depth {
        found.push(UnplacedFault::error(
            format!("{path}.depth_m"),
            format!(
                "robot \"{id}\" starts {:.2} m under the bed; must be from 0 (the surface) to {depth:.2} \
                 (the water's depth there), got {}",
                -p.z - depth,
                -p.z
            ),
        ));
    } else if p.z > 0.0 {
        found.push(UnplacedFault::error(
            format!("{path}.altitude_m"),
            format!(
                "robot \"{id}\" starts {:.2} m above the surface; must be from 0 (the bed) to {depth:.2} \
                 (the water's depth there), got {}",
                p.z,
                p.z + depth
            ),
        ));
    }
    for obstacle in &obstacles.0 {
        let away = obstacle.distance(&p);
        if away < 0.0 {
            found.push(
                UnplacedFault::error(
                    &path,
                    format!(
                        "robot \"{id}\" starts inside obstacle \"{}\", {:.2} m from its surface",
                        obstacle.id, -away
                    ),
                )
                .hint("move the start or the obstacle"),
            );
        } else if away < BERTH_M {
            found.push(UnplacedFault::warning(
                &path,
                format!("robot \"{id}\" starts {away:.2} m from obstacle \"{}\": its hull may touch it", obstacle.id),
            ));
        }
    }
}

/// Checks the robot's map and strategy by building them on its chart.
fn mind(i: usize, robot: &RobotSpec, setting: &Setting, found: &mut Vec<UnplacedFault>) {
    let path = format!("robots[{i}]");
    if let Some(map) = &robot.map
        && let Err(e) = map.build(&setting.area, Stream::new(0, "", ""))
    {
        found.push(robot_error(&path, "map", e));
    }
    if let Err(e) = robot.strategy.build(setting) {
        found.push(robot_error(&path, "strategy", e));
    }
}

/// Checks hull and instruments by building them. Returns the vehicle if both can be built.
fn parts(i: usize, robot: &RobotSpec, step_s: f64, base_dir: &Path, found: &mut Vec<UnplacedFault>) -> Option<Vehicle> {
    let path = format!("robots[{i}]");
    // A folder has files of its own, and no field for them here.
    let in_folder = matches!(robot.vehicle, VehicleSpec::File(_) | VehicleSpec::Shipped(_));
    match Vehicle::load(&robot.vehicle, &FolderFiles(base_dir)) {
        Ok(vehicle) => {
            for told in vehicle.doubts() {
                let field = if in_folder { format!("{path}.vehicle") } else { format!("{path}.vehicle.urdf") };
                found.push(UnplacedFault::warning(field, told.clone()));
            }
            let mounts = |name: &str| vehicle.mount(name);
            let id = robot.id.as_str();
            match SensorSuite::new(&robot.sensors, &mounts, OnBoard::new(id, 0, step_s)) {
                Ok(_) => return Some(vehicle),
                Err(e) => found.push(robot_error(&path, "sensors", e)),
            }
        }
        Err(e) => {
            let mut fault = robot_error(&path, "vehicle", e);
            if in_folder {
                fault.path = format!("{path}.vehicle");
            }
            found.push(fault);
        }
    }
    None
}
