//! A* over a room's free cells with metric costs: 8 moves in the plane, 26 in space, no corner cut.
//!
//! *Source*: A*: Hart, Nilsson & Raphael 1968, IEEE Trans. Syst. Sci. Cybern. 4, 100; bucket queue: Dial 1969,
//! Commun. ACM 12, 632.
//!
//! *Parameters*: cost of a vertical metre in horizontal metres, `climb`; share added to a step's cost in a cell at
//! the least clearance, `weight`, which falls linearly to zero at `soft_m` more than that.
//!
//! *Deviations*: costs are whole numbers, 512 to the shortest side of a cell, each rounded up by at most two: the
//! search is exact in them. The heuristic is the octile distance of the free grid, which is the cheapest way without
//! solids and without clearance costs (see `octile.rs`). Clearance only adds to costs, so the heuristic never
//! overestimates. It is consistent (rounded down, where costs are rounded up and one added), so that no cell is
//! opened twice. All neighbours of a cell are weighed at once (see `neighbours.rs`).

use super::buckets::Buckets;
use super::neighbours::{BEYOND, BLOCKED, Neighbours, PARTS, ones};
use super::octile::Octile;
use super::{FreeSpace, Revision};

/// Units of cost in the shortest side of a cell.
const UNITS: f64 = 512.0;
/// Not reached yet.
const FAR: u32 = u32::MAX;

/// Costs of a search.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Costs {
    pub(super) climb: f64,
    pub(super) weight: f64,
    pub(super) soft_m: f64,
}

/// The search with its arrays, kept between plans.
#[derive(Clone, Debug, Default)]
pub(super) struct Search {
    costs: Costs,
    /// The room's revision from which the arrays were made.
    of: Option<Revision>,
    /// Cells with a border of blocked cells all around (in the plane: no layers above and below).
    n: [usize; 3],
    penalty: Vec<u8>,
    octile: Octile,
    near: Neighbours,
    /// Cost of the best way found to each cell; 0 in a blocked cell, to which no way is better.
    g: Vec<u32>,
    /// The move by which that way reached the cell.
    from: Vec<u8>,
    queue: Buckets,
    opened: usize,
}

impl Search {
    pub(super) fn new(costs: Costs) -> Self {
        Self { costs, ..Self::default() }
    }

    /// Cells opened by the last search.
    #[cfg(test)]
    pub(super) fn opened(&self) -> usize {
        self.opened
    }

    /// Cheapest way between two cells that are both free and joined, and its cost in units; `blind` leaves the
    /// heuristic out (Dijkstra's search, for tests).
    pub(super) fn run(
        &mut self,
        room: &FreeSpace,
        start: usize,
        goal: usize,
        blind: bool,
    ) -> Option<(Vec<usize>, u32)> {
        if self.of.as_ref() != Some(room.revision()) {
            self.take_in(room);
        }
        let (s, t) = (self.padded(room, start), self.padded(room, goal));
        let (target, octile) = (self.place(t), self.octile);
        let h = |at| {
            if blind { 0 } else { octile.between(at, target) }
        };
        for (g, penalty) in self.g.iter_mut().zip(&self.penalty) {
            *g = if *penalty == BLOCKED { 0 } else { FAR };
        }
        self.opened = 0;
        self.g[s] = 0;
        let least = h(self.place(s));
        // The cost of a cell exceeds that of the cell opened before it by at most the dearest move and as much of h.
        (self.queue).clear(2 * self.near.dearest() as usize + 2, least);
        self.queue.push(least, s, 0);
        while let Some((cell, own)) = self.queue.pop() {
            // A better way was found since, and the cell was opened by that.
            if own != self.g[cell] {
                continue;
            }
            self.opened += 1;
            if cell == t {
                return Some((self.way(room, s, t), own));
            }
            let (lanes, costs) = self.near.better(cell, own, &self.g, &self.penalty);
            if lanes == 0 {
                continue;
            }
            let at = self.place(cell);
            for lane in ones(lanes) {
                let (next, g) = (self.near.cell(cell, lane), costs[lane / 4][lane % 4]);
                self.g[next] = g;
                self.from[next] = lane as u8;
                self.queue.push(g + h(self.near.place(at, lane)), next, g);
            }
        }
        None
    }

    fn take_in(&mut self, room: &FreeSpace) {
        let lattice = room.lattice();
        let plane = room.plane();
        let border = [2, 2, if plane { 0 } else { 2 }];
        self.n = [0, 1, 2].map(|a| lattice.n[a] + border[a]);
        let all = self.n.iter().product::<usize>() + BEYOND;
        self.penalty.clear();
        self.penalty.resize(all, BLOCKED);
        let parts = f64::from(PARTS) * self.costs.weight;
        let most = self.costs.soft_m;
        for cell in 0..lattice.len() {
            let spare = room.clearance_m(cell) - room.needed_m();
            if spare >= 0.0 {
                let share = if most > 0.0 { (1.0 - spare / most).max(0.0) } else { 0.0 };
                let at = self.padded(room, cell);
                self.penalty[at] = (parts * share).round().min(f64::from(BLOCKED - 1)) as u8;
            }
        }
        self.g.resize(all, FAR);
        self.from.resize(all, 0);
        let unit = UNITS / room.narrowest_m();
        let c = lattice.cell_m;
        self.octile = Octile::new([c[0] * unit, c[1] * unit, c[2] * unit * self.costs.climb]);
        self.near = Neighbours::new(self.n, plane, &self.octile);
        self.of = Some(room.revision().clone());
    }

    fn padded(&self, room: &FreeSpace, cell: usize) -> usize {
        let [i, j, k] = room.lattice().place(cell);
        let up = usize::from(!room.plane());
        ((k + up) * self.n[1] + j + 1) * self.n[0] + i + 1
    }

    fn place(&self, cell: usize) -> [usize; 3] {
        let row = cell / self.n[0];
        [cell % self.n[0], row % self.n[1], row / self.n[1]]
    }

    fn way(&self, room: &FreeSpace, start: usize, goal: usize) -> Vec<usize> {
        let up = usize::from(!room.plane());
        let mut cells = Vec::new();
        let mut at = goal;
        loop {
            let [i, j, k] = self.place(at);
            cells.push(room.lattice().index([i - 1, j - 1, k - up]));
            if at == start {
                break;
            }
            at = self.near.before(at, usize::from(self.from[at]));
        }
        cells.reverse();
        cells
    }
}

#[cfg(test)]
mod tests;
