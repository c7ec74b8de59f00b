//! Moving rigid bodies: each is told where its own equation of motion takes it, and rapier decides
//! what happens where that meets something solid.
//!
//! *Source:* the force form of added mass needs ρ(M_RB⁻¹ M_A) < 1 to be stable with a lag of one
//! step, whatever the step; a REMUS hull has 1.09. So the body's own equation, added mass on the left,
//! is solved by its owner, and rapier gets the force F = m Δv_G / h and torque T = R I Rᵀ Δω / h that
//! take its (scalar) mass to the same velocities. Contacts come on top of them.
//!
//! *Parameters:* `mass_kg`, `inertia_kg_m2` as rapier sees them: the body's with its added mass.
//!
//! *Deviations:* rapier integrates positions in four sub-steps of first order (6 mm in 230 s of
//! turning at 0.02 s). A body on which no contact impulse acted is therefore put where its own
//! equation takes it, and rapier is not asked at all while no body has anything in reach (and there is no
//! gantry): the result is the same to the last bit, two and a half times as fast.

use super::convert::{from_pose, from_vector, matrix, pose, vector};
use super::gantry::Gantry;
use super::ground::Fixed;
use super::shape::Shape;
use crate::area::Area;
use crate::frames::{Pose, Truth};
use crate::obstacles::Obstacle;
use crate::terrain::Terrain;
use bevy_ecs::prelude::{Component, Resource};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use rapier3d::prelude as r;

/// Room round a body's sphere within which the solver is asked, beyond what it moves in two steps, m.
const NEAR_M: f64 = 0.1;
/// Friction coefficient of a hull on sand or concrete.
const FRICTION: f64 = 0.4;

/// Which steps go through rapier's solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Those in which a body has something in reach.
    #[default]
    WhenInReach,
    /// All, with the same result.
    Always,
    /// All, and bodies stay where rapier puts them even if they touch nothing.
    Alone,
}

/// A body as the solver needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpec {
    /// Name for messages.
    pub id: String,
    /// Where it starts.
    pub truth: Truth,
    /// Its collision shapes, each in body axes.
    pub shapes: Vec<(Pose, Shape)>,
    /// Centre of mass in body axes, m.
    pub p_BG: Vector3<f64>,
    /// Mass with a third of the trace of the linear added mass, kg.
    pub mass_kg: f64,
    /// Inertia about the centre of mass with the added inertia, body axes, kg m².
    pub inertia_kg_m2: Matrix3<f64>,
}

/// Names a body of one [`Physics`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct BodyId(pub(super) usize);

/// What a body touched in the latest step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactReport {
    /// Something pushed back.
    pub touching: bool,
    /// Deepest overlap at the beginning of the step, m.
    pub max_penetration_m: f64,
    /// Impulse on the body, world axes, N s.
    pub impulse_N_s: Vector3<f64>,
}

struct Body {
    id: String,
    handle: r::RigidBodyHandle,
    truth: Truth,
    /// Where its own equation takes it in this step.
    free: Option<Truth>,
    p_BG: Vector3<f64>,
    mass_kg: f64,
    inertia_kg_m2: Matrix3<f64>,
    reach_m: f64,
    /// rapier's copy is older than `truth`.
    stale: bool,
    contact: ContactReport,
}

impl Body {
    /// Velocity of the centre of mass in world axes, m/s.
    fn v_G(&self, t: &Truth) -> Vector3<f64> {
        t.pose.R_WB * (t.v_WB_B + t.w_WB_B.cross(&self.p_BG))
    }

    /// Straight on for a step with the velocities it has.
    fn glide(&self, dt_s: f64) -> Truth {
        let t = &self.truth;
        let v_G = self.v_G(t);
        let R_WB = t.pose.R_WB * UnitQuaternion::from_scaled_axis(t.w_WB_B * dt_s);
        let p_WG = t.pose.point(self.p_BG) + v_G * dt_s;
        Truth {
            pose: Pose {
                p_WB: p_WG - R_WB * self.p_BG,
                R_WB,
            },
            v_WB_B: R_WB.inverse() * v_G - t.w_WB_B.cross(&self.p_BG),
            w_WB_B: t.w_WB_B,
        }
    }

    /// How far from its origin anything can matter within two steps, m.
    fn near_m(&self, dt_s: f64) -> f64 {
        self.reach_m + NEAR_M + 2.0 * dt_s * self.truth.v_WB_B.norm()
    }
}

/// All bodies, moving and fixed.
#[derive(Resource)]
pub struct Physics {
    dt_s: f64,
    solver: Solver,
    pub(super) world: r::PhysicsWorld,
    bodies: Vec<Body>,
    pub(super) gantries: Vec<Gantry>,
    pub(super) fixed: Vec<Fixed>,
}

impl Physics {
    /// Empty water, stepped by `dt_s`, s.
    #[must_use]
    pub fn new(dt_s: f64) -> Self {
        let mut world = r::PhysicsWorld::new();
        world.gravity = r::Vector::ZERO;
        world.integration_parameters.dt = dt_s;
        world.integration_parameters.num_solver_iterations = 4;
        Self {
            dt_s,
            solver: Solver::default(),
            world,
            bodies: Vec::new(),
            gantries: Vec::new(),
            fixed: Vec::new(),
        }
    }

    /// Chooses which steps go through rapier's solver.
    #[must_use]
    pub fn with_solver(mut self, solver: Solver) -> Self {
        self.solver = solver;
        self
    }

    /// Length of a step, s.
    #[must_use]
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Makes the bed solid over the area and 60 m round it.
    pub fn add_terrain(&mut self, terrain: &Terrain, area: &Area) {
        self.add_solid("bed", Fixed::bed(terrain, area));
    }

    /// Makes a fixed shape solid.
    pub fn add_fixed(&mut self, at: &Pose, shape: r::SharedShape) {
        self.add_solid("a fixed shape", Fixed::new(pose(at), shape));
    }

    /// Makes an obstacle solid.
    pub fn add_obstacle(&mut self, obstacle: &Obstacle) {
        let fixed = Fixed::new(pose(&obstacle.pose), obstacle.shape.clone());
        self.add_solid(&obstacle.id, fixed);
    }

    fn add_solid(&mut self, name: &str, mut fixed: Fixed) {
        let collider = r::ColliderBuilder::new(fixed.shape.clone())
            .position(fixed.pose)
            .friction(FRICTION);
        fixed.name = name.to_string();
        fixed.collider = self.world.insert_collider(collider, None);
        self.fixed.push(fixed);
    }

    /// Adds a moving body.
    ///
    /// # Panics
    /// If the points of a hull shape span no volume: whoever read the shape has to check that.
    pub fn add_body(&mut self, spec: BodySpec) -> BodyId {
        let props = r::MassProperties::with_inertia_matrix(
            vector(&spec.p_BG),
            spec.mass_kg,
            matrix(&spec.inertia_kg_m2),
        );
        let body = r::RigidBodyBuilder::dynamic()
            .pose(pose(&spec.truth.pose))
            .additional_mass_properties(props)
            .gravity_scale(0.0)
            .can_sleep(false)
            .gyroscopic_forces_enabled(false)
            .ccd_enabled(true);
        let handle = self.world.insert_body(body);
        let mut reach_m: f64 = 0.0;
        for (at, shape) in &spec.shapes {
            let shared = shape.shared().unwrap_or_else(|| {
                panic!("body {}: a hull needs points that span a volume", spec.id)
            });
            let collider = r::ColliderBuilder::new(shared)
                .position(pose(at))
                .density(0.0)
                .friction(FRICTION);
            self.world.insert_collider(collider, Some(handle));
            reach_m = reach_m.max(at.p_WB.norm() + shape.reach_m());
        }
        self.bodies.push(Body {
            id: spec.id,
            handle,
            truth: spec.truth,
            free: None,
            p_BG: spec.p_BG,
            mass_kg: spec.mass_kg,
            inertia_kg_m2: spec.inertia_kg_m2,
            reach_m,
            stale: true,
            contact: ContactReport::default(),
        });
        BodyId(self.bodies.len() - 1)
    }

    /// True state of a body.
    #[must_use]
    pub fn truth(&self, id: BodyId) -> Truth {
        self.bodies[id.0].truth
    }

    /// Puts a body into a state: a beginning, not a motion.
    pub fn set_truth(&mut self, id: BodyId, truth: Truth) {
        let body = &mut self.bodies[id.0];
        body.truth = truth;
        body.free = None;
        body.stale = true;
    }

    /// What a body touched in the latest step.
    #[must_use]
    pub fn contacts(&self, id: BodyId) -> ContactReport {
        self.bodies[id.0].contact
    }

    /// Distance from `from_W` along `along_W` (any length) to the first fixed solid, m, within `max_m`.
    #[must_use]
    pub fn ray(&self, from_W: &Vector3<f64>, along_W: &Vector3<f64>, max_m: f64) -> Option<f64> {
        let along = along_W.normalize();
        self.fixed
            .iter()
            .filter_map(|f| f.ray(from_W, &along, max_m))
            .fold(None, |best: Option<f64>, d| {
                Some(best.map_or(d, |b| b.min(d)))
            })
    }

    /// Says where a body's own equation of motion takes it in this step if it touches nothing. A
    /// body of which nothing is said glides on as it moves.
    pub fn push(&mut self, id: BodyId, free: Truth) {
        self.bodies[id.0].free = Some(free);
    }

    /// One step.
    ///
    /// # Panics
    /// If a body's state is no longer finite.
    pub fn step(&mut self) {
        let dt_s = self.dt_s;
        for body in &mut self.bodies {
            let free = body.free.unwrap_or_else(|| body.glide(dt_s));
            body.free = Some(free);
            assert!(
                free.is_finite(),
                "body {}: state is no longer finite after {:?}; use a shorter time.step_s or weaker forces",
                body.id,
                body.truth
            );
        }
        // The joints of a gantry are rapier's: it is asked in every step.
        let always = self.solver != Solver::WhenInReach || !self.gantries.is_empty();
        if always || self.anything_in_reach() {
            self.solve();
        }
        for body in &mut self.bodies {
            if let Some(free) = body.free.take() {
                body.truth = free;
                body.stale = true;
                body.contact = ContactReport::default();
            }
        }
    }

    fn anything_in_reach(&self) -> bool {
        self.bodies.iter().enumerate().any(|(i, body)| {
            let (p, near_m) = (body.truth.pose.p_WB, body.near_m(self.dt_s));
            self.fixed.iter().any(|f| f.within(&p, near_m))
                || self.bodies[..i].iter().any(|other| {
                    (other.truth.pose.p_WB - p).norm() < near_m + other.near_m(self.dt_s)
                })
        })
    }

    /// Lets rapier step; takes its word for bodies that were touched.
    fn solve(&mut self) {
        for body in &mut self.bodies {
            let free = body.free.expect("step() filled it in");
            let rb = &mut self.world.bodies[body.handle];
            if body.stale {
                rb.set_position(pose(&body.truth.pose), false);
                rb.set_linvel(vector(&body.v_G(&body.truth)), false);
                rb.set_angvel(vector(&(body.truth.pose.R_WB * body.truth.w_WB_B)), false);
                body.stale = false;
            }
            let dv = body.v_G(&free) - body.v_G(&body.truth);
            let dw = free.pose.R_WB * free.w_WB_B - body.truth.pose.R_WB * body.truth.w_WB_B;
            let R = body.truth.pose.R_WB;
            let torque = R * (body.inertia_kg_m2 * (R.inverse() * dw)) / self.dt_s;
            rb.reset_forces(false);
            rb.reset_torques(false);
            rb.add_force(vector(&(dv * (body.mass_kg / self.dt_s))), false);
            rb.add_torque(vector(&torque), false);
        }
        self.world.step();
        self.read_gantries();
        for i in 0..self.bodies.len() {
            let contact = self.touched(self.bodies[i].handle);
            let body = &mut self.bodies[i];
            if !contact.touching && self.solver != Solver::Alone {
                continue;
            }
            let rb = &self.world.bodies[body.handle];
            let pose = from_pose(rb.position());
            let w_WB_B = pose.R_WB.inverse() * from_vector(rb.angvel());
            let v_G = pose.R_WB.inverse() * from_vector(rb.linvel());
            body.truth = Truth {
                pose,
                v_WB_B: v_G - w_WB_B.cross(&body.p_BG),
                w_WB_B,
            };
            assert!(
                body.truth.is_finite(),
                "body {}: state is no longer finite after a contact; use a shorter time.step_s",
                body.id
            );
            body.contact = contact;
            body.free = None;
        }
    }

    pub(super) fn body_name(&self, id: BodyId) -> &str {
        &self.bodies[id.0].id
    }

    pub(super) fn body_of(&self, handle: r::RigidBodyHandle) -> Option<BodyId> {
        let i = self.bodies.iter().position(|b| b.handle == handle)?;
        Some(BodyId(i))
    }

    pub(super) fn touched(&self, handle: r::RigidBodyHandle) -> ContactReport {
        let mut report = ContactReport::default();
        for &collider in self.world.bodies[handle].colliders() {
            for pair in self.world.contact_pairs_with(collider) {
                if pair.total_impulse_magnitude() <= 0.0 {
                    continue;
                }
                // rapier's normals point from the first collider of a pair to the second.
                let sign = if pair.collider1 == collider {
                    -1.0
                } else {
                    1.0
                };
                report.touching = true;
                report.impulse_N_s += from_vector(pair.total_impulse()) * sign;
                if let Some((_, deepest)) = pair.find_deepest_contact() {
                    report.max_penetration_m = report.max_penetration_m.max(-deepest.dist);
                }
            }
        }
        report
    }
}
