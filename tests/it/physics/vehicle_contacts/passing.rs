//! Nothing is passed, at any legal step and speed, however thin it is.

use super::kit::{RADIUS_M, STEPS_S, Water, ends, front_m, moving, plate, solid};
use nalgebra::Vector3;
use std::path::Path;
use world::obstacles::{CylinderShape, Obstacle, ShapeSpec};
use world::ranges::Positive;

fn post(radius_m: f64) -> Obstacle {
    let shape = CylinderShape { radius_m: Positive::new(radius_m), height_m: Positive::new(39.0) };
    solid(ShapeSpec::Cylinder(shape), Path::new("."))
}

#[test]
fn a_tip_that_sweeps_round_is_held_up() {
    for step_s in STEPS_S {
        for rate in [1.0, 5.0, 20.0] {
            // Half a metre beside the plate, turning towards it about its middle.
            let mut start = moving(-0.5, 0.0, Vector3::zeros());
            start.w_WB_B.z = -rate;
            let mut water = Water::new(step_s, Some(&plate(0.01)), &[start]);
            let mut touched = false;
            for _ in 0..(2.0 / rate / step_s).ceil() as u64 + 5 {
                touched |= water.glide();
                let front = front_m(&water.truth());
                assert!(front < -0.005 + 1e-3, "{rate} rad/s, {step_s} s: {front} m");
            }
            assert!(touched, "{rate} rad/s, {step_s} s");
        }
    }
}

/// Under its own power at 2 m/s against a post of 2 cm, on either side of it: it may be gone round, not through.
#[test]
fn a_post_is_not_run_through_under_power() {
    for step_s in [0.02, 0.1] {
        for n in 0..8 {
            let mut start = moving(-3.0 - 0.037 * f64::from(n), 90.0, Vector3::x() * 2.0);
            start.pose.p_WB.y = 0.025 * f64::from(n - 4);
            let mut water = Water::new(step_s, Some(&post(0.01)), &[start]);
            water.command.rpm = 1200.0;
            let mut touched = false;
            for _ in 0..(5.0 / step_s) as u64 {
                touched |= water.step();
                // Distance of the post's axis from the hull's.
                let [a, b] = ends(&water.truth()).map(|p| p.xy());
                let share = -a.dot(&(b - a)) / (b - a).norm_squared();
                let gap = (a + (b - a) * share.clamp(0.0, 1.0)).norm() - RADIUS_M - 0.01;
                assert!(gap > -1e-3, "{step_s} s, start {n}: {gap} m");
            }
            assert!(touched, "{step_s} s, start {n}");
        }
    }
}

/// Equal and opposite impulses; nobody is passed.
#[test]
fn two_hulls_do_not_pass_each_other() {
    for step_s in STEPS_S {
        for speed in [1.0, 4.0, 15.0] {
            for n in 0..5 {
                let gap = 0.4 + 2.0 * speed * step_s * f64::from(n) / 5.0;
                let starts = [(-1.0, 20.0), (1.0, 200.0)].map(|(side, heading)| {
                    let v = Vector3::x() * (-side * speed);
                    let mut t = moving(side * (gap / 2.0 + 0.25), heading, v);
                    t.pose.p_WB.y = 0.05 * side;
                    t
                });
                let mut water = Water::new(step_s, None, &starts);
                let ids = [water.hulls[0].1, water.hulls[1].1];
                let mut sums = [Vector3::zeros(); 2];
                for _ in 0..(1.0 / speed / step_s) as u64 + 2 {
                    water.glide();
                    for (sum, id) in sums.iter_mut().zip(ids) {
                        *sum += water.physics.contacts(id).impulse_N_s;
                    }
                    let [a, b] = ids.map(|i| water.physics.truth(i).pose.p_WB);
                    assert!(b.x > a.x, "{speed} m/s, {step_s} s, start {n}: {a} passed {b}");
                }
                let away = (sums[0] + sums[1]).norm();
                assert!(sums[0].norm() > 10.0 * speed && away < 1e-9 * sums[0].norm(), "{sums:?}");
            }
        }
    }
}

/// Pressed on by its propeller it stays where it is, whatever the step.
#[test]
fn a_hull_that_pushes_on_stays() {
    for step_s in [0.02, 0.1] {
        let start = moving(-0.805, 90.0, Vector3::zeros());
        let mut water = Water::new(step_s, Some(&plate(0.01)), &[start]);
        water.command.rpm = 1200.0;
        for _ in 0..(30.0 / step_s) as u64 {
            water.step();
            let front = front_m(&water.truth());
            assert!(front < -0.005 + 1e-3, "{step_s} s: {front} m");
        }
        let v = water.truth().v_WB_B;
        assert!(v.norm() < 0.02, "{step_s} s: {v}");
        // (1 − t) K_T0 ρ D⁴ n².
        let thrust = 0.9 * 0.4566 * 1026.0 * 0.14f64.powi(4) * 400.0;
        let force = water.impulse().norm() / step_s;
        // In the step that it would make if it were free, the propeller's inflow takes 20 N per m/s from it.
        assert!((force / thrust - 1.0).abs() < 0.4 * step_s, "{step_s} s: {force} N, not {thrust} N");
    }
}

/// Along a wall: friction takes 0.4 of the momentum in sway from that in surge, and that is all.
#[test]
fn a_hull_that_slides_along_stays_outside() {
    for step_s in [0.02, 0.1] {
        let mut start = moving(-0.105, 0.0, Vector3::new(0.1, 1.5, 0.0));
        start.pose.p_WB.y = -5.0;
        let mut water = Water::new(step_s, Some(&plate(0.01)), &[start]);
        for _ in 0..(3.0 / step_s) as u64 {
            water.glide();
            assert!(front_m(&water.truth()) < -0.005 + 1e-3);
        }
        let v = water.truth().v_world();
        let lost = 0.4 * 0.1 * 60.467 / 31.868;
        assert!(v.x < 0.01 && (v.y - (1.5 - lost)).abs() < 0.02, "{v}");
    }
}
