//! Body axes FLU and FRD.

use nalgebra::{Matrix6, Vector3, Vector6};

/// FLU to FRD and back: y and z change sign, also of angular vectors (a half turn about x). A zero becomes +0: the
/// published REMUS model starts from it, and in a following current atan2(±0, −u) is ±π.
pub(in crate::vehicles) fn flip(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, 0.0 - v.y, 0.0 - v.z)
}

/// A block of FLU in FRD, and back. A zero stays +0.
pub(in crate::vehicles) fn turned(block: &Matrix6<f64>) -> Matrix6<f64> {
    let turns = |k: usize| !k.is_multiple_of(3);
    Matrix6::from_fn(|i, j| if turns(i) == turns(j) { block[(i, j)] } else { 0.0 - block[(i, j)] })
}

/// Force and moment, FRD, as one vector in FLU.
pub(in crate::vehicles) fn wrench((force, moment): (Vector3<f64>, Vector3<f64>)) -> Vector6<f64> {
    Vector6::new(force.x, -force.y, -force.z, moment.x, -moment.y, -moment.z)
}
