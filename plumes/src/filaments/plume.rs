//! The plume: all filaments of all sources. The water moves them, and sensors ask for their concentration.
//!
//! *Source*: Farrell, Murlis, Long, Li & Cardé 2002, Environ. Fluid Mech. 2, 143 (a plume as filaments that are
//! carried, spread and grow). The parts are in the other files of this folder.
//!
//! *Parameters*: [`PlumeSettings`]: the shape of the flow grid and `refresh_s`, how often the flow is evaluated on it
//! (s).
//!
//! *Deviations*: the paper's v_m is white noise of given standard deviation, added in every step. Here it becomes kicks
//! √(2K dt), whose spread does not depend on the step. Under waves, filaments are stored at their mean places, and a
//! fixed source releases at p − ξ(p, t), with ξ the displacement by the waves (file `displaced`).

mod kept;

use super::carried::{Carrier, Way};
use super::cut_off;
use super::index::Index;
use super::kernel::{self, Path, Work};
use super::lookup::Lookup;
use super::noise::step_key;
use super::room::Room;
use super::size::Size;
use super::solids::Solids;
use super::store::Store;
use super::sweep::{hold, keep_out, sweep};
use super::walls::{CARRY_S, carry, keep_between};
use crate::error::PlumeError;
use crate::flow::Blocked;
use crate::flow::grid::{FlowGrid, GridShape};
use crate::release::{ReleaseTimes, Source, SourceSpec, clear, place};
use bevy_ecs::prelude::Resource;
use nalgebra::Vector3;
use std::sync::OnceLock;
use world::area::Area;
use world::fields::{Concentration, Flow};
use world::obstacles::Obstacles;
use world::seeds::{self, Seed};
use world::terrain::Terrain;

/// How finely the plume resolves the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlumeSettings {
    /// The grid on which the flow is evaluated; filaments that leave it are removed.
    pub grid: GridShape,
    /// The flow is evaluated again at multiples of this time, s; 0 means at every drift.
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

/// All filaments at the present time.
#[derive(Resource, Clone, Debug)]
pub struct Plume {
    pub(super) sources: Vec<Source>,
    pub(super) releases: Vec<ReleaseTimes>,
    keys: Vec<u64>,
    pub(super) stores: Vec<Store>,
    pub(super) grid: FlowGrid,
    cells: Lookup,
    refresh_s: f64,
    next_refresh_s: Option<f64>,
    carried_s: Option<f64>,
    steps: u64,
    pub(super) now_s: f64,
    path: Path,
    pub(super) room: Room,
    carrier: Option<Carrier>,
    pub(super) turned_back: u64,
    pub(super) index: OnceLock<Index>,
}

impl Plume {
    /// Clean water with the sources in place. They open at the first [`Plume::drift`].
    ///
    /// # Errors
    /// If a source cannot be at its place; see [`place`].
    pub fn new(
        specs: &[SourceSpec],
        area: &Area,
        terrain: &Terrain,
        seed: impl Into<Seed>,
        settings: PlumeSettings,
    ) -> Result<Self, PlumeError> {
        let seed = seed.into();
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
            cells: Lookup::new(&grid),
            room: Room::new(&grid),
            carrier: None,
            grid,
            refresh_s: settings.refresh_s,
            next_refresh_s: None,
            carried_s: None,
            steps: 0,
            now_s: 0.0,
            path: Path::detect(),
            turned_back: 0,
            index: OnceLock::new(),
        })
    }

    /// Adds solids to the water.
    ///
    /// # Errors
    /// If a source stands inside a solid.
    pub fn with_obstacles(mut self, obstacles: Obstacles) -> Result<Self, PlumeError> {
        clear(&self.sources, &obstacles)?;
        self.room.solids = Solids::new(obstacles);
        Ok(self)
    }

    /// Adds water that flows round the solids, if there is any. Filaments then follow the fluxes through the faces of
    /// the water's cells, and closed cells are the solids. The plume's grid must be
    /// [`crate::flow::BlockageSpec::grid_shape`].
    ///
    /// # Errors
    /// If a source stands in a closed cell, or if a thin wall separates it from its cell's centre.
    ///
    /// # Panics
    /// If the plume has another grid: a mistake in the code.
    pub fn led_round(mut self, blocked: Option<&Blocked>) -> Result<Self, PlumeError> {
        let Some(blocked) = blocked else {
            return Ok(self);
        };
        let cells = blocked.cells();
        assert!(
            (0..3).all(|d| self.grid.dims[d] == cells.n[d] + 1),
            "the plume's grid of {:?} nodes must have the {:?} cells of the blocked water between them: take BlockageSpec::grid_shape",
            self.grid.dims,
            cells.n
        );
        self.room.lead_round(cells.clone());
        self.carrier = Some(Carrier::new(blocked));
        for (n, source) in self.sources.iter().enumerate() {
            if let Some(problem) = cut_off::problem(&self.room, &self.cells, n, source) {
                return Err(problem);
            }
        }
        Ok(self)
    }

    /// Moves every filament from `t0_s` to `t1_s` and releases those that are due meanwhile. `flow` must have been
    /// advanced to `t0_s` or `t1_s`.
    ///
    /// # Panics
    /// If time does not increase, or if the flow returns NaN.
    pub fn drift(&mut self, flow: &dyn Flow, t0_s: f64, t1_s: f64) {
        assert!(
            t1_s > t0_s,
            "plume drift needs growing time, got {t0_s} s to {t1_s} s: check the drift period"
        );
        self.index.take();
        self.refresh(flow, t0_s, t1_s);
        self.now_s = t1_s;
        let walls = flow.walls();
        if let Some(walls) = &walls {
            self.room.between(walls);
        }
        let carried_s = *self.carried_s.get_or_insert(t0_s);
        // Slightly early, as for the refresh.
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
            let (cells, room, p_W) = (&self.cells, &self.room, &self.sources[n].p_W);
            self.releases[n].until(t0_s, t1_s, |t| match flow.displacement(p_W, t) {
                None => store.push(start, bed, t),
                Some(way) => {
                    let p = (p_W - way).map(|v| v as f32);
                    let bed = cells.bed(cells.column(p.x, p.y));
                    let p = [p.x, p.y, kernel::folded(p.z, bed, -1.0 / bed)];
                    store.push(room.in_water(cells, p), bed, t);
                }
            });
            let (mut work, mut way) = (Work::new(), self.carrier.as_ref().map(|_| Way::new()));
            let mut turned = 0;
            sweep(store, old, t0_s, t1_s, |block| {
                if let (Some(carrier), Some(way)) = (&self.carrier, &mut way) {
                    carrier.carry(self.path, cells, &self.grid, block, way);
                }
                let from = room.has_solids().then_some([block.x, block.y, block.z]);
                kernel::step(self.path, cells, &self.grid.data, key, block, &mut work);
                if let Some(way) = &way {
                    for (outside, gone) in block.outside.iter_mut().zip(&way.gone) {
                        *outside |= gone;
                    }
                }
                if let Some(from) = from {
                    turned += keep_out(room, cells, &self.grid, &from, block, &work);
                }
            });
            self.turned_back += turned;
            if let Some(walls) = &walls {
                if carries {
                    let before = room
                        .has_solids()
                        .then(|| [store.x.clone(), store.y.clone(), store.z.clone()]);
                    carry(flow, store, carried_s, t1_s);
                    if let Some(before) = before {
                        self.turned_back += hold(room, cells, &self.grid, &before, store);
                    }
                }
                keep_between(walls, store);
            }
        }
        if carries {
            self.carried_s = Some(t1_s);
        }
        self.steps += 1;
    }

    /// Evaluates the flow on the grid when it is due: for the middle of the step, and at most half a second ahead.
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
        if let Some(carrier) = &mut self.carrier {
            carrier.refresh(flow, self.grid.t_s);
            // The cells hold the velocity that carries filaments; the grid keeps the diffusivity.
            for v in &mut self.grid.data {
                *v = [0.0, 0.0, 0.0, v[3]];
            }
        }
        self.cells.refresh(&self.grid);
        self.next_refresh_s = Some(if self.refresh_s > 0.0 {
            // Slightly early, so that times that are sums of steps do not miss their multiple by rounding.
            ((t0_s / self.refresh_s + 1e-9).floor() + 1.0) * self.refresh_s - 1e-6
        } else {
            t0_s
        });
    }
}

impl Concentration for Plume {
    fn at(&self, p: &Vector3<f64>) -> f64 {
        self.index
            .get_or_init(|| Index::new(&self.stores, self.now_s, self.room.steepness()))
            .at(&self.stores, &self.room, &self.cells, self.path, p)
    }
}
