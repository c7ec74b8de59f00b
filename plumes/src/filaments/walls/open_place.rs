//! Where dye can be, and the nearest such place to one where it cannot.
//!
//! *Source*: none.
//!
//! *Parameters*: none.
//!
//! *Deviations*: a place in a closed cell is mirrored at the nearest side of an open one. What a thin wall divides
//! belongs to the side on which it lies. Obstacles reach into open cells by less than half a cell: dye is there too,
//! but nobody asks for it.

use super::domain::{Domain, DomainPoint};
use crate::filaments::water::lookup::Lookup;
use crate::flow::blockage::Cells;
use nalgebra::Vector3;

/// How many cells away an open place is searched.
const FAR: usize = 12;
/// How far inside an open cell a place stays that was moved there, in cells.
const INSIDE: f64 = 1e-3;

impl Domain {
    /// A point itself if it is in the water, otherwise the nearest point that is.
    pub(crate) fn in_water(&self, lookup: &Lookup, p: [f32; 3]) -> [f32; 3] {
        if !self.has_solids() {
            return p;
        }
        let open = (self.place(lookup, p))
            .and_then(|at| Some((at, self.open(lookup, &at, true)?)))
            .filter(|(at, open)| at.q != open.q);
        open.map_or(p, |(_, open)| self.point(&open))
    }

    /// A point outside all obstacles in place of one in blocked water.
    pub(crate) fn shown(&self, p: [f32; 3]) -> [f32; 3] {
        if self.cells.is_none() {
            return p;
        }
        let at = Vector3::from(p.map(f64::from));
        if self.solids.containing(&at).is_none() {
            return p;
        }
        self.solids.way_out(&at).map(|v| v as f32).into()
    }

    /// Whether dye can be at a place: in an open cell, not separated from the cell's centre by a thin wall, and in no
    /// solid.
    pub(crate) fn is_free(&self, p: &DomainPoint) -> bool {
        let Some(cells) = &self.cells else {
            return self.solids.containing(&self.horizontal(p.q).push(p.z())).is_none();
        };
        cells.open[cells.cell(p.cell)]
    }

    /// The nearest place at which dye can be. This is the place itself, or its mirror image at the nearest side of an
    /// open cell that is visible from it (the obstacle that contains the place does not hide the cell). `None` if there
    /// is none nearby.
    pub(crate) fn open(&self, lookup: &Lookup, p: &DomainPoint, looking: bool) -> Option<DomainPoint> {
        let Some(cells) = &self.cells else {
            if self.is_free(p) {
                return Some(*p);
            }
            let out = self.solids.way_out(&self.horizontal(p.q).push(p.z()));
            return self.place(lookup, out.map(|v| v as f32).into());
        };
        let eye = self.horizontal(p.q).push(p.z());
        let seen = |cell: [usize; 3]| !looking || self.solids.is_empty() || self.sees(cells, lookup, &eye, p, cell);
        if self.is_free(p) && seen(p.cell) {
            return Some(*p);
        }
        let mut best: Option<(f64, DomainPoint)> = None;
        let size = self.spacing[0].min(self.spacing[1]);
        let range = |d: usize, r: usize| {
            let c = p.cell[d];
            c.saturating_sub(r)..(c + r + 1).min(cells.n[d])
        };
        for r in 0..=FAR {
            if best.is_some_and(|(found, _)| found < (r as f64 - 1.0) * size) {
                break;
            }
            for i in range(0, r) {
                for j in range(1, r) {
                    if i.abs_diff(p.cell[0]).max(j.abs_diff(p.cell[1])) != r {
                        continue;
                    }
                    for k in 0..cells.n[2] {
                        let cell = [i, j, k];
                        if !cells.open[cells.cell(cell)] {
                            continue;
                        }
                        let (away, place) = self.mirrored(cells, lookup, p, cell);
                        if best.is_none_or(|(found, _)| away < found) && seen(cell) {
                            best = Some((away, place));
                        }
                    }
                }
            }
        }
        best.map(|(_, place)| place)
    }

    /// Whether the centre of a cell is visible from a point. Obstacles that contain the point do not count.
    fn sees(&self, cells: &Cells, lookup: &Lookup, eye: &Vector3<f64>, from: &DomainPoint, cell: [usize; 3]) -> bool {
        let middle = [0, 1].map(|d| (cell[d] as f64 + 0.5) * self.spacing[d]);
        let Some(at) = self.moved(lookup, from, middle) else {
            return false;
        };
        let s = 0.5 * (cells.s[cell[2]] + cells.s[cell[2] + 1]);
        let to = self.horizontal(at.q).push(at.bed * (1.0 - s));
        self.solids.sees(eye, &to)
    }

    /// Distance (m) from a place to a cell, and the place mirrored into the cell at its nearest side.
    fn mirrored(&self, cells: &Cells, lookup: &Lookup, p: &DomainPoint, cell: [usize; 3]) -> (f64, DomainPoint) {
        let mut q = p.q;
        let mut away = 0.0_f64;
        for d in 0..3 {
            let (low, high) = if d == 2 {
                (cells.s[cell[2]], cells.s[cell[2] + 1])
            } else {
                let h = self.spacing[d];
                (cell[d] as f64 * h, (cell[d] as f64 + 1.0) * h)
            };
            let off = (low - q[d]).max(q[d] - high).max(0.0);
            let metres = if d == 2 { off * -p.bed } else { off };
            away += metres * metres;
            let inside = INSIDE * (high - low);
            if q[d] < low {
                q[d] = 2.0 * low - q[d];
            } else if q[d] > high {
                q[d] = 2.0 * high - q[d];
            }
            q[d] = q[d].clamp(low + inside, high - inside);
        }
        let bed = self.bed(lookup, q);
        (away.sqrt(), DomainPoint { q, bed, cell })
    }
}
