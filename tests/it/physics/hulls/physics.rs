//! What holds for any hull: no energy from nothing, a current only carries, walls stop it.

use super::kit::{built, newtons, random_hull, set, shipped, still};
use nalgebra::{UnitQuaternion, Vector3, Vector6};
use robots::vehicles::Vehicle;
use world::frames::{Pose, Truth};
use world::physics::Physics;
use world::seeds::Stream;

fn spread(rng: &mut Stream, most: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| most * (2.0 * rng.uniform() - 1.0))
}

/// A random place well under water, attitude and motion.
fn random_state(rng: &mut Stream) -> Truth {
    let mut truth = Truth::at_rest(Pose {
        p_WB: Vector3::new(0.0, 0.0, -1e4),
        R_WB: UnitQuaternion::from_scaled_axis(spread(rng, 2.0)),
    });
    truth.v_WB_B = spread(rng, 3.0);
    truth.w_WB_B = spread(rng, 2.0);
    truth
}

/// Kinetic energy in still water, with that of the water that moves along, and potential energy in water of a density,
/// J.
fn energy_J(hull: &Vehicle, truth: &Truth, density_kg_m3: f64) -> f64 {
    let statics = hull.statics().expect("a hull");
    let (v, w) = (truth.v_WB_B, truth.w_WB_B);
    let nu = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
    let [weight, lift] = statics.centres.map(|r| truth.pose.point(r).z);
    let forces = statics.mass_kg * weight - density_kg_m3 * statics.volume_m3 * lift;
    0.5 * nu.dot(&(statics.whole_mass * nu)) + 9.80665 * forces
}

/// Two thousand hulls within what `check` lets pass without a doubt about energy, let go in still water.
#[test]
fn no_hull_gains_energy_from_still_water() {
    let mut rng = Stream::new(7, "hulls", "draws");
    for n in 0..2_000 {
        let mut hull = random_hull(&mut rng);
        let dt_s = [0.005, 0.02, 0.1][n % 3];
        let mut truth = random_state(&mut rng);
        let idle = hull.idle();
        // The potential energy has no zero: what counts is its change beside the kinetic energy at the start.
        let mut energy = energy_J(&hull, &truth, 1025.0);
        let rest = Truth { v_WB_B: Vector3::zeros(), w_WB_B: Vector3::zeros(), ..truth };
        let scale = energy - energy_J(&hull, &rest, 1025.0) + 1.0;
        for step in 0..40 {
            truth = hull.step_in(&truth, &still(1025.0), &idle, dt_s);
            let now = energy_J(&hull, &truth, 1025.0);
            assert!(now - energy < 1e-4 * scale, "hull {n}, step {step} of {dt_s} s: {} J of {scale} J", now - energy);
            energy = now;
        }
    }
}

/// A uniform current carries a vehicle along and changes nothing else.
#[test]
fn a_current_only_carries() {
    let current = Vector3::new(0.4, -0.7, 0.1);
    for name in ["bluerov2", "bluerov2_heavy", "lauv", "glider"] {
        let (file, urdf) = shipped(name);
        let fly = |current: Vector3<f64>| {
            let mut hull = built(&file, &urdf);
            let mut truth = Truth::at_rest(Pose {
                p_WB: Vector3::new(0.0, 0.0, -50.0),
                R_WB: UnitQuaternion::from_euler_angles(0.1, -0.2, 0.3),
            });
            truth.v_WB_B = truth.pose.R_WB.inverse() * current;
            let mut water = still(1025.0);
            water.velocity = current;
            // Every drive otherwise, so that they do not cancel each other.
            let all: Vec<f64> = (hull.drives().iter().enumerate())
                .map(|(k, d)| d.named.idle + (d.limits[1] - d.named.idle) * 0.4 / (1.0 + k as f64))
                .collect();
            for _ in 0..1500 {
                truth = hull.step_in(&truth, &water, &set(&all), 0.02);
            }
            truth
        };
        let (still, carried) = (fly(Vector3::zeros()), fly(current));
        let apart = carried.pose.p_WB - still.pose.p_WB - current * 30.0;
        assert!(apart.norm() < 1e-7, "{name}: {apart}");
        assert!(carried.pose.R_WB.angle_to(&still.pose.R_WB) < 1e-8, "{name}");
        assert!(still.pose.p_WB.xy().norm() > 0.2, "{name} did not move");
    }
}

/// Full ahead into a wall: it stops there, at any step, and does not shake.
#[test]
fn a_wall_stops_it_at_any_step() {
    use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, ShapeSpec, Surface};
    use world::ranges::{Finite, HeadingDeg, Positive};
    let bed = world::terrain::Terrain::Level { depth_m: 30.0 };
    let [l, w, h] = [1.0, 40.0, 60.0].map(Positive::new);
    let wall = ObstacleSpec {
        id: "wall".into(),
        shape: ShapeSpec::Box(BoxShape { size_m: (l, w, h) }),
        east_m: Finite::new(3.5),
        north_m: Finite::new(0.0),
        base: Base::default(),
        heading_deg: HeadingDeg::new(90.0),
        surface: Surface::default(),
    };
    let wall = Obstacle::build(&wall, &bed, std::path::Path::new("")).expect("a wall");
    // A BlueROV without its autopilot pitches over if it pushes harder.
    for (name, share) in [("bluerov2", 0.1), ("bluerov2_heavy", 0.1), ("lauv", 0.8)] {
        for dt_s in [0.005, 0.02, 0.05, 0.1] {
            let (file, urdf) = shipped(name);
            let mut hull = built(&file, &urdf);
            let mut physics = Physics::new(dt_s);
            physics.add_obstacle(&wall);
            // ENU: its nose to the east.
            let start = Pose { p_WB: Vector3::new(0.0, 0.0, -10.0), R_WB: UnitQuaternion::identity() };
            let mut truth = Truth::at_rest(start);
            let id = physics.add_body(hull.body_spec("auv", truth));
            let ahead: Vec<f64> = (hull.drives().iter())
                .map(|d| match &d.does {
                    robots::handoff::DriveEffect::Pushes(arm, table) if arm[0] > 0.5 => {
                        table.input(share * table.thrusts_n()[1])
                    }
                    robots::handoff::DriveEffect::Pushes(arm, table) if arm[0] < -0.5 => {
                        table.input(share * table.thrusts_n()[0])
                    }
                    _ => d.named.idle,
                })
                .collect();
            let mut touched = false;
            let mut fastest: f64 = 0.0;
            for _ in 0..(30.0 / dt_s) as u32 {
                let free = hull.step_in(&truth, &still(1025.0), &set(&ahead), dt_s);
                physics.push(id, free);
                physics.step();
                truth = physics.truth(id);
                touched |= physics.contacts(id).touching;
                fastest = fastest.max(truth.v_WB_B.norm());
                assert!(truth.is_finite() && truth.pose.p_WB.x < 3.0, "{name} {dt_s}");
            }
            assert!(touched, "{name} {dt_s}: never there");
            assert!(fastest < 4.0, "{name} {dt_s}: {fastest} m/s");
        }
    }
}

/// Thrust of a lagging thruster follows exactly, so that a step of 0.1 s ends where steps of 0.001 s end.
#[test]
fn the_step_changes_little() {
    let (mut file, urdf) = shipped("bluerov2_heavy");
    for drive in &mut file.drives {
        if let robots::vehicles::DriveSpec::Thruster(t) = drive {
            let mut plain = newtons(&t.link);
            if let robots::vehicles::DriveSpec::Thruster(p) = &mut plain {
                p.lag_s = world::ranges::NonNegative::new(0.15);
            }
            *drive = plain;
        }
    }
    let asked = set(&[3.0, 2.0, -1.0, -3.0, -4.0, 4.0, 4.0, -4.0]);
    let fly = |dt_s: f64| {
        let mut hull = built(&file, &urdf);
        let mut truth = Truth::at_rest(Pose { p_WB: Vector3::new(0.0, 0.0, -50.0), R_WB: UnitQuaternion::identity() });
        for _ in 0..(10.0 / dt_s).round() as u32 {
            truth = hull.step_in(&truth, &still(1025.0), &asked, dt_s);
        }
        truth
    };
    let (fine, coarse) = (fly(0.001), fly(0.1));
    let apart = (fine.pose.p_WB - coarse.pose.p_WB).norm();
    assert!(apart < 1e-3, "{apart} m");
    assert!(fine.pose.R_WB.angle_to(&coarse.pose.R_WB) < 1e-3);
}
