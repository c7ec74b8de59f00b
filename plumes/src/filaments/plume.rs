//! The plume: all filaments of all sources, moved by the water, asked for concentration.
//!
//! *Source*: Farrell, Murlis, Long, Li & Cardé 2002, Environ. Fluid Mech. 2, 143 (a plume as filaments that
//! are carried, spread and grow); the parts are in the files beside this one.
//!
//! *Parameters*: [`PlumeSettings`]: the flow grid's shape and `refresh_s`, how often the flow is summed on it (s).
//!
//! *Deviations*: the paper's v_m, white noise of given standard deviation added every step, becomes kicks √(2K dt),
//! whose spread does not depend on the step. Under waves filaments are at their mean places, and a source that stands still releases
//! at p − ξ(p, t), ξ the waves' displacement (file `displaced`).

use super::cells::Cells;
use super::index::Index;
use super::kernel::{self, BLOCK, Block, Path, Work};
use super::noise::step_key;
use super::size::Size;
use super::solids::Solids;
use super::store::Store;
use super::walls::{CARRY_S, carry, keep_between};
use crate::error::PlumeError;
use crate::flow::grid::{FlowGrid, GridShape};
use crate::release::{ReleaseTimes, Source, SourceSpec, clear, place};
use bevy_ecs::prelude::Resource;
use nalgebra::Vector3;
use std::sync::OnceLock;
use world::area::Area;
use world::fields::{Concentration, Flow};
use world::obstacles::Obstacles;
use world::record::Digest;
use world::seeds;
use world::terrain::Terrain;

/// How finely the plume sees the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlumeSettings {
    /// The grid on which the flow is summed; filaments leave the domain where it ends.
    pub grid: GridShape,
    /// The flow is summed again at multiples of this time, s; 0: at every drift.
    pub refresh_s: f64,
}

impl Default for PlumeSettings {
    fn default() -> Self {
        Self {
            grid: GridShape::default(),
            refresh_s: 5.0,
        }
    }
}

/// All filaments, now.
#[derive(Resource, Clone, Debug)]
pub struct Plume {
    sources: Vec<Source>,
    releases: Vec<ReleaseTimes>,
    keys: Vec<u64>,
    stores: Vec<Store>,
    grid: FlowGrid,
    cells: Cells,
    refresh_s: f64,
    next_refresh_s: Option<f64>,
    carried_s: Option<f64>,
    steps: u64,
    now_s: f64,
    path: Path,
    solids: Solids,
    brought_out: u64,
    index: OnceLock<Index>,
}

impl Plume {
    /// Clean water with the sources in place; they open at the first [`Plume::drift`].
    ///
    /// # Errors
    /// If a source cannot be where it is said to be; see [`place`].
    pub fn new(
        specs: &[SourceSpec],
        area: &Area,
        terrain: &Terrain,
        seed: u64,
        settings: PlumeSettings,
    ) -> Result<Self, PlumeError> {
        let sources = place(specs, area, terrain)?;
        let grid = FlowGrid::new(area, terrain, settings.grid);
        Ok(Self {
            releases: sources
                .iter()
                .map(|s| ReleaseTimes::new(s.release.rate_hz.get(), s.release.poisson, seed, &s.id))
                .collect(),
            keys: sources
                .iter()
                .map(|s| seeds::key(seed, &s.id, "drift"))
                .collect(),
            stores: sources
                .iter()
                .map(|s| Store::new(Size::new(&s.release), s.filament_kg))
                .collect(),
            sources,
            cells: Cells::new(&grid),
            grid,
            refresh_s: settings.refresh_s,
            next_refresh_s: None,
            carried_s: None,
            steps: 0,
            now_s: 0.0,
            path: Path::detect(),
            solids: Solids::default(),
            brought_out: 0,
            index: OnceLock::new(),
        })
    }

    /// The same with solids in the water.
    ///
    /// # Errors
    /// If a source stands inside one.
    pub fn with_obstacles(mut self, obstacles: Obstacles) -> Result<Self, PlumeError> {
        clear(&self.sources, &obstacles)?;
        self.solids = Solids::new(obstacles);
        Ok(self)
    }

    /// Moves every filament from `t0_s` to `t1_s` and releases those due on the way; `flow` must have been
    /// advanced to `t0_s` or `t1_s`.
    ///
    /// # Panics
    /// If time does not grow, or the flow gives what is not a number.
    pub fn drift(&mut self, flow: &dyn Flow, t0_s: f64, t1_s: f64) {
        assert!(
            t1_s > t0_s,
            "plume drift needs growing time, got {t0_s} s to {t1_s} s: check the drift period"
        );
        self.index.take();
        self.refresh(flow, t0_s, t1_s);
        self.now_s = t1_s;
        let walls = flow.walls();
        let carried_s = *self.carried_s.get_or_insert(t0_s);
        // A hair early, as for the refresh.
        let carries = t1_s - carried_s >= CARRY_S - 1e-6;
        for n in 0..self.stores.len() {
            let key = step_key(self.keys[n], self.steps);
            let k = self.sources[n]
                .release
                .eddy_size_m
                .map(|_| flow.mixing(&self.sources[n].p_W, t0_s));
            let store = &mut self.stores[n];
            if let Some(k) = k {
                store.size.stirred_by(k.k_h_m2_s);
            }
            let old = store.len();
            let p = self.sources[n].p_W.map(|v| v as f32);
            let column = self.cells.column(p.x, p.y);
            let bed = self.cells.bed(column);
            let start = [p.x, p.y, kernel::folded(p.z, bed, -1.0 / bed)];
            let (cells, p_W) = (&self.cells, &self.sources[n].p_W);
            self.releases[n].until(t0_s, t1_s, |t| match flow.displacement(p_W, t) {
                None => store.push(start, bed, t),
                Some(way) => {
                    let p = (p_W - way).map(|v| v as f32);
                    let bed = cells.bed(cells.column(p.x, p.y));
                    store.push([p.x, p.y, kernel::folded(p.z, bed, -1.0 / bed)], bed, t);
                }
            });
            let mut work = Work::new();
            sweep(store, old, t0_s, t1_s, |block| {
                kernel::step(
                    self.path,
                    &self.cells,
                    &self.grid.data,
                    key,
                    block,
                    &mut work,
                );
            });
            if let Some(walls) = &walls {
                if carries {
                    carry(flow, store, carried_s, t1_s);
                }
                keep_between(walls, store);
            }
            self.brought_out += self.solids.keep_out(store);
        }
        if carries {
            self.carried_s = Some(t1_s);
        }
        self.steps += 1;
    }

    /// Sums the flow on the grid when it is due: for the middle of the step, and never more than half a second ahead.
    fn refresh(&mut self, flow: &dyn Flow, t0_s: f64, t1_s: f64) {
        if self.next_refresh_s.is_some_and(|next| t0_s < next) {
            return;
        }
        self.grid
            .refresh(flow, t0_s + (0.5 * (t1_s - t0_s)).min(0.5));
        for (n, v) in self.grid.data.iter().enumerate() {
            assert!(
                v.iter().all(|v| v.is_finite()) && v[3] >= 0.0,
                "the flow at {t0_s} s gives velocity and vertical diffusivity {v:?} at grid node {n}: they must be numbers, the diffusivity >= 0"
            );
        }
        self.cells.refresh(&self.grid);
        self.next_refresh_s = Some(if self.refresh_s > 0.0 {
            // A hair early, so that times that are sums of steps do not miss their multiple by rounding.
            ((t0_s / self.refresh_s + 1e-9).floor() + 1.0) * self.refresh_s - 1e-6
        } else {
            t0_s
        });
    }

    /// Time of the latest drift's end, s.
    #[must_use]
    pub fn now_s(&self) -> f64 {
        self.now_s
    }

    /// Filaments in the domain.
    #[must_use]
    pub fn len(&self) -> usize {
        self.stores.iter().map(Store::len).sum()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Filaments ever released.
    #[must_use]
    pub fn released(&self) -> u64 {
        self.stores.iter().map(|s| s.released).sum()
    }

    /// Filaments that have left the domain.
    #[must_use]
    pub fn left(&self) -> u64 {
        self.stores.iter().map(|s| s.left).sum()
    }

    /// How often a filament that ended a step in a solid was brought out.
    #[must_use]
    pub fn brought_out(&self) -> u64 {
        self.brought_out
    }

    /// Mass in the domain, kg.
    #[must_use]
    pub fn mass_in_kg(&self) -> f64 {
        self.total(|s| s.len() as f64)
    }

    /// Mass ever released, kg.
    #[must_use]
    pub fn mass_released_kg(&self) -> f64 {
        self.total(|s| s.released as f64)
    }

    /// Mass that has left the domain, kg.
    #[must_use]
    pub fn mass_left_kg(&self) -> f64 {
        self.total(|s| s.left as f64)
    }

    fn total(&self, count: impl Fn(&Store) -> f64) -> f64 {
        self.stores.iter().map(|s| count(s) * s.filament_kg).sum()
    }

    /// The sources, as placed.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The flow as the filaments see it.
    #[must_use]
    pub fn grid(&self) -> &FlowGrid {
        &self.grid
    }

    /// x, y, z (m, ENU), horizontal size (m) and mass (kg) of every filament: by source, oldest first.
    pub fn iter(&self) -> impl Iterator<Item = [f32; 5]> + '_ {
        self.stores
            .iter()
            .flat_map(move |s| (0..s.len()).map(move |n| self.filament(s, n)))
    }

    /// Every k-th filament, k the least that leaves at most `max_n`; the same ones for the same state.
    #[must_use]
    pub fn decimated(&self, max_n: usize) -> Vec<[f32; 5]> {
        let every = self.len().div_ceil(max_n.max(1)).max(1);
        self.iter().step_by(every).take(max_n).collect()
    }

    fn filament(&self, s: &Store, n: usize) -> [f32; 5] {
        let size = s.size.horizontal(self.now_s - s.born_s[n]);
        [s.x[n], s.y[n], s.z[n], size, s.filament_kg as f32]
    }

    /// Takes the whole state into a digest.
    pub fn digest_into(&self, digest: &mut Digest) {
        for (s, r) in self.stores.iter().zip(&self.releases) {
            digest.f64s(&[
                s.released as f64,
                s.left as f64,
                r.next_s().unwrap_or(f64::NEG_INFINITY),
            ]);
            for v in [&s.x, &s.y, &s.z] {
                digest.f32s(v);
            }
        }
    }

    #[cfg(test)]
    pub(super) fn stores_mut(&mut self) -> &mut [Store] {
        self.index.take();
        &mut self.stores
    }
}

impl Concentration for Plume {
    fn at(&self, p: &Vector3<f64>) -> f64 {
        self.index
            .get_or_init(|| Index::new(&self.stores, self.now_s))
            .at(&self.stores, self.path, p)
    }
}

/// Sends the store through `step` block by block; `old` of its filaments move for the whole step, the newer ones from their
/// release on. Those that leave are taken out on the way.
fn sweep(store: &mut Store, old: usize, t0_s: f64, t1_s: f64, mut step: impl FnMut(&mut Block)) {
    let mut b = Block {
        x: [0.0; BLOCK],
        y: [0.0; BLOCK],
        z: [0.0; BLOCK],
        bed: [-1.0; BLOCK],
        dt: [(t1_s - t0_s) as f32; BLOCK],
        number: [0; BLOCK],
        kicked: [1.0; BLOCK],
        outside: [0; BLOCK],
    };
    let (total, mut to) = (store.len(), 0);
    for from in (0..total).step_by(BLOCK) {
        let n = BLOCK.min(total - from);
        b.x[..n].copy_from_slice(&store.x[from..from + n]);
        b.y[..n].copy_from_slice(&store.y[from..from + n]);
        b.z[..n].copy_from_slice(&store.z[from..from + n]);
        b.bed[..n].copy_from_slice(&store.bed[from..from + n]);
        b.number[..n].copy_from_slice(&store.number[from..from + n]);
        for l in old.saturating_sub(from).min(n)..n {
            b.dt[l] = (t1_s - store.born_s[from + l]) as f32;
        }
        if store.size.shares() {
            for l in 0..n {
                let middle = t1_s - 0.5 * f64::from(b.dt[l]);
                b.kicked[l] = store.size.kicked(middle - store.born_s[from + l]);
            }
        }
        step(&mut b);
        if b.outside[..n].iter().any(|o| *o != 0) {
            for l in (0..n).filter(|l| b.outside[*l] == 0) {
                put(store, &b, l, to, 1);
                store.shift_labels(from + l, to, 1);
                to += 1;
            }
        } else {
            put(store, &b, 0, to, n);
            if to != from {
                store.shift_labels(from, to, n);
            }
            to += n;
        }
    }
    store.truncate(to);
}

fn put(store: &mut Store, b: &Block, l: usize, to: usize, n: usize) {
    store.x[to..to + n].copy_from_slice(&b.x[l..l + n]);
    store.y[to..to + n].copy_from_slice(&b.y[l..l + n]);
    store.z[to..to + n].copy_from_slice(&b.z[l..l + n]);
    store.bed[to..to + n].copy_from_slice(&b.bed[l..l + n]);
}
