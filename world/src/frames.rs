//! Poses and velocities in monogram notation. `p_WB` is the origin of B seen from W, in the axes of W. `v_WB_B` is the
//! velocity of B relative to W, in the axes of B. `R_WB` rotates the axes of B to those of W.

use crate::units::Heading;
use bevy_ecs::prelude::Component;
use nalgebra::{UnitQuaternion, Vector3};

/// Position and attitude of a body frame (FLU) in the world (ENU).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Origin of B in W, m.
    pub p_WB: Vector3<f64>,
    /// Rotation from B's axes to W's.
    pub R_WB: UnitQuaternion<f64>,
}

impl Pose {
    /// A level body at `p` with the given heading.
    #[must_use]
    pub fn level(p: Vector3<f64>, heading: Heading) -> Self {
        Self {
            p_WB: p,
            R_WB: UnitQuaternion::from_euler_angles(0.0, 0.0, heading.yaw()),
        }
    }

    /// World coordinates of a point given in body axes.
    #[must_use]
    pub fn point(&self, p_B: Vector3<f64>) -> Vector3<f64> {
        self.p_WB + self.R_WB * p_B
    }

    /// Compass heading of the body's x axis.
    #[must_use]
    pub fn heading(&self) -> Heading {
        let x = self.R_WB * Vector3::x();
        Heading::of(x.xy())
    }

    /// (roll, pitch), radians, FLU signs: roll right side down positive, pitch *nose down* positive.
    #[must_use]
    pub fn roll_pitch(&self) -> (f64, f64) {
        let (roll, pitch, _) = self.R_WB.euler_angles();
        (roll, pitch)
    }
}

/// The true state of a rigid body. A searcher never sees it.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Pose of the body frame.
    pub pose: Pose,
    /// Velocity of the body origin over ground, in body axes, m/s.
    pub v_WB_B: Vector3<f64>,
    /// Angular velocity, in body axes, rad/s.
    pub w_WB_B: Vector3<f64>,
}

impl Truth {
    /// A body at rest with a pose.
    #[must_use]
    pub fn at_rest(pose: Pose) -> Self {
        Self {
            pose,
            v_WB_B: Vector3::zeros(),
            w_WB_B: Vector3::zeros(),
        }
    }

    /// Velocity over ground in world axes, m/s.
    #[must_use]
    pub fn v_world(&self) -> Vector3<f64> {
        self.pose.R_WB * self.v_WB_B
    }

    /// Whether every number is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.pose.p_WB.iter().all(|v| v.is_finite())
            && self.pose.R_WB.coords.iter().all(|v| v.is_finite())
            && self.v_WB_B.iter().all(|v| v.is_finite())
            && self.w_WB_B.iter().all(|v| v.is_finite())
    }
}
