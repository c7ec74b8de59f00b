//! Reads the water at the places of a block of filaments, four filaments at a time.
//!
//! *Source*: trilinear interpolation in the layout of `flow::grid`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use super::lookup::{Column, Level, Lookup};
use crate::simd::f32x4::{F32x4, Pair};

/// Filaments in a block.
pub(crate) const BLOCK: usize = 128;

/// The columns of a block, side by side.
pub(crate) struct Columns {
    at: [u32; BLOCK],
    f: [f32; BLOCK],
    g: [f32; BLOCK],
    /// Weights of the cell's four columns; see [`Self::weigh`].
    weight: [[f32; BLOCK]; 4],
}

impl Columns {
    pub(crate) fn new() -> Self {
        Self { at: [0; BLOCK], f: [0.0; BLOCK], g: [0.0; BLOCK], weight: [[0.0; BLOCK]; 4] }
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, l: usize, c: Column) {
        (self.at[l], self.f[l], self.g[l]) = (c.at, c.f, c.g);
    }

    /// Works out the weights of the first `N` for [`fetch`].
    #[inline(always)]
    pub(crate) fn weigh<const N: usize>(&mut self) {
        for l in 0..N {
            let w = weights(self.f[l], self.g[l]);
            for (weight, w) in self.weight.iter_mut().zip(w) {
                weight[l] = w;
            }
        }
    }

    /// The lower corner of a column cell.
    #[inline(always)]
    pub(crate) fn corner(&self, l: usize) -> u32 {
        self.at[l]
    }

    #[inline(always)]
    pub(crate) fn get(&self, l: usize) -> Column {
        Column::inside(self.at[l], self.f[l], self.g[l])
    }
}

/// The levels of a block, side by side.
pub(crate) struct Levels {
    below: [u32; BLOCK],
    part: [f32; BLOCK],
}

impl Levels {
    pub(crate) fn new() -> Self {
        Self { below: [0; BLOCK], part: [0.0; BLOCK] }
    }

    /// Stores a level. Returns the part that is not stored: the reciprocal of the distance between the levels.
    #[inline(always)]
    pub(crate) fn set(&mut self, l: usize, v: Level) -> f32 {
        (self.below[l], self.part[l]) = (v.below, v.part);
        v.per_m
    }

    /// What the current in the lowest cell over a rough bed has more than linearly, as parts of its rise; `None` if no
    /// filament is there.
    #[inline(always)]
    pub(crate) fn extra<'a, const N: usize>(
        &self,
        cells: &Lookup,
        bed: &[f32; BLOCK],
        extra: &'a mut [f32; BLOCK],
    ) -> Option<&'a [f32; BLOCK]> {
        let law = cells.law?;
        let any = |below: &[u32]| below.iter().fold(u32::MAX, |least, n| least.min(*n)) == 0;
        if !any(&self.below[..N]) {
            return None;
        }
        let first = cells.first_level;
        // Most filaments are higher: eight at a time, only those eights that have one so low.
        for from in (0..N).step_by(8) {
            let eight = from..from + 8;
            extra[eight.clone()].fill(0.0);
            if any(&self.below[eight.clone()]) {
                for l in eight {
                    let more = law.extra(self.part[l], -bed[l] * first, -bed[l]);
                    extra[l] = if self.below[l] == 0 { more } else { 0.0 };
                }
            }
        }
        Some(extra)
    }

    /// Not zero if the stored level is another, in any bit, than this one.
    #[inline(always)]
    pub(crate) fn differs(&self, l: usize, v: &Level) -> u32 {
        (self.below[l] ^ v.below) | (self.part[l].to_bits() ^ v.part.to_bits())
    }
}

/// u, v, ω and K_z of a block.
pub(crate) type BlockFlow = [[f32; BLOCK]; 4];

/// Fills in the water at the first `N` places of a block; `N` is a multiple of four. Multiplies `slope`, the reciprocal
/// distance of the levels, by the difference of K_z between them.
///
/// # Safety
/// The machine must have the instructions of `P`.
#[inline(always)]
pub(crate) unsafe fn fetch<P: Pair, const N: usize>(
    cells: &Lookup,
    nodes: &[[f32; 4]],
    column: &Columns,
    level: &Levels,
    water: &mut BlockFlow,
    extra: Option<&[f32; BLOCK]>,
    mut slope: Option<&mut [f32; BLOCK]>,
) {
    let (up_j, up_i) = cells.strides();
    let lowest = highest(&column.at[..N]) as usize * up_j + highest(&level.below[..N]) as usize;
    assert!(
        lowest + 1 + up_j + up_i < nodes.len(),
        "a filament's cell is not one of the flow grid: its nodes and those of the cells were not refreshed together"
    );
    for from in (0..N).step_by(4) {
        // SAFETY: no cell of the block reaches beyond the nodes, as asserted above; the caller promises `P`.
        let [a, b, c, d] = unsafe {
            [
                one::<P>(cells, nodes, column, level, from),
                one::<P>(cells, nodes, column, level, from + 1),
                one::<P>(cells, nodes, column, level, from + 2),
                one::<P>(cells, nodes, column, level, from + 3),
            ]
        };
        let four = F32x4::columns([a.0, b.0, c.0, d.0]);
        for d in 0..4 {
            water[d][from..from + 4].copy_from_slice(&four[d]);
        }
        if extra.is_none() && slope.is_none() {
            continue;
        }
        let rise = F32x4::columns([a.1, b.1, c.1, d.1]);
        if let Some(extra) = extra {
            for l in from..from + 4 {
                water[0][l] += extra[l] * rise[0][l - from];
                water[1][l] += extra[l] * rise[1][l - from];
            }
        }
        if let Some(slope) = slope.as_deref_mut() {
            for l in 0..4 {
                slope[from + l] *= rise[3][l];
            }
        }
    }
}

/// The highest of these indices.
#[inline(always)]
pub(crate) fn highest(indices: &[u32]) -> u32 {
    indices.iter().fold(0, |most, n| most.max(*n))
}

/// Weights of the four columns of a cell, from a position in it: (0, 0), (0, 1), (1, 0), (1, 1).
#[inline(always)]
pub(crate) fn weights(f: f32, g: f32) -> [f32; 4] {
    let (f0, g0) = (1.0 - f, 1.0 - g);
    [f0 * g0, f0 * g, f * g0, f * g]
}

/// `[u, v, w, K_z]` at a point of a column cell, and its difference between the levels below and above.
///
/// # Safety
/// The eight nodes of the cell must exist: with the strides `(up_j, up_i)` of the cells,
/// `at · up_j + level + 1 + up_j + up_i < nodes.len()`. The machine must have the instructions of `P`.
#[inline(always)]
pub(crate) unsafe fn trilinear<P: Pair>(
    cells: &Lookup,
    nodes: &[[f32; 4]],
    at: u32,
    weight: [f32; 4],
    level: u32,
    part: f32,
) -> (F32x4, F32x4) {
    let (up_j, up_i) = cells.strides();
    let at = at as usize * up_j + level as usize;
    let [w00, w01, w10, w11] = weight;
    // SAFETY: these nodes and those above them are the cell's eight, which exist as the caller promises.
    let columns = unsafe {
        [
            both::<P>(nodes, at),
            both::<P>(nodes, at + up_j),
            both::<P>(nodes, at + up_i),
            both::<P>(nodes, at + up_i + up_j),
        ]
    };
    let near = columns[0].times(w00).add(columns[1].times(w01));
    let far = columns[2].times(w10).add(columns[3].times(w11));
    let [low, high] = near.add(far).apart();
    let rise = high.sub(low);
    (low.add(rise.times(part)), rise)
}

/// The water at the place of one filament of a block, as [`trilinear`].
///
/// # Safety
/// As there.
#[inline(always)]
unsafe fn one<P: Pair>(
    cells: &Lookup,
    nodes: &[[f32; 4]],
    column: &Columns,
    level: &Levels,
    l: usize,
) -> (F32x4, F32x4) {
    let weight = [column.weight[0][l], column.weight[1][l], column.weight[2][l], column.weight[3][l]];
    // SAFETY: as the caller promises.
    unsafe { trilinear::<P>(cells, nodes, column.at[l], weight, level.below[l], level.part[l]) }
}

/// A node and the one above it. A function of its own and not a closure, because only a function is certain to become
/// part of code that may use the instructions of `P`.
///
/// # Safety
/// Both nodes must exist, and the machine must have the instructions of `P`.
#[inline(always)]
unsafe fn both<P: Pair>(nodes: &[[f32; 4]], n: usize) -> P {
    debug_assert!(n + 1 < nodes.len());
    // SAFETY: as the caller promises.
    unsafe { P::new(nodes.get_unchecked(n), nodes.get_unchecked(n + 1)) }
}
