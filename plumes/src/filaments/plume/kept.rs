//! A plume whose steps have all ended, written to bytes and read back into a fresh one of the same sources, place,
//! water and seed.
//!
//! The flow is evaluated anew at the next [pace](Plume::pace), so only the filaments are written. Every structure is
//! taken apart field by field, so that a new field does not compile before somebody has said here whether it is kept.

use super::Plume;
use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::Bands;
use crate::filaments::store::rise::Element;
use world::bits::{Reader, Unreadable, Writer};
use world::fields::Flow;

impl Plume {
    /// Writes the filaments, as they are at the end of a pace, with all that decides how they go on at the next pace.
    ///
    /// # Panics
    /// If a step has not ended: a mistake in the code.
    pub fn keep(&self, to: &mut Writer) {
        let Self {
            releases,
            stores,
            steps,
            now_s,
            turned_back,
            bands,
            // These follow from what the plume was made of.
            sources: _,
            keys: _,
            refresh_s: _,
            small: _,
            path: _,
            threads: _,
            // The next pace makes these again, from the water and the filaments.
            grid: _,
            sampled: _,
            next_refresh_s: _,
            stirred: _,
            carrier: _,
            cells: _,
            room: _,
            index: _,
            // Nothing stays in it from step to step.
            scratch: _,
        } = self;
        assert!(
            (0..=bands.last()).all(|band| bands.span(band).to_s <= *now_s),
            "a plume is kept at the end of its steps, not at {now_s} s within one"
        );
        to.word(*steps);
        to.word(*now_s);
        to.word(*turned_back);
        for (releases, store) in releases.iter().zip(stores) {
            releases.keep(to);
            keep(store, to);
        }
    }

    /// Takes over what another plume of the same origin has written. It answers as that one does, and goes on as that
    /// one would after [`Self::pace`]. `flow` is the water as it was then.
    ///
    /// # Errors
    /// If the bytes are not those of such a plume. This one is then of no more use.
    pub fn recall(&mut self, flow: &dyn Flow, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        self.steps = from.word()?;
        let now_s = from.word()?;
        self.turned_back = from.word()?;
        for (releases, store) in self.releases.iter_mut().zip(&mut self.stores) {
            releases.recall(from)?;
            recall(store, from)?;
        }
        if let (1.., Some(walls)) = (self.steps, flow.walls()) {
            self.room.between(&walls);
        }
        self.bands = Bands::single(now_s, now_s);
        self.next_refresh_s = None;
        self.join(now_s);
        Ok(())
    }
}

fn keep(store: &Store, to: &mut Writer) {
    let Store {
        x,
        y,
        z,
        bed,
        number,
        born_s,
        size,
        rise,
        labels,
        released,
        left,
        filament_kg: _,
        structure: _,
        // The next steps start where the last ones have ended, in bands that the next pace chooses.
        start: _,
        first: _,
        carried_s: _,
        least_age_s: _,
    } = store;
    to.word(*released);
    to.word(*left);
    to.maybe(size.stirred());
    for list in [x, y, z, bed] {
        to.write_list(list);
    }
    to.write_list(number);
    to.write_list(born_s);
    if let Some(rise) = rise {
        to.write_list(&rise.elements.iter().flat_map(Element::numbers).collect::<Vec<f64>>());
        to.write_list(&rise.grown_m2);
    }
    if let Some(labels) = labels {
        labels.keep(to);
    }
}

fn recall(store: &mut Store, from: &mut Reader<'_>) -> Result<(), Unreadable> {
    store.released = from.word()?;
    store.left = from.word()?;
    store.size.stir(from.maybe()?);
    store.x = from.read_list()?;
    let n = store.x.len();
    store.y = from.exactly(n)?;
    store.z = from.exactly(n)?;
    store.bed = from.exactly(n)?;
    store.number = from.exactly(n)?;
    store.born_s = from.exactly(n)?;
    if let Some(rise) = &mut store.rise {
        let numbers: Vec<f64> = from.exactly(Element::NUMBERS * n)?;
        let (numbers, _) = numbers.as_chunks();
        rise.elements = numbers.iter().copied().map(Element::from_numbers).collect::<Vec<_>>().into();
        rise.grown_m2 = from.exactly(n)?.into();
    }
    if let Some(labels) = &mut store.labels {
        labels.recall(n, from)?;
    }
    Ok(())
}
