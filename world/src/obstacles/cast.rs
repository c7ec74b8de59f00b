//! Where a ray first meets a solid, and the direction of the surface there. Cameras and sonars ask this.

use super::{Obstacle, Obstacles, Surface};
use crate::convert::{from_vector, pose, vector};
use nalgebra::Vector3;
use parry3d::query::Ray;

/// The first thing a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Hit<'a> {
    /// Distance along the ray, m; zero if the ray starts inside.
    pub way_m: f64,
    /// Outward unit normal there; opposite to the ray if it starts inside.
    pub normal: Vector3<f64>,
    /// Index of the obstacle in the scenario.
    pub obstacle: usize,
    /// How its surface looks and sounds.
    pub surface: &'a Surface,
}

impl Obstacle {
    /// Casts a ray from `origin` (ENU, m) in the unit direction `dir`. Returns the distance to the first hit within
    /// `max_m`, m, and the outward unit normal there. A ray that starts inside returns zero and the direction
    /// backwards.
    pub fn cast(&self, origin: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> Option<(f64, Vector3<f64>)> {
        if self.contains(origin) {
            return Some((0.0, -dir));
        }
        let ray = Ray::new(vector(origin), vector(dir));
        let met = (self.shape).cast_ray_and_get_normal(&pose(&self.pose), &ray, max_m, true)?;
        Some((met.time_of_impact, from_vector(met.normal)))
    }

    /// Centre and radius of a ball that encloses it, m.
    pub fn ball(&self) -> (Vector3<f64>, f64) {
        let (low, high) = self.bounds();
        (0.5 * (low + high), 0.5 * (high - low).norm())
    }
}

impl Obstacles {
    /// The first hit on any obstacle along a ray from `origin` (ENU, m) in the unit direction `dir` within `max_m`, m.
    pub fn cast(&self, origin: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> Option<Hit<'_>> {
        self.0
            .iter()
            .enumerate()
            .filter_map(|(obstacle, o)| {
                let (way_m, normal) = o.cast(origin, dir, max_m)?;
                Some(Hit { way_m, normal, obstacle, surface: &o.surface })
            })
            .min_by(|a, b| a.way_m.total_cmp(&b.way_m))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{LEVEL, block, built, standing};
    use super::super::{ObstacleSpec, Surface};
    use super::*;
    use crate::ranges::Finite;

    fn cube(east_m: f64) -> Obstacle {
        let surface = Surface { backscatter_db: Finite::new(-5.0), ..Surface::default() };
        built(&ObstacleSpec { surface, ..standing(block([2.0; 3]), [east_m, 0.0], 90.0) }, &LEVEL)
    }

    #[test]
    fn the_nearer_face_is_met_with_its_normal() {
        let two = Obstacles(vec![cube(20.0), cube(10.0)]);
        let from = Vector3::new(0.0, 0.0, -7.0);
        let hit = two.cast(&from, &Vector3::x(), 50.0).unwrap();
        assert!((hit.way_m - 9.0).abs() < 1e-12 && hit.obstacle == 1);
        assert!((hit.normal + Vector3::x()).norm() < 1e-12);
        assert_eq!(hit.surface.backscatter_db.get(), -5.0);
        let down = two.cast(&Vector3::new(10.5, 0.0, -3.0), &-Vector3::z(), 50.0).unwrap();
        assert!((down.way_m - 3.0).abs() < 1e-12 && (down.normal.z - 1.0).abs() < 1e-12);
        assert!(two.cast(&from, &Vector3::x(), 8.9).is_none());
    }

    #[test]
    fn the_ball_holds_the_solid() {
        let (middle, r) = cube(3.0).ball();
        assert!((middle - Vector3::new(3.0, 0.0, -7.0)).norm() < 1e-12);
        assert!((r - 3.0f64.sqrt()).abs() < 1e-12);
    }
}
