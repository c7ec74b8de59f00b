//! Slides that are driven, stopped, blocked and pushed.

use super::testing::{body, level};
use super::{AxisDrive, AxisSpec, GantryBodySpec, GantryId, JointState, Physics, Shape, Solid};
use crate::frames::{Pose, Truth};
use crate::seeds::Stream;
use crate::units::Heading;
use nalgebra::Vector3;
use rapier3d::geometry::SharedShape;

const STEP_S: f64 = 0.02;
const EFFORT_N: [f64; 2] = [200.0, 100.0];

fn box_at(x: f64, y: f64, z: f64, size: [f64; 3]) -> (Pose, Shape) {
    (level(x, y, z), Shape::Box { size_m: Vector3::from(size) })
}

/// A block whose near face is 1 m up the first axis.
fn block_the_way(physics: &mut Physics) {
    physics.add_fixed(&level(5.0, 2.2, 0.2), SharedShape::cuboid(1.0, 0.2, 0.1));
}

/// 2 m along the base's x, 1 m along its y; the base's x points north.
fn spec() -> GantryBodySpec {
    GantryBodySpec {
        id: "g".into(),
        base: Pose::level(Vector3::new(5.0, 1.0, 0.0), Heading::from_deg(0.0)),
        base_shapes: vec![box_at(1.0, 0.6, 0.5, [2.2, 0.05, 0.05])],
        axes: [
            AxisSpec {
                along_B: Vector3::x(),
                travel_m: [0.0, 2.0],
                mass_kg: 20.0,
                shapes: vec![box_at(0.0, 0.0, 0.5, [0.1, 1.25, 0.1])],
            },
            AxisSpec {
                along_B: Vector3::y(),
                travel_m: [-0.5, 0.5],
                mass_kg: 5.0,
                shapes: vec![box_at(0.0, 0.0, 0.3, [0.06, 0.13, 0.45])],
            },
        ],
        start_m: [0.5, 0.1],
    }
}

fn at_speed(v: [f64; 2]) -> [AxisDrive; 2] {
    [0, 1].map(|k| AxisDrive { speed_m_s: v[k], max_force_N: EFFORT_N[k], response_s: 0.005 })
}

fn new() -> (Physics, GantryId) {
    let mut physics = Physics::new(STEP_S);
    let id = physics.add_gantry(spec());
    (physics, id)
}

fn run(physics: &mut Physics, id: GantryId, steps: usize) -> [JointState; 2] {
    for _ in 0..steps {
        physics.step();
        for (joint, effort) in physics.joints(id).iter().zip(EFFORT_N) {
            assert!(joint.force_N.abs() <= effort * (1.0 + 1e-9), "{joint:?}");
        }
    }
    physics.joints(id)
}

#[test]
fn both_axes_move_at_once_as_they_are_told() {
    let (mut physics, id) = new();
    assert_eq!(physics.head(id).pose.p_WB.y, 1.5);
    physics.drive(id, at_speed([0.1, -0.05]));
    let [a, b] = run(&mut physics, id, 100);
    // 2 s, minus the loss by the response of 5 ms.
    assert!((a.position_m - 0.7).abs() < 0.001, "{a:?}");
    assert!((b.position_m - 0.0).abs() < 0.0005, "{b:?}");
    assert!((a.speed_m_s - 0.1).abs() < 1e-9 && (b.speed_m_s + 0.05).abs() < 1e-9);
    assert!(a.force_N.abs() < 1e-6, "nothing to push at constant speed");
    // The base's x points north, its y west.
    let head = physics.head(id);
    let want = Vector3::new(5.0 - b.position_m, 1.0 + a.position_m, 0.0);
    assert!((head.pose.p_WB - want).norm() < 1e-12);
    assert!((head.v_world() - Vector3::new(0.05, 0.1, 0.0)).norm() < 1e-9);
    assert!(!physics.gantry_contact(id).touching());
}

#[test]
fn a_weak_drive_takes_its_time() {
    let (mut physics, id) = new();
    let mut drives = at_speed([0.1, 0.0]);
    drives[0].max_force_N = 5.0;
    physics.drive(id, drives);
    let [a, _] = run(&mut physics, id, 10);
    // 5 N on 25 kg for 0.2 s.
    assert!((a.speed_m_s - 0.04).abs() < 1e-9, "{a:?}");
    assert!((a.force_N - 5.0).abs() < 1e-6, "{a:?}");
}

#[test]
fn limits_are_never_passed_whatever_is_asked() {
    let (mut physics, id) = new();
    let mut random = Stream::new(3, "gantry", "speeds");
    let mut at_ends = 0;
    for _ in 0..300 {
        let v = [0, 1].map(|_| 4.0 * random.uniform() - 2.0);
        physics.drive(id, at_speed(v));
        for _ in 0..20 {
            run(&mut physics, id, 1);
            let [a, b] = physics.joints(id).map(|j| j.position_m);
            assert!((0.0..=2.0).contains(&a) && (-0.5..=0.5).contains(&b), "{a} {b}");
            let truth = physics.head(id).pose.p_WB;
            assert!((truth.y - 1.0 - a).abs() < 1e-12);
            at_ends += usize::from(a == 0.0 || a == 2.0);
        }
    }
    assert!(at_ends > 100, "{at_ends}: the ends were hardly met");
}

#[test]
fn a_wall_in_the_way_is_met_named_and_left_again() {
    let (mut physics, id) = new();
    // The head's face is 0.03 m ahead of its middle.
    block_the_way(&mut physics);
    physics.drive(id, at_speed([0.15, 0.0]));
    let mut deepest: f64 = 0.0;
    let mut touched = false;
    for _ in 0..400 {
        let [a, b] = run(&mut physics, id, 1);
        let contact = physics.gantry_contact(id);
        deepest = deepest.max(a.position_m - 0.97);
        assert!(b.position_m.is_finite());
        if contact.touching() {
            touched = true;
            assert_eq!(contact.with, Some(Solid::Fixed(0)));
            assert_eq!(physics.name(Solid::Fixed(0)), "a fixed shape");
            let y = contact.at_W.expect("a place").y;
            assert!((y - 2.0).abs() < 0.01, "touched at y = {y}");
        }
    }
    let [a, _] = physics.joints(id);
    assert!(touched && a.speed_m_s.abs() < 1e-3, "{a:?}");
    assert!((a.force_N - EFFORT_N[0]).abs() < 1.0, "{a:?}");
    assert!(deepest < 1e-4, "{deepest} m deep");
    physics.drive(id, at_speed([-0.1, 0.0]));
    let [a, _] = run(&mut physics, id, 50);
    assert!((a.position_m - 0.87).abs() < 0.005, "{a:?}");
    assert!(!physics.gantry_contact(id).touching());
}

#[test]
fn two_runs_are_the_same_to_the_last_bit() {
    let trace = || {
        let (mut physics, id) = new();
        block_the_way(&mut physics);
        physics.drive(id, at_speed([0.15, 0.03]));
        (0..300)
            .flat_map(|_| run(&mut physics, id, 1))
            .flat_map(|j| [j.position_m, j.speed_m_s, j.force_N].map(f64::to_bits))
            .collect::<Vec<_>>()
    };
    assert_eq!(trace(), trace());
}

#[test]
#[should_panic(expected = "gantry g: axis 1 cannot be driven by")]
fn a_speed_that_is_not_finite_is_named() {
    let (mut physics, id) = new();
    physics.drive(id, at_speed([0.0, f64::NAN]));
}

#[test]
fn a_body_that_runs_into_the_head_is_named_and_stopped() {
    let (mut physics, id) = new();
    let mut truth = Truth::at_rest(level(3.5, 1.5, 0.3));
    truth.v_WB_B.x = 0.4;
    let sphere = Shape::Sphere { radius_m: 0.1 };
    let ball = physics.add_body(body("ball", truth, sphere, [3.0, 3.0, 3.0, 0.01, 0.01, 0.01]));
    physics.drive(id, at_speed([0.0, 0.0]));
    let mut named = false;
    for i in 0..300 {
        run(&mut physics, id, 1);
        let contact = physics.gantry_contact(id);
        if contact.touching() {
            assert_eq!(contact.with, Some(Solid::Body(ball)));
            assert_eq!(physics.name(Solid::Body(ball)), "ball");
            named = true;
        } else if !named {
            // Until then it flies as if there were no gantry.
            let x = 3.5 + 0.4 * STEP_S * f64::from(i + 1);
            assert!((physics.truth(ball).pose.p_WB.x - x).abs() < 1e-12);
        }
    }
    assert!(named);
    let [_, b] = physics.joints(id);
    assert!((-0.5..=0.5).contains(&b.position_m), "{b:?}");
    assert!(physics.truth(ball).v_world().x < 0.05);
}
