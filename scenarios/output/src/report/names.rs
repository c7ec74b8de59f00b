//! The names of the files that a run may leave.

use crate::results::probes::file_name;
use rheotaxis::scenario::Scenario;

/// Files of any run.
const OF_RUN: [&str; 10] = [
    "summary.json",
    "report.html",
    "run.mcap",
    "track.csv",
    "plume.csv",
    "pictures.csv",
    "map.svg",
    "map.png",
    "convergence.svg",
    "convergence.png",
];
/// What names of figures, as `.svg` and `.png`, and of tables begin with; a machine's id follows.
const FIGURES_OF_ROBOT: [&str; 4] = ["series", "belief", "odour", "sidescan"];
const TABLES_OF_ROBOT: [&str; 2] = ["belief", "odour"];
const FIGURES_OF_GANTRY: [&str; 3] = ["flume", "probes", "approach"];
const TABLES_OF_GANTRY: [&str; 1] = ["probes"];

/// Whether a run of a scenario may leave a file of this name. Some it leaves only with certain instruments or options.
pub fn is_result(scenario: &Scenario, name: &str) -> bool {
    let Some((stem, ending)) = name.rsplit_once('.') else {
        return false;
    };
    let of = |id: &str, figures: &[&str], tables: &[&str]| {
        let kinds = match ending {
            "svg" | "png" => figures,
            "csv" => tables,
            _ => &[],
        };
        let id = file_name(id);
        let is = |kind: &&str| stem.strip_prefix(*kind).and_then(|s| s.strip_prefix('-')) == Some(&id);
        kinds.iter().any(is)
    };
    let picture = |id: &str| {
        let number = stem.strip_prefix(&format!("picture-{}-", file_name(id)));
        ending == "png" && number.is_some_and(|n| n.parse::<u32>().is_ok())
    };
    let mut robots = scenario.robots.iter().map(|r| r.id.as_str());
    let mut gantries = scenario.gantries.iter().map(|g| g.id.as_str());
    OF_RUN.contains(&name)
        || robots.any(|id| of(id, &FIGURES_OF_ROBOT, &TABLES_OF_ROBOT) || picture(id))
        || gantries.any(|id| of(id, &FIGURES_OF_GANTRY, &TABLES_OF_GANTRY))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario::{parse, template};

    #[test]
    fn names_are_those_of_the_scenarios_machines() {
        let text = template("uniform_channel").expect("in the catalogue").text;
        let robot = parse("s", text).unwrap();
        for (name, is) in [
            ("summary.json", true),
            ("series-auv0.svg", true),
            ("belief-auv0.csv", true),
            ("picture-auv0-17.png", true),
            ("series-auv0.csv", false),
            ("series-auv1.svg", false),
            ("picture-auv0-x.png", false),
            ("probes-auv0.csv", false),
            ("thesis.tex", false),
            ("notes", false),
        ] {
            assert_eq!(is_result(&robot, name), is, "{name}");
        }
        let crab = parse("s", template("flume_crab").expect("in the catalogue").text).unwrap();
        assert!(is_result(&crab, "probes-crab0.csv") && is_result(&crab, "approach-crab0.png"));
    }
}
