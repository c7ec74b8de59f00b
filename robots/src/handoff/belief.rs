//! A robot's belief about the source's place: a grid of probabilities, and numbers that planners need.

use super::Outlook;
use bevy_ecs::prelude::Component;
use nalgebra::{Vector2, Vector3};
use std::sync::Arc;
use world::area::Area;

/// A regular grid of cells whose axes are those of the operating area (see [`BeliefGrid::centre`]).
#[derive(Clone, Debug, PartialEq)]
pub struct BeliefGrid {
    /// Corner of the cell (0, 0, 0), world ENU, m.
    pub corner: Vector3<f64>,
    /// World direction of the grid's first and second axis (unit, horizontal, perpendicular).
    pub axes: [Vector2<f64>; 2],
    /// Size of a cell along the first, second and vertical axis, m.
    pub cell_m: [f64; 3],
    /// Cells along the first, second and vertical axis; 1 in the third for a map of the plane.
    pub n: [usize; 3],
}

impl BeliefGrid {
    /// A grid of `n` cells over an operating area, between two depths (m). The first axis lies along the area's own
    /// axis, the second points to the left of it, the third upwards. If the area's axis points east, they are east,
    /// north and up.
    pub fn over(area: &Area, top_depth_m: f64, bottom_depth_m: f64, n: [usize; 3]) -> Self {
        let along = area.axis.unit();
        let left = Vector2::new(-along.y, along.x);
        let corner = area.centre - along * (area.length_m / 2.0) - left * (area.width_m / 2.0);
        let high = bottom_depth_m - top_depth_m;
        Self {
            corner: Vector3::new(corner.x, corner.y, -bottom_depth_m),
            axes: [along, left],
            cell_m: [area.length_m / n[0] as f64, area.width_m / n[1] as f64, high / n[2] as f64],
            n,
        }
    }

    /// The grid with each cell divided into so many along both horizontal axes.
    pub fn divided(&self, by: usize) -> Self {
        let [nx, ny, nz] = self.n;
        let [hx, hy, hz] = self.cell_m;
        Self { cell_m: [hx / by as f64, hy / by as f64, hz], n: [nx * by, ny * by, nz], ..self.clone() }
    }

    /// How many cells.
    pub fn len(&self) -> usize {
        self.n[0] * self.n[1] * self.n[2]
    }

    /// No cell at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Index of a cell: first axis fastest.
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.n[1] + j) * self.n[0] + i
    }

    /// Place of a cell in the grid.
    pub fn place(&self, index: usize) -> [usize; 3] {
        let (row, i) = (index / self.n[0], index % self.n[0]);
        [i, row % self.n[1], row / self.n[1]]
    }

    /// Middle of a cell, world ENU, m.
    pub fn centre(&self, index: usize) -> Vector3<f64> {
        self.world(self.local_centre(index))
    }

    /// A point (world ENU, m) in the grid's own axes, m from its corner.
    pub fn local(&self, p_W: &Vector3<f64>) -> [f64; 3] {
        let d = p_W.xy() - self.corner.xy();
        [d.dot(&self.axes[0]), d.dot(&self.axes[1]), p_W.z - self.corner.z]
    }

    /// A point in the grid's own axes (m from its corner) in the world (ENU, m).
    pub fn world(&self, local: [f64; 3]) -> Vector3<f64> {
        let xy = self.corner.xy() + self.axes[0] * local[0] + self.axes[1] * local[1];
        Vector3::new(xy.x, xy.y, self.corner.z + local[2])
    }

    /// Middle of a cell in the grid's own axes, m from its corner.
    pub fn local_centre(&self, index: usize) -> [f64; 3] {
        let place = self.place(index);
        [0, 1, 2].map(|a| (place[a] as f64 + 0.5) * self.cell_m[a])
    }

    /// The cell that holds a point (world ENU, m), if any; in a map of the plane the height does not matter.
    pub fn cell(&self, p_W: &Vector3<f64>) -> Option<usize> {
        let local = self.local(p_W);
        let mut cell = [0; 3];
        for axis in 0..3 {
            if axis == 2 && self.n[2] == 1 {
                continue;
            }
            let q = (local[axis] / self.cell_m[axis]).floor();
            if !(q >= 0.0 && q < self.n[axis] as f64) {
                return None;
            }
            cell[axis] = q as usize;
        }
        Some(self.index(cell))
    }
}

/// What a map that follows odour from cell to cell knows besides the source, at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Odour {
    /// When, s.
    pub t_s: f64,
    /// The cells.
    pub grid: Arc<BeliefGrid>,
    /// Chance of detecting in each cell now.
    pub detection: Vec<f64>,
    /// Cells through which odour most likely came to the vehicle's cell, source first; empty if no way leads there.
    pub came: Vec<usize>,
    /// The vehicle's cell, then the cells of the path that most likely leads to a detection.
    pub walk: Vec<usize>,
}

/// A cell is divided into this many parts along each horizontal axis, to find how much of it lies within a distance.
const PARTS: usize = 8;

impl Belief {
    /// Probability of a source within `m` metres (horizontally) of a place (east, north, m), whatever its depth. Within a
    /// cell it is spread evenly.
    pub fn within(&self, place: Vector2<f64>, m: f64) -> f64 {
        let grid = &self.grid;
        let at = grid.local(&place.push(0.0));
        let layer = grid.n[0] * grid.n[1];
        let mut total = 0.0;
        for cell in 0..layer {
            let middle = grid.local_centre(cell);
            let far = |a: usize| (middle[a] - at[a]).abs() > m + 0.5 * grid.cell_m[a];
            if far(0) || far(1) {
                continue;
            }
            let mut inside = 0_u32;
            for part in 0..PARTS * PARTS {
                let of = [part % PARTS, part / PARTS];
                let d = [0, 1].map(|a| {
                    let share = (of[a] as f64 + 0.5) / PARTS as f64 - 0.5;
                    middle[a] + share * grid.cell_m[a] - at[a]
                });
                inside += u32::from(d[0] * d[0] + d[1] * d[1] <= m * m);
            }
            if inside > 0 {
                let column: f64 = (0..grid.n[2]).map(|k| self.p[cell + k * layer]).sum();
                total += column * f64::from(inside) / (PARTS * PARTS) as f64;
            }
        }
        total.min(1.0)
    }
}

/// A belief at one instant; cheap to clone.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Belief {
    /// When it was last updated, s.
    pub t_s: f64,
    /// Counts the updates.
    pub updates: u64,
    /// At least one detection went into it.
    pub informed: bool,
    /// Its grid.
    pub grid: Arc<BeliefGrid>,
    /// Probability of each cell; they sum to 1.
    pub p: Arc<Vec<f64>>,
    /// Most probable cell (the first of equals).
    pub best: usize,
    /// Entropy, nat.
    pub entropy_nat: f64,
    /// Size of the smallest set of cells with 95 % of the probability, m² (m³ in a map of the space).
    pub credible_95: f64,
    /// What the map knows of the odour; only of a map that follows odour, and if the scenario asks for it.
    pub odour: Option<Arc<Odour>>,
    /// What the map expects on the ways that the strategy has last asked about.
    pub outlook: Option<Arc<Outlook>>,
}
