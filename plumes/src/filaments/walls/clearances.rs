//! How far each column of blocked water is from one that is not open.

use crate::flow::blockage::{Cells, beyond};

/// Number of columns to the nearest column with a closed face other than bed and surface, up to 255; laid out as the
/// nodes of the flow grid.
pub(crate) fn clearances(cells: &Cells) -> Vec<u8> {
    let [nx, ny, nz] = cells.n;
    let mut clear = vec![u8::MAX; (nx + 1) * (ny + 1)];
    let mut edge = Vec::new();
    for i in 0..nx {
        for j in 0..ny {
            let whole = (0..nz).all(|k| {
                let c = [i, j, k];
                let sides = (0..2).all(|d| cells.passes(d, c) && cells.passes(d, beyond(d, c)));
                sides && (k == 0 || cells.passes(2, c))
            });
            if !whole {
                clear[i * (ny + 1) + j] = 0;
                edge.push([i, j]);
            }
        }
    }
    let mut r = 0;
    while !edge.is_empty() && r < u8::MAX {
        r += 1;
        let mut next = Vec::new();
        for [i, j] in edge {
            for a in i.saturating_sub(1)..(i + 2).min(nx) {
                for b in j.saturating_sub(1)..(j + 2).min(ny) {
                    let c = &mut clear[a * (ny + 1) + b];
                    if *c == u8::MAX {
                        *c = r;
                        next.push([a, b]);
                    }
                }
            }
        }
        edge = next;
    }
    clear
}
