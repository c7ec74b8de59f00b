//! Fixed things: the bed as a height field, and obstacles as they are. Rays and distances are computed directly from
//! them, so that the answer does not depend on whether the solver has run.

use crate::convert::{pose, vector};
use crate::area::Area;
use crate::frames::Pose;
use crate::terrain::Terrain;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rapier3d::geometry::{Aabb, ColliderHandle, Ray, SharedShape};
use rapier3d::math as r;
use rapier3d::parry::bounding_volume::BoundingVolume;
use rapier3d::parry::utils::Array2;
use std::sync::Arc;

/// How far the bed's surface extends beyond the area, m: farther than the distance at which a search is aborted.
const MARGIN_M: f64 = 60.0;
/// Side of a cell of the bed's surface, m; between nodes the surface is flat.
const CELL_M: f64 = 5.0;

/// One fixed solid.
pub(super) struct FixedSolid {
    pub(super) pose: r::Pose,
    pub(super) shape: SharedShape,
    bounds: Aabb,
    /// Of a bed: its heights, for a quick answer.
    heights: Option<Arc<Heights>>,
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
    heights: Arc<Heights>,
}

impl FixedSolid {
    pub(super) fn new(pose_W: r::Pose, shape: SharedShape) -> Self {
        let bounds = shape.compute_aabb(&pose_W);
        Self { pose: pose_W, shape, bounds, heights: None, name: String::new(), collider: ColliderHandle::invalid() }
    }

    pub(super) fn bed(bed: &Bed) -> Self {
        Self { heights: Some(bed.heights.clone()), ..Self::new(bed.pose, bed.shape.clone()) }
    }

    /// Whether it can have a part in a box.
    pub(super) fn meets(&self, swept: &Aabb) -> bool {
        let lies_below = |heights: &Arc<Heights>| heights.highest_under(swept).is_some_and(|z| z < swept.mins.z);
        self.bounds.intersects(swept) && !self.heights.as_ref().is_some_and(lies_below)
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
    #[must_use]
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
        let west_north = Vector2::new(middle.x - size.x / 2.0, middle.y + size.y / 2.0);
        Self {
            pose: pose(&upright),
            heights: Arc::new(Heights::new(&heights, west_north, size)),
            shape: SharedShape::heightfield(heights, scale),
        }
    }
}

/// The highest point of a bed in each of its cells.
struct Heights {
    /// South by south from the north, each row from west to east, m.
    z_m: Vec<f64>,
    /// Rows and columns.
    cells: [usize; 2],
    /// North-western corner (east, north), m.
    corner: Vector2<f64>,
    cell_m: Vector2<f64>,
}

impl Heights {
    /// Of nodes in rows from north to south, over an area of this size with this north-western corner.
    fn new(nodes: &Array2<f64>, corner: Vector2<f64>, size: Vector2<f64>) -> Self {
        let cells = [nodes.nrows() - 1, nodes.ncols() - 1];
        let highest = |i: usize, j: usize| {
            let corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
            let z = corners.map(|[i, j]| nodes[(i, j)]);
            z.into_iter().fold(f64::NEG_INFINITY, f64::max)
        };
        let all = (0..cells[0]).flat_map(|i| (0..cells[1]).map(move |j| (i, j)));
        Self {
            z_m: all.map(|(i, j)| highest(i, j)).collect(),
            cells,
            corner,
            cell_m: Vector2::new(size.x / cells[1] as f64, size.y / cells[0] as f64),
        }
    }

    /// The highest point under a box; `None` if the box has a part outside the bed.
    fn highest_under(&self, swept: &Aabb) -> Option<f64> {
        let span = |low: f64, high: f64, cell_m: f64, cells: usize| {
            // A little wider, against rounding.
            let (low, high) = (low / cell_m - 1e-6, high / cell_m + 1e-6);
            let inside = low >= 0.0 && high < cells as f64;
            inside.then_some(low as usize..=high as usize)
        };
        let [rows, columns] = self.cells;
        let south = [self.corner.y - swept.maxs.y, self.corner.y - swept.mins.y];
        let east = [swept.mins.x - self.corner.x, swept.maxs.x - self.corner.x];
        let rows = span(south[0], south[1], self.cell_m.y, rows)?;
        let columns_under = span(east[0], east[1], self.cell_m.x, columns)?;
        let (first, last) = columns_under.into_inner();
        let row = |i: usize| &self.z_m[i * columns + first..=i * columns + last];
        let all = rows.flat_map(|i| row(i).iter().copied());
        Some(all.fold(f64::NEG_INFINITY, f64::max))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Heading;

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
        // A box meets the bed if it reaches below the highest place under it.
        let above = |x: f64, y: f64, over_m: f64| {
            let z = terrain.bed_z(x, y) + over_m;
            Aabb::new(r::Vector::new(x - 1.0, y - 1.0, z), r::Vector::new(x + 1.0, y + 1.0, z + 1.0))
        };
        for (x, y) in [(30.0, -20.0), (-40.0, 77.0), (100.0, -120.0), (71.3, 5.5)] {
            assert!(bed.meets(&above(x, y, -0.5)) && !bed.meets(&above(x, y, 0.5)));
        }
        let beyond = above(1000.0, 0.0, -0.5);
        assert!(!bed.meets(&beyond), "there is no bed");
        // Past the area, within the margin.
        let out = area.world(Vector2::new(255.0, 0.0));
        let from = Vector3::new(out.x, out.y, -1.0);
        assert!(bed.ray(&from, &-Vector3::z(), 100.0).is_some());
    }
}
