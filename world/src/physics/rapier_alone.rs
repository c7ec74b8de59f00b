//! A cross-check: hulls as rapier's own rigid bodies, integrated and stopped by rapier alone.
//!
//! *Source:* added mass as a force is stable with a lag of one step only if ρ(M_RB⁻¹ M_A) < 1; a REMUS hull has 1.09.
//! So rapier gets the force F = m Δv_G / h and the torque T = R I Rᵀ Δω / h that give its body the velocities of the
//! hull's own equation.
//!
//! *Parameters:* rapier's scalar mass is that of the body plus a third of the trace of its linear added mass.
//!
//! *Deviations:* rapier integrates positions in four sub-steps of first order, which makes an error of 6 mm in 230 s of
//! turning at 0.02 s. Its contacts know only the scalar mass. In long steps, its continuous collision detection does
//! not keep a hull from passing a thin plate.

use super::convert::{from_pose, from_vector, matrix, pose, vector};
use super::solid::{Body, FRICTION, Physics};
use crate::frames::Truth;
use nalgebra::Matrix3;
use rapier3d::prelude as r;

/// A hull in rapier's world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Twin {
    handle: r::RigidBodyHandle,
    mass_kg: f64,
    inertia_kg_m2: Matrix3<f64>,
}

impl Physics {
    /// Puts a body into rapier's world too.
    pub(super) fn add_twin(&mut self, body: &Body) -> Twin {
        let mass = (body.inverse_mass_G.try_inverse()).expect("the inverse of a mass matrix");
        let mass_kg = mass.fixed_view::<3, 3>(0, 0).trace() / 3.0;
        let inertia_kg_m2: Matrix3<f64> = mass.fixed_view::<3, 3>(3, 3).into();
        let props = r::MassProperties::with_inertia_matrix(vector(&body.p_BG), mass_kg, matrix(&inertia_kg_m2));
        let rigid = r::RigidBodyBuilder::dynamic()
            .pose(pose(&body.truth.pose))
            .additional_mass_properties(props)
            .gravity_scale(0.0)
            .can_sleep(false)
            .gyroscopic_forces_enabled(false)
            .ccd_enabled(true);
        let handle = self.world.insert_body(rigid);
        for (at, shape) in &body.parts {
            let collider = r::ColliderBuilder::new(shape.clone()).position(*at).density(0.0).friction(FRICTION);
            self.world.insert_collider(collider, Some(handle));
        }
        Twin { handle, mass_kg, inertia_kg_m2 }
    }

    /// One step of every body by rapier alone, contacts included.
    pub(super) fn step_alone(&mut self) {
        let dt_s = self.dt_s();
        for body in &self.bodies {
            let (free, twin) = (body.free.expect("step() filled it in"), body.twin.expect("made with the body"));
            let rb = &mut self.world.bodies[twin.handle];
            let R_WB = body.truth.pose.R_WB;
            rb.set_position(pose(&body.truth.pose), false);
            rb.set_linvel(vector(&body.v_G(&body.truth)), false);
            rb.set_angvel(vector(&(R_WB * body.truth.w_WB_B)), false);
            let dv = body.v_G(&free) - body.v_G(&body.truth);
            let dw = free.pose.R_WB * free.w_WB_B - R_WB * body.truth.w_WB_B;
            let torque = R_WB * (twin.inertia_kg_m2 * (R_WB.inverse() * dw)) / dt_s;
            rb.reset_forces(false);
            rb.reset_torques(false);
            rb.add_force(vector(&(dv * (twin.mass_kg / dt_s))), false);
            rb.add_torque(vector(&torque), false);
        }
        self.world.step();
        for i in 0..self.bodies.len() {
            let twin = self.bodies[i].twin.expect("made with the body");
            let contact = self.touched(twin.handle);
            let rb = &self.world.bodies[twin.handle];
            let pose = from_pose(rb.position());
            let w_WB_B = pose.R_WB.inverse() * from_vector(rb.angvel());
            let v_G = pose.R_WB.inverse() * from_vector(rb.linvel());
            let body = &mut self.bodies[i];
            body.truth = Truth { pose, v_WB_B: v_G - w_WB_B.cross(&body.p_BG), w_WB_B };
            body.contact = contact;
            body.free = None;
        }
    }
}
