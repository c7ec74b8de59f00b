//! Finds the filaments that contribute at a point: groups in the order of release, scanned or divided into packets.
//!
//! *Source*: none.
//!
//! *Parameters*: see `group` and `batch`; speed in `benches/filaments.rs`.
//!
//! *Deviations*: neighbours in the order of release are neighbours in the water. So a group needs only its bounds and
//! no sorting, and most groups are never near a robot. A group that is asked is scanned (`scan`), or made a batch
//! (`batch`) once it is asked often. The bounds hold for the whole step that the filaments take. All ways of searching
//! give the same sum to the last bit (`felt`), so answers do not depend on earlier questions, and a viewer that asks too
//! changes nothing.

use super::contribution::Strongest;
use super::group::Group;
use super::image::QueryPoint;
pub use super::packet::CUT_SIGMAS;
use super::question::Question;
use super::run_bounds::GROUP;
use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::MOST;
use crate::filaments::store::structure::PlaceInFilament;
use std::sync::OnceLock;

/// The groups of every band of every store.
#[derive(Clone, Debug, Default)]
pub(crate) struct Index {
    stores: Vec<[OnceLock<Groups>; MOST]>,
}

/// The groups of a band.
#[derive(Clone, Debug)]
struct Groups {
    all: Vec<Group>,
    /// The axes, from the one along which the band is longest.
    axes: [usize; 3],
}

impl Index {
    /// Forgets everything.
    pub(crate) fn clear(&mut self, stores: usize) {
        self.stores.clear();
        self.stores.resize_with(stores, Default::default);
    }

    /// The bands of a store from `due` on have changed.
    pub(crate) fn changed(&mut self, store: usize, due: usize) {
        for groups in &mut self.stores[store][due..] {
            groups.take();
        }
    }

    /// Forgets what holds only for the present time.
    pub(crate) fn forget(&mut self) {
        let groups = self.stores.iter_mut().flatten().filter_map(OnceLock::get_mut);
        groups.flat_map(|groups| &mut groups.all).for_each(Group::forget);
    }

    /// Concentration at a point from the datum, kg/m³; zero above the surface. In a solid it is that of the nearest
    /// water.
    pub(crate) fn concentration(&self, q: &Question, p: [f32; 3]) -> f64 {
        let Some(spot) = spot(q, p) else {
            return 0.0;
        };
        let mut total = 0.0;
        for (s, bands) in q.stores.iter().zip(&self.stores) {
            near(q, &spot, s, bands, |group, band| total += group.felt(q, &spot, s, band));
        }
        total
    }

    /// The same with the structure of releases that have it, as a probe is given it that averages over a way (m).
    pub(crate) fn sensed(&self, q: &Question, p: [f32; 3], across_m: f64) -> f64 {
        if q.stores.iter().all(|s| s.structure.is_none()) {
            return self.concentration(q, p);
        }
        let Some(spot) = spot(q, p) else {
            return 0.0;
        };
        let of_store = |(s, bands): (&Store, &[OnceLock<Groups>; MOST])| {
            let (mut mean, mut strongest) = (0.0, None);
            near(q, &spot, s, bands, |group, band| mean += group.felt(q, &spot, s, band));
            let (Some(structure), Some(rise), true) = (&s.structure, &s.rise, mean > 0.0) else {
                return mean;
            };
            near(q, &spot, s, bands, |group, band| group.strongest(q, &spot, s, band, &mut strongest));
            strongest.map_or(mean, |Strongest { member, away_m, .. }| {
                let place = PlaceInFilament { number: s.number[member], away_m, sheet: rise.sheet(member) };
                structure.sensed(mean, &place, across_m)
            })
        };
        q.stores.iter().zip(&self.stores).map(of_store).sum()
    }
}

/// A point in the water; `None` above the surface and where no water is near.
fn spot<'a>(q: &Question<'a>, p: [f32; 3]) -> Option<QueryPoint<'a>> {
    if p[2] > 0.0 { None } else { QueryPoint::new(q.room, q.lookup, p, q.reach()) }
}

/// Gives the groups of a store that may be felt at a point, with their bands, in their order.
fn near(
    q: &Question,
    spot: &QueryPoint,
    s: &Store,
    bands: &[OnceLock<Groups>; MOST],
    mut give: impl FnMut(&Group, usize),
) {
    for (band, groups) in bands.iter().enumerate().take(q.bands.last() + 1) {
        let Groups { all, axes } = groups.get_or_init(|| Groups::new(q, s, band));
        for group in all.iter().filter(|group| group.near(q, s, spot.p, *axes)) {
            give(group, band);
        }
    }
}

impl Groups {
    /// Those of a band.
    fn new(q: &Question, s: &Store, band: usize) -> Self {
        let range = s.band(band, q.bands);
        let end_s = q.bands.span(band).to_s.max(q.now_s);
        let mut all = Vec::with_capacity(range.len().div_ceil(GROUP));
        for from in range.clone().step_by(GROUP) {
            let members = from..range.end.min(from + GROUP);
            all.push(Group::new(q, s, members, end_s));
        }
        let mut axes = [0, 1, 2];
        if !range.is_empty() {
            let long = |d: usize| (s.start[d][range.start] - s.start[d][range.end - 1]).abs();
            axes.sort_by(|a, b| long(*b).total_cmp(&long(*a)));
        }
        Self { all, axes }
    }
}
