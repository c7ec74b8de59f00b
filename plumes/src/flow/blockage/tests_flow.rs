//! Blocked water compared with potential theory, and over time.

use super::tests::{area, block, eastward, pile, solids, spec};
use crate::flow::Water;
use crate::flow::tests::kit::meander;
use nalgebra::{Vector2, Vector3};
use world::fields::Flow;
use world::terrain::Terrain;

/// Potential flow past a cylinder of radius a: U − U a²/r² (cos 2θ, sin 2θ) (Milne-Thomson 1968, Theoretical
/// Hydrodynamics, section 6.22).
fn potential(p: Vector2<f64>, a: f64, speed: f64) -> Vector2<f64> {
    let r2 = p.norm_squared();
    let (c, s) = ((p.x * p.x - p.y * p.y) / r2, 2.0 * p.x * p.y / r2);
    Vector2::new(speed - speed * a * a / r2 * c, -speed * a * a / r2 * s)
}

/// Root mean square error between 1.3 and 4 radii as a part of U, and the current at the shoulders as a part of the
/// theory's.
fn past_a_cylinder(cell_m: f64) -> (f64, f64) {
    let (a, speed) = (2.0, 0.5);
    let bed = Terrain::Level { depth_m: 3.0 };
    let solids = solids(&[(pile(a, 5.0), 4.0, -7.0, 0.0)], &bed);
    // 20 radii wide: the fixed potential at the sides adds U/400 or less.
    let water = eastward(speed, spec(cell_m, 2, 0.0)).build_round(&area(80.0, 80.0, 90.0), &bed, &solids, 1).unwrap();
    let at = |p: Vector2<f64>| water.velocity(&(p + Vector2::new(4.0, -7.0)).push(-1.5), 0.0).xy();
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..160 {
        for j in 0..160 {
            let p = Vector2::new(f64::from(i) - 79.5, f64::from(j) - 79.5) * (a / 20.0);
            if (1.3 * a..4.0 * a).contains(&p.norm()) {
                sum += (at(p) - potential(p, a, speed)).norm_squared();
                count += 1.0;
            }
        }
    }
    // 20 degrees to both sides of the shoulders, 0.15 radii from the wall.
    let mut shoulders = (0.0, 0.0);
    for side in [90.0_f64, 270.0] {
        for k in -20..=20 {
            let (sin, cos) = world::math::sin_cos((side + f64::from(k)).to_radians());
            let (p, round) = (Vector2::new(cos, sin) * (1.15 * a), Vector2::new(sin, -cos) * sin.signum());
            shoulders.0 += at(p).dot(&round);
            shoulders.1 += potential(p, a, speed).dot(&round);
        }
    }
    (f64::sqrt(sum / count) / speed, shoulders.0 / shoulders.1)
}

/// Staircase and steps between cells are first order: the error halves with the cell size, and the current at the
/// shoulders (2U on the wall, 1.76 U at 1.15 radii) approaches the theory's. Steps between cells alone, with a gradient
/// of up to 2U/a at 1.3 radii, are up to h/2 · 2U/a = 0.25 U there for four cells per radius, about 0.04 U in the mean
/// over the ring.
#[test]
fn a_cylinder_bends_the_current_as_potential_theory_says() {
    let (coarse, off_coarse) = past_a_cylinder(0.5);
    let (fine, off_fine) = past_a_cylinder(0.25);
    assert!(coarse < 0.06 && fine < 0.65 * coarse, "{coarse} {fine}");
    assert!((off_coarse - 1.0).abs() < 0.10 && (off_fine - 1.0).abs() < 0.05, "{off_coarse} {off_fine}");
}

fn meandering() -> Water {
    let bed = Terrain::Level { depth_m: 5.0 };
    let solids = solids(&[(block([10.0, 6.0, 3.0]), 4.0, -7.0, 60.0)], &bed);
    let mut water = eastward(0.2, spec(2.0, 6, 10.0));
    water.currents.push(meander(0.05, 0.02, 10.0));
    water.build_round(&area(60.0, 40.0, 90.0), &bed, &solids, 9).unwrap()
}

/// The bits are the same however the time to a moment is divided, and there is no jump where one field follows another.
#[test]
fn time_may_be_cut_as_one_likes() {
    let (mut whole, mut cut) = (meandering(), meandering());
    whole.advance(250.0);
    for n in 0..=500 {
        cut.advance(f64::from(n) * 0.5);
    }
    let p = Vector3::new(-6.0, -4.0, -3.3);
    for t in [249.99, 250.0, 250.7] {
        assert_eq!(whole.velocity(&p, t), cut.velocity(&p, t));
        assert_eq!(whole.sample(&p, t).rate, cut.sample(&p, t).rate);
    }
    let mut water = meandering();
    let (mut last, mut went) = (water.velocity(&p, 0.0), 0.0);
    for n in 1..=1000 {
        let t = f64::from(n) * 0.1;
        // The answer before the advance is the same as after it.
        let early = water.velocity(&p, t);
        water.advance(t);
        let now = water.velocity(&p, t);
        assert_eq!(early, now);
        assert!((now - last).norm() < 1e-3, "{t}: {}", now - last);
        went += (now - last).norm();
        last = now;
    }
    assert!(went > 0.01, "it changes: {went}");
    assert_eq!(water.sample(&p, 100.0).velocity, last);
}

/// At multiples of the period, the solution is that of the currents at that moment; far up-stream it is the free
/// current.
#[test]
fn follows_the_currents_of_the_moment() {
    let mut water = meandering();
    water.advance(200.0);
    let blocked = water.blocked().unwrap();
    assert!(blocked.solved().steps < 40 && blocked.solved().divergence <= 1e-7);
    let far = Vector3::new(-24.0, 8.0, -1.0);
    let unblocked = Water::column(&water, far.xy(), 200.0).velocity(far.z);
    let got = water.velocity(&far, 200.0);
    // The current without its meander.
    let wander = (unblocked - Vector3::x() * 0.2).norm();
    // The dipole of the block has U·10·6/(π·30²) = 2 % of U there; steps between cells have as much again.
    assert!(wander > 0.02, "{wander}");
    assert!((got - unblocked).norm() < 0.015, "{got} {unblocked}");
}

/// A wall much thinner than a cell, between the centres of two rows of cells: the water flows round it.
#[test]
fn a_thin_wall_is_felt() {
    let bed = Terrain::Level { depth_m: 6.0 };
    let solids = solids(&[(block([0.1, 14.0, 6.0]), 4.2, -7.0, 90.0)], &bed);
    let area = area(40.0, 32.0, 90.0);
    assert!(spec(2.0, 4, 10.0).unfelt(&area, &bed, &solids, false).unwrap().is_empty());
    let water = eastward(0.3, spec(2.0, 4, 10.0)).build_round(&area, &bed, &solids, 1).unwrap();
    for north in [-6.0, -3.0, 0.0, 3.0, 5.0] {
        for east in [2.6, 3.9, 5.9] {
            let v = water.velocity(&Vector3::new(east, north - 7.0, -3.0), 0.0);
            assert!(v.x.abs() < 0.22, "{east} {north}: {v}");
        }
    }
    assert!(water.velocity(&Vector3::new(4.0, 2.0, -3.0), 0.0).x > 0.3);
}
