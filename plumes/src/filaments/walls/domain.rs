//! The room that filaments have: bounded by bed and surface, side walls, closed faces of blocked cells, or obstacles.
//!
//! *Source*: none. `rebound` and `image` need only straight ways along three axes from wall to wall.
//!
//! *Parameters*: none.
//!
//! *Deviations*: in blocked water, the cells are the solids for water, filaments and kernel alike; obstacles only tell
//! on which side of a thin wall a place is. Without blockage, the obstacles are the solids. The axes are along and
//! across the area, and upwards. Over a sloping bed, a height is followed at the same part of the depth.

use super::clearances::clearances;
use super::solids::Solids;
use crate::filaments::water::fetch::BLOCK;
use crate::filaments::water::lookup::Lookup;
use crate::flow::blockage::Cells;
use crate::flow::grid::FlowGrid;
use nalgebra::{Vector2, Vector3};
use std::sync::Arc;
use world::fields::SideWalls;

/// A place in the water.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DomainPoint {
    /// Along and across, m from the grid's corner; above the bed, as a part of the depth.
    pub(crate) q: [f64; 3],
    /// Height of the bed, m (negative).
    pub(crate) bed: f64,
    /// Cell of the grid along, across, upwards.
    pub(crate) cell: [usize; 3],
}

impl DomainPoint {
    /// Height, m.
    pub(crate) fn z(&self) -> f64 {
        self.bed * (1.0 - self.q[2])
    }

    /// Coordinate along an axis, m.
    pub(crate) fn on(&self, d: usize) -> f64 {
        if d == 2 { self.z() } else { self.q[d] }
    }
}

/// Everything that filaments cannot pass.
#[derive(Clone, Debug)]
pub(crate) struct Domain {
    /// World (east, north) of the datum from which filaments are placed, m.
    pub(crate) datum: Vector2<f64>,
    origin: Vector2<f64>,
    axes: [Vector2<f64>; 2],
    pub(crate) spacing: [f64; 2],
    // Nodes across.
    across: usize,
    /// Solids; they are the walls if there are no cells.
    pub(crate) solids: Solids,
    /// Cells of blocked water.
    pub(crate) cells: Option<Arc<Cells>>,
    /// Side walls, as the two coordinates across.
    sides: Option<[f64; 2]>,
    // For each column of the grid: the number of columns to the nearest one that is not open from bed to surface and to
    // its neighbours.
    clear: Arc<Vec<u8>>,
    /// Steepest slope of the bed.
    pub(crate) steepest: f64,
}

impl Domain {
    pub(crate) fn new(grid: &FlowGrid) -> Self {
        let axis = |a: [f32; 2]| Vector2::new(f64::from(a[0]), f64::from(a[1]));
        let spacing = grid.spacing.map(f64::from);
        Self {
            datum: grid.datum,
            origin: axis(grid.origin),
            axes: [axis(grid.along), axis(grid.across)],
            spacing,
            across: grid.dims[1],
            solids: Solids::default(),
            cells: None,
            sides: None,
            clear: Arc::default(),
            steepest: grid.ground.steepest(),
        }
    }

    /// Takes over the cells, which must lie between the nodes of the plume's grid.
    pub(crate) fn lead_round(&mut self, cells: Arc<Cells>) {
        self.clear = Arc::new(clearances(&cells));
        self.cells = Some(cells);
    }

    pub(crate) fn between(&mut self, walls: &SideWalls) {
        let middle = (walls.centre - self.datum - self.origin).dot(&self.axes[1]);
        self.sides = Some([middle - walls.half_width_m, middle + walls.half_width_m]);
    }

    /// Whether bed and surface are the only boundaries.
    pub(crate) fn is_open(&self) -> bool {
        self.cells.is_none() && self.sides.is_none() && self.solids.is_empty()
    }

    /// Whether there are walls at which the drift itself does not reflect filaments.
    pub(crate) fn has_solids(&self) -> bool {
        self.cells.is_some() || !self.solids.is_empty()
    }

    /// The place of a point; `None` outside the grid.
    pub(crate) fn place(&self, lookup: &Lookup, p: [f32; 3]) -> Option<DomainPoint> {
        let c = lookup.column(p[0], p[1]);
        if c.outside {
            return None;
        }
        let bed = lookup.bed(p[0], p[1]);
        let level = lookup.level(p[2], -1.0 / bed);
        let at = c.at as usize;
        let cell = [at / self.across, at % self.across, level.below as usize];
        Some(DomainPoint {
            q: [
                (cell[0] as f64 + f64::from(c.f)) * self.spacing[0],
                (cell[1] as f64 + f64::from(c.g)) * self.spacing[1],
                (1.0 - f64::from(p[2]) / f64::from(bed)).clamp(0.0, 1.0),
            ],
            bed: f64::from(bed),
            cell,
        })
    }

    /// East, north (from the datum), up of a place, m.
    pub(crate) fn point(&self, p: &DomainPoint) -> [f32; 3] {
        let xy = self.horizontal(p.q);
        [xy.x as f32, xy.y as f32, p.z() as f32]
    }

    pub(crate) fn horizontal(&self, q: [f64; 3]) -> Vector2<f64> {
        self.origin + self.axes[0] * q[0] + self.axes[1] * q[1]
    }

    /// The place at other coordinates along and across, at the same part of the depth; `None` outside the grid.
    pub(crate) fn moved(&self, lookup: &Lookup, p: &DomainPoint, to: [f64; 2]) -> Option<DomainPoint> {
        let q = [to[0], to[1], p.q[2]];
        let xy = self.horizontal(q);
        let c = lookup.column(xy.x as f32, xy.y as f32);
        if c.outside {
            return None;
        }
        let cell = [0, 1].map(|d| (to[d] / self.spacing[d]).max(0.0) as usize);
        let last = self.cells.as_ref().map_or([usize::MAX; 2], |c| [c.n[0] - 1, c.n[1] - 1]);
        Some(DomainPoint {
            q,
            bed: f64::from(lookup.bed(xy.x as f32, xy.y as f32)),
            cell: [cell[0].min(last[0]), cell[1].min(last[1]), p.cell[2]],
        })
    }

    /// Height of the bed, m, at coordinates along and across.
    pub(crate) fn bed(&self, lookup: &Lookup, q: [f64; 3]) -> f64 {
        let xy = self.horizontal(q);
        f64::from(lookup.bed(xy.x as f32, xy.y as f32))
    }

    /// Components of an offset (east, north) along and across.
    pub(crate) fn parts(&self, way: Vector2<f64>) -> [f64; 2] {
        self.axes.map(|a| a.dot(&way))
    }

    /// Whether a filament at a point may feel a wall within a horizontal reach (m).
    #[inline]
    pub(crate) fn near(&self, lookup: &Lookup, p: [f32; 3], reach: f64) -> bool {
        if let Some([low, high]) = self.sides {
            let xy = Vector2::new(f64::from(p[0]), f64::from(p[1])) - self.origin;
            let side = xy.dot(&self.axes[1]);
            if side - low <= reach || high - side <= reach {
                return true;
            }
        }
        if self.cells.is_some() {
            let at = lookup.column(p[0], p[1]).at as usize;
            return f64::from(self.clear[at]) <= 1.0 + reach / self.spacing[0].min(self.spacing[1]);
        }
        self.solids.near(p, reach)
    }

    /// For each filament of a block, whether [`Self::by_walls`] needs to be asked.
    pub(crate) fn near_walls(
        &self,
        lookup: &Lookup,
        from: &[[f32; BLOCK]; 3],
        to: [&[f32; BLOCK]; 3],
    ) -> [bool; BLOCK] {
        let mut near = [true; BLOCK];
        if self.cells.is_none() {
            return near;
        }
        let mut at = [0_u32; BLOCK];
        let mut columns = [0.0_f32; BLOCK];
        let per = 1.0 / self.spacing[0].min(self.spacing[1]) as f32;
        for l in 0..BLOCK {
            at[l] = lookup.column(from[0][l], from[1][l]).at;
            // Slightly more, against rounding.
            let way = (to[0][l] - from[0][l]).abs() + (to[1][l] - from[1][l]).abs();
            columns[l] = 1.001 + 1.001 * per * way;
        }
        for l in 0..BLOCK {
            near[l] = f32::from(self.clear[at[l] as usize]) <= columns[l];
        }
        near
    }

    /// Whether there may be walls on the way from one point to another.
    #[inline]
    pub(crate) fn by_walls(&self, lookup: &Lookup, from: [f32; 3], to: [f32; 3]) -> bool {
        if let Some(cells) = &self.cells {
            let clear = self.clear[lookup.column(from[0], from[1]).at as usize];
            let way = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
            let columns = f64::from(way) / self.spacing[0].min(self.spacing[1]);
            return f64::from(clear) <= 1.0 + columns && !self.is_plain(cells, lookup, from, to);
        }
        self.solids.by(from, to)
    }

    /// Whether a way that goes upwards, then along, then across passes only open faces, and at most into a neighbouring
    /// column.
    fn is_plain(&self, cells: &Cells, lookup: &Lookup, from: [f32; 3], to: [f32; 3]) -> bool {
        let (a, b) = (lookup.column(from[0], from[1]), lookup.column(to[0], to[1]));
        if a.outside || b.outside {
            return false;
        }
        let beds = [from, to].map(|p| lookup.bed(p[0], p[1]));
        let level = |z: f32, bed: f32| lookup.level(z, -1.0 / bed).below as usize;
        let (below, above) = (level(from[2], beds[0]), level(to[2], beds[0]));
        let [i, j] = [a.at as usize / self.across, a.at as usize % self.across];
        let [m, n] = [b.at as usize / self.across, b.at as usize % self.across];
        i.abs_diff(m) <= 1
            && j.abs_diff(n) <= 1
            && (beds[0] == beds[1] || level(to[2], beds[1]) == above)
            && cells.open[cells.cell([i, j, below])]
            && (below.min(above) + 1..=below.max(above)).all(|k| cells.passes(2, [i, j, k]))
            && (i == m || cells.passes(0, [i.max(m), j, above]))
            && (j == n || cells.passes(1, [m, j.max(n), above]))
    }

    /// The free way along an axis on both sides of a place: coordinates of its ends, m; infinite where no wall was
    /// found within `reach`. Upwards the ends are always known.
    pub(crate) fn along(&self, p: &DomainPoint, d: usize, reach: f64) -> [f64; 2] {
        let mut ends = if d == 2 { [p.bed, 0.0] } else { [f64::NEG_INFINITY, f64::INFINITY] };
        if d == 1
            && let Some(sides) = self.sides
        {
            ends = sides;
        }
        if let Some(cells) = &self.cells {
            let [low, high] = self.through(cells, p, d, reach);
            ends = [ends[0].max(low), ends[1].min(high)];
        } else if !self.solids.is_empty() {
            let xy = self.horizontal(p.q);
            let from = xy.push(p.z());
            let axis = if d == 2 { Vector3::z() } else { self.axes[d].push(0.0) };
            let here = p.on(d);
            let way = |end: f64| (end - here).abs().min(if d == 2 { f64::MAX } else { reach });
            if let Some(t) = self.solids.ray(&from, &-axis, way(ends[0])) {
                ends[0] = here - t;
            }
            if let Some(t) = self.solids.ray(&from, &axis, way(ends[1])) {
                ends[1] = here + t;
            }
        }
        ends
    }

    /// As `along`, but in cells: up to the first closed faces.
    fn through(&self, cells: &Cells, p: &DomainPoint, d: usize, reach: f64) -> [f64; 2] {
        let here = p.on(d);
        let at = |f: usize| {
            if d == 2 { p.bed * (1.0 - cells.s[f]) } else { f as f64 * self.spacing[d] }
        };
        let far = |f: usize| d < 2 && (at(f) - here).abs() > reach;
        let mut face = p.cell;
        let low = loop {
            if !cells.passes(d, face) {
                break at(face[d]);
            }
            if face[d] == 0 || far(face[d]) {
                break f64::NEG_INFINITY;
            }
            face[d] -= 1;
        };
        face[d] = p.cell[d] + 1;
        let high = loop {
            if !cells.passes(d, face) {
                break at(face[d]);
            }
            if face[d] == cells.n[d] || far(face[d]) {
                break f64::INFINITY;
            }
            face[d] += 1;
        };
        [low, high]
    }
}
