//! Moves a band of filaments by one step, block by block, and reflects at walls what was kicked or carried through
//! them.
//!
//! *Source*: none.
//!
//! *Parameters*: [`CHUNK`], the filaments that one thread takes at a time.
//!
//! *Deviations*: none. Blocks do not depend on each other, so any number of threads gives the same bits.

use super::kernel::{self, Block, Work};
use super::pollock::{Pollock, PollockScratch};
use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::Span;
use crate::filaments::store::size::Size;
use crate::filaments::walls::domain::Domain;
use crate::filaments::walls::rebound::Kick;
use crate::filaments::water::fetch::BLOCK;
use crate::filaments::water::lookup::Lookup;
use crate::flow::grid::FlowGrid;
use crate::noise::upward_normals;
use crate::simd::dispatch::InstructionSet;
use rayon::prelude::*;
use std::ops::Range;

/// Filaments in a chunk: 16 blocks, a quarter of a millisecond.
const CHUNK: usize = 16 * BLOCK;

/// What a sweep needs to know of the plume.
pub(crate) struct DriftContext<'a> {
    pub(crate) path: InstructionSet,
    pub(crate) cells: &'a Lookup,
    pub(crate) room: &'a Domain,
    pub(crate) grid: &'a FlowGrid,
    pub(crate) carrier: Option<&'a Pollock>,
    pub(crate) key: [u32; 2],
    pub(crate) span: Span,
}

/// What came of a sweep.
#[derive(Default)]
pub(crate) struct DriftOutcome {
    /// Number of reflections at walls.
    pub(crate) turned: u64,
    /// Columns of the grid in whose cells filaments arrived from others; some more than once.
    pub(crate) columns: Vec<u32>,
    /// Places in the chunk of those that left.
    gone: Vec<usize>,
    kept: usize,
}

/// Memory in which blocks are moved, kept so that it is not cleared for every few filaments.
pub(crate) struct Scratch {
    block: Block,
    work: Work,
    pollock_scratch: PollockScratch,
}

impl Default for Scratch {
    fn default() -> Self {
        Self {
            block: Block {
                x: [0.0; BLOCK],
                y: [0.0; BLOCK],
                z: [0.0; BLOCK],
                bed: [-1.0; BLOCK],
                dt: [0.0; BLOCK],
                number: [0; BLOCK],
                kicked: [1.0; BLOCK],
                outside: [0; BLOCK],
                moved: [0; BLOCK],
                used: 0,
            },
            work: Work::new(),
            pollock_scratch: PollockScratch::new(),
        }
    }
}

/// The part of a store that one thread moves.
struct Chunk<'a> {
    x: &'a mut [f32],
    y: &'a mut [f32],
    z: &'a mut [f32],
    start: [&'a mut [f32]; 3],
    bed: &'a mut [f32],
    number: &'a mut [u32],
    born_s: &'a mut [f64],
    size: Size,
    swept: DriftOutcome,
}

impl DriftContext<'_> {
    /// Moves a range of the store. Filaments released within the step move from their release on. Those that leave are
    /// removed. `first` of later bands is corrected. Without `threads`, `scratch` is used.
    pub(crate) fn over(
        &self,
        store: &mut Store,
        band: Range<usize>,
        threads: bool,
        scratch: &mut Scratch,
    ) -> DriftOutcome {
        // A single thread moves them down as it goes.
        let many = if threads { CHUNK } else { band.len() };
        let mut chunks = chunks(store, band.clone(), many);
        if threads {
            (chunks.par_iter_mut()).for_each(|c| self.through(c, &mut Scratch::default()));
        } else {
            chunks.iter_mut().for_each(|c| self.through(c, scratch));
        }
        let swept: Vec<DriftOutcome> = chunks.into_iter().map(|c| c.swept).collect();
        let (mut all, mut to) = (DriftOutcome::default(), band.start);
        for (n, part) in swept.into_iter().enumerate() {
            let from = band.start + n * many;
            all.gone.extend(part.gone.iter().map(|l| from + l));
            store.shift(from..from + part.kept, to);
            to += part.kept;
            all.turned += part.turned;
            all.columns.extend(part.columns);
        }
        let gone = band.end - to;
        if gone > 0 {
            let end = store.len();
            store.forget(&all.gone);
            store.shift(band.end..end, to);
            store.truncate(end - gone);
            for first in store.first.iter_mut().filter(|f| **f >= band.end) {
                *first -= gone;
            }
        }
        all
    }

    fn through(&self, c: &mut Chunk, scratch: &mut Scratch) {
        let Scratch { block: b, work, pollock_scratch } = scratch;
        b.kicked.fill(1.0);
        let Span { from_s, to_s } = self.span;
        let (total, mut to) = (c.x.len(), 0);
        for from in (0..total).step_by(BLOCK) {
            let n = BLOCK.min(total - from);
            b.used = n;
            b.x[..n].copy_from_slice(&c.x[from..from + n]);
            b.y[..n].copy_from_slice(&c.y[from..from + n]);
            b.z[..n].copy_from_slice(&c.z[from..from + n]);
            b.bed[..n].copy_from_slice(&c.bed[from..from + n]);
            b.number[..n].copy_from_slice(&c.number[from..from + n]);
            let born_s = &c.born_s[from..from + n];
            b.dt[..n].fill((to_s - from_s) as f32);
            // The newest filaments come last.
            for (dt, born) in b.dt[..n].iter_mut().zip(born_s).rev() {
                if *born <= from_s {
                    break;
                }
                *dt = (to_s - born) as f32;
            }
            if c.size.shares() {
                for ((kicked, dt), born) in b.kicked.iter_mut().zip(&b.dt).zip(born_s) {
                    let middle = to_s - 0.5 * f64::from(*dt);
                    *kicked = c.size.kicked(middle - born);
                }
            }
            if let Some(carrier) = self.carrier {
                carrier.carry(self.path, self.cells, self.grid, b, pollock_scratch);
            }
            // Copied only where there are solids.
            let carried = match self.room.has_solids() {
                true => Some([b.x, b.y, b.z]),
                false => None,
            };
            kernel::step(self.path, self.cells, &self.grid.data, self.key, b, work);
            if self.carrier.is_some() {
                for (outside, gone) in b.outside.iter_mut().zip(&pollock_scratch.gone) {
                    *outside |= gone;
                }
            }
            if let Some(carried) = &carried {
                c.swept.turned += self.keep_out(carried, b);
            }
            self.note(b, &mut c.swept.columns);
            // Those between two that leave are put down together.
            let all_stay = b.outside[..n].iter().fold(0, |any, out| any | out) == 0;
            let mut l = 0;
            while l < n {
                let stay = match all_stay {
                    true => n,
                    false => b.outside[l..n].iter().take_while(|o| **o == 0).count(),
                };
                c.store(b, l, from + l, to, stay);
                (l, to) = (l + stay, to + stay);
                if l < n {
                    c.swept.gone.push(from + l);
                    l += 1;
                }
            }
        }
        c.swept.kept = to;
    }

    /// Notes the columns of the cells in which filaments of a block have arrived. The cells in which they started were
    /// noted before.
    fn note(&self, b: &Block, columns: &mut Vec<u32>) {
        for (n, some) in b.moved.as_chunks::<32>().0.iter().enumerate() {
            // Few have moved to another column; a word tells which without a look at each.
            let mut bits = 0;
            for (l, moved) in some.iter().enumerate() {
                bits |= moved.wrapping_neg() & (1 << l);
            }
            while bits != 0 {
                let l = 32 * n + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                if l >= b.used {
                    return;
                }
                columns.push(self.cells.column(b.x[l], b.y[l]).at);
            }
        }
    }

    /// Reflects filaments of a block at walls through which their kicks led. Returns their number.
    fn keep_out(&self, from: &[[f32; BLOCK]; 3], b: &mut Block) -> u64 {
        let (room, cells) = (self.room, self.cells);
        let mut turned = 0;
        let near = room.near_walls(cells, from, [&b.x, &b.y, &b.z]);
        for l in (0..b.used).filter(|l| near[*l]) {
            let (start, end) = (from.map(|v| v[l]), [b.x[l], b.y[l], b.z[l]]);
            if !room.by_walls(cells, start, end) {
                continue;
            }
            let kick = Kick { noise: upward_normals(b.number[l], self.key), dt_s: b.dt[l], part: b.kicked[l] };
            let to = room.turn_back(cells, self.grid, start, end, Some(kick));
            turned += u64::from(to.met);
            [b.x[l], b.y[l], b.z[l]] = to.p;
            b.bed[l] = cells.bed(to.p[0], to.p[1]);
            (b.outside[l], b.moved[l]) = (u32::from(to.left), 1);
        }
        turned
    }
}

/// As `DriftContext::keep_out`, for filaments from the `first` on that were carried away from earlier positions.
pub(crate) fn hold(
    room: &Domain,
    cells: &Lookup,
    grid: &FlowGrid,
    before: &[Vec<f32>; 3],
    store: &mut Store,
    first: usize,
) -> u64 {
    let mut turned = 0;
    let [x, y, z] = before;
    for (n, ((x, y), z)) in (first..).zip(x.iter().zip(y).zip(z)) {
        let start = [*x, *y, *z];
        let end = [store.x[n], store.y[n], store.z[n]];
        if room.by_walls(cells, start, end) {
            let to = room.turn_back(cells, grid, start, end, None);
            if !to.left {
                turned += u64::from(to.met);
                [store.x[n], store.y[n], store.z[n]] = to.p;
                store.bed[n] = cells.bed(to.p[0], to.p[1]);
            }
        }
    }
    turned
}

/// The chunks of a range, in order, of `many` filaments each; the last may have fewer.
fn chunks(store: &mut Store, band: Range<usize>, many: usize) -> Vec<Chunk<'_>> {
    let size = store.size;
    let [sx, sy, sz] = &mut store.start;
    let numbers = [&mut store.x, &mut store.y, &mut store.z, &mut store.bed, sx, sy, sz];
    let mut numbers = numbers.map(|v| v[band.clone()].chunks_mut(many));
    let born_s = store.born_s[band.clone()].chunks_mut(many);
    let chunk = |(number, born_s)| {
        let next = numbers.each_mut().map(|v| v.next().expect("all arrays have as many chunks"));
        let [x, y, z, bed, sx, sy, sz] = next;
        Chunk { x, y, z, start: [sx, sy, sz], bed, number, born_s, size, swept: DriftOutcome::default() }
    };
    store.number[band].chunks_mut(many).zip(born_s).map(chunk).collect()
}

impl Chunk<'_> {
    /// Writes `n` filaments of a block, from its place `l` on, to `to`. They were at `from`, where their step starts.
    fn store(&mut self, b: &Block, l: usize, from: usize, to: usize, n: usize) {
        let ends = [(&mut *self.x, &b.x), (&mut *self.y, &b.y), (&mut *self.z, &b.z)];
        for ((end, moved), start) in ends.into_iter().zip(&mut self.start) {
            start[to..to + n].copy_from_slice(&end[from..from + n]);
            end[to..to + n].copy_from_slice(&moved[l..l + n]);
        }
        self.bed[to..to + n].copy_from_slice(&b.bed[l..l + n]);
        if from != to {
            self.number.copy_within(from..from + n, to);
            self.born_s.copy_within(from..from + n, to);
        }
    }
}
