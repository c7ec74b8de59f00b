//! Checks the faults of a robot: what they are of, and when.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::RobotSpec;
use robots::faults::mistakes;
use robots::vehicles::Vehicle;

/// Finds faults of what the robot has not, times that contradict each other, and faults after the mission. `vehicle`
/// is missing if it cannot be built.
pub(super) fn faults(
    i: usize,
    robot: &RobotSpec,
    vehicle: Option<&Vehicle>,
    limit_s: f64,
    found: &mut Vec<UnplacedFault>,
) {
    let drives = vehicle.map(|vehicle| vehicle.named_drives());
    for mistake in mistakes(&robot.faults, &robot.sensors, drives.as_deref()) {
        let told = UnplacedFault::error(format!("robots[{i}].{}", mistake.field), mistake.problem);
        found.push(match mistake.help {
            Some(help) => told.hint(help),
            None => told,
        });
    }
    for (k, fault) in robot.faults.iter().enumerate() {
        let at_s = fault.at_s.get();
        if at_s >= limit_s {
            let problem = format!("begins at {at_s} s, when the mission is over: time.limit_s is {limit_s} s");
            let path = format!("robots[{i}].faults[{k}].at_s");
            found.push(UnplacedFault::warning(path, problem).hint("begin it earlier, or raise the limit"));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scenario::told::told;
    use crate::scenario::{parse, template};

    /// What is said of the channel with these faults.
    fn said(faults: &str) -> Vec<String> {
        let vertical = "vertical: Altitude(2)),";
        told("uniform_channel", &[(vertical, &format!("{vertical} faults: [{faults}],"))])
    }

    /// What the reader says of them first: line, field and problem.
    fn refused(faults: &str) -> String {
        let text = template("uniform_channel").expect("in the catalogue").text;
        let vertical = "vertical: Altitude(2)),";
        let text = text.replace(vertical, &format!("{vertical}\nfaults: [{faults}],"));
        let lines = parse("channel", &text).expect_err("not legal").lines();
        lines.into_iter().next().expect("at least one mistake")
    }

    #[test]
    fn legal_faults_are_not_spoken_of() {
        let none: [&str; 0] = [];
        assert_eq!(
            said(
                "(at_s: 300, what: Fluorometer(Silent)), (at_s: 0, until_s: 5, what: Compass(Biased(5))),
                (at_s: 5, what: Compass(Stuck)), (at_s: 100.5, what: Depth(Drifting(0.001))),
                (at_s: 1, what: Rudder(StuckAt(-10))), (at_s: 1, what: Propeller(Weak(0.5))),
                (at_s: 1, what: Drive(link: \"stern_plane\", how: Dead)),
                (at_s: 60, what: Fixes(Lie(east_m: 20, north_m: -10, over_s: 60)))"
            ),
            none
        );
    }

    #[test]
    fn contradictions_are_told_with_their_fields() {
        for (faults, want) in [
            (
                "(at_s: 300, until_s: 200, what: Compass(Stuck))",
                "robots[0].faults[0].until_s: must be later than at_s, 300 s, got 200",
            ),
            (
                "(at_s: 3, what: Compass(Stuck)), (at_s: 3, what: Ctd(Silent))",
                "robots[0].faults[1].what: the robot carries no ctd",
            ),
            (
                "(at_s: 3, what: Drive(link: \"ruder\", how: Stuck))",
                "robots[0].faults[0].what.link: the vehicle has no drive \"ruder\"",
            ),
            (
                "(at_s: 3, what: Compass(Stuck)), (at_s: 30, what: Compass(Silent))",
                "robots[0].faults[1].what: holds at the same time as faults[0], which is of the same thing",
            ),
            (
                "(at_s: 1800, what: Compass(Stuck))",
                "robots[0].faults[0].at_s: begins at 1800 s, when the mission is over: time.limit_s is 1800 s",
            ),
        ] {
            assert_eq!(said(faults), [want]);
        }
        let vertical = "strategy: Amp(speed_m_s: 1.5, vertical: Altitude(2)),";
        assert_eq!(
            told(
                "uniform_channel",
                &[
                    (vertical, &format!("{vertical} faults: [(at_s: 3, what: Rudder(Stuck))],")),
                    ("Remus100()", "Kinematic(moves: ThroughWater)"),
                ]
            ),
            ["robots[0].faults[0].what: a kinematic vehicle has no rudder that could fail: it moves as its helm asks"]
        );
    }

    #[test]
    fn nonsense_is_refused_by_the_reader_with_its_place() {
        for (fault, want) in [
            ("(at_s: -1, what: Compass(Stuck))", "robots[0].faults[0].at_s: must be >= 0, got -1"),
            ("(at_s: 1, what: Propeller(Weak(1.5)))", "robots[0].faults[0].what: must be from 0 to 1, got 1.5"),
            ("(at_s: 1, what: Fluorometer(StuckAt(10)))", "robots[0].faults[0].what: there is no choice `StuckAt`"),
            ("(at_s: 1, what: Nose(Silent))", "robots[0].faults[0].what: there is no choice `Nose`"),
            (
                "(at_s: 1, what: Compass(Biased(500)))",
                "robots[0].faults[0].what: must be from -180 to 180 degrees, got 500",
            ),
            ("(at_s: 1, what: Fixes(Lie(up_m: 3)))", "robots[0].faults[0].what: there is no field `up_m`"),
        ] {
            let said = refused(fault);
            let line = said.split(": ").next().expect("a place");
            assert!(line.starts_with("channel:31:"), "{said}");
            assert_eq!(said.split_once(": ").expect("a place").1, want);
        }
    }
}
