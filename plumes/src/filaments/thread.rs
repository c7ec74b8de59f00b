//! Concentration of a thread of small filaments. Few of them are near any point, and a search through all finds them.
//!
//! *Source*: none. A linear search is faster than a tree for a few thousand, and the drift moves them between any two
//! questions.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none; the kernel is that of `leaf`, near walls that of `image`.

use super::image::{Felt, Spot};
use super::kernel::Path;
use super::leaf::{CUT_SIGMAS, LEAF, Leaf};
use super::store::Store;

/// Filaments tested at once.
const LANES: usize = 16;

/// Concentration, kg/m³, at a point in the water, from the filaments of a store that stop growing at a size.
pub(super) fn at(s: &Store, now_s: f64, path: Path, query: &Spot<'_>) -> f64 {
    let p = query.p;
    let Some(first) = s.born_s.first() else {
        return 0.0;
    };
    // The first is the oldest, and so the largest.
    let reach = CUT_SIGMAS * 1.000_01 * s.size.horizontal(now_s - first);
    let (mut leaf, mut held, mut total) = (Leaf::new(), 0, 0.0);
    let mut take = |n: usize| {
        if (s.y[n] - p[1]).abs() > reach {
            return;
        }
        let sh = s.size.horizontal(now_s - s.born_s[n]);
        let sizes = [sh, s.size.vertical(sh, s.bed[n])];
        let at = [s.x[n], s.y[n], s.z[n]];
        if let Some(felt) = Felt::new(query.room, query.lookup, at, sizes, s.filament_kg) {
            total += felt.add(query);
            return;
        }
        leaf.push(at, s.bed[n], sizes, s.filament_kg);
        held += 1;
        if held == LEAF {
            total += f64::from(leaf.at(path, p));
            (leaf, held) = (Leaf::new(), 0);
        }
    };
    let whole = s.len() / LANES * LANES;
    for (c, lanes) in s.x[..whole].chunks_exact(LANES).enumerate() {
        let mut near = false;
        for x in lanes {
            near |= (x - p[0]).abs() <= reach;
        }
        if near {
            for (l, x) in lanes.iter().enumerate() {
                if (x - p[0]).abs() <= reach {
                    take(c * LANES + l);
                }
            }
        }
    }
    for n in whole..s.len() {
        if (s.x[n] - p[0]).abs() <= reach {
            take(n);
        }
    }
    total + f64::from(leaf.at(path, p))
}
