//! Fixed things: the bed as a height field, and obstacles as they are. Rays and distances are computed directly from
//! them, so that the answer does not depend on whether the solver has run.

use crate::area::Area;
use crate::convert::{pose, vector};
use crate::frames::Pose;
use crate::terrain::Terrain;
use nalgebra::{UnitQuaternion, Vector3};
use rapier3d::geometry::{Aabb, ColliderHandle, Ray, SharedShape};
use rapier3d::math as r;
use rapier3d::parry::bounding_volume::BoundingVolume;
use rapier3d::parry::utils::Array2;

/// How far the bed's surface extends beyond the area, m: farther than the distance at which a search is aborted.
const MARGIN_M: f64 = 60.0;
/// Side of a cell of the bed's surface, m; between nodes the surface is flat.
const CELL_M: f64 = 5.0;

/// One fixed solid.
pub(super) struct FixedSolid {
    pub(super) pose: r::Pose,
    pub(super) shape: SharedShape,
    bounds: Aabb,
    /// Name for error messages.
    pub(super) name: String,
    /// rapier's handle; invalid until rapier has the collider.
    pub(super) collider: ColliderHandle,
}

/// The bed over an area and a margin round it, as a body meets it. Copies share it.
#[derive(Clone)]
pub struct Bed {
    pose: r::Pose,
    shape: SharedShape,
}

impl FixedSolid {
    pub(super) fn new(pose_W: r::Pose, shape: SharedShape) -> Self {
        let bounds = shape.compute_aabb(&pose_W);
        Self { pose: pose_W, shape, bounds, name: String::new(), collider: ColliderHandle::invalid() }
    }

    pub(super) fn bed(bed: &Bed) -> Self {
        Self::new(bed.pose, bed.shape.clone())
    }

    /// Whether it can have a part in a box.
    pub(super) fn meets(&self, swept: &Aabb) -> bool {
        self.bounds.intersects(swept)
    }

    /// Distance of `p_W` from it, m, 0 inside. Beyond `near_m` it may be less than that: the distance from its bounds.
    pub(super) fn away_m(&self, p_W: &Vector3<f64>, near_m: f64) -> f64 {
        let p = vector(p_W);
        let outside = (self.bounds.mins - p).max(p - self.bounds.maxs);
        let from_bounds_m = outside.max(r::Vector::ZERO).length();
        if from_bounds_m > near_m {
            return from_bounds_m;
        }
        let nearest = self.shape.project_point(&self.pose, p, true);
        if nearest.is_inside { 0.0 } else { (nearest.point - p).length() }
    }

    /// Distance along a unit direction to the first hit, m.
    pub(super) fn ray(&self, from_W: &Vector3<f64>, along_W: &Vector3<f64>, max_m: f64) -> Option<f64> {
        let ray = Ray::new(vector(from_W), vector(along_W));
        self.shape.cast_ray(&self.pose, &ray, max_m, true)
    }
}

impl Bed {
    /// The bed of a terrain.
    pub fn new(terrain: &Terrain, area: &Area) -> Self {
        let (min, max) = area.bounds();
        let size = (max - min).map(|s| s + 2.0 * MARGIN_M);
        let cells = size.map(|s| (s / CELL_M).ceil().max(1.0) as usize);
        let middle = (min + max) / 2.0;
        // parry's height fields have y up. Turned by a quarter about x, their x is our east and their z our south.
        let mut heights = Array2::zeros(cells.y + 1, cells.x + 1);
        for i in 0..=cells.y {
            let north = size.y * (0.5 - i as f64 / cells.y as f64);
            for j in 0..=cells.x {
                let east = size.x * (j as f64 / cells.x as f64 - 0.5);
                heights[(i, j)] = terrain.bed_z(middle.x + east, middle.y + north);
            }
        }
        let upright = Pose {
            p_WB: Vector3::new(middle.x, middle.y, 0.0),
            R_WB: UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2),
        };
        let scale = r::Vector::new(size.x, 1.0, size.y);
        Self { pose: pose(&upright), shape: SharedShape::heightfield(heights, scale) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Heading;
    use nalgebra::Vector2;

    #[test]
    fn the_bed_stands_where_the_terrain_says() {
        let area =
            Area { centre: Vector2::new(30.0, -20.0), length_m: 400.0, width_m: 200.0, axis: Heading::from_deg(340.0) };
        let terrain = Terrain::sloping_over(&area, Heading::from_deg(250.0), 4.0, 8.0);
        let bed = FixedSolid::bed(&Bed::new(&terrain, &area));
        for (x, y) in [(30.0, -20.0), (-40.0, 77.0), (100.0, -120.0), (71.3, 5.5)] {
            let from = Vector3::new(x, y, -1.0);
            let hit = bed.ray(&from, &-Vector3::z(), 100.0).expect("bed below");
            let depth = -terrain.bed_z(x, y);
            assert!((1.0 + hit - depth).abs() < 1e-3, "{hit} at {x} {y}, depth {depth}");
            // A slope of 4 m over 200 m: the nearest place is hardly nearer than the one below.
            let away_m = bed.away_m(&from, 100.0);
            assert!((away_m - (depth - 1.0)).abs() < 0.01, "{away_m} at {x} {y}");
            let high = from + Vector3::z() * 40.0;
            let above_m = bed.away_m(&high, 5.0);
            assert!(above_m > 5.0 && above_m <= bed.away_m(&high, 100.0));
        }
        // Past the area, within the margin.
        let out = area.world(Vector2::new(255.0, 0.0));
        let from = Vector3::new(out.x, out.y, -1.0);
        assert!(bed.ray(&from, &-Vector3::z(), 100.0).is_some());
    }
}
