//! Poses and velocities in monogram notation. `p_WB` is the origin of B seen from W, in the axes of W. `v_WB_B` is the
//! velocity of B relative to W, in the axes of B. `R_WB` rotates the axes of B to those of W.

use crate::math;
use crate::units::Heading;
use bevy_ecs::prelude::Component;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

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
    pub fn level(p: Vector3<f64>, heading: Heading) -> Self {
        // `from_euler_angles` with two angles of zero, whose sines and cosines are known.
        let (s, c) = math::sin_cos(heading.yaw() * 0.5);
        Self { p_WB: p, R_WB: UnitQuaternion::new_unchecked(Quaternion::new(c, 0.0, 0.0, s)) }
    }

    /// World coordinates of a point given in body axes.
    pub fn point(&self, p_B: Vector3<f64>) -> Vector3<f64> {
        self.p_WB + self.R_WB * p_B
    }

    /// Compass heading of the body's x axis.
    pub fn heading(&self) -> Heading {
        let x = self.R_WB * Vector3::x();
        Heading::from_vector(x.xy())
    }

    /// (roll, pitch), radians, FLU signs: roll right side down positive, pitch *nose down* positive.
    pub fn roll_pitch(&self) -> (f64, f64) {
        // `euler_angles` without the third. Straight up and down it chooses the roll as it likes.
        let q = &self.R_WB;
        let nose = q.i * q.k * 2.0 - q.w * q.j * 2.0;
        if nose.abs() >= 1.0 {
            let (roll, pitch, _) = q.euler_angles();
            return (roll, pitch);
        }
        let pitch = -math::asin(nose);
        let level = math::cos(pitch);
        let across = q.w * q.i * 2.0 + q.j * q.k * 2.0;
        let upright = q.w * q.w - q.i * q.i - q.j * q.j + q.k * q.k;
        (math::atan2(across / level, upright / level), pitch)
    }
}

/// What is said of a state that is no number.
pub const NOT_FINITE: &str = "is no longer finite";

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
    pub fn at_rest(pose: Pose) -> Self {
        Self { pose, v_WB_B: Vector3::zeros(), w_WB_B: Vector3::zeros() }
    }

    /// Velocity over ground in world axes, m/s.
    pub fn v_world(&self) -> Vector3<f64> {
        self.pose.R_WB * self.v_WB_B
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.pose.p_WB.iter().all(|v| v.is_finite())
            && self.pose.R_WB.coords.iter().all(|v| v.is_finite())
            && self.v_WB_B.iter().all(|v| v.is_finite())
            && self.w_WB_B.iter().all(|v| v.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeds::Stream;
    use nalgebra::Vector4;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn bits(q: &UnitQuaternion<f64>) -> Vector4<u64> {
        q.coords.map(f64::to_bits)
    }

    #[test]
    fn a_level_pose_has_a_heading_and_two_angles_of_zero() {
        let mut random = Stream::new(1, "test", "headings");
        let odd = [0.0, FRAC_PI_2, PI, 1.5 * PI].map(Heading::from_rad);
        let headings = (0..2000).map(|_| Heading::from_rad(random.uniform() * 7.0));
        for heading in headings.chain(odd) {
            let plain = UnitQuaternion::from_euler_angles(0.0, 0.0, heading.yaw());
            let level = Pose::level(Vector3::zeros(), heading);
            assert_eq!(bits(&level.R_WB), bits(&plain), "{heading:?}");
        }
    }

    #[test]
    fn roll_and_pitch_are_two_of_the_euler_angles() {
        let mut random = Stream::new(1, "test", "attitudes");
        let same = |R_WB: UnitQuaternion<f64>| {
            let pose = Pose { p_WB: Vector3::zeros(), R_WB };
            let ((roll, pitch), plain) = (pose.roll_pitch(), R_WB.euler_angles());
            let plain = (plain.0.to_bits(), plain.1.to_bits());
            assert_eq!((roll.to_bits(), pitch.to_bits()), plain, "{R_WB:?}");
        };
        for _ in 0..5000 {
            let all = Vector4::from_fn(|_, _| random.normal());
            same(UnitQuaternion::new_normalize(Quaternion::from_vector(all)));
            same(Pose::level(Vector3::zeros(), Heading::from_rad(random.uniform() * 7.0)).R_WB);
        }
        for pitch in [FRAC_PI_2, -FRAC_PI_2] {
            same(UnitQuaternion::from_euler_angles(0.3, pitch, 1.0));
        }
    }
}
