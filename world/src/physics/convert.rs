//! Conversion between nalgebra, which our code uses, and glam, which rapier and parry use.

use crate::frames::Pose;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use rapier3d::math as r;

pub(super) fn vector(v: &Vector3<f64>) -> r::Vector {
    r::Vector::new(v.x, v.y, v.z)
}

pub(super) fn from_vector(v: r::Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

pub(super) fn rotation(q: &UnitQuaternion<f64>) -> r::Rotation {
    r::Rotation::from_xyzw(q.i, q.j, q.k, q.w)
}

pub(super) fn from_rotation(q: r::Rotation) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z))
}

pub(super) fn pose(p: &Pose) -> r::Pose {
    r::Pose::from_parts(vector(&p.p_WB), rotation(&p.R_WB))
}

pub(super) fn from_pose(p: &r::Pose) -> Pose {
    Pose { p_WB: from_vector(p.translation), R_WB: from_rotation(p.rotation) }
}

pub(super) fn matrix(m: &Matrix3<f64>) -> r::Matrix {
    r::Matrix::from_cols(
        vector(&m.column(0).into_owned()),
        vector(&m.column(1).into_owned()),
        vector(&m.column(2).into_owned()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_survives_the_way_there_and_back() {
        let p = Pose { p_WB: Vector3::new(1.0, -2.0, 3.0), R_WB: UnitQuaternion::from_euler_angles(0.3, -0.4, 2.0) };
        let q = from_pose(&pose(&p));
        assert_eq!(p.p_WB, q.p_WB);
        assert!(p.R_WB.angle_to(&q.R_WB) < 1e-14);
        let by_ours = p.point(Vector3::new(0.5, 0.25, -1.0));
        let by_theirs = pose(&p).transform_point(r::Vector::new(0.5, 0.25, -1.0));
        assert!((by_ours - from_vector(by_theirs)).norm() < 1e-14);
    }

    #[test]
    fn matrices_keep_rows_and_columns() {
        let m = Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
        let v = Vector3::new(1.0, 0.5, -0.25);
        assert_eq!(from_vector(matrix(&m) * vector(&v)), m * v);
    }
}
