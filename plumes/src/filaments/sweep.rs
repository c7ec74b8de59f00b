//! Moves a store by one step, block by block, and reflects at walls what was kicked or carried through them.
//!
//! *Source*: none.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use super::kernel::{BLOCK, Block, Work};
use super::lookup::Lookup;
use super::rebound::Kick;
use super::room::Room;
use super::store::Store;
use crate::flow::grid::FlowGrid;

/// Reflects filaments of a block at walls through which their kicks led. Returns their number.
pub(super) fn keep_out(
    room: &Room,
    cells: &Lookup,
    grid: &FlowGrid,
    from: &[[f32; BLOCK]; 3],
    b: &mut Block,
    work: &Work,
) -> u64 {
    let mut turned = 0;
    let near = room.near_walls(cells, from, [&b.x, &b.y, &b.z]);
    for l in (0..b.used).filter(|l| near[*l]) {
        let (start, end) = (from.map(|v| v[l]), [b.x[l], b.y[l], b.z[l]]);
        if !room.by_walls(cells, start, end) {
            continue;
        }
        let kick = Kick {
            noise: work.upward(l),
            dt_s: b.dt[l],
            part: b.kicked[l],
        };
        let to = room.turn_back(cells, grid, start, end, Some(kick));
        turned += u64::from(to.met);
        [b.x[l], b.y[l], b.z[l]] = to.p;
        b.bed[l] = cells.bed(cells.column(to.p[0], to.p[1]));
        b.outside[l] = u32::from(to.left);
    }
    turned
}

/// As `keep_out`, for a store that was carried away from earlier positions.
pub(super) fn hold(
    room: &Room,
    cells: &Lookup,
    grid: &FlowGrid,
    before: &[Vec<f32>; 3],
    store: &mut Store,
) -> u64 {
    let mut turned = 0;
    let [x, y, z] = before;
    for (n, ((x, y), z)) in x.iter().zip(y).zip(z).take(store.len()).enumerate() {
        let start = [*x, *y, *z];
        let end = [store.x[n], store.y[n], store.z[n]];
        if room.by_walls(cells, start, end) {
            let to = room.turn_back(cells, grid, start, end, None);
            if !to.left {
                turned += u64::from(to.met);
                [store.x[n], store.y[n], store.z[n]] = to.p;
                store.bed[n] = cells.bed(cells.column(to.p[0], to.p[1]));
            }
        }
    }
    turned
}

/// Applies `step` to the store, block by block. The first `old` filaments move for the whole step, newer ones from
/// their release on. Filaments that leave are removed.
pub(super) fn sweep(
    store: &mut Store,
    old: usize,
    t0_s: f64,
    t1_s: f64,
    mut step: impl FnMut(&mut Block),
) {
    let mut b = Block {
        x: [0.0; BLOCK],
        y: [0.0; BLOCK],
        z: [0.0; BLOCK],
        bed: [-1.0; BLOCK],
        dt: [(t1_s - t0_s) as f32; BLOCK],
        number: [0; BLOCK],
        kicked: [1.0; BLOCK],
        outside: [0; BLOCK],
        used: 0,
    };
    let (total, mut to) = (store.len(), 0);
    for from in (0..total).step_by(BLOCK) {
        let n = BLOCK.min(total - from);
        b.used = n;
        b.x[..n].copy_from_slice(&store.x[from..from + n]);
        b.y[..n].copy_from_slice(&store.y[from..from + n]);
        b.z[..n].copy_from_slice(&store.z[from..from + n]);
        b.bed[..n].copy_from_slice(&store.bed[from..from + n]);
        b.number[..n].copy_from_slice(&store.number[from..from + n]);
        for l in old.saturating_sub(from).min(n)..n {
            b.dt[l] = (t1_s - store.born_s[from + l]) as f32;
        }
        if store.size.shares() {
            for l in 0..n {
                let middle = t1_s - 0.5 * f64::from(b.dt[l]);
                b.kicked[l] = store.size.kicked(middle - store.born_s[from + l]);
            }
        }
        step(&mut b);
        if b.outside[..n].iter().any(|o| *o != 0) {
            for l in (0..n).filter(|l| b.outside[*l] == 0) {
                put(store, &b, l, to, 1);
                store.shift_labels(from + l, to, 1);
                to += 1;
            }
        } else {
            put(store, &b, 0, to, n);
            if to != from {
                store.shift_labels(from, to, n);
            }
            to += n;
        }
    }
    store.truncate(to);
}

fn put(store: &mut Store, b: &Block, l: usize, to: usize, n: usize) {
    store.x[to..to + n].copy_from_slice(&b.x[l..l + n]);
    store.y[to..to + n].copy_from_slice(&b.y[l..l + n]);
    store.z[to..to + n].copy_from_slice(&b.z[l..l + n]);
    store.bed[to..to + n].copy_from_slice(&b.bed[l..l + n]);
}
