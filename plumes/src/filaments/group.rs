//! Neighbours in the order of release: leaves of successive filaments, and the boxes in which they move.
//!
//! *Source*: see `index`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: a leaf holds filaments that were released one after the other, so no sorting is needed. Filaments of
//! one age are as far apart as eddies have carried them, and each has grown with the same eddies to nearly that size.
//! So a leaf that is sorted by place would hardly be asked less often.

use super::bands::Moment;
use super::image::{Felt, Spot};
use super::index::Question;
use super::leaf::{CUT_SIGMAS, LEAF, Leaf};
use super::moving::Moving;
use super::store::Store;
use crate::path::Path;
use std::ops::Range;
use std::sync::OnceLock;

/// Leaves of a group.
const LEAVES: usize = 32;

/// Most filaments in a group.
pub(super) const GROUP: usize = LEAVES * LEAF;

/// Up to [`GROUP`] neighbours in the order of release.
#[derive(Clone, Debug)]
pub(super) struct Group {
    members: Range<usize>,
    /// Size of the oldest member at the end of the step, which is the largest, m.
    largest: f32,
    /// Reach of the largest along each axis, m; upwards with what a steep bed adds to it.
    reach: [f32; 3],
    /// East, north, up. Most groups are ruled out by one of them.
    boxes: [OnceLock<Box<Sides>>; 3],
    leaves: OnceLock<Box<[OnceLock<Box<InStep>>; LEAVES]>>,
}

/// Least and greatest coordinate of each leaf along an axis during the step, m, and of all of them.
#[derive(Clone, Debug)]
struct Sides {
    lo: [f32; LEAVES],
    hi: [f32; LEAVES],
    all: [f32; 2],
}

/// A leaf during a step.
#[derive(Clone, Debug)]
struct InStep {
    moving: Moving,
    present: OnceLock<Box<Present>>,
}

/// A leaf at a time, and the filaments that feel a wall and are therefore not in it.
#[derive(Clone, Debug)]
struct Present {
    leaf: Leaf,
    walled: Vec<Felt>,
}

/// A question to the groups of a band.
pub(super) struct Asked<'a> {
    pub(super) p: [f32; 3],
    pub(super) spot: &'a Spot<'a>,
    pub(super) q: &'a Question<'a>,
    pub(super) s: &'a Store,
    pub(super) moment: Moment,
    /// The axes, from the one along which the band is longest.
    pub(super) axes: [usize; 3],
}

impl Group {
    /// These members of a store, until a time. `steepest` is the slope of bed and solids, 0 without walls.
    pub(super) fn new(s: &Store, members: Range<usize>, end_s: f64, steepest: f32) -> Self {
        // The first is the oldest, and so the largest.
        let largest = s.largest(members.clone(), end_s - s.born_s[members.start]);
        let [flat, high] =
            [largest, s.size.vertical(largest, f32::MIN)].map(|size| CUT_SIGMAS * 1.000_1 * size);
        Self {
            members,
            largest,
            reach: [flat, flat, high + 2.0 * steepest * flat],
            boxes: Default::default(),
            leaves: OnceLock::new(),
        }
    }

    /// Forgets what holds only for the present time.
    pub(super) fn forget(&mut self) {
        let leaves = self.leaves.get_mut().into_iter().flat_map(|l| l.iter_mut());
        for leaf in leaves.filter_map(OnceLock::get_mut) {
            leaf.present.take();
        }
    }

    /// The sum of the contributions of its leaves, one after the other, kg/m³.
    pub(super) fn felt(&self, asked: &Asked) -> f64 {
        let mut near = self.near(asked);
        if near == 0 {
            return 0.0;
        }
        let leaves = (self.leaves).get_or_init(|| Box::new([const { OnceLock::new() }; LEAVES]));
        let mut total = 0.0;
        while near != 0 {
            let n = near.trailing_zeros() as usize;
            near &= near - 1;
            let leaf = leaves[n].get_or_init(|| Box::new(InStep::new(asked, self.leaf(n))));
            total += leaf.felt(asked, self.largest);
        }
        total
    }

    fn leaf(&self, n: usize) -> Range<usize> {
        let from = self.members.start + n * LEAF;
        from..self.members.end.min(from + LEAF)
    }

    /// One bit for each leaf that moves within reach of the point during the step. Somewhat more than the reach of any
    /// member counts; beyond its reach, a filament contributes nothing.
    fn near(&self, asked: &Asked) -> u32 {
        let mut sides = [None; 3];
        for d in asked.axes {
            let side = self.side(asked, d);
            let (p, [lo, hi]) = (asked.p[d], side.all);
            if p < lo - self.reach[d] || p > hi + self.reach[d] {
                return 0;
            }
            sides[d] = Some(side);
        }
        let mut near = u32::MAX;
        for (d, side) in sides.into_iter().enumerate() {
            near &= side.map_or(0, |side| side.near(asked.p[d], self.reach[d]));
        }
        near
    }

    fn side(&self, asked: &Asked, d: usize) -> &Sides {
        self.boxes[d].get_or_init(|| {
            let s = asked.s;
            let ways = [&s.start[d], [&s.x, &s.y, &s.z][d]];
            let ways = ways.map(|way| &way[self.members.clone()]);
            Box::new(match asked.q.path {
                Path::Portable => Sides::new(ways),
                // SAFETY: this variant is only made after the feature was detected.
                #[cfg(target_arch = "x86_64")]
                Path::Avx2 => unsafe { sides_avx2(ways) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                Path::Avx512 => unsafe { sides_avx512(ways) },
            })
        })
    }
}

impl Sides {
    /// From coordinates at both ends of the step.
    #[inline(always)]
    fn new(ways: [&[f32]; 2]) -> Self {
        let mut sides = Self {
            lo: [f32::MAX; LEAVES],
            hi: [f32::MIN; LEAVES],
            all: [f32::MAX, f32::MIN],
        };
        for way in ways {
            let (full, rest) = way.as_chunks::<LEAF>();
            let ends = full.iter().map(extent);
            let mut last = [f32::NAN; LEAF];
            last[..rest.len()].copy_from_slice(rest);
            let last = (!rest.is_empty()).then(|| extent(&last));
            for (n, [lo, hi]) in ends.chain(last).enumerate() {
                sides.lo[n] = sides.lo[n].min(lo);
                sides.hi[n] = sides.hi[n].max(hi);
                sides.all = [sides.all[0].min(lo), sides.all[1].max(hi)];
            }
        }
        sides
    }

    fn near(&self, p: f32, reach: f32) -> u32 {
        let mut near = 0;
        for (n, (lo, hi)) in self.lo.iter().zip(&self.hi).enumerate() {
            near |= u32::from(p >= lo - reach && p <= hi + reach) << n;
        }
        near
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn sides_avx2(ways: [&[f32]; 2]) -> Sides {
    Sides::new(ways)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn sides_avx512(ways: [&[f32]; 2]) -> Sides {
    Sides::new(ways)
}

/// Least and greatest value; what is no number does not count.
#[inline(always)]
fn extent(v: &[f32; LEAF]) -> [f32; 2] {
    const LANES: usize = 16;
    let mut lo = [f32::MAX; LANES];
    let mut hi = [f32::MIN; LANES];
    for from in (0..LEAF).step_by(LANES) {
        for l in 0..LANES {
            let c = v[from + l];
            lo[l] = if c < lo[l] { c } else { lo[l] };
            hi[l] = if c > hi[l] { c } else { hi[l] };
        }
    }
    let mut half = LANES / 2;
    while half > 0 {
        for l in 0..half {
            lo[l] = lo[l].min(lo[l + half]);
            hi[l] = hi[l].max(hi[l + half]);
        }
        half /= 2;
    }
    [lo[0], hi[0]]
}

impl InStep {
    fn new(asked: &Asked, members: Range<usize>) -> Self {
        Self {
            moving: Moving::new(asked.s, asked.q.lookup, members),
            present: OnceLock::new(),
        }
    }

    fn felt(&self, asked: &Asked, largest: f32) -> f64 {
        let present = match self.present.get() {
            Some(present) => present,
            // Many leaves that are asked do not contribute, and to see this from their horizontal places takes a
            // fraction of the time in which a leaf is worked out.
            None if !self.may_feel(asked, largest) => return 0.0,
            None => (self.present).get_or_init(|| Box::new(Present::of(&self.moving, asked))),
        };
        let mut total = f64::from(present.leaf.at(asked.q.path, asked.p));
        for felt in &present.walled {
            total += felt.add(asked.spot);
        }
        total
    }

    /// Whether the members may contribute.
    fn may_feel(&self, asked: &Asked, largest: f32) -> bool {
        if !asked.spot.room.is_open() {
            return true;
        }
        let reach = CUT_SIGMAS * 1.000_1 * largest;
        (self.moving).may_reach(asked.q.path, asked.p, &asked.moment, reach)
    }
}

impl Present {
    fn of(moving: &Moving, asked: &Asked) -> Self {
        let Asked { s, q, spot, .. } = asked;
        let mut leaf = moving.leaf(q.path, &s.size, &asked.moment);
        let mut walled = Vec::new();
        if !spot.room.is_open() {
            leaf.retain(|p, sizes| {
                let felt = Felt::new(spot.room, spot.lookup, p, sizes, s.filament_kg);
                let free = felt.is_none();
                walled.extend(felt);
                free
            });
        }
        leaf.seal(q.path, s.filament_kg);
        Self { leaf, walled }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_hold_every_member_and_no_more() {
        let mut rng = world::seeds::Stream::new(3, "test", "sides");
        for n in [1, 31, 32, 33, 500, 1024] {
            let mut way = || -> Vec<f32> { (0..n).map(|_| rng.normal() as f32).collect() };
            let ways = [way(), way()];
            let sides = Sides::new([&ways[0], &ways[1]]);
            for leaf in 0..LEAVES {
                let part = (leaf * LEAF).min(n)..(leaf * LEAF + LEAF).min(n);
                let of = |f: fn(f32, f32) -> f32, none: f32| {
                    let all = ways.iter().flat_map(|w| &w[part.clone()]);
                    all.fold(none, |a, b| f(a, *b))
                };
                assert_eq!(sides.lo[leaf], of(f32::min, f32::MAX), "{leaf} of {n}");
                assert_eq!(sides.hi[leaf], of(f32::max, f32::MIN), "{leaf} of {n}");
                let inside = sides.near(sides.lo[leaf], 0.0) >> leaf & 1;
                assert_eq!(inside == 1, !part.is_empty());
            }
            let all = [f32::MAX, f32::MIN];
            let [lo, hi] = all;
            let values = || ways.iter().flatten().copied();
            assert_eq!(
                sides.all,
                [values().fold(lo, f32::min), values().fold(hi, f32::max)]
            );
        }
    }
}
