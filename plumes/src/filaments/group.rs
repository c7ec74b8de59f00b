//! Neighbours in the order of release: the box in which they move, and the ways to search them.
//!
//! *Source*: see `index`.
//!
//! *Parameters*: 1024 filaments in a group; a tree from the 33rd question about one time.
//!
//! *Deviations*: none.

use super::felt::{Asked, quanta};
use super::image::Spot;
use super::index::Question;
use super::leaf::CUT_SIGMAS;
use super::part::Tree;
use super::scan;
use super::store::Store;
use crate::path::Path;
use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// Most filaments in a group.
pub(super) const GROUP: usize = 1024;

/// To make a tree takes as long as so many questions without one. What it holds of one time is of no use at the next.
const SCANS: u32 = 32;

/// Up to [`GROUP`] neighbours in the order of release.
#[derive(Clone, Debug)]
pub(super) struct Group {
    members: Range<usize>,
    /// Farthest along each axis from which a member is felt during the step, m.
    reach: [f32; 3],
    quanta: f64,
    /// Least and greatest coordinates during the step: east, north, up. Most groups are ruled out by one of them.
    sides: [OnceLock<[f32; 2]>; 3],
    asked: Count,
    tree: OnceLock<Box<Tree>>,
}

/// How often a group was asked about the present time.
#[derive(Debug, Default)]
struct Count(AtomicU32);

impl Clone for Count {
    fn clone(&self) -> Self {
        Self(AtomicU32::new(self.0.load(Ordering::Relaxed)))
    }
}

impl Group {
    /// These members of a store, until a time.
    pub(super) fn new(q: &Question, s: &Store, members: Range<usize>, end_s: f64) -> Self {
        // The first is the oldest, and so the largest.
        let horizontal = s.largest(members.clone(), end_s - s.born_s[members.start]);
        let largest = [horizontal, s.size.vertical(horizontal, f32::MIN)];
        let smallest = s.size.horizontal(0.0);
        let smallest = [smallest, s.size.vertical(smallest, f32::MIN)];
        let [flat, high] = largest.map(|size| CUT_SIGMAS * 1.000_1 * size);
        // The kernel of a filament near a wall ends at its cut along each of two horizontal axes.
        let flat = if q.room.is_open() {
            flat
        } else {
            std::f32::consts::SQRT_2 * flat
        };
        Self {
            members,
            // A filament is mirrored at the bed below it, which over a slope may be higher than the point.
            reach: [flat, flat, high + 2.0 * q.room.steepest as f32 * flat],
            quanta: quanta(s.filament_kg, smallest, largest),
            sides: Default::default(),
            asked: Count::default(),
            tree: OnceLock::new(),
        }
    }

    /// Forgets what holds only for the present time.
    pub(super) fn forget(&mut self) {
        *self.asked.0.get_mut() = 0;
        if let Some(tree) = self.tree.get_mut() {
            tree.forget();
        }
    }

    /// What its members contribute at a point, kg/m³. `axes` begins with the one along which the band is longest.
    pub(super) fn felt(
        &self,
        q: &Question,
        spot: &Spot,
        s: &Store,
        band: usize,
        axes: [usize; 3],
    ) -> f64 {
        let p = spot.p;
        let near = |d: usize| {
            let [lo, hi] = self.side(q.path, s, d);
            p[d] >= lo - self.reach[d] && p[d] <= hi + self.reach[d]
        };
        if !axes.into_iter().all(near) {
            return 0.0;
        }
        let asked = Asked {
            p,
            spot,
            q,
            s,
            moment: q.bands.moment(band, q.now_s),
            from: self.members.start,
            reach: self.reach,
            quanta: self.quanta,
        };
        let total = if self.asked.0.fetch_add(1, Ordering::Relaxed) < SCANS {
            scan::felt(&asked, self.members.len())
        } else {
            let tree = || Box::new(Tree::new(s, self.members.clone()));
            self.tree.get_or_init(tree).felt(&asked)
        };
        total as f64 / self.quanta
    }

    fn side(&self, path: Path, s: &Store, d: usize) -> [f32; 2] {
        *self.sides[d].get_or_init(|| {
            let ways = [&s.start[d], [&s.x, &s.y, &s.z][d]];
            let ways = ways.map(|way| &way[self.members.clone()]);
            match path {
                Path::Portable => extent(ways),
                // SAFETY: this variant is only made after the feature was detected.
                #[cfg(target_arch = "x86_64")]
                Path::Avx2 => unsafe { extent_avx2(ways) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                Path::Avx512 => unsafe { extent_avx512(ways) },
            }
        })
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn extent_avx2(ways: [&[f32]; 2]) -> [f32; 2] {
    extent(ways)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn extent_avx512(ways: [&[f32]; 2]) -> [f32; 2] {
    extent(ways)
}

/// Least and greatest value.
#[inline(always)]
fn extent(ways: [&[f32]; 2]) -> [f32; 2] {
    const LANES: usize = 16;
    let mut lo = [f32::MAX; LANES];
    let mut hi = [f32::MIN; LANES];
    for way in ways {
        let (full, rest) = way.as_chunks::<LANES>();
        let mut last = [f32::NAN; LANES];
        last[..rest.len()].copy_from_slice(rest);
        for c in full.iter().chain([&last]) {
            for l in 0..LANES {
                // What is no number does not count.
                lo[l] = if c[l] < lo[l] { c[l] } else { lo[l] };
                hi[l] = if c[l] > hi[l] { c[l] } else { hi[l] };
            }
        }
    }
    let (lo, hi) = (lo.into_iter(), hi.into_iter());
    [lo.fold(f32::MAX, f32::min), hi.fold(f32::MIN, f32::max)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extent_holds_every_member_and_no_more() {
        let mut rng = world::seeds::Stream::new(3, "test", "sides");
        for n in [1, 15, 16, 17, 500, 1024] {
            let mut way = || -> Vec<f32> { (0..n).map(|_| rng.normal() as f32).collect() };
            let (start, end) = (way(), way());
            let all = || start.iter().chain(&end).copied();
            let want = [
                all().fold(f32::MAX, f32::min),
                all().fold(f32::MIN, f32::max),
            ];
            assert_eq!(extent([&start, &end]), want);
        }
    }
}
