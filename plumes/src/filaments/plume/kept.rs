//! A plume written to bytes and read back into a fresh one of the same sources, place, water and seed.
//!
//! Only what a drift changes is written. Every structure is taken apart field by field, so that a new field does not
//! compile before somebody has said here whether it is kept.

use super::Plume;
use crate::filaments::store::Store;
use crate::flow::grid::FlowGrid;
use world::bits::{Reader, Unreadable, Writer};
use world::fields::Flow;

impl Plume {
    /// Writes everything that a drift has changed.
    pub fn keep(&self, to: &mut Writer) {
        let Self {
            releases,
            stores,
            grid,
            next_refresh_s,
            carried_s,
            steps,
            now_s,
            carrier,
            turned_back,
            // These follow from what the plume was made of.
            sources: _,
            keys: _,
            refresh_s: _,
            path: _,
            // These follow from the grid, the water and the filaments.
            cells: _,
            room: _,
            index: _,
        } = self;
        to.maybe(*next_refresh_s);
        to.maybe(*carried_s);
        to.word(*steps);
        to.word(*now_s);
        to.word(*turned_back);
        for (releases, store) in releases.iter().zip(stores) {
            releases.keep(to);
            keep(store, to);
        }
        let FlowGrid {
            data,
            k_h,
            t_s,
            origin: _,
            along: _,
            across: _,
            spacing: _,
            dims: _,
            stretch: _,
            levels: _,
            bed: _,
        } = grid;
        to.words(data.as_flattened());
        to.words(k_h);
        to.word(*t_s);
        if let Some(carrier) = carrier {
            to.words(carrier.rates.as_flattened());
        }
    }

    /// Takes over what another plume of the same origin has written. `flow` is the water as it was then.
    ///
    /// # Errors
    /// If the bytes are not those of such a plume. This one is then of no more use.
    pub fn recall(&mut self, flow: &dyn Flow, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        self.next_refresh_s = from.maybe()?;
        self.carried_s = from.maybe()?;
        self.steps = from.word()?;
        self.now_s = from.word()?;
        self.turned_back = from.word()?;
        for (releases, store) in self.releases.iter_mut().zip(&mut self.stores) {
            releases.recall(from)?;
            recall(store, from)?;
        }
        fill(self.grid.data.as_flattened_mut(), from)?;
        fill(&mut self.grid.k_h, from)?;
        self.grid.t_s = from.word()?;
        if let Some(carrier) = &mut self.carrier {
            let [nx, ny, nz] = self.grid.dims;
            // Cells lie between nodes; before the first refresh there are no rates.
            let cells = (nx - 1) * ny * (nz - 1);
            let n = self.next_refresh_s.map_or(0, |_| cells);
            carrier.rates = vec![[0.0; 6]; n];
            fill(carrier.rates.as_flattened_mut(), from)?;
        }
        if self.next_refresh_s.is_some() {
            self.cells.refresh(&self.grid);
        }
        if let (1.., Some(walls)) = (self.steps, flow.walls()) {
            self.room.between(&walls);
        }
        self.index.take();
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
        released,
        left,
        filament_kg: _,
    } = store;
    to.word(*released);
    to.word(*left);
    to.maybe(size.stirred());
    for list in [x, y, z, bed] {
        to.words(list);
    }
    to.words(number);
    to.words(born_s);
}

fn recall(store: &mut Store, from: &mut Reader<'_>) -> Result<(), Unreadable> {
    store.released = from.word()?;
    store.left = from.word()?;
    store.size.stir(from.maybe()?);
    store.x = from.words()?;
    let n = store.x.len();
    store.y = from.exactly(n)?;
    store.z = from.exactly(n)?;
    store.bed = from.exactly(n)?;
    store.number = from.exactly(n)?;
    store.born_s = from.exactly(n)?;
    Ok(())
}

fn fill(list: &mut [f32], from: &mut Reader<'_>) -> Result<(), Unreadable> {
    list.copy_from_slice(&from.exactly(list.len())?);
    Ok(())
}
