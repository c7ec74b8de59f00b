//! One step of a hull's equation of motion: pose, velocity and actuators together.
//!
//! *Source:* classical fourth-order Runge-Kutta on (p, quaternion, ν, actuators).
//!
//! *Parameters:* none.
//!
//! *Deviations:* the water is sampled once per step and taken as linear in space and time during it. Unless the
//! parameter set turns the current by yaw only, the step is done in axes that move with the sampled water: a uniform
//! current then changes nothing but the drift, to the last bits (Galilean invariance).

use super::hydrodynamics::{Actuators, HullWater, Hydrodynamics};
use super::surface;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};

#[derive(Clone, Copy)]
struct State {
    p: Vector3<f64>,
    q: Quaternion<f64>,
    v: Vector3<f64>,
    w: Vector3<f64>,
    actuators: Actuators,
}

impl State {
    fn moved(&self, rate: &State, h: f64) -> State {
        State {
            p: self.p + rate.p * h,
            q: self.q + rate.q * h,
            v: self.v + rate.v * h,
            w: self.w + rate.w * h,
            actuators: self.actuators.moved(&rate.actuators, h),
        }
    }
}

impl Hydrodynamics {
    /// State and actuators after one step.
    pub(super) fn advance(
        &self,
        truth: &Truth,
        actuators: &Actuators,
        asked: &Actuators,
        sample: &WaterSample,
        h: f64,
    ) -> (Truth, Actuators) {
        let carried = if self.c.current_by_yaw_only {
            Vector3::zeros()
        } else {
            sample.velocity
        };
        let start = State {
            p: truth.pose.p_WB,
            q: truth.pose.R_WB.into_inner(),
            v: truth.v_WB_B - truth.pose.R_WB.inverse() * carried,
            w: truth.w_WB_B,
            actuators: *actuators,
        };
        let residue = sample.velocity - carried;
        // The change of the water that a point carried along with it experiences.
        let rate_W = sample.rate + sample.gradient * carried;

        let rate = |s: &State, t: f64| {
            let unit = UnitQuaternion::new_normalize(s.q);
            let R_WB = unit.to_rotation_matrix();
            let (wet, wet_x_m) = surface::wet(
                self.c.length_m,
                self.c.diameter_m,
                s.p.z + carried.z * t,
                R_WB.matrix()[(2, 0)],
            );
            let water = HullWater {
                u_W: residue + sample.gradient * (s.p - start.p) + rate_W * t,
                gradient_W: sample.gradient,
                rate_W,
                density_kg_m3: sample.density_kg_m3,
                wet,
                wet_x_m,
            };
            let standing = if self.c.limits_on_state {
                s.actuators.limited(&self.c)
            } else {
                s.actuators
            };
            let (v, w) = self.acceleration(&R_WB, &s.v, &s.w, &water, &standing);
            State {
                p: R_WB * s.v,
                q: s.q * Quaternion::from_imag(s.w * 0.5),
                v,
                w,
                actuators: s.actuators.rate(asked, &self.c),
            }
        };
        let k1 = rate(&start, 0.0);
        let k2 = rate(&start.moved(&k1, h / 2.0), h / 2.0);
        let k3 = rate(&start.moved(&k2, h / 2.0), h / 2.0);
        let k4 = rate(&start.moved(&k3, h), h);
        let end = start
            .moved(&k1, h / 6.0)
            .moved(&k2, h / 3.0)
            .moved(&k3, h / 3.0)
            .moved(&k4, h / 6.0);

        let R_WB = UnitQuaternion::new_normalize(end.q);
        let truth = Truth {
            pose: Pose {
                p_WB: end.p + carried * h,
                R_WB,
            },
            v_WB_B: end.v + R_WB.inverse() * carried,
            w_WB_B: end.w,
        };
        (truth, end.actuators)
    }
}
