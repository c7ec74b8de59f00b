//! Nothing is passed, at any legal step and speed, however thin it is.

use super::kit::{HALF_M, RADIUS_M, SEA, STEPS_S, Water, ends, front_m, moving, plate, solid};
use nalgebra::{Vector2, Vector3};
use std::path::Path;
use world::area::Area;
use world::obstacles::{CylinderShape, MeshShape, Obstacle, ShapeSpec};
use world::ranges::Positive;
use world::units::Heading;

/// The same as a mesh: surfaces without inside for the geometry.
fn meshed(thick_m: f64) -> Obstacle {
    let dir = std::env::temp_dir().join(format!("rheotaxis-plate-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("a directory");
    let mut text = String::new();
    for corner in 0..8 {
        let side = |bit: u32, half: f64| if corner >> bit & 1 == 0 { -half } else { half };
        text += &format!("v {} {} {}\n", side(0, thick_m / 2.0), side(1, 15.0), side(2, 19.5));
    }
    for [a, b, c, d] in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
        text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
    }
    std::fs::write(dir.join("plate.obj"), text).expect("a file");
    let shape = ShapeSpec::Mesh(MeshShape { file: "plate.obj".into(), scale: Positive::new(1.0) });
    let built = solid(shape, &dir);
    std::fs::remove_dir_all(&dir).expect("cleaned up");
    built
}

fn post(radius_m: f64) -> Obstacle {
    let shape = CylinderShape { radius_m: Positive::new(radius_m), height_m: Positive::new(39.0) };
    solid(ShapeSpec::Cylinder(shape), Path::new("."))
}

#[test]
fn no_step_speed_or_thickness_lets_a_hull_through() {
    let walls = [(plate(0.001), 0.001), (plate(0.01), 0.01), (meshed(0.01), 0.01), (meshed(0.3), 0.3)];
    for (wall, thick_m) in &walls {
        for step_s in STEPS_S {
            for speed in [0.3, 1.5, 2.0, 2.5, 15.0] {
                // Each of three headings from three places within a step.
                for n in 0..9 {
                    let (heading_deg, half_m) = [(0.0, RADIUS_M), (90.0, 0.8), (50.0, HALF_M)][n % 3];
                    let away = speed * step_s * n as f64 / 9.0;
                    let start = moving(-thick_m / 2.0 - 0.02 - half_m - away, heading_deg, Vector3::x() * speed);
                    let mut water = Water::new(step_s, Some(wall), &[start]);
                    let (mut touched, mut front) = (false, f64::NEG_INFINITY);
                    for _ in 0..(0.5 / speed / step_s).ceil() as u64 + 3 {
                        touched |= water.glide();
                        front = front.max(front_m(&water.truth()));
                    }
                    assert!(
                        touched && front < -thick_m / 2.0 + 1e-3,
                        "{speed} m/s, step {step_s} s, {thick_m} m thick, heading {heading_deg}, start {n}: \
                         touched {touched}, came to x = {front} m"
                    );
                }
            }
        }
    }
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

#[test]
fn a_fast_dive_does_not_pass_the_bed() {
    let area = Area { centre: Vector2::zeros(), length_m: 200.0, width_m: 200.0, axis: Heading::from_deg(0.0) };
    for step_s in STEPS_S {
        for n in 0..6 {
            let mut start = moving(0.3, 30.0, Vector3::new(1.0, 0.5, -6.0));
            start.pose.p_WB.z = -38.0 - 0.1 * f64::from(n);
            let mut water = Water::new(step_s, None, &[start]);
            water.physics.add_terrain(&SEA, &area);
            let mut touched = false;
            for _ in 0..(0.6 / step_s) as u64 {
                touched |= water.glide();
                let low = ends(&water.truth()).map(|p| p.z - RADIUS_M);
                let low = low[0].min(low[1]);
                assert!(low > -40.0 - 1e-3, "{step_s} s, start {n}: {low} m");
            }
            assert!(touched, "{step_s} s, start {n}");
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
