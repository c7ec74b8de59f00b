//! One step of a hull's equation of motion: pose, velocity and drives together.
//!
//! *Source:* classical fourth-order Runge-Kutta on (p, quaternion, ν, drives).
//!
//! *Parameters:* none.
//!
//! *Deviations:* the water is sampled once per step and taken as linear in space and time during it. Unless the
//! current is turned by yaw only, the step is done in axes that move with the sampled water: a uniform current then
//! changes nothing but the drift, to the last bits (Galilean invariance).

use super::equation::{Carried, Equation, HullWater, Stage, Terms};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};

/// Nothing to carry: the drives are known at every instant of the step.
#[derive(Clone, Copy)]
struct State<D> {
    p: Vector3<f64>,
    q: Quaternion<f64>,
    v: Vector3<f64>,
    w: Vector3<f64>,
    drives: D,
}

impl<D: Carried> State<D> {
    fn moved(&self, rate: &Self, h: f64) -> Self {
        Self {
            p: self.p + rate.p * h,
            q: self.q + rate.q * h,
            v: self.v + rate.v * h,
            w: self.w + rate.w * h,
            drives: self.drives.moved(&rate.drives, h),
        }
    }
}

impl Equation {
    /// State and drives after one step.
    pub(in crate::vehicles) fn advance<T: Terms>(
        &self,
        terms: &T,
        truth: &Truth,
        drives: &T::Drives,
        sample: &WaterSample,
        h: f64,
    ) -> (Truth, T::Drives) {
        let body = &self.body;
        let carried = if body.current_by_yaw_only { Vector3::zeros() } else { sample.velocity };
        let start = State {
            p: truth.pose.p_WB,
            q: truth.pose.R_WB.into_inner(),
            v: truth.v_WB_B - truth.pose.R_WB.inverse() * carried,
            w: truth.w_WB_B,
            drives: *drives,
        };
        let residue = sample.velocity - carried;
        // The change of the water that a point carried along with it experiences.
        let rate_W = sample.rate + sample.gradient * carried;

        let rate = |s: &State<T::Drives>, stage: Stage| {
            let t = match stage {
                Stage::Start => 0.0,
                Stage::Middle => h / 2.0,
                Stage::End => h,
            };
            let unit = UnitQuaternion::new_normalize(s.q);
            let R_WB = unit.to_rotation_matrix();
            let z_m = s.p.z + carried.z * t;
            let up = R_WB.matrix().row(2).transpose();
            let (wet, wet_r) = body.envelope.wet(z_m, &up);
            let water = HullWater {
                u_W: residue + sample.gradient * (s.p - start.p) + rate_W * t,
                gradient_W: sample.gradient,
                rate_W,
                density_kg_m3: sample.density_kg_m3,
                wet,
                wet_r,
                z_m,
            };
            let (v, w) = self.acceleration(terms, &R_WB, &s.v, &s.w, &water, &s.drives, stage);
            State { p: R_WB * s.v, q: s.q * Quaternion::from_imag(s.w * 0.5), v, w, drives: terms.rate(&s.drives) }
        };
        let k1 = rate(&start, Stage::Start);
        let k2 = rate(&start.moved(&k1, h / 2.0), Stage::Middle);
        let k3 = rate(&start.moved(&k2, h / 2.0), Stage::Middle);
        let k4 = rate(&start.moved(&k3, h), Stage::End);
        let end = start.moved(&k1, h / 6.0).moved(&k2, h / 3.0).moved(&k3, h / 3.0).moved(&k4, h / 6.0);

        let R_WB = UnitQuaternion::new_normalize(end.q);
        let truth = Truth {
            pose: Pose { p_WB: end.p + carried * h, R_WB },
            v_WB_B: end.v + R_WB.inverse() * carried,
            w_WB_B: end.w,
        };
        (truth, end.drives)
    }
}
