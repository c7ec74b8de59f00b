//! Checks that a robot carries the instruments that its strategy, its autopilot, its map and its estimator need.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::RobotSpec;
use robots::handoff::{Capabilities, Need};
use robots::vehicles::Vehicle;

/// Names each instrument that a part of the robot needs and the robot lacks. `vehicle` is missing if it cannot be
/// built.
pub(super) fn fitted(i: usize, robot: &RobotSpec, vehicle: Option<&Vehicle>, found: &mut Vec<UnplacedFault>) {
    let able = vehicle.map(|v| v.capabilities(robot.guidance.tightest_turn_m()));
    let stands_for = |name: &str| robot.sensors.iter().any(|s| s.stands_for().contains(&name));
    let lacks = |name: &str| !robot.sensors.has(name) && !stands_for(name);
    let mut needs = needs(robot, able.as_ref(), &lacks);
    needs.retain(|n| lacks(n.instrument));
    // The one without which the run means nothing comes first.
    needs.sort_by_key(|n| !n.vital);
    for (k, need) in needs.iter().enumerate() {
        let instrument = need.instrument;
        if needs[..k].iter().any(|n| n.instrument == instrument) {
            continue;
        }
        let mut why: Vec<&str> = Vec::new();
        for other in needs.iter().filter(|n| n.instrument == instrument) {
            if !why.contains(&other.so) {
                why.push(other.so);
            }
        }
        let problem = format!("robot \"{}\" carries no {instrument}: it {}", robot.id.as_str(), why.join(", and "));
        let path = format!("robots[{i}].{}", need.field);
        let told = if need.vital { UnplacedFault::error(path, problem) } else { UnplacedFault::warning(path, problem) };
        let hint = format!("fit one, as in `sensors: ({instrument}: ())`");
        found.push(if need.field == "sensors" {
            told.hint(hint)
        } else {
            told.hint(format!("{hint}, or change what asks for it"))
        });
    }
}

/// What the parts of the robot need, with paths below the robot.
fn needs(robot: &RobotSpec, able: Option<&Capabilities>, lacks: &dyn Fn(&str) -> bool) -> Vec<Need> {
    let of_all = |need: Need| match need.field.as_str() {
        "" => need.within("sensors"),
        _ => need,
    };
    let about = robot.strategy.about();
    let searches = about.searches;
    let known = able.copied().unwrap_or_default();
    let commands = about.wishes.needs(&known);
    let steers = !commands.is_empty();
    let mut needs: Vec<Need> = (about.needs.into_iter()).map(|n| n.within("strategy")).collect();
    let of_commands = commands.into_iter().map(|n| match n.field.as_str() {
        "" => of_all(n),
        _ => n.within("strategy"),
    });
    // What a vehicle can do is not known before it can be built.
    needs.extend(of_commands.filter(|_| able.is_some()));
    if steers && lacks("lbl") {
        let so = "never knows where it is: no fix comes either";
        needs.push(Need::vital("sensors", "dvl", so));
    }
    for need in robot.estimator.needs() {
        let afloat = need.instrument == "depth" && able.is_some_and(|a| !a.dives);
        if need.vital {
            needs.push(need.within("estimator"));
        } else if (searches || steers) && !afloat {
            needs.push(of_all(need));
        }
    }
    if searches || robot.map.is_some() {
        needs.push(Need::wish("sensors", "fluorometer", "smells nothing"));
        needs.push(Need::wish("sensors", "adcp", "never knows the flow"));
    }
    needs
}

#[cfg(test)]
mod tests {
    use crate::scenario::{Scenario, Severity, check};
    use crate::testing::{CHANNEL, changed, told};
    use robots::sense::SensorsSpec;
    use std::path::Path;

    const SENSORS: &str = "robots[0].sensors";
    const VERTICAL: &str = "robots[0].strategy.vertical";

    /// What is said of a scenario: whether it stops a run, and path.
    fn problems(scenario: &Scenario) -> Vec<(bool, String)> {
        let found = check(scenario, Path::new("")).into_iter();
        found.map(|f| (f.severity == Severity::Error, f.path)).collect()
    }

    /// What is said of a scenario of the catalogue without an instrument.
    fn without(name: &str, instrument: &str, values: &[(&str, &str)]) -> Vec<(bool, String)> {
        let mut scenario = changed(name, values).scenario;
        let sensors = &mut scenario.robots[0].sensors;
        assert!(sensors.has(instrument), "{name} carries no {instrument}");
        *sensors = sensors.clone().without(instrument);
        problems(&scenario)
    }

    #[test]
    fn what_is_asked_for_must_be_on_board() {
        let deep = [(VERTICAL, "Depth(5)")];
        let kinematic = [("robots[0].vehicle", "Kinematic()")];
        for (name, instrument, values, stops, path) in [
            ("moth_plus", "ctd", [].as_slice(), true, "robots[0].estimator.layer_aware"),
            ("moth_plus", "ranging", &[], true, "robots[0].strategy.layers"),
            ("moth_plus", "lbl", &[], false, "robots[0].strategy.fixes"),
            ("duck_survey", "sidescan", &[], true, "robots[0].strategy.after_declaration.sidescan"),
            ("inspect_places", "camera", &[], true, "robots[0].strategy.survey.camera"),
            // A height needs the instrument that tells it: what holds a depth needs that one.
            (CHANNEL, "altimeter", &[], true, VERTICAL),
            (CHANNEL, "altimeter", &kinematic, true, VERTICAL),
            (CHANNEL, "depth", &deep, true, VERTICAL),
            (CHANNEL, "depth", &[], false, SENSORS),
            // Steering needs a heading and a place; fixes tell the place without a log.
            (CHANNEL, "compass", &[], true, SENSORS),
            ("inspect_places", "compass", &[], true, SENSORS),
            (CHANNEL, "dvl", &[], false, SENSORS),
            ("inspect_places", "dvl", &[], false, SENSORS),
            ("dalian_bay", "dvl", &[], true, SENSORS),
            // A glider turns at its depths, and before the bed.
            ("glider_shelf", "depth", &[], true, SENSORS),
            ("glider_shelf", "altimeter", &[], false, SENSORS),
            // A blind search is a warning.
            (CHANNEL, "fluorometer", &[], false, SENSORS),
            (CHANNEL, "adcp", &[], false, SENSORS),
        ] {
            assert_eq!(without(name, instrument, values), [(stops, path.to_string())], "{name} without {instrument}");
        }
        // A craft on the surface needs neither depth nor altitude, and what holds a depth no altimeter.
        for (name, instrument, values) in [
            ("surface_lake", "depth", [].as_slice()),
            ("surface_lake", "altimeter", &[]),
            (CHANNEL, "altimeter", &deep),
        ] {
            assert_eq!(without(name, instrument, values), [], "{name} without {instrument}");
        }
        let said = told("dalian_bay", &[(VERTICAL, "Altitude(2)")]);
        assert_eq!(said, [format!("{VERTICAL}: robot \"auv0\" carries no altimeter: it cannot hold an altitude")]);
        // A behaviour needs what its strategy does not.
        for (strategy, field) in [
            ("Amp(track_in: Bilateral())", "track_in"),
            ("Subsumption(layers: [Find(ZigZag()), Maintain(track_in: Bilateral())])", "layers[1].track_in"),
        ] {
            let said = told(CHANNEL, &[("robots[0].strategy", strategy)]);
            let problem = "robot \"auv0\" carries no fluorometers_aside: it has no two sides to compare";
            assert_eq!(said[0], format!("robots[0].strategy.{field}: {problem}"));
        }
    }

    /// A search within another strategy, one that stands in for an answer, a route.
    #[test]
    fn a_height_needs_its_instrument_whoever_commands_it() {
        let amp = "Amp(speed_m_s: 1.5, vertical: Altitude(2))";
        let regions = "regions: Grid(along: 2, across: 1, order: [(0, 0)]), timeout_s: 100";
        for (strategy, field) in [
            (format!("Subregions(vertical: Depth(5), {regions}, search: {amp})"), "search.vertical"),
            (format!("External(on_late: Fallback({amp}))"), "on_late.vertical"),
            ("Route(points: [(0, 0)], vertical: Altitude(2))".to_string(), "vertical"),
        ] {
            let mut told = without(CHANNEL, "altimeter", &[("robots[0].strategy", &strategy)]);
            told.retain(|(stops, _)| *stops);
            assert_eq!(told, [(true, format!("robots[0].strategy.{field}"))]);
        }
    }

    #[test]
    fn a_searcher_that_is_not_known_to_steer_needs_nothing() {
        // Nothing is steered by a searcher outside this program, as far as anyone knows.
        let mut bare = changed(CHANNEL, &[("robots[0].strategy", "External()")]).scenario;
        bare.robots[0].sensors = SensorsSpec::default();
        assert_eq!(problems(&bare), vec![(false, SENSORS.to_string()); 5]);
    }
}
