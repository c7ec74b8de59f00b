//! The plume in time: which filaments step when, and on which water.
//!
//! *Source*: see `bands` for steps of different length, `kernel` for the step itself.
//!
//! *Parameters*: the longest step (s); `refresh_s`, how often the flow is evaluated on the grid (s).
//!
//! *Deviations*: the flow of a period is that at its start, or at most half a second later, so that the water needs to
//! be known no further ahead. A filament that leaves the grid is removed at the start of the step in which it leaves.

use super::drift::drift_band::{DriftContext, hold};
use super::drift::small_eddies;
use super::plume::Plume;
use super::store::arrays::Store;
use super::store::bands::Bands;
use super::store::folded::folded;
use super::walls::side_walls::{carry, fold, keep_between};
use super::water::fetch::BLOCK;
use super::water::lookup::Lookup;
use crate::flow::grid::LogLaw;
use crate::noise::step_key;
use std::ops::Range;
use std::sync::Arc;
use world::fields::{Flow, SideWalls};

/// Distance over which a filament may step near solids in water that does not flow round them, m.
const REACH_BY_SOLIDS_M: f64 = 2.0;

/// Filaments from which on their step is worth waking other threads.
pub(super) const WORTH_THREADS: usize = 8192;

/// A pool of so many threads; `None` for one, or if they cannot be started.
pub fn threads(n: usize) -> Option<Arc<rayon::ThreadPool>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(n);
    (n > 1).then(|| pool.build().ok().map(Arc::new)).flatten()
}

impl Plume {
    /// Takes its steps with the threads of a pool, or with its caller's thread alone. The result is the same.
    pub fn use_threads(&mut self, pool: Option<Arc<rayon::ThreadPool>>) {
        self.threads = pool;
    }

    /// The threads that it uses.
    pub fn threads(&self) -> Option<Arc<rayon::ThreadPool>> {
        self.threads.clone()
    }

    /// From `start_s` to `end_s` (which may be infinite), filaments take steps of at most `longest_s`, each as long as
    /// its age and the water allow. All filaments must have reached `start_s`. The flow is evaluated anew, so that what
    /// follows depends on the filaments alone.
    ///
    /// # Panics
    /// If the times do not increase, or if the step is not positive: a mistake in the code.
    pub fn pace(&mut self, start_s: f64, end_s: f64, longest_s: f64) {
        assert!(
            end_s > start_s && longest_s > 0.0,
            "a plume steps forward, not from {start_s} s to {end_s} s in steps of {longest_s} s"
        );
        self.bands = Bands::new(start_s, end_s, longest_s, self.refresh_s, false);
        self.next_refresh_s = None;
        self.join(start_s);
    }

    /// The time at which all filaments meet next, at the end of the longest step that starts now or last started, s.
    pub fn next_meeting_s(&self) -> f64 {
        self.bands.next_meeting_s()
    }

    /// Brings the plume to a time within its pace. `flow` must have been advanced to a time between the start of the
    /// longest step and `t_s`. Returns whether a longest step has started meanwhile.
    ///
    /// # Panics
    /// If the pace ends before `t_s`: a mistake in the code; or if the flow returns NaN.
    pub fn advance(&mut self, flow: &dyn Flow, t_s: f64) -> bool {
        let end_s = self.bands.end_s();
        assert!(t_s <= end_s + 1e-9, "the plume's pace ends at {end_s} s, before {t_s} s: set another pace first");
        let mut met = false;
        while self.bands.next_s() < t_s - 1e-9 {
            met |= self.bands.due() == 0;
            self.take_steps(flow);
        }
        self.now_s = t_s;
        self.index.forget();
        met
    }

    /// Whether no filament begins a step before a time, s. Until then [`Self::look_at`] may take any time from the
    /// latest advance on, and back again.
    pub fn rests_until(&self, t_s: f64) -> bool {
        self.bands.next_s() >= t_s - 1e-9
    }

    /// The plume as it is at a time at which it [rests](Self::rests_until): filaments are on their ways to the ends of
    /// their steps. It is what [`Self::advance`] would make it.
    ///
    /// # Panics
    /// If a filament would begin a step before that time: a mistake in the code.
    pub fn look_at(&mut self, t_s: f64) {
        assert!(self.rests_until(t_s), "the plume takes a step before {t_s} s: advance it");
        if self.now_s != t_s {
            self.now_s = t_s;
            self.index.forget();
        }
    }

    /// Moves every filament from `t0_s` to `t1_s` in one step and releases those that are due meanwhile. `flow` must
    /// have been advanced to `t0_s` or `t1_s`.
    ///
    /// # Panics
    /// If time does not increase, or if the flow returns NaN.
    pub fn drift(&mut self, flow: &dyn Flow, t0_s: f64, t1_s: f64) {
        assert!(t1_s > t0_s, "plume drift needs growing time, got {t0_s} s to {t1_s} s: check the drift period");
        self.bands = Bands::single(t0_s, t1_s);
        self.join(t0_s);
        self.take_steps(flow);
        self.now_s = t1_s;
    }

    pub(super) fn join(&mut self, t_s: f64) {
        self.now_s = t_s;
        self.stirred = false;
        for store in &mut self.stores {
            store.join(t_s);
        }
        self.index.clear(self.stores.len());
    }

    /// Takes the steps of all bands that are due.
    fn take_steps(&mut self, flow: &dyn Flow) {
        let due = self.bands.due();
        let moved: usize = self.stores.iter().map(|s| s.len() - s.first[due]).sum();
        match &self.threads.clone() {
            Some(pool) if moved >= WORTH_THREADS => pool.install(|| self.take_steps_by(flow, true)),
            _ => self.take_steps_by(flow, false),
        }
    }

    fn take_steps_by(&mut self, flow: &dyn Flow, threads: bool) {
        let t0_s = self.bands.next_s();
        let due = self.bands.due();
        if due == 0 {
            self.renew(flow, t0_s, threads);
        }
        let walls = flow.walls();
        if let Some(walls) = &walls {
            self.room.between(walls);
        }
        let until_s = t0_s + self.bands.step_s(self.bands.last());
        self.release(flow, t0_s, until_s.min(self.bands.end_s()));
        self.bands.pass();
        for n in 0..self.stores.len() {
            self.index.changed(n, due);
            for band in due..=self.bands.last() {
                self.sweep(flow, n, band, threads);
                self.carry(flow, walls.as_ref(), n, band);
            }
        }
        self.steps += 1;
    }

    /// Moves the filaments of a band of a store.
    fn sweep(&mut self, flow: &dyn Flow, n: usize, band: usize, threads: bool) {
        if self.sampled.complete(flow, &mut self.grid, threads) {
            self.cells.refresh(&self.grid, self.sampled.even_k_h);
        }
        let store = &mut self.stores[n];
        let range = store.band(band, &self.bands);
        if range.is_empty() {
            return;
        }
        let sweep = DriftContext {
            path: self.path,
            cells: &self.cells,
            room: &self.room,
            grid: &self.grid,
            carrier: self.carrier.as_ref(),
            key: step_key(self.keys[n], self.steps),
            span: self.bands.span(band),
        };
        let swept = sweep.over(store, range, threads, &mut self.scratch.0);
        self.turned_back += swept.turned;
        for column in swept.columns {
            self.sampled.note(column);
        }
    }

    /// Reflects at solids the filaments of a store, from the `first` on, that were carried away from earlier places.
    fn keep_out(&mut self, n: usize, before: Option<[Vec<f32>; 3]>, first: usize) {
        if let Some(before) = before {
            let (room, cells, grid) = (&self.room, &self.cells, &self.grid);
            self.turned_back += hold(room, cells, grid, &before, &mut self.stores[n], first);
        }
    }

    /// Lets the filaments of a band of a store rise, if they are buoyant, and moves them with the eddies between walls.
    fn carry(&mut self, flow: &dyn Flow, walls: Option<&SideWalls>, n: usize, band: usize) {
        let store = &mut self.stores[n];
        if walls.is_none() && store.rise.is_none() {
            return;
        }
        let range = store.band(band, &self.bands);
        if let Some(span) = self.bands.carries(band, store.carried_s) {
            store.carried_s = span.to_s;
            let before = self.room.has_solids().then(|| places_of(store, &range));
            store.rise(self.path, range.clone(), span);
            if walls.is_some() {
                carry(flow, self.grid.datum, store, range.clone(), span);
            }
            if let Some(small) = &self.small {
                let p_W = self.sources[n].p_W;
                let source = (p_W, self.grid.local(&p_W));
                small_eddies::carry(self.path, small, flow, source, store, range.clone(), span);
                fold(store, range.clone());
            }
            self.keep_out(n, before, range.start);
        }
        if let Some(walls) = walls {
            keep_between(walls, self.grid.datum, &mut self.stores[n], range);
        }
    }

    /// Releases what is due within the shortest step, and divides the filaments into bands.
    fn release(&mut self, flow: &dyn Flow, t0_s: f64, t1_s: f64) {
        let stir = !(self.stirred && flow.is_steady());
        self.stirred = true;
        for n in 0..self.stores.len() {
            let p_W = self.sources[n].p_W;
            let store = &mut self.stores[n];
            if stir && let Some(size) = self.sources[n].release.eddy_size_m {
                store.size.stirred_by(flow.stirring(&p_W, size.get(), t0_s));
            }
            let (cells, room, sampled) = (&self.cells, &self.room, &mut self.sampled);
            let grid = &self.grid;
            let (start, bed) = released(cells, grid.local(&p_W));
            self.releases[n].until(t0_s, t1_s, |t| {
                let (start, bed) = match flow.displacement(&p_W, t) {
                    None => (start, bed),
                    Some(way) => {
                        let (start, bed) = released(cells, grid.local(&(p_W - way)));
                        (room.in_water(cells, start), bed)
                    }
                };
                sampled.note(cells.column(start[0], start[1]).at);
                store.push(start, bed, t);
            });
            store.divide(&self.bands);
        }
    }

    /// At the start of a longest step: evaluates the flow again if it is due, and chooses the bands by it.
    fn renew(&mut self, flow: &dyn Flow, t0_s: f64, threads: bool) {
        if self.next_refresh_s.is_none_or(|next| t0_s >= next) {
            if self.next_refresh_s.is_none() || !flow.is_steady() {
                self.refresh(flow, t0_s, threads);
            }
            self.next_refresh_s = Some(if self.refresh_s > 0.0 {
                // Slightly early, so that times that are sums of steps do not miss their multiple by rounding.
                ((t0_s / self.refresh_s + 1e-9).floor() + 1.0) * self.refresh_s - 1e-6
            } else {
                t0_s
            });
        }
        let narrow_m = self.grid.spacing[0].min(self.grid.spacing[1]);
        let mut reach_m = f64::from(narrow_m);
        if self.room.has_solids() && self.carrier.is_none() {
            reach_m = reach_m.min(REACH_BY_SOLIDS_M);
        }
        let scales = self.sampled.scales(reach_m);
        for store in &mut self.stores {
            store.scaled(&self.bands, &scales);
        }
    }

    /// Evaluates the flow where filaments are: for the middle of the step, and at most half a second ahead.
    fn refresh(&mut self, flow: &dyn Flow, t0_s: f64, threads: bool) {
        let ahead_s = (0.5 * self.bands.step_s(0)).min(0.5);
        self.grid.law = flow.log_layer().map(LogLaw::new);
        let all = self.carrier.is_some() || flow.walls().is_some();
        self.sampled.renew(&mut self.grid, t0_s + ahead_s, all);
        for store in &self.stores {
            let mut columns = [0; BLOCK];
            for (x, y) in store.x.chunks(BLOCK).zip(store.y.chunks(BLOCK)) {
                self.path.run(
                    #[inline(always)]
                    || {
                        for ((column, x), y) in columns.iter_mut().zip(x).zip(y) {
                            *column = self.cells.column(*x, *y).at;
                        }
                    },
                );
                for column in &columns[..x.len()] {
                    self.sampled.note(*column);
                }
            }
        }
        for source in &self.sources {
            let [x, y, _] = self.grid.local(&source.p_W);
            self.sampled.note(self.cells.column(x, y).at);
        }
        for (store, source) in self.stores.iter_mut().zip(&self.sources) {
            if let Some(rise) = &mut store.rise {
                let (_, bed) = released(&self.cells, self.grid.local(&source.p_W));
                rise.renew(flow, source.p_W, f64::from(bed), self.grid.t_s);
            }
        }
        self.sampled.complete(flow, &mut self.grid, threads);
        self.cells.refresh(&self.grid, self.sampled.even_k_h);
        if let Some(carrier) = &mut self.carrier {
            carrier.refresh(flow, self.grid.t_s);
            // The cells hold the velocity that carries filaments; the grid keeps the diffusivity.
            for v in &mut self.grid.data {
                *v = [0.0, 0.0, 0.0, v[3]];
            }
        }
    }
}

/// East, north, up of a range of filaments.
fn places_of(store: &Store, range: &Range<usize>) -> [Vec<f32>; 3] {
    [&store.x, &store.y, &store.z].map(|v| v[range.clone()].to_vec())
}

/// Where a source at a point from the datum releases filaments, and the height of the bed there, m.
fn released(cells: &Lookup, [x, y, z]: [f32; 3]) -> ([f32; 3], f32) {
    let bed = cells.bed(x, y);
    ([x, y, folded(z, bed, -1.0 / bed)], bed)
}
