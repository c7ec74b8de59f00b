//! Hits: the whole mass matrix, friction, energy.

use super::kit::{HALF_M, RADIUS_M, Water, moving, plate};
use crate::physics::kit::{flip, join, mass, nu};
use nalgebra::{Matrix3, Vector3, Vector6};
use robots::vehicles::Vehicle;
use world::frames::Truth;

/// Hits of hulls that the water slows down give no energy, whatever the step and the angle.
#[test]
fn no_hit_gives_energy() {
    for step_s in [0.005, 0.02, 0.1] {
        for (n, heading) in [0.0, 20.0, 45.0, 70.0, 90.0, 135.0, 250.0].into_iter().enumerate() {
            let start = moving(-1.2 - 0.01 * n as f64, heading, Vector3::new(1.8, 0.4, 0.1));
            let mut other = moving(-1.2, heading, Vector3::new(1.0, -0.6, 0.0));
            other.pose.p_WB.y = 1.7;
            let mut water = Water::new(step_s, Some(&plate(0.01)), &[start, other]);
            let (mut before, mut touches) = (water.energy(), 0);
            for _ in 0..(4.0 / step_s) as u64 {
                touches += u32::from(water.step());
                let now = water.energy();
                assert!(
                    now <= before * (1.0 + 1e-6) + 1e-6,
                    "{step_s} s, heading {heading}: {before} J became {now} J"
                );
                before = now;
            }
            assert!(touches > 0, "{step_s} s, heading {heading}");
        }
    }
}

/// A hull that hits a wall at 1 m/s, 2 ms before the end of a step: the water with it after that step, its start, and
/// the impulse. What it does afterwards, rolling along the wall, is none of the hit.
fn hit(step_s: f64, heading_deg: f64) -> (Water, Truth, Vector3<f64>) {
    let ahead = world::math::sin(heading_deg.to_radians()).abs() * HALF_M + RADIUS_M;
    let way = (0.5 / step_s).ceil() * step_s - 0.002;
    let start = moving(-0.2 - ahead - way, heading_deg, Vector3::x());
    let mut water = Water::new(step_s, Some(&plate(0.4)), &[start]);
    for _ in 0..(2.0 / step_s) as u64 {
        if water.glide() {
            let impulse = water.impulse();
            return (water, start, impulse);
        }
    }
    panic!("heading {heading_deg}, {step_s} s: touched nothing");
}

/// Velocity of the point at `arm` (FRD) by ν.
fn at(arm: &Vector3<f64>) -> nalgebra::Matrix3x6<f64> {
    let mut j = nalgebra::Matrix3x6::zeros();
    j.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
    j.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
    j
}

/// Impulse on the point at `arm` (FRD) that stops it.
fn stopping(vehicle: &Vehicle, nu: &Vector6<f64>, arm: &Vector3<f64>) -> Vector3<f64> {
    let j = at(arm);
    let inverse = mass(vehicle).try_inverse().expect("a mass");
    let give = (j * inverse * j.transpose()).try_inverse().expect("a point");
    -(give * (j * nu))
}

/// m_surge Δv head on, m_sway Δv broadside, but for the little that the low centre of gravity turns the hull.
#[test]
fn a_hit_takes_the_mass_that_the_hull_has_in_its_direction() {
    for step_s in [0.02, 0.1] {
        for (heading_deg, arm, kg) in [
            (90.0, Vector3::new(0.8, 0.0, 0.0), 31.868),
            // Both ends of the straight part together: as one point amidships.
            (0.0, Vector3::new(0.0, RADIUS_M, 0.0), 60.467),
        ] {
            let (water, start, impulse) = hit(step_s, heading_deg);
            let (vehicle, _) = &water.hulls[0];
            let expected = stopping(vehicle, &nu(&start), &arm);
            let got = flip(start.pose.R_WB.inverse() * impulse);
            assert!((got - expected).norm() < 3e-3 * expected.norm(), "{got} is not {expected}");
            assert!((impulse.x / -kg - 1.0).abs() < 0.05, "{impulse}, {kg} kg");
            let load = join(expected, arm.cross(&expected));
            let after = nu(&start) + mass(vehicle).try_inverse().expect("a mass") * load;
            let off = (nu(&water.truth()) - after).norm();
            assert!(off < 2e-3, "{off} off the velocities that this impulse gives");
        }
    }
}

/// One point with a lever arm: n · M⁻¹ n in six dimensions, friction at most at its bound, and ν + M⁻¹ Jᵀ λ after it.
#[test]
fn an_oblique_hit_turns_the_hull_by_its_lever_arm() {
    for heading_deg in [30.0, 60.0, 120.0, 250.0] {
        let (water, start, impulse) = hit(0.02, heading_deg);
        let (vehicle, _) = &water.hulls[0];
        let back = start.pose.R_WB.inverse();
        let ahead = if (back * Vector3::x()).x > 0.0 { HALF_M } else { -HALF_M };
        let n = flip(back * -Vector3::x());
        let arm = Vector3::new(ahead, 0.0, 0.0) - n * RADIUS_M;
        let load = flip(back * impulse);
        let inverse = mass(vehicle).try_inverse().expect("a mass");
        let after = nu(&start) + inverse * join(load, arm.cross(&load));
        // It turned a little while it was pushed.
        let off = (nu(&water.truth()) - after).norm();
        assert!(off < 0.02, "heading {heading_deg}: {off}");
        let left = at(&arm) * after;
        assert!(left.dot(&n).abs() < 0.02, "heading {heading_deg}: {left}");
        let across = impulse - Vector3::x() * impulse.x;
        assert!(across.norm() <= 0.4 * impulse.x.abs() * (1.0 + 1e-9), "{impulse}");
        assert!(water.truth().w_WB_B.z.abs() > 0.1, "it turns");
        // With a scalar mass of 50.9 kg it would be another impulse.
        let effective = 1.0 / (at(&arm).transpose() * n).dot(&(inverse * (at(&arm).transpose() * n)));
        assert!((10.0..60.0).contains(&effective), "{effective} kg");
    }
}
