//! Warns when a scenario asks for more than vehicle, strategy and plume can do.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::{RobotSpec, Scenario};
use crate::scenario::success::SuccessSpec;
use nalgebra::Vector2;
use plumes::flow::Water;
use robots::actuate::AutopilotSpec;
use robots::handoff::{Control, TurnLimit, Vertical};
use robots::vehicles::Vehicle;
use world::area::Area;
use world::limits::range::stream_m_s;
use world::terrain::Terrain;

/// A speed is reported if it exceeds the possible one by this factor. Drag and thrust are not known better.
const SLACK: f64 = 1.05;
/// A plume shorter than this share of the area's length has hardly left its source.
const SHORT: f64 = 0.02;

/// Speeds that the vehicle cannot reach. `water_m_s` is the speed of the water where it starts.
pub(super) fn speeds(i: usize, robot: &RobotSpec, vehicle: &Vehicle, water_m_s: f64, found: &mut Vec<UnplacedFault>) {
    let top_m_s = vehicle.top_speed_m_s(robot.autopilot.rpm_limit.get());
    let limit_m_s = robot.guidance.water_speed_limit_m_s.get();
    let carried = vehicle.is_carried();
    let makes = |m_s: f64| {
        if carried {
            format!("it reaches at most {m_s:.2} m/s through the water, which moves at {water_m_s:.2} m/s at its start")
        } else {
            format!("it reaches at most {m_s:.2} m/s over ground")
        }
    };
    let own_m_s = top_m_s.min(limit_m_s);
    // Water faster than any is an error of its own.
    if carried && own_m_s < water_m_s && water_m_s <= stream_m_s.1 {
        let problem = format!("the water carries it away: {}", makes(own_m_s));
        let slow = if limit_m_s < top_m_s { "guidance.water_speed_limit_m_s" } else { "vehicle" };
        found.push(UnplacedFault::warning(format!("robots[{i}].{slow}"), problem));
    }
    // What the water adds to the vehicle's own speed.
    let water_m_s = if carried { water_m_s } else { 0.0 };
    let start_m_s = robot.start.speed_m_s.get();
    if start_m_s > SLACK * (top_m_s + water_m_s) {
        let problem = format!("{start_m_s} m/s is more than the vehicle can do: {}", makes(top_m_s));
        found.push(UnplacedFault::warning(format!("robots[{i}].start.speed_m_s"), problem));
    }
    for (field, m_s) in robot.strategy.about().wishes.speeds_m_s {
        if m_s > SLACK * (own_m_s + water_m_s) {
            let by = if limit_m_s < top_m_s { " (guidance.water_speed_limit_m_s)" } else { "" };
            let problem = format!("{m_s} m/s is more than the vehicle can do: {}{by}", makes(own_m_s));
            found.push(UnplacedFault::warning(format!("robots[{i}].strategy.{field}"), problem));
        }
    }
    if limit_m_s > SLACK * top_m_s {
        let problem = format!("{limit_m_s} m/s is never reached: at full power the vehicle makes {top_m_s:.2} m/s");
        found.push(UnplacedFault::warning(format!("robots[{i}].guidance.water_speed_limit_m_s"), problem));
    }
    if let Control::Rates(limits) = vehicle.control() {
        let asked_deg_s = robot.guidance.heading_rate_deg_s.get();
        let most_deg_s = match limits.turn {
            TurnLimit::Rate(rad_s) => rad_s.to_degrees(),
            TurnLimit::Radius(_) => limits.turn.rate_rad_s(own_m_s).to_degrees(),
        };
        if most_deg_s > SLACK * asked_deg_s {
            let problem = format!(
                "the guidance asks for at most {asked_deg_s} degrees/s, so the vehicle never turns at the \
                 {most_deg_s:.1} degrees/s that it can"
            );
            let path = format!("robots[{i}].guidance.heading_rate_deg_s");
            found.push(UnplacedFault::warning(path, problem));
        }
    }
}

/// What a strategy asks of a vehicle that it cannot do. `water_m_s` is the speed of the water where it starts.
pub(super) fn capabilities(
    i: usize,
    robot: &RobotSpec,
    vehicle: &Vehicle,
    step_s: f64,
    water_m_s: f64,
    found: &mut Vec<UnplacedFault>,
) {
    let able = vehicle.capabilities(robot.guidance.tightest_turn_m());
    if let Control::Drives(_) = vehicle.control() {
        // It starts with that speed over ground, and is never much faster than it can go.
        let start_m_s = robot.start.speed_m_s.get() + water_m_s;
        let fastest_m_s = start_m_s.max(able.top_speed_m_s);
        if let Err(problem) = vehicle.follows(step_s, fastest_m_s) {
            found.push(UnplacedFault::error(format!("robots[{i}].vehicle"), problem));
        }
        if robot.autopilot != AutopilotSpec::default() {
            let problem = "is that of a REMUS, and has no effect on this vehicle: its own stands in its vehicle.ron";
            found.push(UnplacedFault::warning(format!("robots[{i}].autopilot"), problem));
        }
    }
    let strategy = robot.strategy.name();
    let wishes = robot.strategy.about().wishes;
    // A depth of zero is the surface itself.
    let asked = |v: &Vertical| *v != Vertical::Depth(0.0);
    if let Some((field, _)) = wishes.verticals.iter().find(|(_, v)| asked(v)) {
        let path = format!("robots[{i}].strategy.{field}");
        if !able.dives {
            let problem = format!(
                "{strategy} commands a height, and this vehicle stays on the surface: what it carries is as deep as its \
                 URDF says"
            );
            found.push(UnplacedFault::warning(path, problem));
        } else if !able.holds_depth {
            let problem = format!(
                "{strategy} commands a height, and this vehicle holds none: it goes up and down between the depths of \
                 its autopilot"
            );
            found.push(UnplacedFault::error(path, problem).hint("a strategy without a height, such as Route"));
        }
    }
    for field in &wishes.waits {
        if !able.hovers {
            let problem = format!(
                "{strategy} waits at a place, and this vehicle cannot hover: its least speed is {:.2} m/s",
                able.least_speed_m_s
            );
            found.push(
                UnplacedFault::error(format!("robots[{i}].strategy.{field}"), problem)
                    .hint("`rheotaxis list vehicles` names vehicles that hover"),
            );
        }
    }
    for (field, m_s) in wishes.speeds_m_s {
        if m_s < able.least_speed_m_s {
            let problem =
                format!("{m_s} m/s is slower than this vehicle can be steered at, {:.2} m/s", able.least_speed_m_s);
            found.push(UnplacedFault::warning(format!("robots[{i}].strategy.{field}"), problem));
        }
    }
}

/// Whether the strategies can make as many declarations as the success rule asks for.
pub(super) fn declarations(scenario: &Scenario, found: &mut Vec<UnplacedFault>) {
    let SuccessSpec::AllDeclared(wanted) = &scenario.success else {
        return;
    };
    let within_m = wanted.within_m.get();
    // One declaration can be near several sources, so only sources too far apart for that are counted.
    let mut apart: Vec<Vector2<f64>> = Vec::new();
    for source in &scenario.sources {
        let p = Vector2::new(source.east_m.get(), source.north_m.get());
        if apart.iter().all(|other| (p - other).norm() > 2.0 * within_m) {
            apart.push(p);
        }
    }
    let robots = scenario.robots.iter().map(|r| r.strategy.about().declares_at_most);
    let most = robots.fold(scenario.gantries.len(), usize::saturating_add);
    if most < apart.len() {
        let problem = format!(
            "{} sources are to be declared, but all strategies together make at most {most} declaration{}",
            apart.len(),
            if most == 1 { "" } else { "s" }
        );
        found.push(UnplacedFault::warning("success", problem).hint("search in Subregions, or with more robots"));
    }
}

/// Whether the plume has spread when the mission starts.
pub(super) fn plume(
    scenario: &Scenario,
    area: &Area,
    terrain: &Terrain,
    water: &Water,
    found: &mut Vec<UnplacedFault>,
) {
    let seeks = |r: &RobotSpec| r.strategy.about().searches;
    if !scenario.robots.iter().any(seeks) && scenario.gantries.is_empty() {
        return;
    }
    let spin_up_s = scenario.time.spin_up_s.get();
    let Ok(placed) = plumes::release::place(&scenario.sources, area, terrain) else {
        return;
    };
    let fastest = placed.iter().map(|s| water.velocity_without_eddies(&s.p_W, 0.0).xy().norm());
    let Some(m_s) = fastest.max_by(f64::total_cmp) else {
        return;
    };
    let reach_m = spin_up_s * m_s;
    let moves = m_s > 1e-3;
    if spin_up_s <= 0.0 || moves && reach_m < SHORT * area.length_m {
        let problem = format!("the plume is {reach_m:.1} m long when the mission starts: there is nothing to find yet");
        let hint = if moves {
            format!("in {:.0} s it crosses the area", (area.length_m / m_s).ceil())
        } else {
            "give it time to develop".to_string()
        };
        found.push(UnplacedFault::warning("time.spin_up_s", problem).hint(hint));
    }
}

/// Whether the mission can succeed at all.
pub(super) fn purpose(scenario: &Scenario, found: &mut Vec<UnplacedFault>) {
    let seeks = |r: &RobotSpec| r.strategy.about().searches;
    let declares = scenario.success.declared_within_m().is_some();
    if scenario.sources.is_empty() {
        if let Some(i) = scenario.robots.iter().position(seeks) {
            found.push(UnplacedFault::warning(
                format!("robots[{i}].strategy"),
                "the robot searches, but the scenario has no source to find",
            ));
        } else if declares {
            found.push(UnplacedFault::warning(
                "success",
                "it asks for a declaration near a source, but the scenario has no source",
            ));
        }
    }
    if declares && scenario.gantries.is_empty() && !scenario.robots.iter().any(seeks) {
        found.push(UnplacedFault::warning("success", "it asks for a declaration, but no robot searches"));
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{CHANNEL, NOTHING, told, told_once};

    #[test]
    fn speeds_that_no_thrust_makes_are_told() {
        let strategy = "robots[0].strategy.speed_m_s";
        assert_eq!(told(CHANNEL, &[(strategy, "2.0")]), NOTHING);
        for (path, says) in [
            (strategy, "15 m/s is more than the vehicle can do: it reaches at most 2.00 m/s"),
            ("robots[0].start.speed_m_s", "15 m/s is more"),
            ("robots[0].guidance.water_speed_limit_m_s", "at full power the vehicle makes 2.5"),
        ] {
            let said = told_once(CHANNEL, &[(path, "15")]);
            assert!(said.starts_with(path) && said.contains(says), "{said}");
        }
    }

    #[test]
    fn more_sources_than_declarations_are_told() {
        let source = |id: &str, east_m: i32, north_m: i32| {
            format!("(id: \"{id}\", east_m: {east_m}, north_m: {north_m}, height_m: 2, rate_g_s: 0.02)")
        };
        let three = format!("[{}, {}, {}]", source("s1", -150, 0), source("s2", 0, 0), source("s3", 100, 20));
        let said = |success: &str| told(CHANNEL, &[("sources", &three), ("success", success)]);
        assert_eq!(
            said("AllDeclared(within_m: 20)"),
            ["success: 3 sources are to be declared, but all strategies together make at most 1 declaration"]
        );
        // One declaration half-way is near them all.
        assert_eq!(said("AllDeclared(within_m: 200)"), NOTHING);
    }

    #[test]
    fn a_search_for_a_plume_that_has_not_left_its_source_is_told() {
        for (spin_up_s, says) in [("0", "the plume is 0.0 m long"), ("10", "the plume is ")] {
            let said = told_once(CHANNEL, &[("time.spin_up_s", spin_up_s)]);
            assert!(said.starts_with(&format!("time.spin_up_s: {says}")), "{said}");
        }
    }
}
