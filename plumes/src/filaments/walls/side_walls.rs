//! Filaments between side walls: eddies carry them, and walls, bed and surface reflect them.
//!
//! *Source*: reflection at a solid wall (Thomson 1987, J. Fluid Mech. 180, 529, section 4).
//!
//! *Parameters*: none.
//!
//! *Deviations*: the eddies act after mean flow and kicks (splitting, Strang 1968, SIAM J. Numer. Anal. 5, 506; first
//! order in the step), and once in several steps that are shorter than a fifth of a second: in the frame that moves
//! with the stream, in which they are evaluated, they change over seconds.

use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::Span;
use crate::filaments::store::folded::folded;
use nalgebra::Vector2;
use std::ops::Range;
use world::fields::{Flow, SideWalls};

/// Carries filaments with the eddies through a step, or from their release on.
pub(crate) fn carry(flow: &dyn Flow, datum: Vector2<f64>, store: &mut Store, range: Range<usize>, span: Span) {
    let dt: Vec<f32> = store.steps_s(range.clone(), span).collect();
    let places = [&mut store.x, &mut store.y, &mut store.z].map(|v| &mut v[range.clone()]);
    flow.carry(span.to_s, &dt, datum, places);
    fold(store, range);
}

/// Mirrors filaments that passed bed or surface back into the water.
pub(crate) fn fold(store: &mut Store, range: Range<usize>) {
    for (z, bed) in store.z[range.clone()].iter_mut().zip(&store.bed[range]) {
        *z = folded(*z, *bed, -1.0 / bed);
    }
}

/// Mirrors filaments that passed a wall back into the water.
pub(crate) fn keep_between(walls: &SideWalls, datum: Vector2<f64>, store: &mut Store, range: Range<usize>) {
    let (ax, ay) = (walls.across.x as f32, walls.across.y as f32);
    let centre = walls.centre - datum;
    let (cx, cy) = (centre.x as f32, centre.y as f32);
    let half = walls.half_width_m as f32;
    for (x, y) in (store.x[range.clone()].iter_mut()).zip(&mut store.y[range]) {
        let side = (*x - cx) * ax + (*y - cy) * ay;
        // Without branches, so that several are looked at at once. No kick is longer than the distance between the
        // walls; the limits would hold even such a filament inside.
        let back = (2.0 * half).copysign(side) - side;
        let back = if back > half { half } else { back };
        let back = if back < -half { -half } else { back };
        let turn = back - side;
        let inside = [*x + turn * ax, *y + turn * ay];
        [*x, *y] = if side.abs() > half { inside } else { [*x, *y] };
    }
}
