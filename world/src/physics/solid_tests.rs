//! Bodies alone, against walls, against each other.

use super::testing::{body, level};
use super::{BodySpec, Physics, Shape, Solver};
use crate::frames::Truth;
use nalgebra::{UnitQuaternion, Vector3};
use rapier3d::geometry::SharedShape;

const STEP_S: f64 = 0.02;

fn ball(id: &str, x: f64, v: f64) -> BodySpec {
    let mut truth = Truth::at_rest(level(x, 0.0, -5.0));
    truth.v_WB_B.x = v;
    body(id, truth, Shape::Sphere { radius_m: 0.2 }, [10.0, 10.0, 10.0, 0.2, 0.2, 0.2])
}

/// A cube of 2 m with its near face at x = 3 m.
fn wall(physics: &mut Physics) {
    physics.add_fixed(&level(4.0, 0.0, -5.0), SharedShape::cuboid(1.0, 1.0, 1.0));
}

#[test]
fn a_body_in_open_water_is_where_it_is_told_to_be() {
    let mut physics = Physics::new(STEP_S).with_solver(Solver::Always);
    let id = physics.add_body(ball("a", 0.0, 1.0));
    let mut free = physics.truth(id);
    free.v_WB_B += Vector3::new(0.1, -0.2, 0.3);
    free.w_WB_B = Vector3::new(0.02, 0.0, -0.03);
    physics.push(id, free);
    physics.step();
    assert_eq!(physics.truth(id), free);
}

#[test]
fn a_body_nobody_pushes_glides_about_its_centre_of_mass() {
    let mut physics = Physics::new(STEP_S);
    let mut spec = ball("a", 0.0, 1.0);
    spec.p_BG = Vector3::new(0.0, 0.0, -0.1);
    spec.truth.w_WB_B = Vector3::new(0.0, 1.0, 0.0);
    let centre = |t: &Truth| t.pose.point(spec.p_BG);
    let start = centre(&spec.truth);
    let id = physics.add_body(spec.clone());
    for _ in 0..100 {
        physics.step();
    }
    let t = physics.truth(id);
    // The origin moves at 1 m/s; the centre is 0.1 m below it and turns about it at 1 rad/s.
    let moved = centre(&t) - start;
    assert!((moved - Vector3::new(0.9 * 2.0, 0.0, 0.0)).norm() < 1e-9, "{moved}");
    let turned = t.pose.R_WB.angle_to(&UnitQuaternion::identity());
    assert!((turned - 2.0).abs() < 1e-9, "{turned}");
}

#[test]
fn a_wall_stops_a_ball() {
    let mut physics = Physics::new(STEP_S);
    wall(&mut physics);
    let id = physics.add_body(ball("a", 0.0, 2.0));
    let mut touched = false;
    for _ in 0..200 {
        physics.step();
        let (t, contact) = (physics.truth(id), physics.contacts(id));
        assert!(t.pose.p_WB.x < 2.8 + 0.005, "{} m", t.pose.p_WB.x);
        assert!(t.v_WB_B.norm() <= 2.0 + 1e-9);
        assert!(!contact.only_bodies, "a wall is no body");
        if contact.touching && !touched {
            touched = true;
            // Its momentum, except for what rapier leaves to the next steps.
            assert!(contact.impulse_N_s.x < -1.0, "{}", contact.impulse_N_s);
        }
    }
    assert!(touched && physics.truth(id).v_WB_B.x < 0.05);
}

#[test]
fn two_balls_share_their_momentum() {
    let mut physics = Physics::new(STEP_S);
    let a = physics.add_body(ball("a", 0.0, 1.0));
    let b = physics.add_body(ball("b", 1.0, 0.0));
    for _ in 0..100 {
        physics.step();
    }
    let (va, vb) = (physics.truth(a).v_world().x, physics.truth(b).v_world().x);
    assert!((va + vb - 1.0).abs() < 1e-6, "{va} + {vb}");
    assert!(vb > 0.4, "{vb}");
}

#[test]
fn rays_find_the_nearest_solid() {
    let mut physics = Physics::new(STEP_S);
    wall(&mut physics);
    let from = Vector3::new(0.0, 0.0, -5.0);
    let d = physics.ray(&from, &(Vector3::x() * 7.0), 50.0);
    assert!((d.expect("a wall") - 3.0).abs() < 1e-9);
    assert_eq!(physics.ray(&from, &Vector3::x(), 2.0), None);
    assert_eq!(physics.ray(&from, &-Vector3::x(), 50.0), None);
}

#[test]
#[should_panic(expected = "body a: state is no longer finite")]
fn a_state_that_is_not_finite_is_named() {
    let mut physics = Physics::new(STEP_S);
    let id = physics.add_body(ball("a", 0.0, 1.0));
    let mut free = physics.truth(id);
    free.v_WB_B.y = f64::NAN;
    physics.push(id, free);
    physics.step();
}

#[test]
fn bodies_that_touch_nothing_but_each_other_say_so() {
    let mut physics = Physics::new(STEP_S);
    wall(&mut physics);
    let ids = [ball("a", 0.0, 1.0), ball("b", 0.9, -1.0)].map(|spec| physics.add_body(spec));
    let mut met = false;
    for _ in 0..50 {
        physics.step();
        let [a, b] = ids.map(|id| physics.contacts(id));
        met |= a.touching && b.touching;
        assert_eq!([a.only_bodies, b.only_bodies], [a.touching, b.touching]);
    }
    assert!(met);
}
