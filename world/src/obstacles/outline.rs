//! The outline of a solid for a map.

use super::Obstacle;
use crate::math;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// Number of corners that represent a circle.
const ROUND: usize = 32;

impl Obstacle {
    /// Convex outline seen from above: corners (east, north) anticlockwise, m.
    pub fn outline(&self) -> Vec<[f64; 2]> {
        let points: Vec<Vector3<f64>> = if let Some(block) = self.shape.as_cuboid() {
            let h = block.half_extents;
            let signs = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2 & 1].map(|b| f64::from(2 * b - 1)));
            signs.map(|[x, y, z]| Vector3::new(x * h.x, y * h.y, z * h.z)).collect()
        } else if let Some(mesh) = self.shape.as_trimesh() {
            mesh.vertices().iter().map(|v| Vector3::new(v.x, v.y, v.z)).collect()
        } else {
            let local = self.shape.compute_local_aabb();
            let r = local.maxs.x;
            let turn = (0..ROUND).map(|k| math::sin_cos(TAU * k as f64 / ROUND as f64));
            // parry's cylinder stands along its own y axis; the pose turns it upright.
            turn.map(|(s, c)| Vector3::new(r * c, 0.0, r * s)).collect()
        };
        hull(points.iter().map(|p| self.pose.point(*p).xy()).collect())
    }
}

/// Convex hull by Andrew's monotone chain.
fn hull(mut points: Vec<Vector2<f64>>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut corners: Vec<Vector2<f64>> = Vec::new();
    for pass in 0..2 {
        let begin = corners.len();
        for &p in &points {
            while let [.., a, b] = corners[begin..] {
                if (b - a).perp(&(p - b)) > 0.0 {
                    break;
                }
                corners.pop();
            }
            corners.push(p);
        }
        corners.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    corners.iter().map(|p| [p.x, p.y]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hull_keeps_the_corners_only() {
        let square = [(0., 0.), (2., 0.), (1., 1.), (2., 2.), (1., 0.), (0., 2.)];
        let corners = hull(square.map(|(x, y)| Vector2::new(x, y)).to_vec());
        assert_eq!(corners, [[0., 0.], [2., 0.], [2., 2.], [0., 2.]]);
    }
}
