//! The surface of a solid as triangles, to be drawn.

use super::Obstacle;
use crate::convert::from_vector;
use nalgebra::Vector3;

/// Number of corners that represent a circle.
const ROUND: u32 = 32;

impl Obstacle {
    /// Its surface: corners in the world (ENU, m), anticlockwise seen from outside.
    pub fn triangles(&self) -> Vec<[Vector3<f64>; 3]> {
        let (points, triangles) = if let Some(block) = self.shape.as_cuboid() {
            block.to_trimesh()
        } else if let Some(pillar) = self.shape.as_cylinder() {
            pillar.to_trimesh(ROUND)
        } else if let Some(mesh) = self.shape.as_trimesh() {
            (mesh.vertices().to_vec(), mesh.indices().to_vec())
        } else {
            unreachable!("an obstacle is a box, a cylinder or a mesh")
        };
        let at = |corner: u32| self.pose.point(from_vector(points[corner as usize]));
        triangles.into_iter().map(|t| t.map(at)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{LEVEL, block, built, pillar, standing};
    use super::*;

    /// By the divergence theorem, which counts a triangle that is turned inside out against the others.
    fn volume_m3(triangles: &[[Vector3<f64>; 3]]) -> f64 {
        let middle = Vector3::new(100.0, -50.0, -7.0);
        let part = |t: &[Vector3<f64>; 3]| {
            let [a, b, c] = t.map(|p| p - middle);
            a.dot(&b.cross(&c)) / 6.0
        };
        triangles.iter().map(part).sum()
    }

    #[test]
    fn surfaces_enclose_the_solid_and_look_outwards() {
        // A prism of 32 sides has 0.64 % less than the cylinder.
        let (sin, _) = crate::math::sin_cos(std::f64::consts::TAU / 32.0);
        let prism = 0.5 * 32.0 * sin * 5.0;
        for (shape, volume) in [(block([4.0, 3.0, 2.0]), 24.0), (pillar(1.0, 5.0), prism)] {
            let triangles = built(&standing(shape, [100.0, -50.0], 30.0), &LEVEL).triangles();
            assert!((volume_m3(&triangles) - volume).abs() < 1e-9);
            let low = triangles.as_flattened().iter().map(|p| p.z);
            assert!((low.fold(f64::MAX, f64::min) + 8.0).abs() < 1e-9);
        }
    }
}
