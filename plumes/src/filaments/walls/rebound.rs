//! Reflects filaments at walls. A motion that would pass a wall is mirrored at it: along, across and upwards in turn.
//!
//! *Source*: reflection at a solid wall (Thomson 1987, J. Fluid Mech. 180, 529, section 4).
//!
//! *Parameters*: none.
//!
//! *Deviations*: a kick along one axis is symmetric and is mirrored at both ends of the free way on which it starts. It
//! leaves dye that is even along that way even, whatever its length. Three such kicks in a row leave even dye even at
//! any step, up to walls, in corners and between walls, and none ever passes a wall. Near a wall that ends within a
//! kick, the way round the edge follows the axes. Between closed faces above and below, the diffusivity is the water's
//! own, mirrored. In horizontal motion a filament keeps its height; it is mirrored at a bed or a solid's slope that it
//! runs into.

use super::domain::{Domain, DomainPoint};
use crate::filaments::water::lookup::Lookup;
use crate::flow::blockage::Cells;
use crate::flow::grid::FlowGrid;
use nalgebra::Vector2;

/// Distance of a mirrored filament from an obstacle, m: more than the rounding of single-precision positions of a
/// kilometre.
const CLEAR_M: f64 = 5e-4;
/// Most walls that a filament may meet in a step.
const IN_A_ROW: usize = 10_000;

/// Mirrors a coordinate at the ends of a way, as often as necessary.
pub(crate) fn folded(x: f64, [low, high]: [f64; 2]) -> f64 {
    if x >= low && x <= high {
        return x;
    }
    if low.is_infinite() {
        return 2.0 * high - x;
    }
    if high.is_infinite() {
        return 2.0 * low - x;
    }
    let long = high - low;
    let passed = (x - low).abs() % (2.0 * long);
    let back = if passed > long { 2.0 * long - passed } else { passed };
    (low + back).clamp(low, high)
}

/// Result of a filament's motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflection {
    /// East, north, up, m.
    pub(crate) p: [f32; 3],
    /// Whether it met a wall.
    pub(crate) met: bool,
    /// Whether it left the grid.
    pub(crate) left: bool,
}

/// A vertical kick of a filament.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kick {
    /// Two standard normals.
    pub(crate) noise: [f32; 2],
    /// Step, s.
    pub(crate) dt_s: f32,
    /// Part of the diffusivity that kicks it.
    pub(crate) part: f32,
}

impl Domain {
    /// Moves a filament from `from` towards `to` and reflects it at walls; `to` already allows for bed and surface. In
    /// cells, `kick`, if any, is computed again between the closed faces above and below.
    pub(crate) fn turn_back(
        &self,
        lookup: &Lookup,
        grid: &FlowGrid,
        from: [f32; 3],
        to: [f32; 3],
        kick: Option<Kick>,
    ) -> Reflection {
        let went = [0, 1, 2].map(|d| f64::from(to[d]) - f64::from(from[d]));
        let [along, across] = self.parts(Vector2::new(went[0], went[1]));
        let gone = Reflection { p: to, met: false, left: true };
        let Some(start) = self.place(lookup, from) else {
            return gone;
        };
        let Some(cells) = &self.cells else {
            return self.round_obstacles(lookup, start, [along, across, went[2]]).unwrap_or(gone);
        };
        let Some(start) = self.open(lookup, &start, false) else {
            return Reflection { p: from, met: true, left: false };
        };
        let mut p = start;
        let ends = self.along(&p, 2, 0.0);
        let up = match kick {
            Some(kick) => self.kicked(grid, &p, ends, kick),
            None => went[2],
        };
        let z = folded(p.z() + up, ends);
        let mut met = p.z() + up != z && (ends[0] > p.bed || ends[1] < 0.0);
        for (d, way) in [along, across].into_iter().enumerate() {
            match self.walked(cells, lookup, &mut p, z, d, way) {
                Some(turned) => met |= turned,
                None => return gone,
            }
        }
        self.settled(cells, lookup, p, z).map_or(Reflection { p: from, met: true, left: false }, |p| Reflection {
            p,
            met,
            left: false,
        })
    }

    /// Milstein's step as in `kernel`, between two ends, m.
    fn kicked(&self, grid: &FlowGrid, p: &DomainPoint, ends: [f64; 2], kick: Kick) -> f64 {
        let [x, y, z] = self.point(p);
        let here = grid.sample(x, y, z);
        let dt = f64::from(kick.dt_s) * f64::from(kick.part);
        let [one, two] = kick.noise.map(f64::from);
        let way = (2.0 * f64::from(here.k_z) * dt).sqrt() * one;
        let there = grid.sample(x, y, folded(p.z() + way, ends) as f32);
        let slope = f64::from(here.dk_dz);
        let secant = if way.abs() > -1e-5 * p.bed { f64::from(there.k_z - here.k_z) / way } else { slope };
        way + 0.25 * dt * (slope + secant) * (one * one + two * two)
    }

    /// Moves along one axis at a constant height, from cell to cell. Returns whether it was reflected; `None` if it
    /// left the grid.
    fn walked(&self, cells: &Cells, lookup: &Lookup, p: &mut DomainPoint, z: f64, d: usize, way: f64) -> Option<bool> {
        let h = cells.d[d];
        let (mut to, mut met) = (p.q[d] + way, false);
        for _ in 0..IN_A_ROW {
            let c = p.cell[d];
            let (low, high) = (c as f64 * h, (c + 1) as f64 * h);
            let (face, at) = if to > high {
                (c + 1, high)
            } else if to < low {
                (c, low)
            } else {
                break;
            };
            let mut f = p.cell;
            f[d] = face;
            let mut q = p.q;
            q[d] = at;
            f[2] = cells.level((1.0 - z / self.bed(lookup, q)).clamp(0.0, 1.0));
            if !cells.passes(d, f) {
                to = 2.0 * at - to;
                met = true;
            } else if to > high {
                if c + 1 == cells.n[d] {
                    return None;
                }
                p.cell[d] = c + 1;
            } else {
                if c == 0 {
                    return None;
                }
                p.cell[d] = c - 1;
            }
        }
        let c = p.cell[d] as f64;
        p.q[d] = to.clamp(c * h, (c + 1.0) * h);
        Some(met)
    }

    /// The point of a place at a height. It is mirrored at the bed, at the surface, or at the solid above or below that
    /// it is in.
    fn settled(&self, cells: &Cells, lookup: &Lookup, mut p: DomainPoint, z: f64) -> Option<[f32; 3]> {
        p.bed = self.bed(lookup, p.q);
        let z = folded(z, [p.bed, 0.0]);
        p.q[2] = (1.0 - z / p.bed).clamp(0.0, 1.0);
        p.cell[2] = cells.level(p.q[2]);
        if !self.is_free(&p) {
            p = self.open(lookup, &p, false)?;
        }
        let point = self.point(&p);
        let again = self.place(lookup, point)?;
        if self.is_free(&again) {
            return Some(point);
        }
        self.open(lookup, &again, false).map(|p| self.point(&p))
    }

    /// Moves along the three axes between obstacles; `None` if it left the grid.
    fn round_obstacles(&self, lookup: &Lookup, mut p: DomainPoint, way: [f64; 3]) -> Option<Reflection> {
        let mut met = false;
        for d in 0..3 {
            let ends = self.along(&p, d, way[d].abs() + CLEAR_M);
            let wanted = p.on(d) + way[d];
            let mut to = folded(wanted, ends);
            met |= to != wanted && !(d == 2 && ends == [p.bed, 0.0]);
            if met && ends[1] - ends[0] > 2.0 * CLEAR_M {
                to = to.clamp(ends[0] + CLEAR_M, ends[1] - CLEAR_M);
            }
            if d == 2 {
                p.q[2] = (1.0 - to / p.bed).clamp(0.0, 1.0);
            } else {
                let z = p.z();
                let mut q = [p.q[0], p.q[1]];
                q[d] = to;
                p = self.moved(lookup, &p, q)?;
                p.q[2] = 1.0 - folded(z, [p.bed, 0.0]) / p.bed;
            }
        }
        let mut point = self.point(&p);
        let at = nalgebra::Vector3::from(point.map(f64::from));
        if self.solids.containing(&at).is_some() {
            point = self.solids.way_out(&at).map(|v| v as f32).into();
            met = true;
        }
        Some(Reflection { p: point, met, left: false })
    }
}

#[cfg(test)]
mod tests {
    use super::folded;

    #[test]
    fn folding_mirrors_at_both_ends() {
        let open = f64::INFINITY;
        for (x, ends, want) in [
            (1.5, [0.0, 1.0], 0.5),
            (-0.25, [0.0, 1.0], 0.25),
            (3.25, [0.0, 1.0], 0.75),
            (-2.25, [0.0, 1.0], 0.25),
            (5.0, [-open, 4.0], 3.0),
            (1.0, [2.0, open], 3.0),
            (-7.0, [-open, open], -7.0),
        ] {
            assert!((folded(x, ends) - want).abs() < 1e-12, "{x} {ends:?}");
        }
    }
}
