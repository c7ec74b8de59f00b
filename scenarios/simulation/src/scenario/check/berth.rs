//! Checks that hulls have room where they start: away from each other and clear of the bed.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::RobotSpec;
use world::terrain::Terrain;

/// Length of a REMUS hull, m.
const LENGTH_M: f64 = 1.6;
/// Its diameter, m. Hulls whose centres are nearer than this overlap.
const DIAMETER_M: f64 = 0.19;

/// Finds starts that overlap each other or touch the bed.
pub(super) fn berths(robots: &[RobotSpec], terrain: &Terrain, found: &mut Vec<UnplacedFault>) {
    for (i, robot) in robots.iter().enumerate() {
        let path = format!("robots[{i}].start");
        let id = robot.id.as_str();
        let p = robot.start.p_W(terrain);
        let clear = p.z - terrain.bed_z(p.x, p.y);
        if (0.0..DIAMETER_M / 2.0).contains(&clear) {
            let problem = format!("robot \"{id}\" starts {clear:.2} m above the bed: its hull may touch it");
            found.push(UnplacedFault::warning(&path, problem));
        }
        // Robots of the same name are reported elsewhere.
        let others = robots[..i].iter().enumerate().filter(|(_, o)| o.id != robot.id);
        for (k, other) in others {
            let apart = (other.start.p_W(terrain) - p).norm();
            let other = other.id.as_str();
            let problem = |so: &str| format!("robot \"{id}\" starts {apart:.2} m from robots[{k}], \"{other}\": {so}");
            if apart < DIAMETER_M {
                let problem = problem("their hulls overlap");
                found.push(UnplacedFault::error(&path, problem).hint("move one of them"));
            } else if apart < LENGTH_M {
                let problem = problem("their hulls may touch");
                found.push(UnplacedFault::warning(&path, problem));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scenario::check;
    use crate::scenario::fault::Severity::{self, Error, Warning};
    use crate::testing::{CHANNEL, changed};
    use std::path::Path;

    /// What is said of a second robot so far east of the first, both so far above the bed.
    fn told(apart_m: f64, altitude_m: f64) -> Vec<(Severity, String)> {
        let mut scenario = changed(CHANNEL, &[]).scenario;
        scenario.robots[0].start.altitude_m = Some(altitude_m.try_into().unwrap());
        let mut second = scenario.robots[0].clone();
        second.id = "auv1".to_string().try_into().unwrap();
        second.start.east_m = (second.start.east_m.get() - apart_m).try_into().unwrap();
        scenario.robots.push(second);
        let found = check(&scenario, Path::new(""));
        found.into_iter().map(|f| (f.severity, f.message)).collect()
    }

    #[test]
    fn hulls_have_room() {
        assert_eq!(told(5.0, 2.0), []);
        for (apart_m, altitude_m, severity, robots, says) in [
            (1.0, 2.0, Warning, ["auv1"].as_slice(), "1.00 m from robots[0], \"auv0\": their hulls may touch"),
            (0.1, 2.0, Error, &["auv1"], "0.10 m from robots[0], \"auv0\": their hulls overlap"),
            (5.0, 0.05, Warning, &["auv0", "auv1"], "0.05 m above the bed: its hull may touch it"),
        ] {
            let want = robots.iter().map(|id| (severity, format!("robot \"{id}\" starts {says}")));
            assert_eq!(told(apart_m, altitude_m), Vec::from_iter(want));
        }
    }
}
