//! Neighbours in the order of release: the box in which they move, and the ways to search them.
//!
//! *Source*: see `index`.
//!
//! *Parameters*: 1024 filaments in a group; a batch from the 33rd question about one time.
//!
//! *Deviations*: none.

use super::batch::Batch;
use super::contribution::{GroupQuery, Strongest, quanta, reach};
use super::image::QueryPoint;
use super::order::order;
use super::question::Question;
use super::run_bounds::RunBounds;
use super::scan;
use crate::filaments::store::arrays::Store;
use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// To make a batch takes as long as so many questions without one. It holds for one time only.
const SCANS: u32 = 32;

/// Up to [`GROUP`](super::run_bounds::GROUP) neighbours in the order of release.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    members: Range<usize>,
    /// Farthest along each axis from which a member is felt during the step, m.
    reach: [f32; 3],
    quanta: f64,
    per_quantum: f64,
    /// Between which coordinates they move during the step: east, north, up. Most groups are ruled out by one of them.
    sides: [OnceLock<Box<RunBounds>>; 3],
    asked: Count,
    /// Holds for the step.
    order: OnceLock<Vec<u16>>,
    batch: OnceLock<Box<Batch>>,
}

/// How often something was asked about the present time.
#[derive(Debug, Default)]
struct Count(AtomicU32);

impl Clone for Count {
    fn clone(&self) -> Self {
        Self(AtomicU32::new(self.0.load(Ordering::Relaxed)))
    }
}

impl Count {
    /// One more; returns whether that is often. If several threads ask at once, some of them may not be counted.
    fn often(&self) -> bool {
        let before = self.0.load(Ordering::Relaxed);
        self.0.store(before.saturating_add(1), Ordering::Relaxed);
        before >= SCANS
    }

    fn forget(&mut self) {
        *self.0.get_mut() = 0;
    }
}

impl Group {
    /// These members of a store, until a time.
    pub(crate) fn new(q: &Question, s: &Store, members: Range<usize>, end_s: f64) -> Self {
        // The first is the oldest, and so the largest.
        let horizontal = s.largest(members.clone(), end_s - s.born_s[members.start]);
        let largest = [horizontal, s.size.vertical(horizontal, f32::MIN)];
        let smallest = s.size.horizontal(0.0);
        let smallest = [smallest, s.size.vertical(smallest, f32::MIN)];
        let quanta = quanta(s.filament_kg, smallest, largest);
        Self {
            members,
            reach: reach(q, largest),
            quanta,
            per_quantum: 1.0 / quanta,
            sides: Default::default(),
            asked: Count::default(),
            order: OnceLock::new(),
            batch: OnceLock::new(),
        }
    }

    /// Forgets what holds only for the present time.
    pub(crate) fn forget(&mut self) {
        self.asked.forget();
        self.batch.take();
    }

    /// Whether one of its members may be felt at a point during the step. `axes` begins with the one along which the
    /// band is longest.
    pub(crate) fn near(&self, q: &Question, s: &Store, p: [f32; 3], axes: [usize; 3]) -> bool {
        let near = |d: usize| self.side(q, s, d).near(p[d], self.reach[d]);
        axes.into_iter().all(near)
    }

    /// What its members contribute at a point [near](Self::near) them, kg/m³.
    #[inline]
    pub(crate) fn felt(&self, q: &Question, spot: &QueryPoint, s: &Store, band: usize) -> f64 {
        let asked = || self.asked_by(q, spot, s, band);
        let total = match self.batch.get() {
            Some(batch) => batch.contribution(q.path, spot.p, asked),
            None => self.first_felt(&asked()),
        };
        // The number of quanta is a power of two.
        total as f64 * self.per_quantum
    }

    /// Which of its members contributes most at a point near them, if it is more than the strongest so far.
    pub(crate) fn strongest(
        &self,
        q: &Question,
        spot: &QueryPoint,
        s: &Store,
        band: usize,
        so_far: &mut Option<Strongest>,
    ) {
        let sides = [0, 1, 2].map(|d| self.side(q, s, d));
        let runs = RunBounds::runs(q.path, sides, spot.p, self.reach);
        scan::strongest(&self.asked_by(q, spot, s, band), self.members.len(), runs, so_far);
    }

    fn asked_by<'a>(&self, q: &'a Question, spot: &'a QueryPoint, s: &'a Store, band: usize) -> GroupQuery<'a> {
        GroupQuery {
            p: spot.p,
            spot,
            q,
            s,
            moment: q.bands.moment(band, q.now_s),
            from: self.members.start,
            reach: self.reach,
            quanta: self.quanta,
        }
    }

    /// The same in quanta as long as there is no batch.
    #[inline(never)]
    fn first_felt(&self, asked: &GroupQuery) -> i64 {
        let GroupQuery { q, s, p, .. } = *asked;
        let sides = [0, 1, 2].map(|d| self.side(q, s, d));
        let runs = RunBounds::runs(q.path, sides, p, self.reach);
        if runs == 0 {
            0
        } else if self.asked.often() {
            let batch = self.batch.get_or_init(|| self.batch(asked));
            batch.contribution(q.path, p, || *asked)
        } else {
            scan::felt(asked, self.members.len(), runs)
        }
    }

    /// Its members at the present time.
    fn batch(&self, asked: &GroupQuery) -> Box<Batch> {
        let order = self.order.get_or_init(|| {
            // Those that are released within the step stay last.
            let born_s = &asked.s.born_s[self.members.clone()];
            let on_time = born_s.partition_point(|b| *b <= asked.moment.span.from_s);
            let range = self.members.start..self.members.start + on_time;
            let ends = [&asked.s.x, &asked.s.y, &asked.s.z].map(|end| &end[range.clone()]);
            let mut order = order(ends, self.reach);
            order.extend(on_time as u16..self.members.len() as u16);
            order
        });
        Box::new(Batch::new(asked, order))
    }

    fn side(&self, q: &Question, s: &Store, d: usize) -> &RunBounds {
        self.sides[d].get_or_init(|| {
            let ways = [&s.start[d], [&s.x, &s.y, &s.z][d]];
            let ways = ways.map(|way| &way[self.members.clone()]);
            Box::new(RunBounds::new(q.path, ways))
        })
    }
}
