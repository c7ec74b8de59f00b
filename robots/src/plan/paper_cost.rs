//! The paper's A*: no cost in free cells, 1000 in obstacle cells, five moves relative to the heading.
//!
//! *Source*: Wang & Pang, section II-D, eq. 7-9 and the five directions: left, left-forward, forward, right-forward,
//! right.
//!
//! *Parameters*: 1000 for entering an obstacle cell (eq. 8); h the Manhattan distance in cells (eq. 9).
//!
//! *Deviations*: g adds up along the path (eq. 7 calls it the cost of the path). A state is a cell and the direction
//! in which it was entered, so that the five moves exclude no way; of states with equal f the newest is taken first.
//! Obstacle cells are those whose middle lies in a solid, without inflation, and corners may be cut, because the
//! paper mentions neither. If the goal lies in an obstacle, or beyond one that closes the room, the path leads to the
//! nearest free cell that can be reached. If the start lies outside the room, the path begins in the cell nearest to
//! it.

use super::ends::Ends;
use super::{FreeSpace, NoPath, Path, PathStart, Reach};
use nalgebra::{Vector2, Vector3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The eight directions, anticlockwise from the grid's first axis.
const ROUND: [[isize; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
/// The five moves in eighths of a turn to the left, forward first.
const FIVE: [usize; 5] = [0, 1, 7, 2, 6];
/// Cost of entering an obstacle cell (eq. 8).
const OBSTACLE: u32 = 1000;

/// The search with its arrays.
#[derive(Clone, Debug, Default)]
pub(super) struct FiveMoves {
    ends: Ends,
    g: Vec<u32>,
    from: Vec<u32>,
    open: BinaryHeap<(Reverse<u32>, u32, u32)>,
}

impl FiveMoves {
    pub(super) fn plan(&mut self, room: &FreeSpace, start: &PathStart, goal: &Vector3<f64>) -> Result<Path, NoPath> {
        let e = self.ends.resolve(room, |c| !room.solid(c), &start.p_W, goal)?;
        let grid = room.lattice();
        let [nx, ny, _] = grid.n.map(|n| n as isize);
        let target = grid.place(e.goal);
        let h = |cell: usize| {
            let at = grid.place(cell);
            (at[0].abs_diff(target[0]) + at[1].abs_diff(target[1])) as u32
        };
        self.g.clear();
        self.g.resize(8 * grid.len(), u32::MAX);
        self.from.clear();
        self.from.resize(8 * grid.len(), u32::MAX);
        self.open.clear();
        let first = 8 * e.start + facing(room, start);
        self.g[first] = 0;
        let mut count = 0_u32;
        self.open.push((Reverse(h(e.start)), count, first as u32));
        let mut nearest = (u32::MAX, first);
        while let Some((Reverse(f), _, state)) = self.open.pop() {
            let (cell, dir) = (state as usize / 8, state as usize % 8);
            let g = self.g[state as usize];
            if f > g + h(cell) || g >= OBSTACLE {
                continue;
            }
            if h(cell) < nearest.0 {
                nearest = (h(cell), state as usize);
            }
            if cell == e.goal {
                break;
            }
            let [i, j, _] = grid.place(cell).map(|v| v as isize);
            for turn in FIVE {
                let to = (dir + turn) % 8;
                let (x, y) = (i + ROUND[to][0], j + ROUND[to][1]);
                if !(0..nx).contains(&x) || !(0..ny).contains(&y) {
                    continue;
                }
                let next = grid.index([x as usize, y as usize, 0]);
                let more = g + if room.solid(next) { OBSTACLE } else { 0 };
                let entered = 8 * next + to;
                if more < self.g[entered] {
                    self.g[entered] = more;
                    self.from[entered] = state;
                    count += 1;
                    self.open.push((Reverse(more + h(next)), count, entered as u32));
                }
            }
        }
        Ok(self.path(room, start, goal, e.leaves_solid, nearest.1))
    }

    fn path(&self, room: &FreeSpace, start: &PathStart, goal: &Vector3<f64>, leaves_solid: bool, end: usize) -> Path {
        let mut states = vec![end];
        while let Some(&before) = states.last().map(|s| &self.from[*s]) {
            if before == u32::MAX {
                break;
            }
            states.push(before as usize);
        }
        states.reverse();
        let mut points = vec![start.p_W];
        // Keeps only the corners: a cell entered and left in the same direction is not one.
        for (k, state) in states.iter().enumerate().skip(usize::from(!leaves_solid)) {
            let straight = states.get(k + 1).is_some_and(|next| next % 8 == state % 8);
            if !straight || k == 0 {
                let p = room.lattice().centre(state / 8);
                points.push(Vector3::new(p.x, p.y, start.p_W.z));
            }
        }
        if points.len() == 1 {
            let p = room.lattice().centre(end / 8);
            points.push(Vector3::new(p.x, p.y, start.p_W.z));
        }
        let there = room.lattice().cell(goal) == Some(end / 8);
        let (last, wish) = (points[points.len() - 1].xy(), goal.xy());
        Path {
            reach: if there { Reach::Goal } else { Reach::Nearest((last - wish).norm()) },
            tightest_m: if points.len() > 2 { 0.0 } else { f64::INFINITY },
            leaves_solid,
            points,
        }
    }
}

/// The start's direction in eighths of a turn, measured in cells rather than metres.
fn facing(room: &FreeSpace, start: &PathStart) -> usize {
    let grid = room.lattice();
    let u = start.heading.unit();
    let v = Vector2::new(u.dot(&grid.axes[0]), u.dot(&grid.axes[1])).normalize();
    let along = |d: &[isize; 2]| {
        let d = Vector2::new(d[0] as f64 * grid.cell_m[0], d[1] as f64 * grid.cell_m[1]);
        d.normalize().dot(&v)
    };
    (0..8).max_by(|a, b| along(&ROUND[*a]).total_cmp(&along(&ROUND[*b]))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::{block, from, room};

    /// The paper's room: 40 × 25 cells of 2.5 × 4 m, its block and its ends.
    #[test]
    fn goes_round_the_papers_block_in_cells() {
        let r = room([40, 25, 1], [2.5, 4.0, 8.0], vec![block("b", 43.75, 50.0, [7.5, 20.0, 8.0])]);
        let solid = (0..1000).filter(|c| r.solid(*c)).count();
        assert_eq!(solid, 15);
        let goal = Vector3::new(21.25, 50.0, -4.0);
        for (start, most) in [(from(61.25, 10.0, 0.0), 30.0 * 4.0), (from(61.25, 50.0, 270.0), 100.0)] {
            let path = FiveMoves::default().plan(&r, &start, &goal).unwrap();
            assert_eq!(path.reach, Reach::Goal);
            assert!(path.length_m() < most, "{path:?}");
            for w in path.points.windows(2) {
                let n = 50;
                for k in 0..=n {
                    let p = w[0] + (w[1] - w[0]) * (f64::from(k) / f64::from(n));
                    let inside = (p.x - 43.75).abs() < 3.7 && (p.y - 50.0).abs() < 9.9;
                    assert!(!inside, "{path:?} runs through the block");
                }
            }
        }
    }

    #[test]
    fn never_turns_back_in_one_move() {
        let r = room([40, 25, 1], [2.5, 4.0, 8.0], vec![]);
        // Facing west with the goal due east: two turns at least.
        let path = FiveMoves::default().plan(&r, &from(50.0, 50.0, 270.0), &Vector3::new(90.0, 50.0, -4.0)).unwrap();
        assert_eq!(path.reach, Reach::Goal);
        let first = path.points[1] - path.points[0];
        assert!(path.points.len() > 3 && first.x < 1.3, "{path:?}");
    }

    #[test]
    fn a_goal_in_the_block_ends_beside_it() {
        let r = room([40, 25, 1], [2.5, 4.0, 8.0], vec![block("b", 43.75, 50.0, [7.5, 20.0, 8.0])]);
        let path = FiveMoves::default().plan(&r, &from(61.25, 10.0, 0.0), &Vector3::new(43.75, 50.0, -4.0)).unwrap();
        assert!(matches!(path.reach, Reach::Nearest(m) if m < 6.0), "{path:?}");
    }
}
