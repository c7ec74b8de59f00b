//! The cells around a cell, all at once: what the way to each of them would cost, and to which it may go.
//!
//! *Source*: none of its own; for the costs see `search.rs`.
//!
//! *Parameters*: size of the padded grid; lengths of the moves.
//!
//! *Deviations*: none. Cells lie in rows of four lanes: three neighbours along the first axis, and a fourth that only
//! fills the row, so that the compiler makes vector instructions of the arithmetic. A block of neighbours has three
//! rows in the plane, nine in space; a lane's number is 4·row + place in the row.

use super::octile::Octile;

/// Penalty of a cell that is not free.
pub(super) const BLOCKED: u8 = u8::MAX;
/// Penalties are counted in parts of a move's length.
pub(super) const PARTS: u32 = 64;
/// Cells that an array needs beyond the last one of the grid, for the lane that fills the last row.
pub(super) const BEYOND: usize = 1;

/// Costs by lane.
pub(super) type Lanes = [[u32; 4]; 9];

/// Tables of a grid that has a border of blocked cells all around (in the plane: none above and below).
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    plane: bool,
    /// From the first cell of the block to the first cell of each row.
    rows: [usize; 9],
    /// From the first cell of the block to its middle.
    middle: usize,
    /// Lanes that are moves, as bits.
    moves: u64,
    /// Costs of the moves without penalty.
    lengths: Lanes,
    /// Lanes that must be free for a move: all cells of the block between its ends.
    needs: [[u64; 4]; 9],
}

impl Neighbours {
    pub(super) fn new(n: [usize; 3], plane: bool, octile: &Octile) -> Self {
        let mut new = Self { plane, middle: 1 + n[0] + if plane { 0 } else { n[0] * n[1] }, ..Self::default() };
        for row in 0..new.count() {
            new.rows[row] = (row % 3) * n[0] + (row / 3) * n[0] * n[1];
            for place in 0..3 {
                let d = new.step(4 * row + place);
                let set = (0..3).filter(|a| d[*a] != 0).map(|a| 1 << a).sum();
                if set == 0 {
                    continue;
                }
                new.moves |= 1 << (4 * row + place);
                new.lengths[row][place] = octile.length(set).ceil() as u32 + 1;
                for corner in 1..8_usize {
                    let part = [0, 1, 2].map(|a| if corner >> a & 1 == 1 { d[a] } else { 0 });
                    if part != [0; 3] {
                        new.needs[row][place] |= 1 << new.lane(part);
                    }
                }
            }
        }
        new
    }

    /// Number of rows.
    fn count(&self) -> usize {
        if self.plane { 3 } else { 9 }
    }

    /// How far a lane's cell is from the middle along each axis.
    #[inline]
    fn step(&self, lane: usize) -> [isize; 3] {
        let row = lane / 4;
        let up = if self.plane { 0 } else { row / 3 } as isize - isize::from(!self.plane);
        [(lane % 4) as isize - 1, (row % 3) as isize - 1, up]
    }

    fn lane(&self, [i, j, k]: [isize; 3]) -> usize {
        let row = j + 1 + if self.plane { 0 } else { 3 * (k + 1) };
        (4 * row + i + 1) as usize
    }

    /// The cell of a lane in the block around `cell`.
    #[inline]
    pub(super) fn cell(&self, cell: usize, lane: usize) -> usize {
        cell - self.middle + self.rows[lane / 4] + lane % 4
    }

    /// The cell from which the move of this lane led to `cell`.
    pub(super) fn before(&self, cell: usize, lane: usize) -> usize {
        cell + self.middle - self.rows[lane / 4] - lane % 4
    }

    /// The place of a lane's cell, where the middle of the block is at `at`.
    #[inline]
    pub(super) fn place(&self, at: [usize; 3], lane: usize) -> [usize; 3] {
        let d = self.step(lane);
        [0, 1, 2].map(|a| at[a].wrapping_add_signed(d[a]))
    }

    /// Lanes whose cells are reached from `cell`, at the end of a way that costs `own`, for less than the costs `g`;
    /// and what they would cost.
    #[inline]
    pub(super) fn better(&self, cell: usize, own: u32, g: &[u32], penalty: &[u8]) -> (u64, Lanes) {
        let (lanes, costs) = if self.plane {
            self.cheaper::<3>(cell, own, g, penalty)
        } else {
            self.cheaper::<9>(cell, own, g, penalty)
        };
        let mut lanes = lanes & self.moves;
        if lanes != 0 {
            let free = self.free(cell, penalty);
            for lane in ones(lanes) {
                let needs = self.needs[lane / 4][lane % 4];
                if free & needs != needs {
                    lanes &= !(1 << lane);
                }
            }
        }
        (lanes, costs)
    }

    /// The same without a look at which moves there are.
    #[inline]
    fn cheaper<const ROWS: usize>(&self, cell: usize, own: u32, g: &[u32], penalty: &[u8]) -> (u64, Lanes) {
        let mut costs = [[0; 4]; 9];
        let mut less = [[0_u8; 4]; 9];
        let first = cell - self.middle;
        for row in 0..ROWS {
            let at = first + self.rows[row];
            let (g, penalty) = (&g[at..at + 4], &penalty[at..at + 4]);
            for i in 0..4 {
                let parts = PARTS + u32::from(penalty[i]);
                costs[row][i] = own + (self.lengths[row][i] * parts).div_ceil(PARTS);
                less[row][i] = u8::from(costs[row][i] < g[i]);
            }
        }
        let mut lanes = 0;
        for (row, less) in less.iter().enumerate().take(ROWS) {
            // The product moves the four bytes, each 0 or 1, to bits 24 to 27.
            let bits = u32::from_le_bytes(*less).wrapping_mul(0x0102_0408) >> 24;
            lanes |= u64::from(bits) << (4 * row);
        }
        (lanes, costs)
    }

    /// Lanes whose cells are free.
    #[inline]
    fn free(&self, cell: usize, penalty: &[u8]) -> u64 {
        let mut lanes = 0;
        for row in 0..self.count() {
            let at = cell - self.middle + self.rows[row];
            for (i, penalty) in penalty[at..at + 3].iter().enumerate() {
                lanes |= u64::from(*penalty != BLOCKED) << (4 * row + i);
            }
        }
        lanes
    }

    /// Cost of the dearest move.
    pub(super) fn dearest(&self) -> u32 {
        let longest = self.lengths.iter().flatten().max().unwrap_or(&0);
        (longest * (PARTS + u32::from(BLOCKED))).div_ceil(PARTS)
    }
}

/// The numbers of the bits that are set, least first.
#[inline]
pub(super) fn ones(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let least = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        least
    })
}
