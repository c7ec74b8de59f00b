//! Conversion between nalgebra, which our code uses, and glam, which parry and rapier use.

use crate::frames::Pose;
use nalgebra::Vector3;
use parry3d::math as p;

pub(crate) fn vector(v: &Vector3<f64>) -> p::Vector {
    p::Vector::new(v.x, v.y, v.z)
}

pub(crate) fn from_vector(v: p::Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

pub(crate) fn pose(pose: &Pose) -> p::Pose {
    let q = pose.R_WB.coords;
    p::Pose::from_parts(vector(&pose.p_WB), p::Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::UnitQuaternion;

    #[test]
    fn a_point_of_a_pose_is_the_same_on_both_sides() {
        let ours = Pose { p_WB: Vector3::new(1.0, -2.0, 3.0), R_WB: UnitQuaternion::from_euler_angles(0.3, -0.4, 2.0) };
        let by_ours = ours.point(Vector3::new(0.5, 0.25, -1.0));
        let by_theirs = pose(&ours).transform_point(p::Vector::new(0.5, 0.25, -1.0));
        assert!((by_ours - from_vector(by_theirs)).norm() < 1e-14);
    }
}
