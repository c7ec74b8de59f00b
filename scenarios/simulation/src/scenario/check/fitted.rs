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
    use crate::scenario::told::told;
    use crate::scenario::{Scenario, Severity, check, parse, template};
    use robots::sense::SensorsSpec;
    use std::path::Path;

    /// What is said of a scenario of the catalogue without an instrument: whether it stops a run, and path.
    fn without(name: &str, instrument: &str, changes: &[(&str, &str)]) -> Vec<(bool, String)> {
        let mut text = template(name).expect("in the catalogue").text.to_string();
        for (from, to) in changes {
            assert_eq!(text.matches(from).count(), 1, "{from}");
            text = text.replace(from, to);
        }
        let mut scenario = parse("changed", &text).unwrap_or_else(|e| panic!("{:?}", e.lines()));
        let sensors = &mut scenario.robots[0].sensors;
        assert!(sensors.has(instrument), "{name} carries no {instrument}");
        *sensors = sensors.clone().without(instrument);
        problems(&scenario)
    }

    fn problems(scenario: &Scenario) -> Vec<(bool, String)> {
        let found = check(scenario, Path::new("")).into_iter();
        found.map(|f| (f.severity == Severity::Error, f.path)).collect()
    }

    fn error(path: &str) -> Vec<(bool, String)> {
        vec![(true, path.to_string())]
    }

    fn warning(path: &str) -> Vec<(bool, String)> {
        vec![(false, path.to_string())]
    }

    #[test]
    fn what_is_asked_for_must_be_on_board() {
        let moth = "moth_plus";
        assert_eq!(without(moth, "ctd", &[]), error("robots[0].estimator.layer_aware"));
        assert_eq!(without(moth, "ranging", &[]), error("robots[0].strategy.layers"));
        assert_eq!(without(moth, "lbl", &[]), warning("robots[0].strategy.fixes"));
        let survey = "robots[0].strategy.after_declaration.sidescan";
        assert_eq!(without("duck_survey", "sidescan", &[]), error(survey));
        let camera = error("robots[0].strategy.survey.camera");
        assert_eq!(without("inspect_places", "camera", &[]), camera);
    }

    #[test]
    fn a_height_needs_the_instrument_that_tells_it() {
        let said = told("dalian_bay", &[("vertical: Depth(1.5)", "vertical: Altitude(2)")]);
        assert_eq!(
            said,
            ["robots[0].strategy.vertical: robot \"auv0\" carries no altimeter: it cannot hold an altitude"]
        );
        let channel = "uniform_channel";
        let vertical = "robots[0].strategy.vertical";
        assert_eq!(without(channel, "altimeter", &[]), error(vertical));
        let kinematic = [("Remus100()", "Kinematic()")];
        assert_eq!(without(channel, "altimeter", &kinematic), error(vertical));
        // What holds a depth needs that one, and only that one.
        let deep = [("Altitude(2)", "Depth(5)")];
        assert_eq!(without(channel, "altimeter", &deep), []);
        assert_eq!(without(channel, "depth", &deep), error(vertical));
        assert_eq!(without(channel, "depth", &[]), warning("robots[0].sensors"));
        // Whoever commands it: a search within another strategy, one that stands in for an answer, a route.
        let amp = "strategy: Amp(speed_m_s: 1.5, vertical: Altitude(2))";
        for (strategy, field) in [
            (
                "Subregions(vertical: Depth(5), regions: Grid(along: 2, across: 1, order: [(0, 0)]), timeout_s: 100, \
                 search: Amp(speed_m_s: 1.5, vertical: Altitude(2)))",
                "search.vertical",
            ),
            ("External(on_late: Fallback(Amp(speed_m_s: 1.5, vertical: Altitude(2))))", "on_late.vertical"),
            ("Route(points: [(0, 0)], vertical: Altitude(2))", "vertical"),
        ] {
            let strategy = format!("strategy: {strategy}");
            let said = without(channel, "altimeter", &[(amp, strategy.as_str())]);
            let told: Vec<_> = said.into_iter().filter(|(stops, _)| *stops).collect();
            assert_eq!(told, error(&format!("robots[0].strategy.{field}")));
        }
    }

    #[test]
    fn steering_needs_a_heading_and_a_place() {
        let sensors = || "robots[0].sensors";
        for name in ["uniform_channel", "inspect_places"] {
            assert_eq!(without(name, "compass", &[]), error(sensors()), "{name}");
            // Fixes tell the place without a log.
            assert_eq!(without(name, "dvl", &[]), warning(sensors()), "{name}");
        }
        assert_eq!(without("dalian_bay", "dvl", &[]), error(sensors()));
        // A glider turns at its depths, and before the bed.
        assert_eq!(without("glider_shelf", "depth", &[]), error(sensors()));
        assert_eq!(without("glider_shelf", "altimeter", &[]), warning(sensors()));
        // A craft on the surface needs neither.
        assert_eq!(without("surface_lake", "depth", &[]), []);
        assert_eq!(without("surface_lake", "altimeter", &[]), []);
    }

    #[test]
    fn a_blind_search_is_a_warning() {
        for instrument in ["fluorometer", "adcp"] {
            assert_eq!(without("uniform_channel", instrument, &[]), warning("robots[0].sensors"));
        }
        // Nothing is steered by an open loop, which needs nothing.
        assert_eq!(told("remus_dive", &[]), [""; 0]);
        // Nor by a searcher outside this program, as far as anyone knows.
        let text = template("uniform_channel").expect("in the catalogue").text;
        let text = text.replace("Amp(speed_m_s: 1.5, vertical: Altitude(2))", "External()");
        let mut bare = parse("changed", &text).unwrap_or_else(|e| panic!("{:?}", e.lines()));
        bare.robots[0].sensors = SensorsSpec::default();
        let all = vec![warning("robots[0].sensors"); 5];
        assert_eq!(problems(&bare), all.concat());
    }
}
