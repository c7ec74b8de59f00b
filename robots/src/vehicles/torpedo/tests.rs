//! The hull's accelerations against those of the published model, one effect after the other.

use super::actuators::Actuators;
use super::coefficients::{Coefficients, Inflow};
use super::terms::TorpedoTerms;
use super::testing::remus100;
use crate::vehicles::dynamics::{Equation, HullWater, Relative, Stage};
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::f64::consts::FRAC_PI_2;

/// A hull with its numbers.
struct Hydrodynamics {
    c: Coefficients,
    equation: Equation,
}

impl Hydrodynamics {
    fn new(c: Coefficients) -> Self {
        let equation = Equation::new(c.body()).expect("masses");
        Self { c, equation }
    }

    fn terms(&self) -> TorpedoTerms<'_> {
        TorpedoTerms { c: &self.c, asked: Actuators::default() }
    }

    fn acceleration(
        &self,
        R_WB: &Rotation3<f64>,
        v: &Vector3<f64>,
        w: &Vector3<f64>,
        water: &HullWater,
        actuators: &Actuators,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let terms = self.terms();
        (self.equation).acceleration(&terms, R_WB, v, w, water, actuators, Stage::Start)
    }
}

fn still() -> HullWater {
    HullWater {
        u_W: Vector3::zeros(),
        gradient_W: Matrix3::zeros(),
        rate_W: Vector3::zeros(),
        density_kg_m3: 1026.0,
        wet: 1.0,
        wet_r: Vector3::zeros(),
        z_m: -10.0,
    }
}

fn both() -> [Hydrodynamics; 2] {
    [true, false].map(|published| Hydrodynamics::new(remus100(published)))
}

/// Every row of the published model's table, with the propeller's inflow as first and as later published.
#[test]
fn published_derivatives() {
    let table = include_str!("../../../../tests/reference/remus100/derivative_points.csv");
    let mut worst: f64 = 0.0;
    for (inflow, first) in [(Inflow::Ground, 17), (Inflow::Water, 23)] {
        let hull = Hydrodynamics::new(Coefficients { inflow, ..remus100(true) });
        for line in table.lines().skip(1) {
            let n: Vec<f64> = line.split(',').map(|s| s.parse().expect("a number")).collect();
            let to_current = world::units::Heading::from_rad(n[1]).unit() * n[0];
            let water = HullWater { u_W: Vector3::new(to_current.x, to_current.y, 0.0), ..still() };
            // (roll, pitch, yaw) of FRD in NED, as the same rotation of FLU in ENU.
            let R_WB = Rotation3::from_euler_angles(n[5], -n[6], FRAC_PI_2 - n[7]);
            let (dv, dw) = hull.acceleration(
                &R_WB,
                &Vector3::new(n[8], -n[9], -n[10]),
                &Vector3::new(n[11], -n[12], -n[13]),
                &water,
                &Actuators { rudder_rad: n[14], stern_rad: n[15], rpm: n[16] },
            );
            let ours = [dv.x, -dv.y, -dv.z, dw.x, -dw.y, -dw.z];
            for (a, b) in ours.iter().zip(&n[first..first + 6]) {
                worst = worst.max((a - b).abs() / b.abs().max(1.0));
            }
        }
    }
    assert!(worst < 1e-9, "worst relative difference {worst:e}");
}

#[test]
fn rudder_turns_to_starboard_and_stern_plane_dives() {
    for hull in both() {
        let v = Vector3::new(1.5, 0.0, 0.0);
        let level = Rotation3::identity();
        let helm = |rudder_rad, stern_rad| Actuators { rudder_rad, stern_rad, rpm: 1000.0 };
        let turn = |a: Actuators| hull.acceleration(&level, &v, &Vector3::zeros(), &still(), &a).1;
        let straight = turn(helm(0.0, 0.0));
        // FLU: clockwise seen from above is −z; nose down is +y.
        assert!(turn(helm(0.1, 0.0)).z < straight.z - 0.01);
        assert!(turn(helm(0.0, 0.1)).y > straight.y + 0.01);
    }
}

#[test]
fn known_force_gives_known_acceleration() {
    // At rest the thrust is the only force: K_T0 ρ D⁴ n² (1 − t) on m + 0.839 kg, and the surge-pitch coupling m z_g.
    for hull in both() {
        let actuators = Actuators { rpm: 600.0, ..Actuators::default() };
        let zero = Vector3::zeros();
        let (dv, dw) = hull.acceleration(&Rotation3::identity(), &zero, &zero, &still(), &actuators);
        let c = &hull.c;
        let thrust = 0.9 * 1026.0 * 0.14f64.powi(4) * 0.4566 * 100.0;
        let (m, i, z) = (c.mass_kg + c.added[0], c.rigid_mass()[(4, 4)] + c.added[4], c.mass_kg * c.z_g_m);
        let det = m * i - z * z;
        assert!((dv.x - thrust * i / det).abs() < 1e-12);
        assert!((dw.y - thrust * z / det).abs() < 1e-12);
    }
}

#[test]
fn planes_of_the_shipped_set_are_alike() {
    let mut c = remus100(false);
    c.spec.fins.stern_slope = c.spec.fins.rudder_slope;
    let hull = Hydrodynamics::new(c);
    let none = Vector3::zeros();
    let f = |v, w| {
        let at = Relative { v_ground: v, v, w, along: none, rho: 1026.0, down: Vector3::z(), z_m: -10.0, wet: 1.0 };
        hull.terms().submerged(&at, &Actuators::default())
    };
    let (side, turn) = f(Vector3::new(1.0, 0.3, 0.0), Vector3::new(0.0, 0.0, 0.2));
    let (heave, pitch) = f(Vector3::new(1.0, 0.0, 0.3), Vector3::new(0.0, -0.2, 0.0));
    assert!((side.y - heave.z).abs() < 1e-12 && (side.x - heave.x).abs() < 1e-12);
    let pitch_damping = hull.c.damping[4] * 0.2;
    assert!((turn.z + pitch.y - pitch_damping).abs() < 1e-12);
}
