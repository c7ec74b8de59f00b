//! Two driven slides, one carried by the other: the axes of a gantry as joints of rapier.
//!
//! *Source:* R. Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, ch. 3 (reduced coordinates). The inner
//! loop of a servo makes the axis follow a commanded speed within the force available.
//!
//! *Parameters:* `travel_m`, `mass_kg` of each axis; `speed_m_s`, `max_force_N`, `response_s` of each drive.
//!
//! *Deviations:* the chain is a multibody of rapier with two coordinates, so nothing drifts off its rail. rapier acts
//! on a limit only after it has been passed. Therefore, an end stop that takes all speed is set at each limit after the
//! step, and a joint is never beyond its limit. Bearings have no friction and carry all weight. Contacts of a gantry
//! slide without friction, so that the forces of the drives follow from the balance of momentum (rapier does not report
//! those of a multibody's motors). A gantry does not touch itself. When 25 kg are driven into a fixed solid at 0.15 m/s
//! with 200 N, they overlap it by less than 0.1 mm (a test checks this).

use super::gantry_body::{AxisDrive, Gantry, GantryBodySpec, GantryContact, GantryId, JointState, Solid};
use super::shape::Shape;
use super::solid::Physics;
use crate::convert::{from_vector, pose, vector};
use crate::frames::{Pose, Truth};
use nalgebra::Vector3;
use rapier3d::prelude as r;

impl Physics {
    /// Adds a gantry.
    ///
    /// # Panics
    /// If a direction is not a unit vector, if a start lies outside its travel, or if the points of a hull span no
    /// volume. Whoever reads them has to check that.
    pub fn add_gantry(&mut self, spec: GantryBodySpec) -> GantryId {
        let id = &spec.id;
        let fixed = r::RigidBodyBuilder::fixed().pose(pose(&spec.base));
        let base_handle = self.world.insert_body(fixed);
        self.dress(id, base_handle, &spec.base_shapes);
        let mut parent = base_handle;
        let mut slides = [base_handle; 2];
        let mut joints = Vec::with_capacity(2);
        for (k, axis) in spec.axes.iter().enumerate() {
            let [low, high] = axis.travel_m;
            assert!(
                (axis.along_B.norm() - 1.0).abs() < 1e-9 && axis.mass_kg > 0.0,
                "gantry {id}: axis {k} needs a direction of length 1 and a mass > 0"
            );
            assert!(
                low < high && (low..=high).contains(&spec.start_m[k]),
                "gantry {id}: axis {k} cannot start at {} m in {low} to {high} m",
                spec.start_m[k]
            );
            // It never turns, so any inertia will do.
            let props = r::MassProperties::new(r::Vector::ZERO, axis.mass_kg, r::Vector::splat(axis.mass_kg));
            let slide = r::RigidBodyBuilder::dynamic()
                .pose(pose(&spec.base))
                .additional_mass_properties(props)
                .can_sleep(false);
            let slide = self.world.insert_body(slide);
            self.dress(id, slide, &axis.shapes);
            let joint = r::PrismaticJointBuilder::new(vector(&axis.along_B))
                .limits(axis.travel_m)
                .motor_velocity(0.0, 1.0)
                .motor_max_force(0.0);
            let joint =
                self.world.insert_multibody_joint(parent, slide, joint).expect("a chain of new bodies has no loop");
            joints.push(joint);
            slides[k] = slide;
            parent = slide;
        }
        let joints = [joints[0], joints[1]];
        let start = |k: usize| JointState { position_m: spec.start_m[k], ..JointState::default() };
        self.gantries.push(Gantry {
            id: spec.id,
            base: spec.base,
            base_handle,
            slides,
            joints,
            along_B: spec.axes.each_ref().map(|a| a.along_B),
            travel_m: spec.axes.each_ref().map(|a| a.travel_m),
            mass_kg: spec.axes.each_ref().map(|a| a.mass_kg),
            drives: [AxisDrive::default(); 2],
            states: [start(0), start(1)],
            before_m: spec.start_m,
            contact: GantryContact::default(),
        });
        let (chain, _) = self.world.multibody_joints.get_mut(joints[1]).expect("new");
        chain.set_self_contacts_enabled(false);
        // This tells rapier that the base is fixed; only then are there just two coordinates.
        chain.forward_kinematics(&self.world.bodies, true);
        assert_eq!(chain.ndofs(), 2);
        self.shift(self.gantries.len() - 1, spec.start_m);
        GantryId(self.gantries.len() - 1)
    }

    fn dress(&mut self, id: &str, on: r::RigidBodyHandle, shapes: &[(Pose, Shape)]) {
        for (at, shape) in shapes {
            let shared =
                shape.shared().unwrap_or_else(|| panic!("gantry {id}: a hull needs points that span a volume"));
            let collider = r::ColliderBuilder::new(shared)
                .position(pose(at))
                .density(0.0)
                .friction(0.0)
                .friction_combine_rule(r::CoefficientCombineRule::Multiply);
            self.world.insert_collider(collider, Some(on));
        }
    }

    /// Shifts the joints at once.
    pub(super) fn shift(&mut self, gantry: usize, by_m: [f64; 2]) {
        let joint = self.gantries[gantry].joints[1];
        let set = &mut self.world.multibody_joints;
        let (chain, _) = set.get_mut(joint).expect("never removed");
        chain.apply_displacements(&by_m);
        chain.forward_kinematics(&self.world.bodies, false);
        chain.update_rigid_bodies(&mut self.world.bodies, true);
    }

    /// Sets the commands of the drives until the next call.
    ///
    /// # Panics
    /// If a number is not finite, a force negative or a response not positive.
    pub fn drive(&mut self, id: GantryId, drives: [AxisDrive; 2]) {
        let gantry = &self.gantries[id.0];
        for (k, drive) in drives.iter().enumerate() {
            assert!(
                drive.speed_m_s.is_finite() && drive.max_force_N >= 0.0 && drive.response_s > 0.0,
                "gantry {}: axis {k} cannot be driven by {drive:?}; mend the drive's parameters",
                gantry.id
            );
            let set = &mut self.world.multibody_joints;
            let (chain, link) = set.get_mut(gantry.joints[k]).expect("never removed");
            let motor = &mut chain.link_mut(link).expect("its link").joint.data.motors[0];
            motor.target_vel = drive.speed_m_s;
            motor.damping = 1.0 / drive.response_s;
            motor.max_force = drive.max_force_N;
        }
        self.gantries[id.0].drives = drives;
    }

    /// The joints after the latest step.
    pub fn joints(&self, id: GantryId) -> [JointState; 2] {
        self.gantries[id.0].states
    }

    /// Pose of the base axes as if the second slide carried them; it never turns.
    pub fn head(&self, id: GantryId) -> Truth {
        let g = &self.gantries[id.0];
        let [a, b] = &g.states;
        Truth {
            pose: Pose {
                p_WB: g.base.point(g.along_B[0] * a.position_m + g.along_B[1] * b.position_m),
                R_WB: g.base.R_WB,
            },
            v_WB_B: g.along_B[0] * a.speed_m_s + g.along_B[1] * b.speed_m_s,
            w_WB_B: Vector3::zeros(),
        }
    }

    /// What a gantry touched in the latest step.
    pub fn gantry_contact(&self, id: GantryId) -> GantryContact {
        self.gantries[id.0].contact
    }

    /// Reads the state of the gantries after a step of rapier.
    pub(super) fn read_gantries(&mut self) {
        for i in 0..self.gantries.len() {
            let touched = self.gantries[i].slides.map(|s| self.touched(s));
            let contact = self.gantry_touch(i, &touched);
            let gantry = &mut self.gantries[i];
            gantry.before_m = gantry.states.map(|s| s.position_m);
            let gantry = &self.gantries[i];
            let mut states = gantry.states;
            let mut back = [0.0; 2];
            let mut freed = [0.0; 2];
            for k in 0..2 {
                let set = &mut self.world.multibody_joints;
                let (chain, link) = set.get_mut(gantry.joints[k]).expect("never removed");
                let link = *chain.link(link).expect("its link");
                let q = link.joint.coords()[0];
                let v = chain.joint_velocity(&link)[0];
                assert!(
                    q.is_finite() && v.is_finite(),
                    "gantry {}: axis {k} is no longer finite after {states:?}; use a shorter time.step_s",
                    gantry.id
                );
                freed[k] = v;
                let [low, high] = gantry.travel_m[k];
                let held = q.clamp(low, high);
                back[k] = held - q;
                let stopped = (held == low && v < 0.0) || (held == high && v > 0.0);
                if stopped {
                    chain.generalized_velocity_mut()[link.assembly_id()] = 0.0;
                }
                states[k].position_m = held;
                states[k].speed_m_s = if stopped { 0.0 } else { v };
            }
            let before = gantry.momentum(gantry.states.map(|s| s.speed_m_s));
            let after = gantry.momentum(freed);
            let pushed = touched.map(|t| gantry.base.R_WB.inverse() * t.impulse_N_s);
            let by_contact = [(pushed[0] + pushed[1]).dot(&gantry.along_B[0]), pushed[1].dot(&gantry.along_B[1])];
            for k in 0..2 {
                let force_N = (after[k] - before[k] - by_contact[k]) / self.dt_s();
                let most = gantry.drives[k].max_force_N;
                // At an end of the travel, any force beyond the drive's comes from the end stop.
                let [low, high] = gantry.travel_m[k];
                let way = 2.0 * self.dt_s() * gantry.drives[k].speed_m_s.abs();
                let q = states[k].position_m;
                let at_stop = q - low <= way || high - q <= way;
                states[k].force_N = if at_stop { force_N.clamp(-most, most) } else { force_N };
            }
            self.gantries[i].states = states;
            self.gantries[i].contact = contact;
            if back != [0.0; 2] {
                self.shift(i, back);
            }
        }
    }

    /// Name of something solid, for messages.
    pub fn name(&self, solid: Solid) -> &str {
        match solid {
            Solid::Fixed(i) => &self.fixed[i].name,
            Solid::Body(id) => self.body_name(id),
            Solid::Gantry(id) => &self.gantries[id.0].id,
        }
    }

    /// The point at which one collider of a pair touches the other, as the solver found it.
    pub(super) fn touch_point(&self, pair: &r::ContactPair) -> Option<Vector3<f64>> {
        let (manifold, deepest) = pair.find_deepest_contact()?;
        let first = self.world.colliders.get(pair.collider1)?;
        let part = manifold.subshape_pos1().copied().unwrap_or(r::Pose::IDENTITY);
        let point = (*first.position() * part).transform_point(deepest.local_p1);
        Some(from_vector(point))
    }
}
