//! Clearances of a box of cells from the solid cells around it, computed in a time that does not grow with the number
//! of solid cells.
//!
//! *Source*: distance transform of sampled functions, one axis after the other: Felzenszwalb & Huttenlocher 2012,
//! Theory of Computing 8, 415, section 2; Saito & Toriwaki 1994, Pattern Recognition 27, 1551.
//!
//! *Parameters*: reach, m; the cell's size.
//!
//! *Deviations*: a solid cell counts as solid as a whole, so that the distance along an axis is that to its nearer
//! face. Distances beyond the reach are not distinguished, so that each axis is searched over the reach only.

use crate::handoff::BeliefGrid;

/// A box of cells: along each axis the first cell and the one after the last.
pub(super) type CellBox = [(usize, usize); 3];

/// Distance from a cell's middle to the nearer face of the cell `i` cells away along an axis with cells of `cell_m`,
/// m.
pub(super) fn gap_m(cell_m: f64, i: usize) -> f64 {
    (i as f64 - 0.5).max(0.0) * cell_m
}

/// A box widened by `span` cells on each side, within the lattice.
pub(super) fn wider(b: CellBox, span: [usize; 3], n: [usize; 3]) -> CellBox {
    [0, 1, 2].map(|a| (b[a].0.saturating_sub(span[a]), (b[a].1 + span[a]).min(n[a])))
}

/// Number of cells in a box.
pub(super) fn count(b: CellBox) -> usize {
    b.iter().map(|(lo, hi)| hi - lo).product()
}

/// Squares of the distances of a row's cells, from its cell `first` on, to the nearest solid one (0 in `row`), m².
fn sweep(row: &[f64], gaps2: &[f64], first: usize, out: &mut [f64]) {
    fn one_way<'a>(cells: impl Iterator<Item = (&'a mut usize, &'a f64)>, most: usize) {
        let mut steps = most;
        for (near, d) in cells {
            steps = if *d == 0.0 { 0 } else { steps.saturating_add(1) };
            *near = steps.min(*near);
        }
    }
    let mut near = vec![gaps2.len(); row.len()];
    one_way(near.iter_mut().zip(row), gaps2.len());
    one_way(near.iter_mut().zip(row).rev(), gaps2.len());
    for (out, near) in out.iter_mut().zip(&near[first..]) {
        *out = gaps2.get(*near).copied().unwrap_or(f64::INFINITY);
    }
}

/// Calls `show` for each cell of box `b` with its distance (m) from the nearest solid cell, if that is less than
/// `reach_m`. A solid cell itself gets −`inside_m`.
pub(super) fn for_each(
    g: &BeliefGrid,
    b: CellBox,
    span: [usize; 3],
    (reach_m, inside_m): (f64, f64),
    solid: &[bool],
    mut show: impl FnMut(usize, f64),
) {
    let from = wider(b, span, g.n);
    let mut at = from;
    let size = |c: CellBox| c.map(|(lo, hi)| hi - lo);
    let mut d2: Vec<f64> = Vec::with_capacity(count(from));
    for k in from[2].0..from[2].1 {
        for j in from[1].0..from[1].1 {
            let row = g.index([from[0].0, j, k]);
            let row = &solid[row..row + size(from)[0]];
            d2.extend(row.iter().map(|s| if *s { 0.0 } else { f64::INFINITY }));
        }
    }
    for a in 0..3 {
        // From the cells of `at` to those of `to`, which are narrowed to the box along this axis.
        let mut to = at;
        to[a] = b[a];
        let gaps2: Vec<f64> = (0..=span[a]).map(|i| gap_m(g.cell_m[a], i)).map(|x| x * x).collect();
        let (n, m) = (size(at), size(to));
        let inner: usize = n[..a].iter().product();
        let mut next = vec![f64::INFINITY; m.iter().product()];
        if a == 0 {
            // Along the first axis cells are solid or not: two sweeps find the nearest, however small cells are.
            for (row, out) in d2.chunks_exact(n[0]).zip(next.chunks_exact_mut(m[0])) {
                sweep(row, &gaps2, to[0].0 - at[0].0, out);
            }
            (d2, at) = (next, to);
            continue;
        }
        for outer in 0..n[a + 1..].iter().product::<usize>() {
            for i in 0..m[a] {
                let out = &mut next[(outer * m[a] + i) * inner..][..inner];
                let own = i + to[a].0 - at[a].0;
                for j in own.saturating_sub(span[a])..(own + span[a] + 1).min(n[a]) {
                    let gap2 = gaps2[own.abs_diff(j)];
                    let row = &d2[(outer * n[a] + j) * inner..][..inner];
                    for (o, d) in out.iter_mut().zip(row) {
                        *o = o.min(d + gap2);
                    }
                }
            }
        }
        (d2, at) = (next, to);
    }
    let mut values = d2.into_iter();
    for k in b[2].0..b[2].1 {
        for j in b[1].0..b[1].1 {
            for i in b[0].0..b[0].1 {
                let cell = g.index([i, j, k]);
                let d = values.next().map_or(f64::INFINITY, f64::sqrt);
                if solid[cell] {
                    show(cell, -inside_m);
                } else if d < reach_m {
                    show(cell, d);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sweeps_find_what_a_search_over_the_reach_finds() {
        let gaps2: Vec<f64> = (0..4).map(|i| gap_m(0.5, i)).map(|x| x * x).collect();
        // Every row of nine cells.
        for solid in 0u32..1 << 9 {
            let row: Vec<f64> = (0..9).map(|j| if solid >> j & 1 == 1 { 0.0 } else { f64::INFINITY }).collect();
            let mut got = [f64::NAN; 5];
            sweep(&row, &gaps2, 2, &mut got);
            let search = |i: usize| {
                let near = (0..9).filter(|j| i.abs_diff(*j) < gaps2.len());
                near.map(|j| row[j] + gaps2[i.abs_diff(j)]).fold(f64::INFINITY, f64::min)
            };
            assert_eq!(got, [2, 3, 4, 5, 6].map(search), "{solid:09b}");
        }
    }
}
