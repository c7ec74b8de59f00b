//! Bodies in few words.

use super::{BodySpec, Shape};
use crate::frames::{Pose, Truth};
use crate::units::Heading;
use nalgebra::{Matrix6, Vector3};

/// A level pose; its x axis points east.
pub(super) fn level(x: f64, y: f64, z: f64) -> Pose {
    Pose::level(Vector3::new(x, y, z), Heading::from_deg(90.0))
}

/// A body of one shape, with its centre of mass at its origin.
pub(super) fn body(id: &str, truth: Truth, shape: Shape, mass: [f64; 6]) -> BodySpec {
    BodySpec {
        id: id.into(),
        truth,
        shapes: vec![(level(0.0, 0.0, 0.0), shape)],
        p_BG: Vector3::zeros(),
        mass: Matrix6::from_diagonal(&mass.into()),
        without_momentum: false,
    }
}
