//! Checks that a robot carries the instruments that its estimator and its strategy need.

use super::fault::Found;
use super::schema::RobotSpec;

/// Instruments that the estimator or the strategy requires and the robot lacks.
pub(super) fn fitted(i: usize, robot: &RobotSpec, found: &mut Vec<Found>) {
    let path = format!("robots[{i}]");
    if robot.estimator.needs_ctd() && !robot.sensors.has("ctd") {
        let problem =
            "the estimator tells water layers apart by density, but the robot does not measure it";
        found.push(
            Found::error(format!("{path}.estimator.layer_aware"), problem)
                .hint("fit a CTD, as in `sensors: (ctd: ())`, or leave layer_aware out"),
        );
    }
    if robot.strategy.needs_ranging() && !robot.sensors.has("ranging") {
        let problem = "its Avoid layer needs a forward ranging, but the robot has none";
        found.push(
            Found::error(format!("{path}.strategy.layers"), problem)
                .hint("fit one, as in `sensors: (ranging: ())`, or leave Avoid out"),
        );
    }
}

/// Instruments without which a search is blind.
pub(super) fn blind(i: usize, robot: &RobotSpec, found: &mut Vec<Found>) {
    if !robot.strategy.searches() {
        return;
    }
    for (name, so) in [
        ("fluorometer", "smells nothing"),
        ("compass", "never knows its heading"),
        ("dvl", "never knows how it moves"),
        ("adcp", "never knows the flow"),
        ("depth", "never knows its depth"),
    ] {
        if !robot.sensors.has(name) {
            let problem = format!(
                "robot \"{}\" searches without {name}: it {so}",
                robot.id.as_str()
            );
            let hint = format!("fit one, as in `sensors: ({name}: ())`");
            found.push(Found::warning(format!("robots[{i}].sensors"), problem).hint(&hint));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scenario::{check, parse, template};
    use std::path::Path;

    fn problems(text: &str) -> Vec<String> {
        let scenario = parse("changed", text).unwrap_or_else(|e| panic!("{:?}", e.lines()));
        let found = check(&scenario, Path::new(""));
        found.into_iter().map(|f| f.path).collect()
    }

    #[test]
    fn what_is_asked_for_must_be_on_board() {
        let text = template("moth_plus").expect("in the catalogue").text;
        assert_eq!(problems(text), Vec::<String>::new());
        let without = |what: &str| {
            let line = text.lines().find(|l| l.trim_start().starts_with(what));
            text.replace(line.expect("it is fitted"), "")
        };
        assert_eq!(
            problems(&without("ctd: (")),
            ["robots[0].estimator.layer_aware"]
        );
        assert_eq!(
            problems(&without("ranging: (")),
            ["robots[0].strategy.layers"]
        );
    }

    #[test]
    fn a_blind_search_is_a_warning() {
        let text = template("uniform_channel").expect("in the catalogue").text;
        assert_eq!(problems(text), Vec::<String>::new());
        let line = text
            .lines()
            .find(|l| l.trim_start().starts_with("sensors: ("));
        let without = text.replace(line.expect("it is fitted"), "");
        assert_eq!(problems(&without), ["robots[0].sensors"; 5]);
        let deaf = text.replace("fluorometer: (), ", "");
        assert_eq!(problems(&deaf), ["robots[0].sensors"]);
    }
}
