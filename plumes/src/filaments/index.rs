//! Finds the filaments that contribute at a point: groups in the order of release, divided into leaves where needed.
//!
//! *Source*: k-d tree, Bentley 1975, Commun. ACM 18, 509, as bounding boxes of leaves.
//!
//! *Parameters*: 1024 filaments in a group, 32 in a leaf; speed in `benches/filaments.rs`.
//!
//! *Deviations*: neighbours in the order of release are neighbours in the water. So a group needs only its bounds and
//! no sorting, and most groups are never near a robot. A group is halved repeatedly, but only where a question falls
//! near a half. The bounds hold for the whole step that the filaments take; only the leaves that are asked for are
//! worked out for the time of the question. Answers do not depend on earlier questions, so a viewer that asks too
//! changes nothing.

use super::bands::{Bands, MOST};
use super::image::Spot;
pub use super::leaf::CUT_SIGMAS;
use super::lookup::Lookup;
use super::part::{Asked, Boxes, Part, extent};
use super::room::Room;
use super::store::Store;
use crate::path::Path;
use nalgebra::Vector3;
use std::sync::OnceLock;

/// Most filaments in a group.
pub(super) const GROUP: usize = 1024;

/// The groups of every band of every store.
#[derive(Clone, Debug, Default)]
pub(super) struct Index {
    stores: Vec<[OnceLock<Groups>; MOST]>,
    /// Set once something was asked at the present time.
    asked: OnceLock<()>,
}

/// The groups of a band.
#[derive(Clone, Debug)]
struct Groups {
    all: Vec<Group>,
    /// The axes, from the one along which the band is longest.
    axes: [usize; 3],
}

/// Neighbours in the order of release.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub(super) from: usize,
    n: usize,
    /// Least and greatest coordinates during the step: east, north, up. Most groups are ruled out by one of them.
    sides: [OnceLock<[f32; 2]>; 3],
    /// Sizes of the oldest member at the end of the step, which are the largest: horizontal, and vertical at any place.
    pub(super) largest: [f32; 2],
    /// Reach of the largest, m.
    reach: f32,
    /// Additional vertical reach over a steep bed, m.
    pub(super) steep: f32,
    boxes: OnceLock<Boxes>,
    whole: OnceLock<Part>,
}

/// What a question is answered from.
pub(super) struct Question<'a> {
    pub(super) stores: &'a [Store],
    pub(super) bands: &'a Bands,
    pub(super) room: &'a Room,
    pub(super) lookup: &'a Lookup,
    pub(super) path: Path,
    pub(super) now_s: f64,
}

impl Index {
    /// Forgets everything.
    pub(super) fn clear(&mut self, stores: usize) {
        self.stores.clear();
        self.stores.resize_with(stores, Default::default);
        self.asked.take();
    }

    /// The bands of a store from `due` on have changed.
    pub(super) fn changed(&mut self, store: usize, due: usize) {
        for groups in &mut self.stores[store][due..] {
            groups.take();
        }
    }

    /// Forgets what holds only for the present time.
    pub(super) fn forget(&mut self) {
        if self.asked.take().is_none() {
            return;
        }
        let groups = self.stores.iter_mut().flatten();
        let groups = groups.filter_map(OnceLock::get_mut);
        for group in groups.flat_map(|g| &mut g.all) {
            if let Some(whole) = group.whole.get_mut() {
                whole.forget();
            }
        }
    }

    /// Concentration at a point, kg/m³; zero above the surface. In a solid it is that of the nearest water.
    pub(super) fn at(&self, q: &Question, p: &Vector3<f64>) -> f64 {
        let p = [p.x as f32, p.y as f32, p.z as f32];
        if p[2] > 0.0 {
            return 0.0;
        }
        let Some(spot) = Spot::new(q.room, q.lookup, p, q.reach()) else {
            return 0.0;
        };
        let p = spot.p;
        self.asked.get_or_init(|| ());
        let mut total = 0.0;
        for (s, bands) in q.stores.iter().zip(&self.stores) {
            for (band, groups) in bands.iter().enumerate().take(q.bands.last() + 1) {
                let groups = groups.get_or_init(|| q.groups(s, band));
                for g in groups.all.iter().filter(|g| g.near(s, p, groups.axes)) {
                    let asked = Asked {
                        p,
                        spot: &spot,
                        q,
                        g,
                        s,
                        band,
                    };
                    let mut felt = 0.0;
                    g.whole.get_or_init(|| g.whole(s)).add(&asked, &mut felt);
                    total += felt;
                }
            }
        }
        total
    }
}

impl Question<'_> {
    /// Longest reach of any filament, m.
    fn reach(&self) -> f64 {
        let oldest = |s: &Store| Some(s.largest(0..s.len(), self.now_s - s.born_s.first()?));
        let largest = self.stores.iter().filter_map(oldest).fold(0.0, f32::max);
        f64::from(CUT_SIGMAS * 1.000_01 * largest)
    }

    /// The groups of a band. `steepest` is the slope of bed and solids: over a steep slope, a filament near a wall is
    /// felt over a larger range of heights. 0 without walls.
    fn groups(&self, s: &Store, band: usize) -> Groups {
        let (range, steepest) = (s.band(band, self.bands), self.room.steepness());
        let end_s = self.bands.span(band).to_s.max(self.now_s);
        let mut all = Vec::with_capacity(range.len().div_ceil(GROUP));
        for from in range.clone().step_by(GROUP) {
            let n = GROUP.min(range.end - from);
            // The first is the oldest, and so the largest.
            let horizontal = s.largest(from..from + n, end_s - s.born_s[from]);
            let reach = CUT_SIGMAS * 1.000_01 * horizontal;
            all.push(Group {
                from,
                n,
                sides: Default::default(),
                largest: [horizontal, s.size.vertical(horizontal, f32::MIN)],
                reach,
                steep: 2.0 * steepest * reach,
                boxes: OnceLock::new(),
                whole: OnceLock::new(),
            });
        }
        let mut axes = [0, 1, 2];
        if !range.is_empty() {
            let long = |d: usize| (s.start[d][range.start] - s.start[d][range.end - 1]).abs();
            axes.sort_by(|a, b| long(*b).total_cmp(&long(*a)));
        }
        Groups { all, axes }
    }
}

impl Group {
    /// Whether a point is within reach of the box in which the members move during the step.
    fn near(&self, s: &Store, p: [f32; 3], axes: [usize; 3]) -> bool {
        axes.into_iter().all(|d| {
            let [lo, hi] = self.side(s, d);
            let (mut lo, mut hi) = (lo - self.reach, hi + self.reach);
            if d == 2 {
                (lo, hi) = (lo - self.steep, hi + self.steep);
            }
            p[d] >= lo && p[d] <= hi
        })
    }

    fn side(&self, s: &Store, d: usize) -> [f32; 2] {
        *self.sides[d].get_or_init(|| {
            let (start, end) = (&s.start[d], [&s.x, &s.y, &s.z][d]);
            let members = self.from..self.from + self.n;
            let (low, high) = extent(&start[members.clone()]);
            let (low_end, high_end) = extent(&end[members]);
            [low.min(low_end), high.max(high_end)]
        })
    }

    /// The ways of its members.
    pub(super) fn boxes(&self, s: &Store) -> &Boxes {
        (self.boxes).get_or_init(|| Boxes::new(s, self.from, self.n))
    }

    fn whole(&self, s: &Store) -> Part {
        let sides = [0, 1, 2].map(|d| self.side(s, d));
        Part::within(sides, (0..self.n as u16).collect())
    }
}
