//! Carries filaments through the cells of blocked water, along paths that the flow through the cells' faces determines.
//!
//! *Source*: Pollock 1988, Ground Water 26, 743: in a cell each velocity component is linear between two faces, so the
//! path has a closed form. The field is that of Raviart and Thomas 1977, Lect. Notes Math. 606, 292.
//!
//! *Parameters*: none.
//!
//! *Deviations*: the cells follow the bed. In the coordinates along, across and s, a filament passes the cell as it
//! would a box with the cell's mean depth (Piola's transform; Matringe et al. 2006, J. Comput. Phys. 219, 992). Dye
//! that is evenly mixed stays even from cell to cell; within a cell, to the change of depth over half of it. Where
//! friction holds the water at the bed, the current in the lowest cells grows linearly from zero at the bed to twice
//! its mean; that field is still free of divergence and its paths still have a closed form. The field is constant
//! between two refreshes.
//!
//! A filament that stays in its cell moves by a series in f32, eight at once. One that leaves its cell goes from face
//! to face in f64. No step is too long: nothing passes a closed face, and the volume of any cloud is conserved.

use super::kernel::Block;
use super::series::{current_time, expansion, logarithm, series};
use crate::filaments::water::fetch::{BLOCK, highest};
use crate::filaments::water::lookup::Lookup;
use crate::flow::blockage::ObstacleFlow;
use crate::flow::grid::FlowGrid;
use crate::simd::dispatch::InstructionSet;
use crate::simd::f32x4::F32x4;
use world::fields::Flow;

/// Greatest growth over a step (rate · time) for the series.
const GENTLE: f32 = 0.25;
/// More faces than this in one step mean that something is wrong.
const MOST_FACES: usize = 1_000_000;

/// Carries filaments from face to face.
#[derive(Clone, Debug)]
pub(crate) struct Pollock {
    // Speeds along, across and upwards at the lower and the upper face, in cell sizes per second. Laid out as the
    // columns of the grid, without the last level.
    rates: Vec<[f32; 6]>,
    levels: usize,
    // Columns along, across.
    n: [usize; 2],
    // Distance between two levels as a part of the depth.
    ds: Vec<f32>,
    still_bed: bool,
}

/// Memory for what is computed about a block.
pub(crate) struct PollockScratch {
    column: [u32; BLOCK],
    level: [u32; BLOCK],
    part: [[f32; BLOCK]; 3],
    rate: [[f32; BLOCK]; 6],
    to: [[f32; BLOCK]; 3],
    fits: [u32; BLOCK],
    /// Set if it left the grid.
    pub(crate) gone: [u32; BLOCK],
}

impl PollockScratch {
    pub(crate) fn new() -> Self {
        Self {
            column: [0; BLOCK],
            level: [0; BLOCK],
            part: [[0.0; BLOCK]; 3],
            rate: [[0.0; BLOCK]; 6],
            to: [[0.0; BLOCK]; 3],
            fits: [0; BLOCK],
            gone: [0; BLOCK],
        }
    }
}

/// A filament in a cell: the cell, and its position there as parts of the cell.
#[derive(Clone, Copy, Debug)]
struct Inside {
    cell: [usize; 3],
    part: [f64; 3],
    left: bool,
}

impl Pollock {
    pub(crate) fn new(blocked: &ObstacleFlow) -> Self {
        let cells = blocked.cells();
        Self {
            rates: Vec::new(),
            levels: cells.n[2],
            n: [cells.n[0], cells.n[1]],
            ds: cells.s.windows(2).map(|s| (s[1] - s[0]) as f32).collect(),
            still_bed: blocked.still_bed(),
        }
    }

    /// Evaluates the flow again.
    ///
    /// # Panics
    /// If the flow was not computed in cells, or returns NaN.
    pub(crate) fn refresh(&mut self, flow: &dyn Flow, t_s: f64) {
        assert!(
            flow.rates(t_s, &mut self.rates),
            "the plume was led round obstacles, but the flow at {t_s} s was not worked out in cells: drift it with the water it was made for"
        );
        assert_eq!(
            self.rates.len(),
            self.n[0] * (self.n[1] + 1) * self.levels,
            "the plume was led round obstacles in other cells than the flow's: drift it with the water it was made for"
        );
        for (n, r) in self.rates.iter().enumerate() {
            assert!(
                r.iter().all(|v| v.is_finite()),
                "the flow at {t_s} s gives rates {r:?} in cell {n}: they must be numbers"
            );
        }
    }

    fn rates_of_cell(&self, [i, j, k]: [usize; 3]) -> &[f32; 6] {
        &self.rates[(i * (self.n[1] + 1) + j) * self.levels + k]
    }

    /// Carries a block by its `dt`.
    pub(crate) fn carry(
        &self,
        path: InstructionSet,
        lookup: &Lookup,
        grid: &FlowGrid,
        block: &mut Block,
        way: &mut PollockScratch,
    ) {
        path.run(
            #[inline(always)]
            || self.body(lookup, grid, block, way),
        );
    }

    #[inline(always)]
    fn body(&self, lookup: &Lookup, grid: &FlowGrid, b: &mut Block, way: &mut PollockScratch) {
        let PollockScratch { column, level, part, rate, to, fits, gone } = way;
        for l in 0..BLOCK {
            let c = lookup.column(b.x[l], b.y[l]);
            (column[l], part[0][l], part[1][l]) = (c.at, c.f, c.g);
        }
        for l in 0..BLOCK {
            let v = lookup.level(b.z[l], -1.0 / b.bed[l]);
            (level[l], part[2][l]) = (v.below, v.part);
        }
        let last = highest(column) as usize * self.levels + highest(level) as usize;
        assert!(
            last < self.rates.len(),
            "a filament's cell has no rates: they were made for another grid than the filaments'"
        );
        for from in (0..BLOCK).step_by(4) {
            // The first four and the last four of six values.
            let at = |l: usize, first: usize| {
                let n = column[from + l] as usize * self.levels + level[from + l] as usize;
                // SAFETY: no cell of the block lies beyond the rates, as asserted above.
                let rates = unsafe { self.rates.get_unchecked(n) };
                let four = rates[first..].first_chunk().expect("four of the six");
                F32x4::new(four)
            };
            let low = F32x4::columns([at(0, 0), at(1, 0), at(2, 0), at(3, 0)]);
            let high = F32x4::columns([at(0, 2), at(1, 2), at(2, 2), at(3, 2)]);
            for d in 0..4 {
                rate[d][from..from + 4].copy_from_slice(&low[d]);
            }
            for d in 2..4 {
                rate[d + 2][from..from + 4].copy_from_slice(&high[d]);
            }
        }
        let mut time = b.dt;
        if self.still_bed {
            // In the lowest cell over a no-slip bed, time runs as the current at the filament's height measures it.
            for l in 0..BLOCK {
                let x = (rate[5][l] - rate[4][l]) * part[2][l] * b.dt[l];
                let counted = 2.0 * part[2][l] * b.dt[l] * current_time(x);
                time[l] = if level[l] == 0 { counted } else { time[l] };
            }
        }
        fits.fill(1);
        gone.fill(0);
        for d in 0..3 {
            let (low, high) = (&rate[2 * d], &rate[2 * d + 1]);
            let time = if d == 2 { &b.dt } else { &time };
            let (part, to) = (&part[d], &mut to[d]);
            for l in 0..BLOCK {
                let growth = high[l] - low[l];
                let e = growth * time[l];
                let end = part[l] + (low[l] + growth * part[l]) * time[l] * series(e);
                to[l] = end;
                fits[l] &= u32::from((e.abs() < GENTLE) & (0.0..=1.0).contains(&end));
            }
        }
        if self.still_bed {
            for l in 0..BLOCK {
                let e = (rate[5][l] - rate[4][l]) * b.dt[l];
                let end = part[2][l] / (1.0 - e * part[2][l]);
                let inside = u32::from((e.abs() < 0.5 * GENTLE) & (0.0..=1.0).contains(&end));
                let lowest = level[l] == 0;
                fits[l] &= if lowest { inside } else { 1 };
                to[2][l] = if lowest { end } else { to[2][l] };
            }
        }
        // A filament that does not stay in its cell is left where it is and carried individually later.
        for d in 0..3 {
            for l in 0..BLOCK {
                to[d][l] = if fits[l] == 0 { part[d][l] } else { to[d][l] };
            }
        }
        let [along, across] = [grid.along, grid.across];
        for l in 0..BLOCK {
            let da = (to[0][l] - part[0][l]) * grid.spacing[0];
            let db = (to[1][l] - part[1][l]) * grid.spacing[1];
            b.x[l] += along[0] * da + across[0] * db;
            b.y[l] += along[1] * da + across[1] * db;
        }
        for l in 0..BLOCK {
            let rise = (to[2][l] - part[2][l]) * self.ds[level[l] as usize];
            let bed = lookup.bed(b.x[l], b.y[l]);
            b.z[l] = b.z[l] * (bed / b.bed[l]) - bed * rise;
            b.bed[l] = bed;
        }
        for l in (0..b.used).filter(|l| fits[*l] == 0) {
            self.far(lookup, grid, b, l, column[l], level[l], gone);
        }
    }

    /// Carries one filament from cell to cell.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "where one filament of a block is")]
    fn far(
        &self,
        lookup: &Lookup,
        grid: &FlowGrid,
        b: &mut Block,
        l: usize,
        column: u32,
        level: u32,
        gone: &mut [u32; BLOCK],
    ) {
        let c = lookup.column(b.x[l], b.y[l]);
        if c.outside {
            gone[l] = 1;
            return;
        }
        let v = lookup.level(b.z[l], -1.0 / b.bed[l]);
        let across = self.n[1] + 1;
        let cell = [column as usize / across, column as usize % across, level as usize];
        let start = [c.f, c.g, v.part].map(f64::from);
        let end = self.path(Inside { cell, part: start, left: false }, f64::from(b.dt[l]));
        gone[l] = u32::from(end.left);
        let went = |d: usize| {
            let cells = end.cell[d] as f64 - cell[d] as f64 + end.part[d] - start[d];
            (cells * f64::from(grid.spacing[d])) as f32
        };
        let (da, db) = (went(0), went(1));
        b.x[l] += grid.along[0] * da + grid.across[0] * db;
        b.y[l] += grid.along[1] * da + grid.across[1] * db;
        let k = end.cell[2];
        let s = f64::from(grid.levels[k]) + end.part[2] * f64::from(self.ds[k]);
        let bed = lookup.bed(b.x[l], b.y[l]);
        b.z[l] = (f64::from(bed) * (1.0 - s)) as f32;
        b.bed[l] = bed;
    }

    /// Position of a filament after a time, s.
    fn path(&self, mut at: Inside, mut left_s: f64) -> Inside {
        let n = [self.n[0], self.n[1], self.levels];
        for _ in 0..MOST_FACES {
            let r = self.rates_of_cell(at.cell).map(f64::from);
            let still = self.still_bed && at.cell[2] == 0;
            // Speeds at the lower faces and their growth; over a no-slip bed, in the current's own time.
            let growth = [r[1] - r[0], r[3] - r[2], (r[5] - r[4]) * if still { 0.5 } else { 1.0 }];
            let speed = [0, 1, 2].map(|d| {
                let low = if still && d == 2 { 0.0 } else { r[2 * d] };
                low + growth[d] * at.part[d]
            });
            let (h, f) = (growth[2], at.part[2]);
            let counted = if still { 2.0 * f * left_s * logarithm(-2.0 * h * f * left_s) } else { left_s };
            let (mut first, mut through) = (counted, None);
            for d in 0..3 {
                let to = if speed[d] > 0.0 { 1.0 } else { 0.0 };
                let way = to - at.part[d];
                if speed[d] == 0.0 {
                    continue;
                }
                // The speed at the face is speed + growth · way. The filament reaches the face unless the speed changes
                // sign before.
                let q = growth[d] * way / speed[d];
                if q <= -1.0 {
                    continue;
                }
                let time = (way / speed[d] * logarithm(q)).max(0.0);
                // Not `<`: a time that is NaN (that of an infinite current) does not count.
                if time < first || (first.is_infinite() && time.is_finite()) {
                    (first, through) = (time, Some((d, to)));
                }
            }
            for d in 0..3 {
                at.part[d] = (at.part[d] + speed[d] * first * expansion(growth[d] * first)).clamp(0.0, 1.0);
            }
            let Some((d, to)) = through else {
                return at;
            };
            let passed = if still { 0.5 / f * first * expansion(-h * first) } else { first };
            left_s = (left_s - passed).max(0.0);
            at.part[d] = 1.0 - to;
            if to > 0.5 {
                at.cell[d] += 1;
                if at.cell[d] == n[d] {
                    (at.cell[d], at.part[d], at.left) = (n[d] - 1, 1.0 + 1e-3, true);
                    return at;
                }
            } else if at.cell[d] == 0 {
                (at.part[d], at.left) = (-1e-3, true);
                return at;
            } else {
                at.cell[d] -= 1;
            }
        }
        panic!(
            "a filament passed {MOST_FACES} faces of blocked water's cells in one step: take larger water.blockage.cell_m or a shorter drift period"
        );
    }
}
