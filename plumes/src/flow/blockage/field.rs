//! Velocity anywhere in the blocked water, from the fluxes through the faces of the cell it is asked in.
//!
//! *Source*: lowest-order Raviart–Thomas interpolation, Raviart and Thomas 1977, Lect. Notes Math. 606, 292, carried to the
//! bed-following cells by Piola's transform: u = û/H, w = ŵ + u·∇z at constant s.
//!
//! *Parameters*: none.
//!
//! *Deviations*: along each axis a component is linear in its own direction and constant in the two others, so divergence is
//! zero at every point and nothing passes a solid face, at the price of steps in the tangential component from cell to cell.
//! For the plume's flow grid, whose nodes are the corners of the cells, the faces that meet at a corner are averaged instead
//! (those between two solid cells left out): smooth, second order, divergence and tangency then as good as the cells are
//! fine. With bed friction the water stands still at the bed's corners, as the log law has it. No boundary layer or wake: water slips along obstacles.

use nalgebra::{Vector2, Vector3};

use super::cells::{Cells, Faces};
use crate::flow::ground::Floor;

/// Two fields and how far from the first to the second the moment is.
pub(super) type Between<'a> = ([&'a Faces<f32>; 2], f64);

#[inline]
fn mixed(of: impl Fn(&Faces<f32>) -> f32, (fields, part): Between<'_>) -> f64 {
    let [a, b] = fields.map(|f| f64::from(of(f)));
    a + part * (b - a)
}

/// The cell of a place and a height, and the parts of it passed; none beyond the cells.
#[inline]
fn locate(cells: &Cells, p: Vector2<f64>, z: f64, floor: &Floor) -> Option<([usize; 3], [f64; 3])> {
    let c = cells.in_cells(p);
    let inside = (0..2).all(|d| c[d] >= 0.0 && c[d] <= cells.n[d] as f64);
    if !inside {
        return None;
    }
    let [i, j] = [0, 1].map(|d| (c[d] as usize).min(cells.n[d] - 1));
    let s = (1.0 - z / floor.z).clamp(0.0, 1.0);
    let k = cells.level(s);
    let fs = ((s - cells.s[k]) / (cells.s[k + 1] - cells.s[k])).clamp(0.0, 1.0);
    Some(([i, j, k], [c[0] - i as f64, c[1] - j as f64, fs]))
}

/// Velocity (ENU, m/s) at a place and height over a floor; none beyond the cells.
#[inline]
pub(super) fn velocity(
    cells: &Cells,
    between: Between<'_>,
    p: Vector2<f64>,
    z: f64,
    floor: &Floor,
) -> Option<Vector3<f64>> {
    let ([i, j, k], part) = locate(cells, p, z, floor)?;
    let along = |d: usize| {
        let mut next = [i, j, k];
        next[d] += 1;
        let (one, two) = (cells.face(d, [i, j, k]), cells.face(d, next));
        let of = |at: usize| {
            let pick = |f: &Faces<f32>| match d {
                0 => f.x[at],
                1 => f.y[at],
                _ => f.s[at],
            };
            mixed(pick, between)
        };
        let (low, high) = (of(one), of(two));
        low + part[d] * (high - low)
    };
    Some(physical(cells, [along(0), along(1), along(2)], z, floor))
}

/// From depth-integrated components to a velocity.
fn physical(cells: &Cells, [a, b, up]: [f64; 3], z: f64, floor: &Floor) -> Vector3<f64> {
    let u = (cells.axes[0] * a + cells.axes[1] * b) / -floor.z;
    u.push(up + u.dot(&floor.slope) * (z / floor.z).clamp(0.0, 1.0))
}

/// Whether the cell of a place is solid; not beyond the cells.
pub(super) fn solid(cells: &Cells, p: Vector2<f64>, z: f64, floor: &Floor) -> bool {
    locate(cells, p, z, floor)
        .is_some_and(|([i, j, k], _)| !cells.open[(i * cells.n[1] + j) * cells.n[2] + k])
}

/// Height of the cell in which a height lies, m.
pub(super) fn thickness(cells: &Cells, z: f64, floor: &Floor) -> f64 {
    let k = cells.level((1.0 - z / floor.z).clamp(0.0, 1.0));
    (cells.s[k + 1] - cells.s[k]) * -floor.z
}

/// The corner of cells at a place, if there is one within a thousandth of a cell.
pub(super) fn corner(cells: &Cells, p: Vector2<f64>) -> Option<[usize; 2]> {
    let c = cells.in_cells(p);
    let near = c.map(f64::round);
    (0..2)
        .all(|d| (c[d] - near[d]).abs() < 1e-3 && near[d] >= 0.0 && near[d] <= cells.n[d] as f64)
        .then(|| near.map(|v| v as usize))
}

/// Velocity (ENU, m/s) at a corner of cells and a height: across the faces that meet there the mean, upwards in between
/// straight from corner to corner.
pub(super) fn at_corner(
    cells: &Cells,
    between: Between<'_>,
    at: [usize; 2],
    z: f64,
    floor: &Floor,
    still_bed: bool,
) -> Vector3<f64> {
    let s = (1.0 - z / floor.z).clamp(0.0, 1.0);
    let k = cells.level(s);
    let part = ((s - cells.s[k]) / (cells.s[k + 1] - cells.s[k])).clamp(0.0, 1.0);
    let low = node(cells, between, [at[0], at[1], k], still_bed);
    let high = node(cells, between, [at[0], at[1], k + 1], still_bed);
    let mean = [0, 1, 2].map(|d| low[d] + part * (high[d] - low[d]));
    physical(cells, mean, z, floor)
}

/// Depth-integrated components at a corner.
fn node(cells: &Cells, between: Between<'_>, at: [usize; 3], still_bed: bool) -> [f64; 3] {
    let nz = cells.n[2];
    let thick = |k: usize| cells.s[k + 1] - cells.s[k];
    [0, 1, 2].map(|d| {
        if d < 2 && still_bed && at[2] == 0 {
            return 0.0;
        }
        let (mut sum, mut weights) = (0.0, 0.0);
        let (one, two) = [(1, 2), (0, 2), (0, 1)][d];
        for (low, next) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let mut face = at;
            // A face beside the corner: in its two own directions one before it or at it.
            if (low == 1 && at[one] == 0) || (next == 1 && at[two] == 0) {
                continue;
            }
            face[one] -= low;
            face[two] -= next;
            if face[one] >= cells.n[one] || face[two] >= cells.n[two] {
                continue;
            }
            let sides = cells.beside(d, face);
            if !sides.iter().flatten().any(|c| cells.open[*c]) {
                continue;
            }
            // Straight from the middle of the level below to that of the one above.
            let weight = if d == 2 || at[2] == 0 || at[2] == nz {
                1.0
            } else {
                thick(2 * at[2] - 1 - face[2])
            };
            let n = cells.face(d, face);
            let pick = |f: &Faces<f32>| match d {
                0 => f.x[n],
                1 => f.y[n],
                _ => f.s[n],
            };
            sum += weight * mixed(pick, between);
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    })
}
