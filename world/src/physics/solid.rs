//! Moving rigid bodies. Each is told where its own equation of motion takes it, and gets there unless it meets
//! something solid on the way.
//!
//! *Source:* added mass as a force is stable with a lag of one step, however short, only if ρ(M_RB⁻¹ M_A) < 1; a REMUS
//! hull has 1.09. Therefore the owner of a body solves its equation with the added mass on the left side, and contacts
//! use the same mass matrix (`meet.rs`). rapier moves the gantries only, because it knows a scalar mass only
//! (`tests/it/rapier_alone.rs` compares the two).
//!
//! *Parameters:* `mass`: that of the body with its added mass.
//!
//! *Deviations:* a body on which no impulse acts is put where its own equation takes it. No contacts are searched while
//! no body has anything in reach and there is no gantry; the result is the same to the last bit.

use super::body::{Body, BodyId, BodySpec, ContactReport, FRICTION};
use super::gantry_body::Gantry;
use super::ground::{Bed, FixedSolid};
use crate::area::Area;
use crate::convert::pose;
use crate::frames::{NOT_FINITE, Pose, Truth};
use crate::obstacles::Obstacle;
use crate::terrain::Terrain;
use bevy_ecs::prelude::Resource;
use nalgebra::{Matrix6, Vector3};
use rapier3d::prelude as r;

/// The steps in which contacts are searched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Those in which a body has something in reach.
    #[default]
    WhenInReach,
    /// All steps, with the same result.
    Always,
}

/// All bodies, moving and fixed.
#[derive(Resource)]
pub struct Physics {
    dt_s: f64,
    solver: Solver,
    /// Apart, because a world of entities sets aside the room of many for each of its resources.
    pub(super) world: Box<r::PhysicsWorld>,
    pub(super) bodies: Vec<Body>,
    pub(super) gantries: Vec<Gantry>,
    pub(super) fixed: Vec<FixedSolid>,
}

impl Physics {
    /// Empty water with steps of `dt_s`, s.
    pub fn new(dt_s: f64) -> Self {
        let mut world = Box::new(r::PhysicsWorld::new());
        world.gravity = r::Vector::ZERO;
        world.integration_parameters.dt = dt_s;
        world.integration_parameters.num_solver_iterations = 4;
        Self { dt_s, solver: Solver::default(), world, bodies: Vec::new(), gantries: Vec::new(), fixed: Vec::new() }
    }

    /// Chooses the steps in which contacts are searched.
    #[must_use]
    pub fn with_solver(mut self, solver: Solver) -> Self {
        self.solver = solver;
        self
    }

    /// Length of a step, s.
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Makes the bed solid under the area and 60 m beyond it.
    pub fn add_terrain(&mut self, terrain: &Terrain, area: &Area) {
        self.add_bed(&Bed::new(terrain, area));
    }

    /// Makes a bed solid.
    pub fn add_bed(&mut self, bed: &Bed) {
        self.add_solid("bed", FixedSolid::bed(bed));
    }

    /// Makes a fixed shape solid.
    pub fn add_fixed(&mut self, at: &Pose, shape: r::SharedShape) {
        self.add_solid("a fixed shape", FixedSolid::new(pose(at), shape));
    }

    /// Makes an obstacle solid.
    pub fn add_obstacle(&mut self, obstacle: &Obstacle) {
        let fixed = FixedSolid::new(pose(&obstacle.pose), obstacle.shape.clone());
        self.add_solid(&obstacle.id, fixed);
    }

    fn add_solid(&mut self, name: &str, mut fixed: FixedSolid) {
        let collider = r::ColliderBuilder::new(fixed.shape.clone()).position(fixed.pose).friction(FRICTION);
        for body in &mut self.bodies {
            body.clear.1 = 0.0;
        }
        fixed.name = name.to_string();
        fixed.collider = self.world.insert_collider(collider, None);
        self.fixed.push(fixed);
    }

    /// Adds a moving body.
    ///
    /// # Panics
    /// If the points of a hull shape span no volume, or if the mass matrix has no inverse. Whoever reads them has to
    /// check that.
    pub fn add_body(&mut self, spec: BodySpec) -> BodyId {
        let mut reach_m: f64 = 0.0;
        let mut parts = Vec::with_capacity(spec.shapes.len());
        for (at, shape) in &spec.shapes {
            let shared =
                shape.shared().unwrap_or_else(|| panic!("body {}: a hull needs points that span a volume", spec.id));
            parts.push((pose(at), shared));
            reach_m = reach_m.max(at.p_WB.norm() + shape.reach_m());
        }
        let inverse = spec
            .mass
            .try_inverse()
            .unwrap_or_else(|| panic!("body {}: a mass matrix needs to be positive definite", spec.id));
        // v_G = v_O + ω × p.
        let mut to_G = Matrix6::identity();
        let lever = -spec.p_BG.cross_matrix();
        to_G.fixed_view_mut::<3, 3>(0, 3).copy_from(&lever);
        self.bodies.push(Body {
            id: spec.id,
            truth: spec.truth,
            free: None,
            p_BG: spec.p_BG,
            inverse_mass_G: to_G * inverse * to_G.transpose(),
            without_momentum: spec.without_momentum,
            parts,
            reach_m,
            clear: (Vector3::zeros(), 0.0),
            contact: ContactReport::default(),
        });
        BodyId(self.bodies.len() - 1)
    }

    /// True state of a body.
    pub fn truth(&self, id: BodyId) -> Truth {
        self.bodies[id.0].truth
    }

    /// Sets the state of a body. This is a beginning, not a motion.
    pub fn set_truth(&mut self, id: BodyId, truth: Truth) {
        let body = &mut self.bodies[id.0];
        body.truth = truth;
        body.free = None;
    }

    /// What a body touched in the latest step.
    pub fn contacts(&self, id: BodyId) -> ContactReport {
        self.bodies[id.0].contact
    }

    /// Distance from `from_W` along `along_W` (any length) to the first fixed solid, m, within `max_m`.
    pub fn ray(&self, from_W: &Vector3<f64>, along_W: &Vector3<f64>, max_m: f64) -> Option<f64> {
        let along = along_W.normalize();
        self.fixed
            .iter()
            .filter_map(|f| f.ray(from_W, &along, max_m))
            .fold(None, |best: Option<f64>, d| Some(best.map_or(d, |b| b.min(d))))
    }

    /// Says where a body's own equation of motion takes it in this step if it touches nothing. Without this call a body
    /// keeps its velocities.
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
            if body.free.is_none() {
                body.free = Some(body.glide(dt_s));
            }
            assert!(
                body.free.as_ref().is_some_and(Truth::is_finite),
                "body {}: state {NOT_FINITE} after {:?}; use a shorter time.step_s or weaker forces",
                body.id,
                body.truth
            );
        }
        if !self.gantries.is_empty() {
            self.world.step();
            self.read_gantries();
        }
        let always = self.solver == Solver::Always || !self.gantries.is_empty();
        if !self.bodies.is_empty() && (always || self.anything_in_reach()) {
            self.touch();
        }
        for body in &mut self.bodies {
            if let Some(free) = body.free.take() {
                body.truth = free;
                body.contact = ContactReport::default();
            }
        }
    }

    /// Puts a body that touched something where the contact left it.
    fn touch(&mut self) {
        let courses = self.meet();
        let (bodies, gantries) = courses.split_at(self.bodies.len());
        for (body, course) in self.bodies.iter_mut().zip(bodies).filter(|(_, c)| c.moved) {
            body.truth = course.truth(&body.p_BG);
            assert!(
                body.truth.is_finite(),
                "body {}: state {NOT_FINITE} after a contact; use a shorter time.step_s",
                body.id
            );
            body.contact = course.contact;
            body.free = None;
        }
        for (i, course) in gantries.iter().enumerate().filter(|(_, c)| c.moved) {
            self.strike_gantry(i, course);
        }
    }

    fn anything_in_reach(&mut self) -> bool {
        let (dt_s, fixed) = (self.dt_s, &self.fixed);
        let near_fixed = (self.bodies.iter_mut()).any(|body| body.is_near(fixed, dt_s));
        near_fixed
            || self.bodies.iter().enumerate().any(|(i, body)| {
                let (p, near_m) = (body.truth.pose.p_WB, body.near_m(dt_s));
                self.bodies[..i].iter().any(|other| (other.truth.pose.p_WB - p).norm() < near_m + other.near_m(dt_s))
            })
    }

    pub(super) fn body_name(&self, id: BodyId) -> &str {
        &self.bodies[id.0].id
    }
}
