//! Velocity at any place in the blocked water, from the fluxes through the faces of the cell that contains it.
//!
//! *Source*: lowest-order Raviart–Thomas interpolation, Raviart and Thomas 1977, Lect. Notes Math. 606, 292, carried to
//! the bed-following cells by Piola's transform: u = û/H, w = ŵ + u·∇z at constant s.
//!
//! *Parameters*: none.
//!
//! *Deviations*: each component is linear along its own direction and constant in the two others. So divergence is zero
//! at every point and nothing passes a solid face, but the tangential component has steps from cell to cell. Filaments
//! follow the same faces (`filaments::drift::pollock`). There is no boundary layer or wake: water slips along obstacles.

use nalgebra::{Vector2, Vector3};

use super::cells::{Cells, Faces, beyond};
use crate::flow::ground::Floor;

/// Two fields, and the position of the moment between the first and the second.
pub(super) type FieldPair<'a> = ([&'a Faces<f32>; 2], f64);

#[inline]
pub(super) fn mixed(of: impl Fn(&Faces<f32>) -> f32, (fields, part): FieldPair<'_>) -> f64 {
    let [a, b] = fields.map(|f| f64::from(of(f)));
    a + part * (b - a)
}

/// The cell of a place and a height, and the position in it as parts of the cell; `None` outside the cells.
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

/// Velocity (ENU, m/s) at a place and height over a floor; `None` outside the cells.
#[inline]
pub(super) fn velocity(
    cells: &Cells,
    between: FieldPair<'_>,
    p: Vector2<f64>,
    z: f64,
    floor: &Floor,
) -> Option<Vector3<f64>> {
    let ([i, j, k], part) = locate(cells, p, z, floor)?;
    let along = |d: usize| {
        let (one, two) = (cells.face(d, [i, j, k]), cells.face(d, beyond(d, [i, j, k])));
        let of = |at: usize| mixed(|f: &Faces<f32>| f.0[d][at], between);
        let (low, high) = (of(one), of(two));
        low + part[d] * (high - low)
    };
    Some(physical(cells, [along(0), along(1), along(2)], z, floor))
}

/// Converts depth-integrated components to a velocity.
fn physical(cells: &Cells, [a, b, up]: [f64; 3], z: f64, floor: &Floor) -> Vector3<f64> {
    let u = (cells.axes[0] * a + cells.axes[1] * b) / -floor.z;
    u.push(up + u.dot(&floor.slope) * (z / floor.z).clamp(0.0, 1.0))
}

/// Whether the cell of a place is solid; false outside the cells.
pub(super) fn solid(cells: &Cells, p: Vector2<f64>, z: f64, floor: &Floor) -> bool {
    locate(cells, p, z, floor).is_some_and(|([i, j, k], _)| !cells.open[cells.cell([i, j, k])])
}

/// Height of the cell that contains a height, m.
pub(super) fn thickness(cells: &Cells, z: f64, floor: &Floor) -> f64 {
    let k = cells.level((1.0 - z / floor.z).clamp(0.0, 1.0));
    (cells.s[k + 1] - cells.s[k]) * -floor.z
}
