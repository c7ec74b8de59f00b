//! Which part of a beam lies in a planner's room, so that the work for a beam does not grow with its range.
//!
//! *Source*: clipping of a line to a box, Liang & Barsky 1984, ACM Trans. Graph. 3, 1.
//!
//! *Parameters*: none.
//!
//! *Deviations*: the box is one cell larger than the room on every side, so that rounding leaves no part out.

use crate::handoff::BeliefGrid;
use nalgebra::Vector3;
use std::ops::Range;

/// Which of the `steps` parts of a line (ENU, m) may lie in the grid; the height does not matter in a grid of a
/// single layer.
pub(super) fn within(grid: &BeliefGrid, from: &Vector3<f64>, to: &Vector3<f64>, steps: usize) -> Range<usize> {
    let (a, b) = (grid.local(from), grid.local(to));
    let (mut begin, mut end) = (0.0_f64, 1.0_f64);
    let axes = if grid.n[2] == 1 { 2 } else { 3 };
    for d in 0..axes {
        let c = grid.cell_m[d];
        let (low, high) = (-c, (grid.n[d] as f64 + 1.0) * c);
        let way = b[d] - a[d];
        if way == 0.0 {
            if a[d] < low || a[d] > high {
                return 0..0;
            }
            continue;
        }
        let (s, t) = ((low - a[d]) / way, (high - a[d]) / way);
        begin = begin.max(s.min(t));
        end = end.min(s.max(t));
    }
    if begin > end {
        return 0..0;
    }
    let at = |part: f64| part * steps as f64;
    (at(begin).floor() as usize)..(at(end).ceil() as usize + 1).min(steps)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::room;
    use world::seeds::Stream;

    /// No part that has a cell is left out, and a beam of any range has no more parts than the room.
    #[test]
    fn all_parts_in_the_room_and_few_others() {
        for n in [[40, 30, 1], [40, 30, 8]] {
            let room = room(n, [1.0; 3], vec![]);
            let grid = room.lattice();
            let mut rng = Stream::new(5, "test", "beams");
            for k in 0..400 {
                let reach = if k % 2 == 0 { 60.0 } else { 1e5 };
                let mut point = |far: f64| {
                    Vector3::new(20.0 + far * rng.normal(), 15.0 + far * rng.normal(), -4.0 + 0.1 * far * rng.normal())
                };
                let (from, to) = (point(20.0), point(reach));
                let steps = ((to - from).norm() / 0.5).floor() as usize;
                let range = within(grid, &from, &to, steps);
                assert!(range.len() < 400, "{} parts", range.len());
                for k in (0..steps).filter(|k| !range.contains(k)) {
                    let p = from + (to - from) * (k as f64 / steps as f64);
                    assert_eq!(grid.cell(&p), None, "{k} of {steps}");
                }
            }
        }
    }
}
