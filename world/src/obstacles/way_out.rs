//! The way out of a solid for something that water carries: sideways or up, never down into the bed.

use super::{Obstacle, Obstacles};
use crate::convert::{pose, vector};
use crate::math;
use nalgebra::Vector3;
use parry3d::query::Ray;
use std::f64::consts::TAU;

/// Number of directions that are tried sideways.
const SIDES: usize = 8;
/// How far outside a surface the way ends, m: more than the rounding of single-precision positions of a kilometre.
const CLEAR_M: f64 = 1e-3;
/// Most solids that a way may pass through one after the other.
const IN_A_ROW: usize = 16;

impl Obstacle {
    /// Distance along a unit vector from a point inside to the surface, m.
    fn thickness(&self, p: &Vector3<f64>, along: &Vector3<f64>) -> Option<f64> {
        let ray = Ray::new(vector(p), vector(along));
        (self.shape).cast_ray(&pose(&self.pose), &ray, f64::MAX, false)
    }
}

impl Obstacles {
    /// The nearest free point to a point inside a solid, searched sideways and up to the surface. Returns the point
    /// itself if it is free, or if there is no way out below the surface.
    pub fn way_out(&self, p: &Vector3<f64>) -> Vector3<f64> {
        if self.containing(p).is_none() {
            return *p;
        }
        let sideways = (0..SIDES).map(|k| {
            let (s, c) = math::sin_cos(TAU * k as f64 / SIDES as f64);
            Vector3::new(c, s, 0.0)
        });
        sideways
            .chain([Vector3::z()])
            .filter_map(|along| self.out_along(p, &along))
            .min_by(|a, b| (a - p).norm().total_cmp(&(b - p).norm()))
            .unwrap_or(*p)
    }

    fn out_along(&self, p: &Vector3<f64>, along: &Vector3<f64>) -> Option<Vector3<f64>> {
        let mut q = *p;
        for _ in 0..IN_A_ROW {
            match self.containing(&q) {
                None => return (q.z <= 0.0).then_some(q),
                Some(solid) => q += along * (solid.thickness(&q, along)? + CLEAR_M),
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{LEVEL, block, built, standing};
    use super::*;

    /// Blocks of 4 m by 6 m and 3 m height at these places east.
    fn blocks(east_m: &[f64]) -> Obstacles {
        let at = |east_m: &f64| built(&standing(block([4.0, 6.0, 3.0]), [*east_m, 0.0], 90.0), &LEVEL);
        Obstacles(east_m.iter().map(at).collect())
    }

    #[test]
    fn leads_to_the_nearest_side_or_top_and_never_down() {
        let one = blocks(&[0.0]);
        let free = Vector3::new(9.0, 0.0, -7.0);
        assert_eq!(one.way_out(&free), free);
        let side = one.way_out(&Vector3::new(1.5, 0.0, -7.9));
        assert!((side - Vector3::new(2.001, 0.0, -7.9)).norm() < 1e-9);
        let top = one.way_out(&Vector3::new(0.0, 0.0, -5.2));
        assert!((top - Vector3::new(0.0, 0.0, -4.999)).norm() < 1e-9);
    }

    #[test]
    fn leads_through_solids_that_overlap() {
        let two = blocks(&[0.0, 3.0]);
        let out = two.way_out(&Vector3::new(1.9, 0.0, -7.9));
        assert!(two.containing(&out).is_none());
        // Through both solids it is 3.1 m to the east, 2.9 m up, 3.9 m to the west, and 3 m to the north or south.
        assert!((out.z + 4.999).abs() < 1e-9);
    }
}
