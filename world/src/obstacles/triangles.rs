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
    use super::super::{Base, BoxShape, CylinderShape, ObstacleSpec, ShapeSpec, Surface};
    use super::*;
    use crate::ranges::{Finite, HeadingDeg, Positive};
    use crate::terrain::Terrain;
    use std::path::Path;

    fn triangles(shape: ShapeSpec) -> Vec<[Vector3<f64>; 3]> {
        let spec = ObstacleSpec {
            id: "a".into(),
            shape,
            east_m: Finite::new(100.0),
            north_m: Finite::new(-50.0),
            heading_deg: HeadingDeg::new(30.0),
            base: Base::OnBed,
            surface: Surface::default(),
        };
        let built = Obstacle::build(&spec, &Terrain::Level { depth_m: 10.0 }, Path::new(""));
        built.unwrap().triangles()
    }

    /// By the divergence theorem, which counts a triangle that is turned inside out against the others.
    fn volume_m3(triangles: &[[Vector3<f64>; 3]]) -> f64 {
        let middle = Vector3::new(100.0, -50.0, -9.0);
        let part = |t: &[Vector3<f64>; 3]| {
            let [a, b, c] = t.map(|p| p - middle);
            a.dot(&b.cross(&c)) / 6.0
        };
        triangles.iter().map(part).sum()
    }

    #[test]
    fn surfaces_enclose_the_solid_and_look_outwards() {
        let m = Positive::new;
        let block = triangles(ShapeSpec::Box(BoxShape { size_m: (m(4.0), m(3.0), m(2.0)) }));
        assert!((volume_m3(&block) - 24.0).abs() < 1e-9);
        let pillar = triangles(ShapeSpec::Cylinder(CylinderShape { radius_m: m(1.0), height_m: m(5.0) }));
        // A prism of 32 sides has 0.64 % less.
        let (sin, _) = crate::math::sin_cos(std::f64::consts::TAU / 32.0);
        let prism = 0.5 * 32.0 * sin * 5.0;
        assert!((volume_m3(&pillar) - prism).abs() < 1e-9);
        let low = pillar.as_flattened().iter().map(|p| p.z);
        assert!((low.fold(f64::MAX, f64::min) + 10.0).abs() < 1e-9);
    }
}
