//! What a plume contains: the number of filaments, the mass of dye, each filament, and a digest of all of it.
//!
//! A filament that is shown in place of others (`decimated`) carries the mass of all of them.

use super::plume::Plume;
use super::store::arrays::Store;
use crate::flow::grid::FlowGrid;
use crate::release::Source;
use world::digest::Digest;

impl Plume {
    /// The time to which the plume was brought last, s.
    pub fn now_s(&self) -> f64 {
        self.now_s
    }

    /// Number of filaments in the domain.
    pub fn len(&self) -> usize {
        self.stores.iter().map(|s| self.count(s)).sum()
    }

    /// Filaments of a store that are released.
    fn count(&self, s: &Store) -> usize {
        s.len() - s.unborn(self.now_s)
    }

    /// Whether there are no filaments.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of filaments ever released.
    pub fn released(&self) -> u64 {
        self.stores.iter().map(|s| self.ever(s)).sum()
    }

    /// Filaments that a store has released up to now.
    fn ever(&self, s: &Store) -> u64 {
        s.released - s.unborn(self.now_s) as u64
    }

    /// Number of filaments that have left the domain.
    pub fn left(&self) -> u64 {
        self.stores.iter().map(|s| s.left).sum()
    }

    /// How often a filament was reflected at a solid.
    pub fn turned_back(&self) -> u64 {
        self.turned_back
    }

    /// Mass in the domain, kg.
    pub fn mass_in_kg(&self) -> f64 {
        self.total(|s| self.count(s) as f64)
    }

    /// Mass ever released, kg.
    pub fn mass_released_kg(&self) -> f64 {
        self.total(|s| self.ever(s) as f64)
    }

    /// Mass that has left the domain, kg.
    pub fn mass_left_kg(&self) -> f64 {
        self.total(|s| s.left as f64)
    }

    fn total(&self, count: impl Fn(&Store) -> f64) -> f64 {
        self.stores.iter().map(|s| count(s) * s.filament_kg).sum()
    }

    /// The sources, as placed.
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The flow that the filaments see.
    pub fn grid(&self) -> &FlowGrid {
        &self.grid
    }

    /// x, y, z (m, ENU), horizontal size (m) and mass (kg) of every filament: by source, oldest first. In blocked
    /// water, cells may leave a part of an obstacle open; a filament in it is shown at the nearest free place.
    pub fn iter(&self) -> impl Iterator<Item = [f64; 5]> + '_ {
        self.stores.iter().flat_map(move |s| (0..self.count(s)).map(move |n| self.filament(s, n)))
    }

    /// Every k-th filament of each source, with the smallest k that leaves at most `max_n` (but at least one of each
    /// source); the same ones for the same state. As [`Self::iter`], but with the mass (kg) of all filaments that it
    /// stands for, so that the masses of a source sum to its mass in the water; and with the number of those filaments.
    pub fn decimated(&self, max_n: usize) -> Vec<[f64; 6]> {
        let shown = |every: usize| -> usize { (self.stores.iter()).map(|s| self.count(s).div_ceil(every)).sum() };
        let longest = self.stores.iter().map(|s| self.count(s)).max().unwrap_or(0);
        let mut every = self.len().div_ceil(max_n.max(1)).max(1);
        while shown(every) > max_n && every < longest {
            every += 1;
        }
        let of = |s: &Store| {
            let count = self.count(s);
            let stands_for = count as f64 / count.div_ceil(every).max(1) as f64;
            let shown = (0..count).step_by(every);
            let rows = shown.map(|n| {
                let [x, y, z, size, mass] = self.filament(s, n);
                [x, y, z, size, mass * stands_for, stands_for]
            });
            rows.collect::<Vec<_>>()
        };
        self.stores.iter().flat_map(of).collect()
    }

    fn filament(&self, s: &Store, n: usize) -> [f64; 5] {
        let size = s.horizontal(n, self.now_s - s.born_s[n]);
        let band = s.band_of(n, &self.bands);
        let place = s.place(n, &self.bands.moment(band, self.now_s));
        let shown = self.room.shown(place.expect("it is released"));
        let p = self.grid.world(shown);
        [p.x, p.y, p.z, size.into(), s.filament_kg]
    }

    /// Takes the whole state into a digest: every filament at the end of the step that it takes.
    pub fn digest_into(&self, digest: &mut Digest) {
        for (s, r) in self.stores.iter().zip(&self.releases) {
            digest.f64s(&[s.released as f64, s.left as f64, r.next_s().unwrap_or(f64::NEG_INFINITY)]);
            for v in [&s.x, &s.y, &s.z] {
                digest.f32s(v);
            }
        }
    }

    /// East, north (from the datum), up of every filament at its mean place.
    #[cfg(test)]
    pub(super) fn all(&self) -> impl Iterator<Item = [f32; 3]> + '_ {
        let of = |s: &Store, n: usize| [s.x[n], s.y[n], s.z[n]];
        self.stores.iter().flat_map(move |s| (0..s.len()).map(move |n| of(s, n)))
    }

    #[cfg(test)]
    pub(super) fn stores_mut(&mut self) -> &mut [Store] {
        self.index.clear(self.stores.len());
        &mut self.stores
    }
}
