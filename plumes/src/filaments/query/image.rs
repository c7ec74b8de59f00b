//! Concentration at a point from a filament near walls: its kernel is mirrored at every wall that it reaches.
//!
//! *Source*: images of a source at walls, Csanady 1973, Turbulent Diffusion in the Environment, ch. 3; between two
//! walls, the rows of images of Carslaw & Jaeger 1959, Conduction of Heat in Solids, section 14.3.
//!
//! *Parameters*: none.
//!
//! *Deviations*: the way from filament to point is taken along the three axes in turn. Along each axis the Gaussian is
//! mirrored at both ends of the free way. The result is the mean of the orders along-across-up and up-across-along, so
//! that it is the same from either end. Each of the three factors has the integral 1 over its way, from the point's
//! side as well as from the filament's. Therefore all of the mass is in the water, and even dye has one concentration
//! everywhere: at a wall, in a corner, in a narrow gap. Nothing is felt through a wall, however thin; round the edge of
//! a wall, the kernel reaches as far as the ways lead. It is cut at 4σ along each axis. Between walls less than 4/3 σ
//! apart it is even, to 3e-5.

use super::packet::{CUT_SIGMAS, falling};
use crate::filaments::walls::domain::{Domain, DomainPoint};
use crate::filaments::water::lookup::Lookup;
use std::cell::OnceCell;

/// Part of a Gaussian's mass within the cut: erf(4/√2).
const WITHIN_CUT: f64 = 0.999_936_66;

/// A filament near a wall.
#[derive(Clone, Debug)]
pub(crate) struct NearWall {
    at: DomainPoint,
    sizes: [f64; 2],
    kg: f64,
    along: [f64; 2],
    up: [f64; 2],
}

/// A point at which the concentration is asked for.
pub(crate) struct QueryPoint<'a> {
    pub(crate) room: &'a Domain,
    pub(crate) lookup: &'a Lookup,
    /// East, north, up, m; the point lies in the water.
    pub(crate) p: [f32; 3],
    at: Option<DomainPoint>,
    // Longest reach of any filament, m.
    reach: f64,
    ends: OnceCell<[[f64; 2]; 2]>,
}

impl<'a> QueryPoint<'a> {
    /// `None` if no water is near.
    pub(crate) fn new(room: &'a Domain, lookup: &'a Lookup, p: [f32; 3], reach: f64) -> Option<Self> {
        let mut query = Self { room, lookup, p, at: None, reach, ends: OnceCell::new() };
        if room.is_open() {
            return Some(query);
        }
        query.at = room.place(lookup, p);
        if room.near(lookup, p, 0.0)
            && let Some(at) = query.at
        {
            let open = room.open(lookup, &at, true)?;
            if open.q != at.q {
                (query.p, query.at) = (room.point(&open), Some(open));
            }
        }
        Some(query)
    }

    /// Free ways along and upwards from the point.
    fn ends(&self, at: &DomainPoint) -> [[f64; 2]; 2] {
        *(self.ends).get_or_init(|| [0, 2].map(|d| self.room.along(at, d, self.reach)))
    }
}

impl NearWall {
    /// A filament of `kg` at `p` with horizontal and vertical sizes (m), if a wall is near enough to matter.
    pub(crate) fn new(room: &Domain, lookup: &Lookup, p: [f32; 3], sizes: [f32; 2], kg: f64) -> Option<Self> {
        let sizes = sizes.map(f64::from);
        let reach = f64::from(CUT_SIGMAS) * sizes[0];
        if room.is_open() || !room.near(lookup, p, reach) {
            return None;
        }
        let at = room.place(lookup, p)?;
        Some(Self { at, sizes, kg, along: room.along(&at, 0, reach), up: room.along(&at, 2, reach) })
    }

    /// Its contribution at a point, kg/m³.
    pub(crate) fn add(&self, query: &QueryPoint<'_>) -> f64 {
        let Some(to) = &query.at else { return 0.0 };
        let from = &self.at;
        let [flat, high] = self.sizes;
        let reach = f64::from(CUT_SIGMAS) * flat;
        if (0..2).any(|d| (to.q[d] - from.q[d]).abs() > reach) {
            return 0.0;
        }
        let (room, lookup) = (query.room, query.lookup);
        let [along, up] = query.ends(to);
        let mut sum = 0.0;
        // Along, across, up.
        let z = to.bed * (1.0 - from.q[2]);
        if within(to.q[0], self.along)
            && within(z, up)
            && let Some(middle) = room.moved(lookup, from, [to.q[0], from.q[1]])
        {
            let across = room.along(&middle, 1, reach);
            if within(to.q[1], across) {
                sum += density(to.q[0], from.q[0], flat, self.along)
                    * density(to.q[1], from.q[1], flat, across)
                    * density(to.z(), z, high, up);
            }
        }
        // Up, across, along.
        let z = from.bed * (1.0 - to.q[2]);
        if within(z, self.up) && within(from.q[0], along) {
            let mut middle = *from;
            (middle.q[2], middle.cell[2]) = (to.q[2], to.cell[2]);
            let across = room.along(&middle, 1, reach);
            if within(to.q[1], across) {
                sum += density(z, from.z(), high, self.up)
                    * density(to.q[1], from.q[1], flat, across)
                    * density(to.q[0], from.q[0], flat, along)
                    * (from.bed / to.bed);
            }
        }
        0.5 * self.kg * sum
    }
}

fn within(x: f64, [low, high]: [f64; 2]) -> bool {
    x >= low && x <= high
}

/// Gaussian of standard deviation `size` about `from`, mirrored at both ends of a way, 1/m.
fn density(x: f64, from: f64, size: f64, [low, high]: [f64; 2]) -> f64 {
    let eighth = 1.0 / (16.0 * size * size);
    let term = |at: f64| f64::from(falling(((x - at) * (x - at) * eighth) as f32));
    let long = high - low;
    let mut sum = term(from);
    if long < 4.0 / 3.0 * size {
        return 1.0 / long;
    } else if long.is_finite() {
        sum += term(2.0 * low - from);
        // Rows of images up to the cut: 4σ is at most three ways.
        for n in [-2.0, -1.0, 1.0, 2.0] {
            let shift = 2.0 * n * long;
            sum += term(from + shift) + term(2.0 * low - from + shift);
        }
    } else if low.is_finite() {
        sum += term(2.0 * low - from);
    } else if high.is_finite() {
        sum += term(2.0 * high - from);
    }
    sum / (WITHIN_CUT * std::f64::consts::TAU.sqrt() * size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral over the way is 1, from the point's side as well as from the filament's.
    #[test]
    fn density_is_one_over_the_way_however_wide_it_is() {
        for size in [0.05, 0.3, 0.7, 0.76, 1.0, 4.0] {
            for fixed in [0.0, 0.01, 0.4, 1.0] {
                let n = 2000;
                let sum = |f: &dyn Fn(f64) -> f64| -> f64 {
                    (0..n).map(|k| f((f64::from(k) + 0.5) / f64::from(n))).sum::<f64>() / f64::from(n)
                };
                let ends = [0.0, 1.0];
                for total in [sum(&|x| density(x, fixed, size, ends)), sum(&|from| density(fixed, from, size, ends))] {
                    assert!((total - 1.0).abs() < 1e-4, "{size} {fixed}: {total}");
                }
            }
        }
        let half = density(0.2, 0.1, 0.3, [0.0, f64::INFINITY]);
        assert!((half - density(0.2, 0.1, 0.3, [0.0, 9.0])).abs() < 1e-9);
    }
}
