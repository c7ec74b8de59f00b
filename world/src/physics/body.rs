//! A body that moves, and what it touched.

use super::ground::FixedSolid;
use super::shape::Shape;
use crate::convert::vector;
use crate::frames::{Pose, Truth};
use bevy_ecs::prelude::Component;
use nalgebra::{Matrix6, UnitQuaternion, Vector3};
use rapier3d::parry::bounding_volume::BoundingVolume;
use rapier3d::prelude as r;

/// Distance round a body's sphere within which contacts are searched, beyond its motion in two steps, m.
const NEAR_M: f64 = 0.1;
/// Friction coefficient of a hull on sand or concrete.
pub(super) const FRICTION: f64 = 0.4;

/// A body as the solver needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpec {
    /// Name for error messages.
    pub id: String,
    /// Where it starts.
    pub truth: Truth,
    /// Its collision shapes, each in body axes.
    pub shapes: Vec<(Pose, Shape)>,
    /// Centre of mass in body axes, m.
    pub p_BG: Vector3<f64>,
    /// Mass matrix for the velocity of the body's origin and the angular velocity, in body axes, with added mass: kg,
    /// kg m, kg m²; symmetric and positive definite.
    pub mass: Matrix6<f64>,
    /// Whether it has no momentum: it goes where it is told, contacts stop it and move it aside without turning it, and it
    /// slides along them without friction. It turns as it is told wherever there is room.
    pub without_momentum: bool,
}

/// Identifies a body of one [`Physics`](super::Physics).
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct BodyId(pub(super) usize);

/// What a body touched in the latest step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactReport {
    /// Whether anything pushed back.
    pub touching: bool,
    /// Whether that was another body that moves freely, and nothing else.
    pub only_bodies: bool,
    /// Deepest overlap in the step, m.
    pub max_penetration_m: f64,
    /// Impulse on the body, world axes, N s.
    pub impulse_N_s: Vector3<f64>,
}

pub(super) struct Body {
    pub(super) id: String,
    pub(super) truth: Truth,
    /// Where its own equation takes it in this step.
    pub(super) free: Option<Truth>,
    pub(super) p_BG: Vector3<f64>,
    /// Inverse of the mass matrix about the centre of mass.
    pub(super) inverse_mass_G: Matrix6<f64>,
    pub(super) without_momentum: bool,
    /// Its shapes in body axes.
    pub(super) parts: Vec<(r::Pose, r::SharedShape)>,
    pub(super) reach_m: f64,
    /// A sphere without anything fixed in it: its middle and radius, m.
    pub(super) clear: (Vector3<f64>, f64),
    pub(super) contact: ContactReport,
}

impl Body {
    /// Velocity of the centre of mass in world axes, m/s.
    pub(super) fn v_G(&self, t: &Truth) -> Vector3<f64> {
        t.pose.R_WB * (t.v_WB_B + t.w_WB_B.cross(&self.p_BG))
    }

    /// Where it gets in a step if it keeps its velocities.
    pub(super) fn glide(&self, dt_s: f64) -> Truth {
        let t = &self.truth;
        let v_G = self.v_G(t);
        let R_WB = t.pose.R_WB * UnitQuaternion::from_scaled_axis(t.w_WB_B * dt_s);
        let p_WG = t.pose.point(self.p_BG) + v_G * dt_s;
        Truth {
            pose: Pose { p_WB: p_WG - R_WB * self.p_BG, R_WB },
            v_WB_B: R_WB.inverse() * v_G - t.w_WB_B.cross(&self.p_BG),
            w_WB_B: t.w_WB_B,
        }
    }

    /// Distance from its origin within which anything can matter in two steps, m.
    pub(super) fn near_m(&self, dt_s: f64) -> f64 {
        let way_m = self.free.map_or(0.0, |free| (free.pose.p_WB - self.truth.pose.p_WB).norm());
        self.reach_m + NEAR_M + way_m.max(2.0 * dt_s * self.truth.v_WB_B.norm())
    }

    /// A box that it does not leave in this step: its centre of mass goes straight, and it turns about it.
    fn swept(&self) -> r::Aabb {
        let start = vector(&self.truth.pose.p_WB);
        let end = self.free.map_or(start, |free| vector(&free.pose.p_WB));
        r::Aabb::new(start.min(end), start.max(end)).loosened(self.reach_m + 2.0 * self.p_BG.norm() + NEAR_M)
    }

    /// Whether anything fixed can matter in this step. While the body stays in a sphere that is known to be clear,
    /// nothing is searched.
    pub(super) fn is_near(&mut self, fixed: &[FixedSolid], dt_s: f64) -> bool {
        let (p, near_m) = (self.truth.pose.p_WB, self.near_m(dt_s));
        let (middle, radius_m) = self.clear;
        if (p - middle).norm() + near_m < radius_m || !fixed.iter().any(|f| f.meets(&self.swept())) {
            return false;
        }
        let away = fixed.iter().map(|f| f.away_m(&p, near_m));
        let away_m = away.fold(f64::INFINITY, f64::min);
        self.clear = (p, away_m);
        away_m <= near_m
    }
}
