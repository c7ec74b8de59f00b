//! The reference set against an integration of the published equations written here a second time, from their text:
//! NED, FRD, Euler angles. Above all: what it does at rest in a current.

use super::kit::{STEP_S, remus, water};
use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};
use robots::handoff::{Actuation, ActuatorCommand};
use robots::vehicles::ParameterSet;
use std::f64::consts::PI;
use world::frames::{Pose, Truth};
use world::math;
use world::units::Heading;

/// (x y z φ θ ψ), (u v w p q r), (rudder, stern plane, rpm).
#[derive(Clone, Copy)]
struct State {
    eta: Vector6<f64>,
    nu: Vector6<f64>,
    act: Vector3<f64>,
}

impl State {
    fn moved(&self, rate: &State, h: f64) -> State {
        State { eta: self.eta + rate.eta * h, nu: self.nu + rate.nu * h, act: self.act + rate.act * h }
    }
}

fn skew(v: Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

/// C(ν) of a mass matrix: force −l × v2, moment −l × v1 − h × v2.
fn coriolis(m: &Matrix6<f64>, nu: &Vector6<f64>) -> Matrix6<f64> {
    let p = m * nu;
    let l = skew(p.fixed_rows::<3>(0).into());
    let h = skew(p.fixed_rows::<3>(3).into());
    let mut c = Matrix6::zeros();
    c.fixed_view_mut::<3, 3>(0, 3).copy_from(&-l);
    c.fixed_view_mut::<3, 3>(3, 0).copy_from(&-l);
    c.fixed_view_mut::<3, 3>(3, 3).copy_from(&-h);
    c
}

struct Published {
    rigid: Matrix6<f64>,
    added: Matrix6<f64>,
    inverse: Matrix6<f64>,
    damping: Vector6<f64>,
    v_c: f64,
    beta_c: f64,
}

impl Published {
    fn new(v_c: f64, beta_c: f64) -> Self {
        let (a, b, rho) = (0.8f64, 0.095f64, 1026.0);
        let m = 4.0 / 3.0 * PI * rho * a * b * b;
        let (ix, iy) = (0.4 * m * b * b, 0.2 * m * (a * a + b * b));
        let e = (1.0 - (b / a).powi(2)).sqrt();
        let log = math::ln((1.0 + e) / (1.0 - e));
        let alpha0 = 2.0 * (1.0 - e * e) / e.powi(3) * (0.5 * log - e);
        let beta0 = 1.0 / (e * e) - (1.0 - e * e) / (2.0 * e.powi(3)) * log;
        let (k1, k2) = (alpha0 / (2.0 - alpha0), beta0 / (2.0 - beta0));
        let k = e.powi(4) * (beta0 - alpha0) / ((2.0 - e * e) * (2.0 * e * e - (2.0 - e * e) * (beta0 - alpha0)));
        let z = 0.02;
        let mut rigid = Matrix6::from_diagonal(&Vector6::new(m, m, m, ix + m * z * z, iy + m * z * z, iy));
        for (i, j, x) in [(0, 4, m * z), (1, 3, -m * z)] {
            rigid[(i, j)] = x;
            rigid[(j, i)] = x;
        }
        let added = Matrix6::from_diagonal(&Vector6::new(m * k1, m * k2, m * k2, 0.3 * ix, k * iy, k * iy));
        let total = rigid + added;
        let swing = |i: usize| (m * 9.81 * z / total[(i, i)]).sqrt();
        let damping = Vector6::new(
            total[(0, 0)] / 20.0,
            total[(1, 1)] / 20.0,
            total[(2, 2)] / 20.0,
            2.0 * 0.3 * swing(3) * total[(3, 3)],
            2.0 * 0.8 * swing(4) * total[(4, 4)],
            total[(5, 5)],
        );
        Self { rigid, added, inverse: total.try_inverse().expect("masses"), damping, v_c, beta_c }
    }

    fn rate(&self, s: &State, asked: &Vector3<f64>) -> State {
        let (nu, rho) = (&s.nu, 1026.0);
        let [phi, theta, psi] = [s.eta[3], s.eta[4], s.eta[5]];
        let (u_c, v_c) = (self.v_c * math::cos(self.beta_c - psi), self.v_c * math::sin(self.beta_c - psi));
        let nu_r = nu - Vector6::new(u_c, v_c, 0.0, 0.0, 0.0, 0.0);
        let rate_c = Vector6::new(nu[5] * v_c, -nu[5] * u_c, 0.0, 0.0, 0.0, 0.0);
        let speed = nu_r.fixed_rows::<3>(0).norm();

        let mut c_a = coriolis(&self.added, &nu_r);
        for (i, j) in [(4, 0), (4, 2), (5, 0), (5, 1)] {
            c_a[(i, j)] = 0.0;
            c_a[(j, i)] = 0.0;
        }
        let fade = math::exp(-3.0 * speed);
        let faded = Vector6::new(fade, fade, 1.0, 1.0, 1.0, 1.0);
        let damping = self.damping.component_mul(&faded).component_mul(&nu_r);
        let mut tau = -(coriolis(&self.rigid, &nu_r) + c_a) * nu_r - damping;

        // Hull lift and drag.
        let (area, d) = (0.7 * 1.6 * 0.19, 0.19);
        let aspect = d * d / area;
        let slope = PI * aspect / (1.0 + (1.0 + (aspect / 2.0f64).powi(2)).sqrt());
        let alpha = math::atan2(nu_r[2], nu_r[0]);
        let lift = slope * alpha;
        let drag = 0.42 * PI * 0.095 * 0.095 / area + lift * lift / (PI * 0.7 * aspect);
        let q = 0.5 * rho * speed * speed * area;
        let (L, D) = (q * lift, q * drag);
        tau[0] += -D * math::cos(alpha) + L * math::sin(alpha);
        tau[2] += -D * math::sin(alpha) - L * math::cos(alpha);

        // Cross-flow, end stations at full weight.
        for i in 0..=20 {
            let x = -0.8 + 0.08 * f64::from(i);
            let across = nu_r[1] + x * nu[5];
            let f = -0.5 * rho * d * 1.197_728_834_355_83 * across.abs() * across * 0.08;
            tau[1] += f;
            tau[5] += x * f;
        }

        // Limits act on the actuators' state.
        let limit = 15f64.to_radians();
        let rudder = s.act[0].clamp(-limit, limit);
        let stern = s.act[1].clamp(-limit, limit);
        let n = s.act[2].clamp(-1525.0, 1525.0) / 60.0;
        let (D4, va) = (0.14f64.powi(4), 0.944 * speed);
        let by = |k0: f64, k_max: f64| {
            let slip = if n > 0.0 { (k_max - k0) / 0.6632 * (va / 0.14) * n.abs() } else { 0.0 };
            k0 * n * n.abs() + slip
        };
        let thrust = rho * D4 * by(0.4566, 0.1798);
        let torque = rho * D4 * 0.14 * by(0.0700, 0.0312);
        let at_rudder = nu_r[0] * nu_r[0] + nu_r[1] * nu_r[1];
        let at_stern = nu_r[0] * nu_r[0] + nu_r[2] * nu_r[2];
        let k = 0.5 * rho * 2.0 * 0.00665;
        let (y_r, z_s) = (-k * at_rudder * 0.5 * rudder, -k * at_stern * 0.7 * stern);
        tau[0] += 0.9 * thrust + y_r * rudder + z_s * stern;
        tau[1] += y_r;
        tau[2] += z_s;
        tau[3] += 0.1 * torque;
        tau[4] += 0.8 * z_s;
        tau[5] += -0.8 * y_r;

        // Weight under the middle.
        let zw = 0.02 * self.rigid[(0, 0)] * 9.81;
        tau[3] -= zw * math::cos(theta) * math::sin(phi);
        tau[4] -= zw * math::sin(theta);

        let (cf, sf, ct, st, cp, sp) =
            (math::cos(phi), math::sin(phi), math::cos(theta), math::sin(theta), math::cos(psi), math::sin(psi));
        let R = Matrix3::new(
            cp * ct,
            -sp * cf + cp * st * sf,
            sp * sf + cp * cf * st,
            sp * ct,
            cp * cf + sf * st * sp,
            -cp * sf + st * sp * cf,
            -st,
            ct * sf,
            ct * cf,
        );
        let v = R * nu.fixed_rows::<3>(0);
        let (p, q, r) = (nu[3], nu[4], nu[5]);
        let turn = q * sf + r * cf;
        State {
            eta: Vector6::new(v.x, v.y, v.z, p + turn * st / ct, q * cf - r * sf, turn / ct),
            nu: rate_c + self.inverse * tau,
            act: (asked - s.act).component_div(&Vector3::new(0.1, 0.1, 1.0)),
        }
    }

    fn step(&self, s: &State, asked: &Vector3<f64>, h: f64) -> State {
        let k1 = self.rate(s, asked);
        let k2 = self.rate(&s.moved(&k1, h / 2.0), asked);
        let k3 = self.rate(&s.moved(&k2, h / 2.0), asked);
        let k4 = self.rate(&s.moved(&k3, h), asked);
        s.moved(&k1, h / 6.0).moved(&k2, h / 3.0).moved(&k3, h / 3.0).moved(&k4, h / 6.0)
    }
}

/// Greatest distance (m) over `seconds` between our reference set and the published equations, started at rest with a
/// heading,
/// roll and pitch (degrees, NED) in a current towards `beta_deg`.
fn apart(v_c: f64, beta_deg: f64, attitude_deg: [f64; 3], asked: Vector3<f64>, seconds: f64) -> f64 {
    let published = Published::new(v_c, beta_deg.to_radians());
    let [phi, theta, psi] = attitude_deg.map(f64::to_radians);
    let mut theirs =
        State { eta: Vector6::new(0.0, 0.0, 100.0, phi, theta, psi), nu: Vector6::zeros(), act: Vector3::zeros() };
    let mut vehicle = remus(ParameterSet::Reference);
    let mut ours = Truth::at_rest(Pose {
        p_WB: Vector3::new(0.0, 0.0, -100.0),
        R_WB: UnitQuaternion::from_euler_angles(phi, -theta, Heading::from_rad(psi).yaw()),
    });
    let to = Heading::from_deg(beta_deg).unit() * v_c;
    let water = water(Vector3::new(to.x, to.y, 0.0));
    let command = Actuation::Fins(ActuatorCommand { rudder_rad: asked[0], stern_rad: asked[1], rpm: asked[2] });
    let mut worst: f64 = 0.0;
    for _ in 0..(seconds / STEP_S).round() as u64 {
        ours = vehicle.step_in(&ours, &water, &command, STEP_S);
        theirs = published.step(&theirs, &asked, STEP_S);
        let e = &theirs.eta;
        let there = Vector3::new(e[1], e[0], -e[2]);
        worst = worst.max((ours.pose.p_WB - there).norm());
    }
    worst
}

/// A following current of 0.5 m/s towards 30 degrees: the water meets the hull from astern, α = π with the sign of
/// zero.
#[test]
fn at_rest_in_a_following_current_the_sign_of_zero_is_the_published_one() {
    let ahead = Vector3::new(0.0, 0.0, 1525.0);
    let worst = apart(0.5, 30.0, [0.0, 0.0, 0.0], ahead, 100.0);
    assert!(worst < 2e-6, "{worst} m");
}

/// Every direction of the current but those exactly abeam, where the published first step hangs on a rounding error in
/// surge.
#[test]
fn at_rest_in_any_current_the_path_is_the_published_one() {
    let turning = Vector3::new(5f64.to_radians(), 2f64.to_radians(), 1000.0);
    for (beta_deg, psi_deg) in (0..360).step_by(30).map(f64::from).zip([0.0, 101.0, 200.0].into_iter().cycle()) {
        let angle = (beta_deg - psi_deg).to_radians();
        if math::cos(angle).abs() > 1e-9 {
            let worst = apart(0.5, beta_deg, [0.0, 0.0, psi_deg], turning, 40.0);
            assert!(worst < 2e-6, "towards {beta_deg}, heading {psi_deg}: {worst} m");
        }
    }
    for attitude_deg in [[20.0, 0.0, 40.0], [0.0, 15.0, 220.0], [-30.0, -10.0, 310.0]] {
        let worst = apart(0.5, 30.0, attitude_deg, turning, 40.0);
        assert!(worst < 2e-6, "{attitude_deg:?}: {worst} m");
    }
}

/// Without a current too.
#[test]
fn in_still_water_the_path_is_the_published_one() {
    let turning = Vector3::new(8f64.to_radians(), -1f64.to_radians(), 1525.0);
    let worst = apart(0.0, 0.0, [0.0; 3], turning, 100.0);
    assert!(worst < 2e-6, "{worst} m");
}
