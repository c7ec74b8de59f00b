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
    use crate::testing::{CHANNEL, NOTHING, refused, told, told_once};

    #[test]
    fn legal_faults_are_not_spoken_of() {
        let faults = "[
            (at_s: 300, what: Fluorometer(Silent)), (at_s: 0, until_s: 5, what: Compass(Biased(5))),
            (at_s: 5, what: Compass(Stuck)), (at_s: 100.5, what: Depth(Drifting(0.001))),
            (at_s: 1, what: Rudder(StuckAt(-10))), (at_s: 1, what: Propeller(Weak(0.5))),
            (at_s: 1, what: Drive(link: \"stern_plane\", how: Dead)),
            (at_s: 60, what: Fixes(Lie(east_m: 20, north_m: -10, over_s: 60))),
        ]";
        assert_eq!(told(CHANNEL, &[("robots[0].faults", faults)]), NOTHING);
    }

    /// Other contradictions are those of `tests/golden/bad_input`.
    #[test]
    fn contradictions_are_told_with_their_fields() {
        let stuck = "[(at_s: 1800, what: Compass(Stuck))]";
        let late = told_once(CHANNEL, &[("robots[0].faults", stuck)]);
        assert!(late.starts_with("robots[0].faults[0].at_s: ") && late.ends_with("time.limit_s is 1800 s"), "{late}");
        let kinematic = ("robots[0].vehicle", "Kinematic(moves: ThroughWater)");
        let bare = told_once(CHANNEL, &[kinematic, ("robots[0].faults", "[(at_s: 3, what: Rudder(Stuck))]")]);
        assert!(bare.starts_with("robots[0].faults[0].what: a kinematic vehicle has no rudder"), "{bare}");
    }

    #[test]
    fn nonsense_is_refused_by_the_reader() {
        for (fault, says) in [
            ("Fluorometer(StuckAt(10))", "there is no choice `StuckAt`"),
            ("Fixes(Lie(up_m: 3))", "there is no field `up_m`"),
        ] {
            let said = refused("robots[0].faults", &format!("[(at_s: 1, what: {fault})]"));
            assert!(said.ends_with(&format!("robots[0].faults[0].what: {says}")), "{said}");
        }
    }
}
