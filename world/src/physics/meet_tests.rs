//! Bodies of every shape, thrown at random against solids of every shape.

use super::testing::{body, level};
use super::{BodySpec, Physics, Shape, Solver};
use crate::area::Area;
use crate::convert::pose;
use crate::frames::{Pose, Truth};
use crate::seeds::Stream;
use crate::terrain::Terrain;
use crate::units::Heading;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rapier3d::geometry::SharedShape;
use rapier3d::math::Vector;

const STEP_S: f64 = 0.1;
const MASS: [f64; 6] = [30.0, 60.0, 60.0, 0.5, 8.0, 8.0];
const BED: Terrain = Terrain::Level { depth_m: 20.0 };

fn area(axis_deg: f64) -> Area {
    Area { centre: Vector2::zeros(), length_m: 100.0, width_m: 100.0, axis: Heading::from_deg(axis_deg) }
}

/// Pieces of 0.2 to 1.6 m, one of them 2 mm thin.
fn shapes() -> Vec<Shape> {
    let corners = [[0.8, 0.0, 0.0], [-0.7, 0.1, 0.1], [-0.7, -0.15, 0.0], [0.0, 0.0, -0.1], [0.2, 0.1, 0.2]];
    vec![
        Shape::Sphere { radius_m: 0.2 },
        Shape::Capsule { radius_m: 0.095, length_m: 1.41 },
        Shape::Cylinder { radius_m: 0.1, length_m: 1.2 },
        Shape::Box { size_m: Vector3::new(1.0, 0.3, 0.2) },
        Shape::Box { size_m: Vector3::new(0.002, 0.4, 0.3) },
        Shape::Hull { points_m: corners.map(Vector3::from).to_vec() },
    ]
}

fn thrown(rng: &mut Stream, shape: Shape, at: Vector3<f64>, v_W: Vector3<f64>) -> BodySpec {
    let turned = Vector3::from_fn(|_, _| 2.0 * rng.normal());
    let R_WB = UnitQuaternion::from_scaled_axis(turned);
    let truth = Truth {
        pose: Pose { p_WB: at, R_WB },
        v_WB_B: R_WB.inverse() * v_W,
        w_WB_B: Vector3::from_fn(|_, _| 3.0 * rng.normal()),
    };
    body("thrown", truth, shape, MASS)
}

/// Least and greatest coordinates of a thrown body.
fn extent(spec: &BodySpec, t: &Truth) -> (Vector3<f64>, Vector3<f64>) {
    let at = pose(&Pose { p_WB: t.pose.p_WB, R_WB: t.pose.R_WB * spec.shapes[0].0.R_WB });
    let shape = spec.shapes[0].1.shared().expect("a solid");
    // The bounds of a compound are those of its box as it is turned.
    let bounds = match shape.as_compound() {
        Some(whole) => {
            let (local, part) = &whole.shapes()[0];
            part.compute_aabb(&(at * *local))
        }
        None => shape.compute_aabb(&at),
    };
    let plain = |v: Vector| Vector3::new(v.x, v.y, v.z);
    (plain(bounds.mins), plain(bounds.maxs))
}

/// The near side of each at x = 0.
fn walls() -> Vec<(Vector3<f64>, SharedShape)> {
    let side = |s: f64| Vector::new(0.0, s * 20.0, -20.0);
    let corners = vec![side(1.0), side(-1.0), Vector::new(0.0, 0.0, 40.0)];
    let sheet = SharedShape::trimesh(corners, vec![[0, 1, 2]]).expect("a triangle");
    vec![
        (Vector3::x() * 0.0005, SharedShape::cuboid(0.0005, 20.0, 20.0)),
        (Vector3::x(), SharedShape::cuboid(1.0, 20.0, 20.0)),
        (Vector3::zeros(), sheet),
        (Vector3::x() * 0.5, SharedShape::cylinder(20.0, 0.5)),
        (Vector3::x() * 20.0, SharedShape::ball(20.0)),
    ]
}

#[test]
fn no_shape_passes_a_wall_however_it_is_thrown() {
    let mut rng = Stream::new(7, "meet", "walls");
    for (w, (at, wall)) in walls().into_iter().enumerate() {
        for (k, shape) in shapes().into_iter().enumerate() {
            for n in 0..12 {
                let speed = [0.5, 2.5, 15.0][n % 3];
                let start = Vector3::new(-0.9 - 1.5 * rng.uniform(), 0.0, 0.0);
                let across = Vector3::new(0.0, 0.1 * rng.normal(), 0.1 * rng.normal());
                let spec = thrown(&mut rng, shape.clone(), start, (Vector3::x() + across) * speed);
                let mut physics = Physics::new(STEP_S);
                physics.add_fixed(&level(at.x, at.y, at.z), wall.clone());
                let id = physics.add_body(spec.clone());
                let mut touched = false;
                for _ in 0..(3.0 / speed / STEP_S).ceil() as u64 + 5 {
                    physics.step();
                    touched |= physics.contacts(id).touching;
                    let t = physics.truth(id);
                    let (low, high) = extent(&spec, &t);
                    let place = format!("wall {w}, shape {k}, throw {n}");
                    // A body stays entirely before plane walls. It does not come out behind round ones.
                    if w < 3 {
                        assert!(high.x < 2e-3, "{place}: came to x = {} m", high.x);
                    } else {
                        let inside = t.pose.p_WB - at;
                        let radius = if w == 3 { inside.xz().norm() } else { inside.norm() };
                        let far = low.x.abs().max(high.x.abs()) < 3.0 && t.pose.p_WB.y.abs() < 2.0;
                        assert!(!far || radius > [0.5, 20.0][w - 3] * 0.99, "{place}: {radius} m");
                    }
                }
                assert!(touched || w > 2, "wall {w}, shape {k}, throw {n}: touched nothing");
            }
        }
    }
}

#[test]
fn no_shape_passes_the_bed() {
    let mut rng = Stream::new(8, "meet", "bed");
    for (k, shape) in shapes().into_iter().enumerate() {
        for n in 0..8 {
            let speed = [1.0, 6.0][n % 2];
            let start = Vector3::new(3.0 * rng.normal(), 3.0 * rng.normal(), -18.0);
            let v = Vector3::new(0.3 * rng.normal(), 0.3 * rng.normal(), -1.0) * speed;
            let spec = thrown(&mut rng, shape.clone(), start, v);
            let mut physics = Physics::new(STEP_S);
            physics.add_terrain(&BED, &area(30.0));
            let id = physics.add_body(spec.clone());
            let mut touched = false;
            for _ in 0..(4.0 / speed / STEP_S) as u64 {
                physics.step();
                touched |= physics.contacts(id).touching;
                let (low, _) = extent(&spec, &physics.truth(id));
                assert!(low.z > -20.0 - 2e-3, "shape {k}, throw {n}: {} m", low.z);
            }
            assert!(touched, "shape {k}, throw {n}");
        }
    }
}

/// Steps in which no contact is searched, because nothing fixed is in reach, are the same to the last bit as with the
/// search: past bed and wall, in short steps and in long ones, and with a centre of mass that is not the origin.
#[test]
fn steps_without_a_search_are_those_with_one() {
    let terrain = Terrain::sloping_over(&area(30.0), Heading::from_deg(250.0), 8.0, 9.0);
    let mut rng = Stream::new(10, "meet", "skipped");
    let (mut touched, mut free) = (0, 0);
    for shape in shapes() {
        for n in 0..9 {
            let step_s = [0.02, 0.1, 1.0][n % 3];
            let start = Vector3::new(3.0 * rng.normal(), 3.0 * rng.normal(), -5.0);
            let v = Vector3::from_fn(|_, _| 1.5 * rng.normal());
            let spec = BodySpec {
                p_BG: Vector3::from_fn(|_, _| 0.2 * rng.normal()),
                ..thrown(&mut rng, shape.clone(), start, v)
            };
            let [mut skipping, mut always] = [Solver::WhenInReach, Solver::Always].map(|solver| {
                let mut physics = Physics::new(step_s).with_solver(solver);
                physics.add_terrain(&terrain, &area(30.0));
                let at = Pose::level(Vector3::new(4.0, 0.0, -5.0), Heading::from_deg(20.0));
                physics.add_fixed(&at, SharedShape::cuboid(1.0, 3.0, 2.0));
                (physics.add_body(spec.clone()), physics)
            });
            for _ in 0..(6.0 / step_s) as u64 {
                for (_, physics) in [&mut skipping, &mut always] {
                    physics.step();
                }
                let [a, b] = [&skipping, &always].map(|(id, p)| (p.truth(*id), p.contacts(*id)));
                assert_eq!(a, b, "{shape:?}, throw {n}, steps of {step_s} s");
                let count = if a.1.touching { &mut touched } else { &mut free };
                *count += 1;
            }
        }
    }
    assert!(touched > 50 && free > 1000, "{touched} touched, {free} free");
}

/// Five bodies thrown together: momentum is exchanged, not made.
#[test]
fn bodies_among_each_other_keep_their_impulses_in_balance() {
    let mut rng = Stream::new(9, "meet", "throng");
    for round in 0..6 {
        let mut physics = Physics::new(STEP_S);
        let ids: Vec<_> = (0..5)
            .map(|k| {
                let angle = f64::from(k) * 1.2566;
                let (sin, cos) = crate::math::sin_cos(angle);
                let out = Vector3::new(cos, sin, 0.05 * rng.normal());
                let shape = shapes().swap_remove((k as usize + round) % 6);
                physics.add_body(thrown(&mut rng, shape, out * 2.0, out * -3.0))
            })
            .collect();
        let mut touches = 0;
        for _ in 0..30 {
            physics.step();
            let all = ids.iter().map(|&id| physics.contacts(id));
            let (sum, size) = all.fold((Vector3::zeros(), 0.0), |(sum, size), c| {
                touches += u32::from(c.touching);
                (sum + c.impulse_N_s, size + c.impulse_N_s.norm())
            });
            assert!(sum.norm() <= 1e-9 * size, "{sum} of {size} N s");
        }
        assert!(touches >= 4, "round {round}: {touches} touches");
    }
}

/// A level body whose axis or centre lies in the bed, in a block or in another body, where no direction is the nearest.
#[test]
fn what_starts_within_a_solid_keeps_numbers_and_comes_out_without_a_leap() {
    for (k, shape) in shapes().into_iter().enumerate() {
        for below_m in [0.0, -0.0, 1e-9, 0.05, 0.3, 2.0] {
            for turn in [0.0, 0.25, 0.5] {
                let at = Vector3::new(0.0, 0.0, -20.0 - below_m);
                let R_WB = UnitQuaternion::from_euler_angles(0.0, 0.0, turn * std::f64::consts::PI);
                let rest = |p_WB| body("within", Truth::at_rest(Pose { p_WB, R_WB }), shape.clone(), MASS);
                let mut physics = Physics::new(STEP_S);
                physics.add_terrain(&BED, &area(90.0));
                physics.add_fixed(&level(5.0, 0.0, -20.0), SharedShape::cuboid(1.0, 1.0, 1.0));
                // On the bed, in the block, and two in each other.
                let starts = [at, at + Vector3::x() * 5.0, at - Vector3::x() * 5.0];
                let ids = [starts[0], starts[1], starts[2], starts[2]].map(|start| physics.add_body(rest(start)));
                for _ in 0..50 {
                    physics.step();
                    for (n, id) in ids.iter().enumerate() {
                        let t = physics.truth(*id);
                        let place = format!("shape {k}, {below_m} m below, body {n}: {t:?}");
                        assert!(t.is_finite(), "{place}");
                        assert!(t.v_WB_B.norm() < 0.5 + 1e-6, "{place}");
                        let moved = t.pose.p_WB - starts[n.min(2)];
                        assert!(moved.norm() < 3.0, "{place}");
                    }
                }
            }
        }
    }
}
