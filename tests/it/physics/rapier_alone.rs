//! A cross-check: a hull as rapier's own rigid body, integrated by rapier alone.
//!
//! *Source:* added mass as a force is stable with a lag of one step only if ρ(M_RB⁻¹ M_A) < 1; a REMUS hull has 1.09.
//! So rapier gets the force F = m Δv_G / h and the torque T = R I Rᵀ Δω / h that give its body the velocities of the
//! hull's own equation.
//!
//! *Parameters:* rapier's scalar mass is that of the body plus a third of the trace of its linear added mass.
//!
//! *Deviations:* rapier integrates positions in four sub-steps of first order, which makes an error of 6 mm in 230 s of
//! turning at 0.02 s.

use nalgebra::{Matrix3, Matrix6, Quaternion, UnitQuaternion, Vector3};
use rapier3d::prelude as r;
use world::frames::{Pose, Truth};
use world::physics::BodySpec;

/// A hull in rapier's world.
pub(crate) struct RapierAlone {
    world: r::PhysicsWorld,
    handle: r::RigidBodyHandle,
    p_BG: Vector3<f64>,
    mass_kg: f64,
    inertia_kg_m2: Matrix3<f64>,
    pub(crate) truth: Truth,
}

fn vector(v: Vector3<f64>) -> r::Vector {
    r::Vector::new(v.x, v.y, v.z)
}

fn from_vector(v: r::Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

fn pose(p: &Pose) -> r::Pose {
    let q = p.R_WB.coords;
    r::Pose::from_parts(vector(p.p_WB), r::Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

impl RapierAlone {
    /// A body that meets nothing, in steps of `dt_s`.
    pub(crate) fn new(spec: &BodySpec, dt_s: f64) -> Self {
        let mut world = r::PhysicsWorld::new();
        world.gravity = r::Vector::ZERO;
        world.integration_parameters.dt = dt_s;
        world.integration_parameters.num_solver_iterations = 4;
        // About the centre of mass: v_G = v_O + ω × p.
        let mut to_O = Matrix6::identity();
        to_O.fixed_view_mut::<3, 3>(0, 3).copy_from(&spec.p_BG.cross_matrix());
        let mass = to_O.transpose() * spec.mass * to_O;
        let mass_kg = mass.fixed_view::<3, 3>(0, 0).trace() / 3.0;
        let inertia_kg_m2: Matrix3<f64> = mass.fixed_view::<3, 3>(3, 3).into();
        let column = |k: usize| vector(inertia_kg_m2.column(k).into());
        let inertia = r::Matrix::from_cols(column(0), column(1), column(2));
        let rigid = r::RigidBodyBuilder::dynamic()
            .pose(pose(&spec.truth.pose))
            .additional_mass_properties(r::MassProperties::with_inertia_matrix(vector(spec.p_BG), mass_kg, inertia))
            .gravity_scale(0.0)
            .can_sleep(false)
            .gyroscopic_forces_enabled(false);
        let handle = world.insert_body(rigid);
        Self { world, handle, p_BG: spec.p_BG, mass_kg, inertia_kg_m2, truth: spec.truth }
    }

    /// Velocity of the centre of mass in world axes, m/s.
    fn v_G(&self, t: &Truth) -> Vector3<f64> {
        t.pose.R_WB * (t.v_WB_B + t.w_WB_B.cross(&self.p_BG))
    }

    /// One step towards where its own equation takes it.
    pub(crate) fn step(&mut self, free: &Truth) {
        let dt_s = self.world.integration_parameters.dt;
        let R_WB = self.truth.pose.R_WB;
        let v_G = self.v_G(&self.truth);
        let dv = self.v_G(free) - v_G;
        let dw = free.pose.R_WB * free.w_WB_B - R_WB * self.truth.w_WB_B;
        let torque = R_WB * (self.inertia_kg_m2 * (R_WB.inverse() * dw)) / dt_s;
        let rb = &mut self.world.bodies[self.handle];
        rb.set_position(pose(&self.truth.pose), false);
        rb.set_linvel(vector(v_G), false);
        rb.set_angvel(vector(R_WB * self.truth.w_WB_B), false);
        rb.reset_forces(false);
        rb.reset_torques(false);
        rb.add_force(vector(dv * (self.mass_kg / dt_s)), false);
        rb.add_torque(vector(torque), false);
        self.world.step();
        let rb = &self.world.bodies[self.handle];
        let q = rb.position().rotation;
        let R_WB = UnitQuaternion::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z));
        let w_WB_B = R_WB.inverse() * from_vector(rb.angvel());
        let v_G = R_WB.inverse() * from_vector(rb.linvel());
        self.truth = Truth {
            pose: Pose { p_WB: from_vector(rb.position().translation), R_WB },
            v_WB_B: v_G - w_WB_B.cross(&self.p_BG),
            w_WB_B,
        };
    }
}
