//! The REMUS under physics against the published model's trajectories, and single effects.
//!
//! Reference data: `tests/reference/remus100/README.md`.

use super::kit::{STEP_S, command, remus, water};
use super::rapier_alone::RapierAlone;
use crate::common::root;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use robots::handoff::{Actuation, ActuatorCommand};
use robots::vehicles::{ParameterSet, Vehicle};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::physics::{BodyId, Physics, Solver};
use world::units::Heading;

/// Deep enough that the surface is out of reach, heading north, as the reference's origin.
fn start() -> Truth {
    Truth::at_rest(Pose::level(Vector3::new(0.0, 0.0, -100.0), Heading::from_deg(0.0)))
}

/// What moves a hull.
#[derive(Clone, Copy, Debug)]
enum Mover {
    /// The physics of missions.
    Ours(Solver),
    /// rapier's rigid body.
    Rapier,
}

/// A vehicle alone in the water.
struct Alone {
    moved: Moved,
    vehicle: Vehicle,
    water: WaterSample,
    step_s: f64,
    steps: u64,
}

enum Moved {
    Ours(Physics, BodyId),
    Rapier(Box<RapierAlone>),
}

impl Alone {
    fn new(parameters: ParameterSet, mover: Mover, start: Truth, water: WaterSample) -> Self {
        Self::in_steps_of(STEP_S, parameters, mover, start, water)
    }

    fn in_steps_of(step_s: f64, parameters: ParameterSet, mover: Mover, start: Truth, water: WaterSample) -> Self {
        let vehicle = remus(parameters);
        let body = vehicle.body_spec("auv", start);
        let moved = match mover {
            Mover::Ours(solver) => {
                let mut physics = Physics::new(step_s).with_solver(solver);
                let id = physics.add_body(body);
                Moved::Ours(physics, id)
            }
            Mover::Rapier => Moved::Rapier(Box::new(RapierAlone::new(&body, step_s))),
        };
        Self { moved, vehicle, water, step_s, steps: 0 }
    }

    fn t_s(&self) -> f64 {
        self.steps as f64 * self.step_s
    }

    fn truth(&self) -> Truth {
        match &self.moved {
            Moved::Ours(physics, id) => physics.truth(*id),
            Moved::Rapier(hull) => hull.truth,
        }
    }

    fn step(&mut self, command: &ActuatorCommand) {
        let truth = self.truth();
        let free = self.vehicle.step_in(&truth, &self.water, &Actuation::Fins(*command), self.step_s);
        match &mut self.moved {
            Moved::Ours(physics, id) => {
                physics.push(*id, free);
                physics.step();
            }
            Moved::Rapier(hull) => hull.step(&free),
        }
        self.steps += 1;
    }
}

/// Worst (position, m; attitude, deg) along a reference file.
fn against(file: &str, mover: Mover, water: WaterSample, at: fn(f64) -> ActuatorCommand) -> (f64, f64) {
    let path = root().join("tests/reference/remus100").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|l| l.split(',').map(|s| s.parse().expect("number")).collect()).collect();
    // NED and FRD Euler angles to ENU and FLU.
    let pose = |n: &[f64]| Pose {
        p_WB: start().pose.p_WB + Vector3::new(n[2], n[1], -n[3]),
        R_WB: UnitQuaternion::from_euler_angles(n[4], -n[5], Heading::from_rad(n[6]).yaw()),
    };
    let begin = Truth::at_rest(pose(&rows[0]));
    let mut auv = Alone::new(ParameterSet::Reference, mover, begin, water);
    let (mut worst_m, mut worst_deg): (f64, f64) = (0.0, 0.0);
    for row in &rows {
        while auv.t_s() < row[0] - STEP_S / 2.0 {
            auv.step(&at(auv.t_s()));
        }
        let (ours, theirs) = (auv.truth().pose, pose(row));
        worst_m = worst_m.max((ours.p_WB - theirs.p_WB).norm());
        worst_deg = worst_deg.max(ours.R_WB.angle_to(&theirs.R_WB).to_degrees());
    }
    (worst_m, worst_deg)
}

/// Every way of stepping: contacts looked for or not, and rapier's integration alone.
fn holds(file: &str, water: WaterSample, at: fn(f64) -> ActuatorCommand) {
    for mover in [Mover::Ours(Solver::WhenInReach), Mover::Ours(Solver::Always), Mover::Rapier] {
        let (m, deg) = against(file, mover, water, at);
        assert!(m < 0.02 && deg < 0.05, "{file} {mover:?}: {m} m, {deg} deg");
    }
}

#[test]
fn surge() {
    holds("a_surge_1000rpm.csv", water(Vector3::zeros()), |_| command(0.0, 0.0, 1000.0));
}

fn turn_from_30_s(t_s: f64) -> ActuatorCommand {
    let rudder = if t_s >= 30.0 - STEP_S / 2.0 { 10.0 } else { 0.0 };
    command(rudder, 0.0, 1525.0)
}

#[test]
fn turn() {
    holds("b_turn_10deg.csv", water(Vector3::zeros()), turn_from_30_s);
}

#[test]
fn depth_change() {
    holds("c_depth_change_doublet3deg.csv", water(Vector3::zeros()), |t_s| {
        let t = t_s + STEP_S / 2.0;
        let stern = match t {
            30.0..50.0 => 3.0,
            50.0..70.0 => -3.0,
            _ => 0.0,
        };
        command(0.0, stern, 1525.0)
    });
}

#[test]
fn turn_in_a_current() {
    // Towards 90 degrees is towards the east.
    let current = water(Vector3::new(0.3, 0.0, 0.0));
    holds("d_turn10_Vc0.3_b90_VaRelative.csv", current, turn_from_30_s);
}

#[test]
fn roll_release() {
    let still = water(Vector3::zeros());
    let free = |_| command(0.0, 0.0, 0.0);
    let file = "f_roll_release_30deg.csv";
    for solver in [Solver::WhenInReach, Solver::Always] {
        let (m, deg) = against(file, Mover::Ours(solver), still, free);
        assert!(m < 0.02 && deg < 0.05, "{solver:?}: {m} m, {deg} deg");
    }
    // rapier's four sub-steps of first order are off by h Δω / 8, with 2.2 rad/s of roll rate.
    let of_rapier = (STEP_S * 2.2 / 8.0).to_degrees();
    let (m, deg) = against(file, Mover::Rapier, still, free);
    assert!(m < 0.02 && deg < of_rapier, "{m} m, {deg} deg");
}

/// What `duck_st` says of its steps: after four minutes of turns to both sides, in water that shears, a hull in steps
/// of
/// 0.05 s is less than a millimetre from one in steps of 1 ms.
#[test]
fn steps_of_a_twentieth_of_a_second_are_exact_enough_for_a_mission() {
    let around = water(Vector3::new(0.05, -0.11, 0.0));
    let gradient = Matrix3::new(0.0, 0.001, 0.02, -0.001, 0.0, -0.05, 0.0, 0.0, 0.0);
    let flown = |step_s: f64| {
        let (set, mover) = (ParameterSet::Remus100, Mover::Ours(Solver::default()));
        let mut auv = Alone::in_steps_of(step_s, set, mover, start(), around);
        auv.water.gradient = gradient;
        // Every ten seconds to the other side: far more often than any search turns.
        while auv.t_s() < 240.0 - 0.5 * step_s {
            let side = if ((auv.t_s() / 10.0 + 1e-9) as u64).is_multiple_of(2) { 1.0 } else { -1.0 };
            let moved = auv.truth().pose.p_WB - start().pose.p_WB;
            auv.water.velocity = around.velocity + gradient * moved;
            auv.step(&command(15.0 * side, 1.0 * side, 1500.0));
        }
        auv.truth().pose
    };
    let exact = flown(0.001);
    let away = [0.01, 0.02, 0.05].map(|step_s| (flown(step_s).p_WB - exact.p_WB).norm());
    assert!((exact.p_WB - start().pose.p_WB).norm() > 50.0, "it moves");
    // Measured: 0.3 and 6 micrometres and 0.18 mm, a step of fourth order.
    assert!(away[0] < away[1] && 10.0 * away[1] < away[2], "{away:?}");
    assert!(away[2] < 1e-3, "{away:?}");
}
