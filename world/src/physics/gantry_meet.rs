//! A gantry as bodies meet it: two joints with their masses. rapier moves it, and bodies that run into it push it.

use super::course::Course;
use super::gantry_body::{Gantry, JointState, Solid};
use super::gaps::PlacedShape;
use super::solid::Physics;
use crate::convert::pose;
use crate::frames::Pose;
use nalgebra::{Matrix2, Matrix6, Vector3};
use rapier3d::prelude as r;

impl Gantry {
    /// Directions of both joints in world axes.
    pub(super) fn along_W(&self) -> [Vector3<f64>; 2] {
        self.along_B.map(|a| self.base.R_WB * a)
    }

    /// Inverse mass matrix of both joints; the other four velocities do not exist.
    pub(super) fn inverse_mass(&self) -> Matrix6<f64> {
        let [a, b] = [[1.0, 0.0], [0.0, 1.0]].map(|unit| self.momentum(unit));
        let mass = Matrix2::new(a[0], b[0], a[1], b[1]);
        let mut inverse = Matrix6::zeros();
        let joints = mass.try_inverse().expect("two axes along one line are refused");
        inverse.fixed_view_mut::<2, 2>(0, 0).copy_from(&joints);
        inverse
    }

    /// Positions of the joints before the latest step, m, and their state after it.
    pub(super) fn latest(&self) -> ([f64; 2], [JointState; 2]) {
        (self.before_m, self.states)
    }
}

impl Physics {
    /// Shapes on a part of a gantry that moves with its first `slides` joints.
    pub(super) fn shapes_of(
        &self,
        part: r::RigidBodyHandle,
        gantry: &Gantry,
        joints_m: [f64; 2],
        slides: usize,
    ) -> Vec<PlacedShape> {
        let way = (gantry.along_B.iter().zip(joints_m)).take(slides);
        let way: Vector3<f64> = way.map(|(along, q)| along * q).sum();
        let at = pose(&Pose { p_WB: gantry.base.point(way), R_WB: gantry.base.R_WB });
        let colliders = self.world.bodies[part].colliders().iter();
        colliders
            .map(|&handle| {
                let collider = &self.world.colliders[handle];
                let local = collider.position_wrt_parent().copied();
                PlacedShape::new(at * local.unwrap_or(r::Pose::IDENTITY), collider.shared_shape())
            })
            .collect()
    }

    /// Applies to a gantry what bodies did to it in this step.
    pub(super) fn strike_gantry(&mut self, i: usize, course: &Course) {
        let gantry = &mut self.gantries[i];
        let mut back = [0.0; 2];
        for (k, back) in back.iter_mut().enumerate() {
            let state = &mut gantry.states[k];
            let [low, high] = gantry.travel_m[k];
            let q = course.joints_m[k].clamp(low, high);
            let v = state.speed_m_s + course.gained[k];
            let stopped = (q == low && v < 0.0) || (q == high && v > 0.0);
            *back = q - state.position_m;
            state.position_m = q;
            state.speed_m_s = if stopped { 0.0 } else { v };
            let set = &mut self.world.multibody_joints;
            let (chain, link) = set.get_mut(gantry.joints[k]).expect("never removed");
            let at = chain.link(link).expect("its link").assembly_id();
            chain.generalized_velocity_mut()[at] = gantry.states[k].speed_m_s;
        }
        let contact = &mut gantry.contact;
        let by_rapier: f64 = contact.impulse_N_s.iter().map(Vector3::norm).sum();
        for (sum, by) in contact.impulse_N_s.iter_mut().zip(course.slides_N_s) {
            *sum += by;
        }
        contact.max_penetration_m = contact.max_penetration_m.max(course.contact.max_penetration_m);
        if let Some((most_N_s, body, at_W)) = course.hardest
            && (contact.with.is_none() || most_N_s > by_rapier)
        {
            contact.with = Some(Solid::Body(body));
            contact.at_W = Some(at_W);
        }
        self.shift(i, back);
    }
}
