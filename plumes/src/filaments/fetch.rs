//! Reads the water at the places of a block of filaments, four filaments at a time.
//!
//! *Source*: trilinear interpolation in the layout of `flow::grid`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use super::kernel::BLOCK;
use super::lookup::{Column, Level, Lookup};
use crate::quad::Quad;

/// The columns of a block, side by side.
pub(super) struct Columns {
    at: [u32; BLOCK],
    f: [f32; BLOCK],
    g: [f32; BLOCK],
}

impl Columns {
    pub(super) fn new() -> Self {
        Self {
            at: [0; BLOCK],
            f: [0.0; BLOCK],
            g: [0.0; BLOCK],
        }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, l: usize, c: Column) {
        (self.at[l], self.f[l], self.g[l]) = (c.at, c.f, c.g);
    }

    #[inline(always)]
    pub(super) fn get(&self, l: usize) -> Column {
        Column::inside(self.at[l], self.f[l], self.g[l])
    }
}

/// The levels of a block, side by side.
pub(super) struct Levels {
    below: [u32; BLOCK],
    part: [f32; BLOCK],
}

impl Levels {
    pub(super) fn new() -> Self {
        Self {
            below: [0; BLOCK],
            part: [0.0; BLOCK],
        }
    }

    /// Stores a level. Returns the part that is not stored: the reciprocal of the distance between the levels.
    #[inline(always)]
    pub(super) fn set(&mut self, l: usize, v: Level) -> f32 {
        (self.below[l], self.part[l]) = (v.below, v.part);
        v.per_m
    }
}

/// u, v, w and K_z of a block.
pub(super) type Fetched = [[f32; BLOCK]; 4];

/// Fills in the water at the places of a block. Multiplies `slope`, the reciprocal distance of the levels, by the
/// difference of K_z between them.
#[inline(always)]
pub(super) fn fetch(
    cells: &Lookup,
    nodes: &[[f32; 4]],
    column: &Columns,
    level: &Levels,
    water: &mut Fetched,
    mut slope: Option<&mut [f32; BLOCK]>,
) {
    let (up_j, up_i) = cells.strides();
    let lowest = highest(&column.at) as usize * up_j + highest(&level.below) as usize;
    assert!(
        lowest + 1 + up_j + up_i < nodes.len(),
        "a filament's cell is not one of the flow grid: its nodes and those of the cells were not refreshed together"
    );
    for from in (0..BLOCK).step_by(4) {
        let at = |l: usize| {
            let l = from + l;
            // SAFETY: no cell of the block reaches beyond the nodes, as asserted above.
            unsafe { trilinear(cells, nodes, column.get(l), level.below[l], level.part[l]) }
        };
        let (a, b, c, d) = (at(0), at(1), at(2), at(3));
        let four = Quad::columns([a.0, b.0, c.0, d.0]);
        for d in 0..4 {
            water[d][from..from + 4].copy_from_slice(&four[d]);
        }
        if let Some(slope) = slope.as_deref_mut() {
            let rise = Quad::columns([a.1, b.1, c.1, d.1])[3];
            for l in 0..4 {
                slope[from + l] *= rise[l];
            }
        }
    }
}

/// The highest index of a block.
#[inline(always)]
pub(super) fn highest(indices: &[u32; BLOCK]) -> u32 {
    indices.iter().fold(0, |most, n| most.max(*n))
}

/// `[u, v, w, K_z]` at a point of a column cell, and its difference between the levels below and above.
///
/// # Safety
/// The eight nodes of the cell must exist: with the strides `(up_j, up_i)` of the cells,
/// `c.at · up_j + level + 1 + up_j + up_i < nodes.len()`.
#[inline(always)]
pub(super) unsafe fn trilinear(
    cells: &Lookup,
    nodes: &[[f32; 4]],
    c: Column,
    level: u32,
    part: f32,
) -> (Quad, Quad) {
    let (up_j, up_i) = cells.strides();
    let at = c.at as usize * up_j + level as usize;
    let node = |n: usize| {
        debug_assert!(n < nodes.len());
        // SAFETY: this node is one of the cell's eight, which exist as the caller promises.
        Quad::new(unsafe { nodes.get_unchecked(n) })
    };
    let (f0, g0) = (1.0 - c.f, 1.0 - c.g);
    let (w00, w01, w10, w11) = (f0 * g0, f0 * c.g, c.f * g0, c.f * c.g);
    let layer = |n: usize| {
        let near = node(n).times(w00).add(node(n + up_j).times(w01));
        let far = node(n + up_i)
            .times(w10)
            .add(node(n + up_i + up_j).times(w11));
        near.add(far)
    };
    let (low, high) = (layer(at), layer(at + 1));
    let rise = high.sub(low);
    (low.add(rise.times(part)), rise)
}
