//! The room in which a planner plans: a grid of cells, each with its clearance from charted and sensed solids.
//!
//! *Source*: occupancy grids, Moravec & Elfes 1985, ICRA, 116 (evidence for and against each cell); inflation by the
//! hull, Lozano-Pérez 1983, IEEE Trans. Comput. 32, 108.
//!
//! *Parameters*: hull radius with its margin, `hull_m`; clearance beyond which cells are not distinguished,
//! `reach_m`; evidence of an echo +2, of a beam that passed through −1, held within ±6; a cell counts as solid from
//! +2 on, and as free again from −2 on.
//!
//! *Deviations*: evidence is counted in whole numbers, not in logarithms of odds. A cell is free if every point of it
//! is at least the hull's radius away from any solid, so that any line through free cells is free of collisions. A
//! cell with an echo counts as solid as a whole. The scenario gives the searcher its chart; everything else comes
//! from the searcher's own ranging, placed by its own navigation.

use super::beam::within;
use super::clearance::{self, CellBox};
use super::revision::Revision;
use crate::handoff::BeliefGrid;
use nalgebra::Vector3;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// Evidence of an echo in a cell.
const ECHO: i8 = 2;
/// Evidence at which a cell counts as solid.
const SOLID: i8 = 2;
/// Evidence at which a solid cell counts as free again: noise at a wall must not make it flicker.
const FREE: i8 = -2;
/// Greatest evidence kept, for or against.
const MOST: i8 = 6;

/// A grid of cells with clearances.
#[derive(Clone, Debug)]
pub struct FreeSpace {
    lattice: BeliefGrid,
    hull_m: f64,
    reach_m: f64,
    half_diagonal_m: f64,
    charted_m: Vec<f32>,
    evidence: Vec<i8>,
    clearance_m: Vec<f32>,
    /// Cells found to be solid, as flags and as a list.
    found: Vec<bool>,
    sensed: Vec<u32>,
    /// Steps to the cells within reach of a solid one, with the distances of their middles from it, m.
    round: Vec<([i32; 3], f32)>,
    /// How many cells the reach spans along each axis.
    span: [usize; 3],
    /// Boxes around cells found to be free again, in which the clearances must be computed anew.
    lifted: Vec<CellBox>,
    revision: Revision,
}

impl FreeSpace {
    /// An empty room.
    pub fn new(lattice: BeliefGrid, hull_m: f64, reach_m: f64) -> Self {
        let c = lattice.cell_m;
        let z = if lattice.n[2] == 1 { 0.0 } else { c[2] };
        let half_diagonal_m = 0.5 * (c[0] * c[0] + c[1] * c[1] + z * z).sqrt();
        let cells = lattice.len();
        let reach_m = reach_m + hull_m + half_diagonal_m;
        let span = [0, 1, 2].map(|a| {
            let n = lattice.n[a];
            let cells = (reach_m / c[a]).ceil().min(n as f64) as usize + 1;
            if n == 1 { 0 } else { cells }
        });
        Self {
            round: round(&lattice, span, reach_m, half_diagonal_m),
            span,
            lattice,
            hull_m,
            reach_m,
            half_diagonal_m,
            charted_m: vec![f32::INFINITY; cells],
            evidence: vec![0; cells],
            clearance_m: vec![f32::INFINITY; cells],
            found: vec![false; cells],
            sensed: Vec::new(),
            lifted: Vec::new(),
            revision: Revision::default(),
        }
    }

    /// Adds charted solids to the room; in a room of three dimensions also bed and surface. In a room of the plane,
    /// `level` gives the height (z, m) at which the vehicle moves over a place (east, north).
    pub fn chart(&mut self, solids: &Obstacles, terrain: &Terrain, level: &dyn Fn(f64, f64) -> f64) {
        let plane = self.plane();
        let boxes: Vec<_> = solids.0.iter().map(|o| (o, o.bounds())).collect();
        for cell in 0..self.lattice.len() {
            let mut p = self.lattice.centre(cell);
            if plane {
                p.z = level(p.x, p.y);
            }
            let mut d = self.charted_m[cell].into();
            if !plane {
                let bed = (p.z - terrain.bed_z(p.x, p.y)) * terrain.normal(p.x, p.y).z;
                d = f64::min(d, bed.min(-p.z));
            }
            for (solid, (lo, hi)) in &boxes {
                let away = (lo - p).sup(&(p - hi)).sup(&Vector3::zeros());
                if away.norm() < self.reach_m.min(d) {
                    d = d.min(solid.distance(&p));
                }
            }
            self.charted_m[cell] = d.min(self.reach_m) as f32;
        }
        self.lifted.push(self.lattice.n.map(|n| (0, n)));
        self.refresh();
    }

    /// Takes in a beam from `from` that ended at `to` (ENU, m), with an echo there or without any.
    pub fn beam(&mut self, from: &Vector3<f64>, to: &Vector3<f64>, echo: bool) {
        let ends_in = echo.then(|| self.lattice.cell(to)).flatten();
        let mut passed = usize::MAX;
        let step = 0.5 * self.narrowest_m();
        let steps = ((to - from).norm() / step).floor() as usize;
        // Parts of the beam beyond the room tell nothing of the room, however far the beam reaches.
        for k in within(&self.lattice, from, to, steps) {
            let p = from + (to - from) * (k as f64 / steps as f64);
            match self.lattice.cell(&p) {
                Some(cell) if cell != passed && Some(cell) != ends_in => {
                    passed = cell;
                    self.weigh(cell, -1);
                }
                _ => {}
            }
        }
        if let Some(cell) = ends_in {
            self.weigh(cell, ECHO);
        }
    }

    fn weigh(&mut self, cell: usize, by: i8) {
        let now = (self.evidence[cell] + by).clamp(-MOST, MOST);
        self.evidence[cell] = now;
        if now >= SOLID && !self.found[cell] {
            self.found[cell] = true;
            self.sensed.push(cell as u32);
            self.stamp(cell);
            self.revision = Revision::default();
        } else if now <= FREE && self.found[cell] {
            self.found[cell] = false;
            self.sensed.retain(|c| *c as usize != cell);
            let own = self.lattice.place(cell).map(|i| (i, i + 1));
            (self.lifted).push(clearance::wider(own, self.span, self.lattice.n));
        }
    }

    /// Updates the clearances after cells were found to be free again; cheap if there were none.
    pub fn refresh(&mut self) {
        let lifted = std::mem::take(&mut self.lifted);
        let Some(first) = lifted.first() else { return };
        // All boxes at once, unless that is more work than one after the other.
        let whole = lifted.iter().fold(*first, |w, b| [0, 1, 2].map(|a| (w[a].0.min(b[a].0), w[a].1.max(b[a].1))));
        let work = |b: &CellBox| clearance::count(clearance::wider(*b, self.span, self.lattice.n));
        if work(&whole) <= lifted.iter().map(work).sum() {
            self.clear(whole);
        } else {
            lifted.into_iter().for_each(|b| self.clear(b));
        }
        self.revision = Revision::default();
    }

    /// Computes the clearances of a box of cells anew.
    fn clear(&mut self, b: CellBox) {
        for k in b[2].0..b[2].1 {
            for j in b[1].0..b[1].1 {
                let row = self.lattice.index([b[0].0, j, k])..=self.lattice.index([b[0].1 - 1, j, k]);
                self.clearance_m[row.clone()].copy_from_slice(&self.charted_m[row]);
            }
        }
        let limits = (self.reach_m, self.half_diagonal_m);
        let clearance_m = &mut self.clearance_m;
        clearance::for_each(&self.lattice, b, self.span, limits, &self.found, |cell, d| {
            clearance_m[cell] = clearance_m[cell].min(d as f32);
        });
    }

    /// Updates the clearances around a new solid cell.
    fn stamp(&mut self, solid: usize) {
        let at = self.lattice.place(solid).map(|v| v as i32);
        let n = self.lattice.n.map(|v| v as i32);
        for (step, d) in &self.round {
            let to = [0, 1, 2].map(|a| at[a] + step[a]);
            if (0..3).all(|a| (0..n[a]).contains(&to[a])) {
                let cell = ((to[2] * n[1] + to[1]) * n[0] + to[0]) as usize;
                self.clearance_m[cell] = self.clearance_m[cell].min(*d);
            }
        }
    }

    /// Whether it is a map of the plane.
    pub fn plane(&self) -> bool {
        self.lattice.n[2] == 1
    }

    /// Its cells.
    pub fn lattice(&self) -> &BeliefGrid {
        &self.lattice
    }

    /// The state of its clearances, a new one after every change. A copy of the room has the same until either of the
    /// two changes.
    pub fn revision(&self) -> &Revision {
        &self.revision
    }

    /// Number of cells sensed to be solid.
    pub fn sensed(&self) -> usize {
        self.sensed.len()
    }

    /// Distance of a cell's middle from the nearest solid, m; negative inside one, at most a little more than the
    /// reach.
    pub fn clearance_m(&self, cell: usize) -> f64 {
        f64::from(self.clearance_m[cell])
    }

    /// Half the diagonal of a cell, m.
    pub fn half_diagonal_m(&self) -> f64 {
        self.half_diagonal_m
    }

    /// Clearance that a free cell needs, m: the hull's radius and half the cell's diagonal.
    pub fn needed_m(&self) -> f64 {
        self.hull_m + self.half_diagonal_m
    }

    /// Whether every point of the cell is at least the hull's radius away from any solid.
    pub fn free(&self, cell: usize) -> bool {
        self.clearance_m(cell) >= self.needed_m()
    }

    /// Whether the middle of the cell lies in a solid.
    pub fn solid(&self, cell: usize) -> bool {
        self.clearance_m(cell) < 0.0
    }

    /// Shortest side of a cell, m.
    pub fn narrowest_m(&self) -> f64 {
        let c = self.lattice.cell_m;
        let flat = c[0].min(c[1]);
        if self.plane() { flat } else { flat.min(c[2]) }
    }

    /// The cell nearest to a point (ENU, m), which may lie outside.
    pub fn nearest_cell(&self, p_W: &Vector3<f64>) -> usize {
        let g = &self.lattice;
        let d = p_W.xy() - g.corner.xy();
        let local = [d.dot(&g.axes[0]), d.dot(&g.axes[1]), p_W.z - g.corner.z];
        let place = [0, 1, 2].map(|a| {
            let q = (local[a] / g.cell_m[a]).floor();
            q.clamp(0.0, (g.n[a] - 1) as f64) as usize
        });
        g.index(place)
    }

    /// Whether `open` is true for all cells that a straight line (ENU, m) passes.
    pub fn line(&self, a: &Vector3<f64>, b: &Vector3<f64>, mut open: impl FnMut(usize) -> bool) -> bool {
        let g = &self.lattice;
        let local = |p: &Vector3<f64>| {
            let d = p.xy() - g.corner.xy();
            let z = if self.plane() { 0.5 } else { (p.z - g.corner.z) / g.cell_m[2] };
            [d.dot(&g.axes[0]) / g.cell_m[0], d.dot(&g.axes[1]) / g.cell_m[1], z]
        };
        let (a, b) = (local(a), local(b));
        let mut at = a.map(|v| v.floor() as i64);
        let end = b.map(|v| v.floor() as i64);
        let inside = |c: [i64; 3]| (0..3).all(|k| c[k] >= 0 && c[k] < g.n[k] as i64);
        let mut go = |c: [i64; 3]| inside(c) && open(g.index(c.map(|v| v as usize)));
        if !go(at) {
            return false;
        }
        // From face to face (Amanatides & Woo 1987, Eurographics, 3).
        let slope = [0, 1, 2].map(|k| b[k] - a[k]);
        let sign = slope.map(|s| if s > 0.0 { 1 } else { -1 });
        let mut next = [0, 1, 2].map(|k| {
            let face = at[k] + i64::from(slope[k] > 0.0);
            if at[k] == end[k] { f64::INFINITY } else { (face as f64 - a[k]) / slope[k] }
        });
        while at != end {
            let k = (0..3).min_by(|i, j| next[*i].total_cmp(&next[*j])).unwrap_or(0);
            if !next[k].is_finite() {
                return true;
            }
            at[k] += sign[k];
            next[k] = if at[k] == end[k] { f64::INFINITY } else { next[k] + 1.0 / slope[k].abs() };
            if !go(at) {
                return false;
            }
        }
        true
    }

    /// Whether a straight line (ENU, m) passes only free cells.
    pub fn line_free(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
        self.line(a, b, |cell| self.free(cell))
    }
}

/// The cells within reach of a solid one, which counts as solid as a whole.
fn round(lattice: &BeliefGrid, span: [usize; 3], reach_m: f64, half_diagonal_m: f64) -> Vec<([i32; 3], f32)> {
    let span = span.map(|s| s as i32);
    let gap = |a: usize, i: i32| clearance::gap_m(lattice.cell_m[a], i.unsigned_abs() as usize);
    let mut round = Vec::new();
    for k in -span[2]..=span[2] {
        for j in -span[1]..=span[1] {
            for i in -span[0]..=span[0] {
                let (x, y, z) = (gap(0, i), gap(1, j), gap(2, k));
                let d = (x * x + y * y + z * z).sqrt();
                if [i, j, k] == [0; 3] {
                    round.push(([0; 3], -half_diagonal_m as f32));
                } else if d < reach_m {
                    round.push(([i, j, k], d as f32));
                }
            }
        }
    }
    round
}

#[cfg(test)]
mod tests;
