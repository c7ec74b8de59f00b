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
use super::side::Side;
use super::store::Store;
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
    /// Between which coordinates they move during the step: east, north, up. Most groups are ruled out by one of them.
    sides: [OnceLock<Box<Side>>; 3],
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
        let near = |d: usize| self.side(q, s, d).near(p[d], self.reach[d]);
        if !axes.into_iter().all(near) {
            return 0.0;
        }
        let sides = [0, 1, 2].map(|d| self.side(q, s, d));
        let runs = Side::runs(q.path, sides, p, self.reach);
        if runs == 0 {
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
            scan::felt(&asked, self.members.len(), runs)
        } else {
            let tree = || Box::new(Tree::new(s, self.members.clone()));
            self.tree.get_or_init(tree).felt(&asked)
        };
        total as f64 / self.quanta
    }

    fn side(&self, q: &Question, s: &Store, d: usize) -> &Side {
        self.sides[d].get_or_init(|| {
            let ways = [&s.start[d], [&s.x, &s.y, &s.z][d]];
            let ways = ways.map(|way| &way[self.members.clone()]);
            Box::new(Side::new(q.path, ways))
        })
    }
}
