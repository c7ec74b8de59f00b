//! Where a path can begin and end: the free cells nearest to the wanted places.
//!
//! *Source*: connected components by flood fill (Rosenfeld & Pfaltz 1966, J. ACM 13, 471).
//!
//! *Parameters*: none.
//!
//! *Deviations*: none. Where no corner may be cut, cells that are joined by any move are also joined through faces,
//! so that the flood through faces tells what can be reached.

use super::{FreeSpace, NoPath, Revision};
use nalgebra::Vector3;

/// The components of a room's free cells, kept until the room changes.
#[derive(Clone, Debug, Default)]
pub(super) struct Ends {
    labels: Vec<u32>,
    of: Option<Revision>,
    stack: Vec<u32>,
}

/// Resolved ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ResolvedEnds {
    /// Free cell where the path begins.
    pub(super) start: usize,
    /// The start itself was not free.
    pub(super) leaves_solid: bool,
    /// Free cell where the path ends, joined to the start.
    pub(super) goal: usize,
    /// Whether that is the goal's own cell.
    pub(super) at_goal: bool,
}

impl Ends {
    /// The ends of a path in `room`; `open` tells which of its cells are free.
    pub(super) fn resolve(
        &mut self,
        room: &FreeSpace,
        open: impl Fn(usize) -> bool,
        start: &Vector3<f64>,
        goal: &Vector3<f64>,
    ) -> Result<ResolvedEnds, NoPath> {
        if self.of.as_ref() != Some(room.revision()) {
            self.label(room, &open);
        }
        let own = room.nearest_cell(start);
        let begin = self.nearest(room, start, own, |l| l != 0).ok_or(NoPath::Full)?;
        let label = self.labels[begin];
        let wanted = room.nearest_cell(goal);
        let end = self.nearest(room, goal, wanted, |l| l == label).ok_or(NoPath::Full)?;
        Ok(ResolvedEnds { start: begin, leaves_solid: begin != own, goal: end, at_goal: end == wanted })
    }

    /// The cell of a wanted component nearest to `p`; `own` is preferred to all others.
    fn nearest(&self, room: &FreeSpace, p: &Vector3<f64>, own: usize, wanted: impl Fn(u32) -> bool) -> Option<usize> {
        if wanted(self.labels[own]) {
            return Some(own);
        }
        let mut from = *p;
        if room.plane() {
            from.z = room.lattice().centre(0).z;
        }
        let mut best = (f64::INFINITY, None);
        for (cell, label) in self.labels.iter().enumerate() {
            if wanted(*label) {
                let d = (room.lattice().centre(cell) - from).norm_squared();
                if d < best.0 {
                    best = (d, Some(cell));
                }
            }
        }
        best.1
    }

    fn label(&mut self, room: &FreeSpace, open: impl Fn(usize) -> bool) {
        const UNSEEN: u32 = u32::MAX;
        let n = room.lattice().n;
        let (row, layer, all) = (n[0], n[0] * n[1], n[0] * n[1] * n[2]);
        self.labels.clear();
        self.labels.extend((0..all).map(|c| if open(c) { UNSEEN } else { 0 }));
        let mut label = 0;
        for seed in 0..all {
            if self.labels[seed] != UNSEEN {
                continue;
            }
            label += 1;
            self.labels[seed] = label;
            self.stack.push(seed as u32);
            while let Some(cell) = self.stack.pop() {
                let c = cell as usize;
                let [i, j, k] = [c % row, c / row % n[1], c / layer];
                let neighbours = [
                    (i > 0).then(|| c - 1),
                    (i + 1 < n[0]).then_some(c + 1),
                    (j > 0).then(|| c - row),
                    (j + 1 < n[1]).then_some(c + row),
                    (k > 0).then(|| c - layer),
                    (k + 1 < n[2]).then_some(c + layer),
                ];
                for next in neighbours.into_iter().flatten() {
                    if self.labels[next] == UNSEEN {
                        self.labels[next] = label;
                        self.stack.push(next as u32);
                    }
                }
            }
        }
        self.of = Some(room.revision().clone());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::{block, room};

    fn at(x: f64, y: f64) -> Vector3<f64> {
        Vector3::new(x, y, -4.0)
    }

    #[test]
    fn goal_behind_a_wall_ends_before_it() {
        // A wall right across the room.
        let r = room([20, 20, 1], [1.0; 3], vec![block("w", 10.0, 10.0, [2.0, 40.0, 8.0])]);
        let mut ends = Ends::default();
        let free = |c| r.free(c);
        let e = ends.resolve(&r, free, &at(2.5, 2.5), &at(18.5, 2.5)).unwrap();
        assert!(!e.at_goal && !e.leaves_solid);
        let stop = r.lattice().centre(e.goal);
        // Face at 9 m, 0.4 m of hull, 0.71 m of half diagonal: the last free middle is at 7.5 m.
        assert_eq!((stop.x, stop.y), (7.5, 2.5));
        let same = ends.resolve(&r, free, &at(12.5, 2.5), &at(18.5, 2.5)).unwrap();
        assert!(same.at_goal);
    }

    #[test]
    fn goal_and_start_in_a_solid_give_the_nearest_free_cells() {
        let r = room([20, 20, 1], [1.0; 3], vec![block("b", 10.0, 10.0, [4.0, 4.0, 8.0])]);
        let mut ends = Ends::default();
        let free = |c| r.free(c);
        let e = ends.resolve(&r, free, &at(2.5, 2.5), &at(11.2, 10.1)).unwrap();
        assert_eq!(r.lattice().centre(e.goal).xy(), nalgebra::Vector2::new(13.5, 10.5));
        assert!(!e.at_goal);
        let e = ends.resolve(&r, free, &at(10.2, 11.9), &at(2.5, 2.5)).unwrap();
        assert!(e.leaves_solid && e.at_goal);
        assert_eq!(r.lattice().centre(e.start).xy(), nalgebra::Vector2::new(10.5, 13.5));
    }
}
