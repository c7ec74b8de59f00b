//! Checks steps and periods of a scenario.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::Scenario;
use robots::vehicles::VehicleSpec;

/// Shortest step of the physics, s. A shorter one makes a run endless.
const SHORTEST_STEP_S: f64 = 0.001;
/// Longest step that can follow a vehicle with dynamics or a gantry, s.
const STEP_OF_DYNAMICS_S: f64 = 0.1;
/// Longest step of kinematic vehicles, s. They move exactly in a step of any length, but see and decide only between.
const STEP_OF_KINEMATICS_S: f64 = 1.0;

/// Finds steps that the vehicles cannot take, and periods shorter than a step.
pub(super) fn times(scenario: &Scenario, found: &mut Vec<UnplacedFault>) {
    let t = &scenario.time;
    let step = t.step_s.get();
    let robots = &scenario.robots;
    let dynamic = (robots.iter()).find(|r| !matches!(r.vehicle, VehicleSpec::Kinematic(_)));
    let dynamic = dynamic.map(|r| &r.id);
    let dynamic = dynamic.or(scenario.gantries.first().map(|g| &g.id));
    let longest = match dynamic {
        None if !robots.is_empty() => STEP_OF_KINEMATICS_S,
        _ => STEP_OF_DYNAMICS_S,
    };
    if !(SHORTEST_STEP_S..=longest).contains(&step) {
        let range = format!("must be from {SHORTEST_STEP_S} to {longest} s, got {step}");
        let fault = UnplacedFault::error("time.step_s", range);
        found.push(match dynamic {
            Some(id) if step > longest && step <= STEP_OF_KINEMATICS_S => fault.hint(format!(
                "steps of up to {STEP_OF_KINEMATICS_S} s need kinematic vehicles, and \"{}\" has dynamics",
                id.as_str()
            )),
            _ => fault,
        });
    }
    let r = &scenario.record;
    for (path, period) in [
        ("time.limit_s", t.limit_s),
        ("time.drift_period_s", t.drift_period_s),
        ("time.spin_up_period_s", t.spin_up_period_s),
        ("record.frame_period_s", r.frame_period_s),
        ("record.plume_period_s", r.plume_period_s),
    ] {
        if period < t.step_s {
            found.push(UnplacedFault::error(
                path,
                format!("must be at least time.step_s, {step}, got {}", period.get()),
            ));
        }
    }
    let flow_s = t.flow_period_s.get();
    if flow_s > 0.0 && flow_s < step {
        let problem = format!("must be 0 (at each step of the plume) or at least time.step_s, {step}, got {flow_s}");
        found.push(UnplacedFault::error("time.flow_period_s", problem));
    }
    let robots = scenario.robots.iter().map(|r| r.strategy.about().consulted);
    let gantries = scenario.gantries.iter().map(|g| g.tracker.consulted());
    let asked = (robots.enumerate().map(|(i, c)| (format!("robots[{i}].strategy"), c)))
        .chain(gantries.enumerate().map(|(i, c)| (format!("gantries[{i}].tracker"), c)));
    for (path, period_s) in asked.filter_map(|(path, c)| Some((path, c?.period_s))) {
        if period_s < step {
            let problem = format!("must be at least time.step_s, {step}, got {period_s}");
            found.push(UnplacedFault::error(format!("{path}.period_s"), problem));
        }
    }
}
