//! A* over a room's free cells with metric costs: 8 moves in the plane, 26 in space, no corner cut.
//!
//! *Source*: A*: Hart, Nilsson & Raphael 1968, IEEE Trans. Syst. Sci. Cybern. 4, 100; bucket queue: Dial 1969,
//! Commun. ACM 12, 632.
//!
//! *Parameters*: cost of a vertical metre in horizontal metres, `climb`; share added to a step's cost in a cell at
//! the least clearance, `weight`, which falls linearly to zero at `soft_m` more than that.
//!
//! *Deviations*: costs are whole numbers, 512 to the shortest side of a cell, each rounded up by at most two: the
//! search is exact in them. The heuristic is the octile distance of the free grid: the longest diagonal as often as
//! it helps, then the next one, then straight moves. It is the cheapest way without solids and without clearance
//! costs (the length of a move is a submodular function of the axes that it changes, so that the chain of diagonals
//! attains the minimum). Clearance only adds to costs, so the heuristic never overestimates. It is consistent
//! (rounded down, where costs are rounded up and one added), so that no cell is opened twice.

use super::{Revision, Room};

/// Units of cost in the shortest side of a cell.
const UNITS: f64 = 512.0;
/// Clearance costs are counted in parts of the length.
const PARTS: u32 = 64;
/// A cell that is not free.
const BLOCKED: u8 = u8::MAX;
/// Not reached yet.
const FAR: u32 = u32::MAX;

/// Costs of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Costs {
    pub(super) climb: f64,
    pub(super) weight: f64,
    pub(super) soft_m: f64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Move {
    step: isize,
    cost: u32,
    /// Cells of the block between both ends of the move, as bits of the 27 cells around a cell.
    needs: u32,
}

/// The search with its arrays, kept between plans.
#[derive(Clone, Debug)]
pub(super) struct Search {
    costs: Costs,
    /// The room's revision from which the arrays were made.
    of: Option<Revision>,
    /// Cells with a border of blocked cells all around (in the plane: no layers above and below).
    n: [usize; 3],
    penalty: Vec<u8>,
    moves: Vec<Move>,
    /// Units along the octile chain: lengths by the set of axes changed.
    lengths: [f64; 8],
    g: Vec<u32>,
    from: Vec<u8>,
    buckets: Vec<Vec<u32>>,
    opened: usize,
}

const CLOSED: u8 = 0x80;

impl Search {
    pub(super) fn new(costs: Costs) -> Self {
        Self {
            costs,
            of: None,
            n: [0; 3],
            penalty: Vec::new(),
            moves: Vec::new(),
            lengths: [0.0; 8],
            g: Vec::new(),
            from: Vec::new(),
            buckets: Vec::new(),
            opened: 0,
        }
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
        room: &Room,
        start: usize,
        goal: usize,
        blind: bool,
    ) -> Option<(Vec<usize>, u32)> {
        if self.of.as_ref() != Some(room.revision()) {
            self.take_in(room);
        }
        let (s, t) = (self.padded(room, start), self.padded(room, goal));
        let target = self.place(t);
        self.g.fill(FAR);
        self.from.fill(0);
        self.buckets.iter_mut().for_each(Vec::clear);
        self.opened = 0;
        let mask = self.buckets.len() - 1;
        let h = |this: &Self, cell: usize| if blind { 0 } else { this.octile(cell, target) };
        self.g[s] = 0;
        let mut f = h(self, s) as usize;
        self.buckets[f & mask].push(s as u32);
        let mut waiting = 1_usize;
        while waiting > 0 {
            let Some(cell) = self.buckets[f & mask].pop() else {
                f += 1;
                continue;
            };
            waiting -= 1;
            let cell = cell as usize;
            if self.from[cell] & CLOSED != 0 {
                continue;
            }
            self.from[cell] |= CLOSED;
            self.opened += 1;
            if cell == t {
                return Some((self.way(room, s, t), self.g[t]));
            }
            let free = self.free_round(cell);
            let g = self.g[cell];
            for (k, m) in self.moves.iter().enumerate() {
                if free & m.needs != m.needs {
                    continue;
                }
                let next = cell.wrapping_add_signed(m.step);
                let more = m.cost + (m.cost * u32::from(self.penalty[next])).div_ceil(PARTS);
                if g + more < self.g[next] {
                    self.g[next] = g + more;
                    self.from[next] = k as u8;
                    let at = (g + more + h(self, next)) as usize;
                    self.buckets[at & mask].push(next as u32);
                    waiting += 1;
                }
            }
        }
        None
    }

    fn take_in(&mut self, room: &Room) {
        let lattice = room.lattice();
        let plane = room.plane();
        let border = [2, 2, if plane { 0 } else { 2 }];
        self.n = [0, 1, 2].map(|a| lattice.n[a] + border[a]);
        let all = self.n.iter().product();
        self.penalty.clear();
        self.penalty.resize(all, BLOCKED);
        let parts = f64::from(PARTS) * self.costs.weight;
        let most = self.costs.soft_m;
        for cell in 0..lattice.len() {
            let spare = room.clearance_m(cell) - room.needed_m();
            if spare >= 0.0 {
                let share = if most > 0.0 {
                    (1.0 - spare / most).max(0.0)
                } else {
                    0.0
                };
                let at = self.padded(room, cell);
                self.penalty[at] = (parts * share).round().min(f64::from(BLOCKED - 1)) as u8;
            }
        }
        self.g.resize(all, FAR);
        self.from.resize(all, 0);
        let c = lattice.cell_m;
        let unit = UNITS
            / if plane {
                c[0].min(c[1])
            } else {
                c[0].min(c[1]).min(c[2])
            };
        let side = [c[0] * unit, c[1] * unit, c[2] * unit * self.costs.climb];
        for set in 0..8_usize {
            let squares = (0..3).map(|a| {
                if set >> a & 1 == 1 {
                    side[a] * side[a]
                } else {
                    0.0
                }
            });
            self.lengths[set] = squares.sum::<f64>().sqrt();
        }
        self.set_moves(plane);
        let dearest = self.moves.iter().map(|m| m.cost).max().unwrap_or(0);
        let dearest = dearest + (dearest * u32::from(BLOCKED)).div_ceil(PARTS);
        let buckets = (2 * dearest as usize + 2).next_power_of_two();
        self.buckets.resize_with(buckets, Vec::new);
        self.of = Some(room.revision().clone());
    }

    fn set_moves(&mut self, plane: bool) {
        let strides = [1, self.n[0] as isize, (self.n[0] * self.n[1]) as isize];
        let bit = |d: [isize; 3]| 1_u32 << ((d[2] + 1) * 9 + (d[1] + 1) * 3 + d[0] + 1);
        self.moves.clear();
        for code in 0..27_isize {
            let d = [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
            if d == [0; 3] || (plane && d[2] != 0) {
                continue;
            }
            let mut needs = 0;
            for corner in 1..8_usize {
                let part = [0, 1, 2].map(|a| if corner >> a & 1 == 1 { d[a] } else { 0 });
                if part != [0; 3] {
                    needs |= bit(part);
                }
            }
            let set = (0..3).filter(|a| d[*a] != 0).map(|a| 1 << a).sum::<usize>();
            self.moves.push(Move {
                step: (0..3).map(|a| d[a] * strides[a]).sum(),
                cost: self.lengths[set].ceil() as u32 + 1,
                needs,
            });
        }
    }

    /// Which of the 27 cells around a cell (itself included) are free, as bits.
    #[inline]
    fn free_round(&self, cell: usize) -> u32 {
        let layer = self.n[0] * self.n[1];
        let mut free = 0;
        let layers = if self.n[2] == 1 { 1..2 } else { 0..3 };
        for k in layers {
            for j in 0..3 {
                let at = cell + k * layer + j * self.n[0] - layer - self.n[0] - 1;
                let row = &self.penalty[at..at + 3];
                let bits = u32::from(row[0] != BLOCKED)
                    | u32::from(row[1] != BLOCKED) << 1
                    | u32::from(row[2] != BLOCKED) << 2;
                free |= bits << (k * 9 + j * 3);
            }
        }
        free
    }

    fn padded(&self, room: &Room, cell: usize) -> usize {
        let [i, j, k] = room.lattice().place(cell);
        let up = usize::from(!room.plane());
        ((k + up) * self.n[1] + j + 1) * self.n[0] + i + 1
    }

    fn place(&self, cell: usize) -> [usize; 3] {
        let row = cell / self.n[0];
        [cell % self.n[0], row % self.n[1], row / self.n[1]]
    }

    #[inline]
    fn octile(&self, cell: usize, target: [usize; 3]) -> u32 {
        let at = self.place(cell);
        let d = [0, 1, 2].map(|a| at[a].abs_diff(target[a]) as u32);
        let (mut rest, mut set, mut sum) = (d, 7_usize, 0.0);
        let gone = |rest: &[u32; 3]| {
            let zero = rest.iter().enumerate().filter(|(_, r)| **r == 0);
            zero.map(|(a, _)| 1_usize << a).sum::<usize>()
        };
        set &= !gone(&rest);
        while set != 0 {
            let within = |a: &usize| set >> a & 1 == 1;
            let least = (0..3).filter(within).map(|a| rest[a]).min().unwrap_or(0);
            sum += f64::from(least) * self.lengths[set];
            (0..3).filter(within).for_each(|a| rest[a] -= least);
            set &= !gone(&rest);
        }
        sum as u32
    }

    fn way(&self, room: &Room, start: usize, goal: usize) -> Vec<usize> {
        let up = usize::from(!room.plane());
        let mut cells = Vec::new();
        let mut at = goal;
        loop {
            let [i, j, k] = self.place(at);
            cells.push(room.lattice().index([i - 1, j - 1, k - up]));
            if at == start {
                break;
            }
            let m = self.moves[usize::from(self.from[at] & !CLOSED)];
            at = at.wrapping_add_signed(-m.step);
        }
        cells.reverse();
        cells
    }
}

#[cfg(test)]
#[path = "tests_search.rs"]
mod tests;
