//! The area and its water divided into boxes, each open or solid.
//!
//! *Source*: solid voxelisation by intersection tests against the obstacles' own shapes (Gottschalk, Lin and Manocha
//! 1996 for box against box, as in parry); clearance as in `distance`.
//!
//! *Parameters*: cell sizes (m) along the area's axis, across it and upwards; they are reduced to fit, never enlarged.
//!
//! *Deviations*: a cell is solid if any part of it is solid. So water in open cells is free of solids everywhere, and
//! things thinner than a cell are not missed. The bed is tested at each cell's corners and centre. Obstacles that
//! overlap count as their union. Outside the area nothing is known, so nothing is solid.

use super::distance::distances;
use crate::area::Area;
use crate::error::WorldError;
use crate::frames::Pose;
use crate::obstacles::{Obstacle, Obstacles};
use crate::terrain::Terrain;
use nalgebra::{UnitQuaternion, Vector2, Vector3};

/// Most cells: a byte and a distance each, 320 MB.
const MOST: f64 = 64e6;

/// Cells over the area from the deepest bed to the surface.
///
/// Cell (i, j, k): i along the area's axis, j to its right, k upwards; numbered (i·ny + j)·nz + k.
#[derive(Clone, Debug, PartialEq)]
pub struct Voxels {
    area: Area,
    n: [usize; 3],
    cell_m: [f64; 3],
    low_z: f64,
    solid: Vec<bool>,
    clearance: Vec<f32>,
}

impl Voxels {
    /// The area with bed and obstacles.
    ///
    /// # Errors
    /// If the cells are not positive or too many, or if none is left open.
    pub fn new(area: &Area, cell_m: [f64; 3], terrain: &Terrain, obstacles: &Obstacles) -> Result<Self, WorldError> {
        let deep = terrain.deepest_m();
        let extent = [area.length_m, area.width_m, deep];
        let wrong = |problem| WorldError::Invalid { field: "cell_m".into(), problem };
        if !cell_m.iter().all(|c| *c > 0.0 && c.is_finite()) {
            return Err(wrong(format!("must be > 0 in each direction, got {cell_m:?}")));
        }
        // Slightly less, so that rounding does not add a cell where the size divides the extent.
        let count = [0, 1, 2].map(|d| (extent[d] / cell_m[d] - 1e-9).ceil().max(1.0));
        if count.iter().product::<f64>() > MOST {
            return Err(wrong(format!(
                "{cell_m:?} m makes {} x {} x {} cells of {:.0} x {:.0} x {deep:.1} m; at most {MOST:e} fit: take larger cells",
                count[0], count[1], count[2], extent[0], extent[1]
            )));
        }
        let n = count.map(|c| c as usize);
        let mut this = Self {
            area: *area,
            n,
            cell_m: [0, 1, 2].map(|d| extent[d] / count[d]),
            low_z: -deep,
            solid: vec![false; n[0] * n[1] * n[2]],
            clearance: Vec::new(),
        };
        this.fill_bed(terrain);
        for obstacle in &obstacles.0 {
            this.fill(obstacle);
        }
        if this.solid.iter().all(|s| *s) {
            return Err(WorldError::Invalid {
                field: "obstacles".into(),
                problem: format!(
                    "no open water is left in the area in cells of {:.2} x {:.2} x {:.2} m: make obstacles smaller, or the cells",
                    this.cell_m[0], this.cell_m[1], this.cell_m[2]
                ),
            });
        }
        this.measure();
        Ok(this)
    }

    fn fill_bed(&mut self, terrain: &Terrain) {
        for i in 0..self.n[0] {
            for j in 0..self.n[1] {
                let corner = |di: f64, dj: f64| {
                    let local = self.local_of([i as f64 + di, j as f64 + dj]);
                    let p = self.area.world(local);
                    terrain.bed_z(p.x, p.y)
                };
                let bed = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.5)]
                    .map(|(a, b)| corner(a, b))
                    .into_iter()
                    .fold(f64::NEG_INFINITY, f64::max);
                let up_to = (bed - self.low_z) / self.cell_m[2];
                for k in (0..self.n[2]).take_while(|k| (*k as f64) < up_to - 1e-6) {
                    let at = self.index([i, j, k]);
                    self.solid[at] = true;
                }
            }
        }
    }

    /// Marks the cells that an obstacle fills or touches.
    fn fill(&mut self, obstacle: &Obstacle) {
        let (low, high) = obstacle.bounds();
        let mut range = [(f64::INFINITY, f64::NEG_INFINITY); 3];
        for (x, y) in [(low.x, low.y), (low.x, high.y), (high.x, low.y), (high.x, high.y)] {
            for z in [low.z, high.z] {
                let c = self.in_cells(&Vector3::new(x, y, z));
                for d in 0..3 {
                    range[d] = (range[d].0.min(c[d]), range[d].1.max(c[d]));
                }
            }
        }
        let of = |d: usize| {
            let n = self.n[d] as f64;
            let clamp = |v: f64| v.clamp(0.0, n) as usize;
            clamp(range[d].0.floor())..clamp(range[d].1.ceil())
        };
        let half = self.cell_m.map(|c| c / 2.0);
        // A cell that only touches a solid is open, so the cell is shrunk by its rounding.
        let tight = half.map(|h| h * (1.0 - 1e-6));
        let across = Vector3::from(half).norm();
        let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, self.area.axis.yaw());
        let (is, js, ks) = (of(0), of(1), of(2));
        for i in is {
            for j in js.clone() {
                for k in ks.clone() {
                    let at = self.index([i, j, k]);
                    if self.solid[at] {
                        continue;
                    }
                    let p_WB = self.centre([i, j, k]);
                    let d = obstacle.distance(&p_WB);
                    self.solid[at] = d <= 0.0 || d < across && obstacle.meets_box(&Pose { p_WB, R_WB: turn }, tight);
                }
            }
        }
    }

    /// Computes the clearances again after cells were [set](Self::set).
    pub fn measure(&mut self) {
        self.clearance = distances(&self.solid, self.n, self.cell_m);
    }

    /// Makes a cell solid or open. Clearances are valid again after [`Self::measure`].
    pub fn set(&mut self, cell: [usize; 3], solid: bool) {
        let at = self.index(cell);
        self.solid[at] = solid;
    }

    /// Number of cells along, across and upwards.
    pub fn size(&self) -> [usize; 3] {
        self.n
    }

    /// Size of a cell along, across and upwards, m.
    pub fn cell_m(&self) -> [f64; 3] {
        self.cell_m
    }

    /// The area that the cells fill.
    pub fn area(&self) -> &Area {
        &self.area
    }

    /// Number of a cell: (i·ny + j)·nz + k.
    #[inline]
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * self.n[1] + j) * self.n[2] + k
    }

    /// Whether a cell is solid or contains part of a solid.
    #[inline]
    pub fn solid(&self, i: usize, j: usize, k: usize) -> bool {
        self.solid[self.index([i, j, k])]
    }

    /// All cells, by [number](Self::index).
    pub fn solids(&self) -> &[bool] {
        &self.solid
    }

    /// Distance from the centre of a cell to the surface of the nearest solid cell, m; 0 if it is solid itself,
    /// infinite if none is.
    #[inline]
    pub fn clearance(&self, cell: [usize; 3]) -> f64 {
        f64::from(self.clearance[self.index(cell)])
    }

    /// Clearances of all cells, by [number](Self::index), m.
    pub fn clearances(&self) -> &[f32] {
        &self.clearance
    }

    /// Clearance of the cell that contains a point (ENU, m), m; infinite outside.
    pub fn clearance_m(&self, p: &Vector3<f64>) -> f64 {
        self.cell(p).map_or(f64::INFINITY, |c| self.clearance(c))
    }

    /// The cell that contains a point (ENU, m); `None` outside.
    pub fn cell(&self, p: &Vector3<f64>) -> Option<[usize; 3]> {
        let c = self.in_cells(p);
        // The far edges belong to the last cells.
        (0..3)
            .all(|d| c[d] >= 0.0 && c[d] <= self.n[d] as f64)
            .then(|| [0, 1, 2].map(|d| (c[d] as usize).min(self.n[d] - 1)))
    }

    /// Centre of a cell (ENU), m.
    pub fn centre(&self, [i, j, k]: [usize; 3]) -> Vector3<f64> {
        let p = self.area.world(self.local_of([i as f64 + 0.5, j as f64 + 0.5]));
        Vector3::new(p.x, p.y, self.low_z + (k as f64 + 0.5) * self.cell_m[2])
    }

    /// Position (along, across), m, for coordinates in cells.
    fn local_of(&self, c: [f64; 2]) -> Vector2<f64> {
        Vector2::new(c[0] * self.cell_m[0] - self.area.length_m / 2.0, c[1] * self.cell_m[1] - self.area.width_m / 2.0)
    }

    /// Coordinates of a point (ENU, m) in cells from the lowest corner.
    fn in_cells(&self, p: &Vector3<f64>) -> [f64; 3] {
        let l = self.area.local(p.xy());
        [
            (l.x + self.area.length_m / 2.0) / self.cell_m[0],
            (l.y + self.area.width_m / 2.0) / self.cell_m[1],
            (p.z - self.low_z) / self.cell_m[2],
        ]
    }
}
