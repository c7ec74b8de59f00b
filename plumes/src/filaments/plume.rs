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

use super::drift::drift_band::Scratch;
use super::drift::pollock::Pollock;
use super::query::index::Index;
use super::query::question::Question;
use super::store::arrays::Store;
use super::store::bands::Bands;
use super::store::eddy_coordinates::EddyCoordinates;
use super::store::rise::Rise;
use super::store::size::Size;
use super::store::structure::Structure;
use super::walls::cut_off;
use super::walls::domain::Domain;
use super::walls::solids::Solids;
use super::water::lookup::Lookup;
use super::water::sampled::SampledFlow;
use crate::error::PlumeError;
use crate::flow::ObstacleFlow;
use crate::flow::eddies::Small;
use crate::flow::grid::{FlowGrid, GridShape};
use crate::release::{ReleaseTimes, Source, SourceSpec, clear, place};
use crate::simd::dispatch::InstructionSet;
use bevy_ecs::prelude::Resource;
use nalgebra::Vector3;
use std::sync::Arc;
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
        Self { grid: GridShape::default(), refresh_s: 5.0 }
    }
}

/// All filaments at the present time.
#[derive(Resource, Clone, Debug)]
pub struct Plume {
    pub(super) sources: Vec<Source>,
    pub(super) releases: Vec<ReleaseTimes>,
    pub(super) keys: Vec<u64>,
    pub(super) stores: Vec<Store>,
    pub(super) bands: Bands,
    pub(super) grid: FlowGrid,
    pub(super) sampled: SampledFlow,
    pub(super) cells: Lookup,
    pub(super) refresh_s: f64,
    pub(super) next_refresh_s: Option<f64>,
    /// Whether the water has said since the pace began how it stirs what is released; if steady, it need not again.
    pub(super) stirred: bool,
    /// Number of times at which steps have started.
    pub(super) steps: u64,
    pub(super) now_s: f64,
    pub(super) path: InstructionSet,
    pub(super) room: Domain,
    pub(super) carrier: Option<Pollock>,
    pub(super) small: Option<Arc<Small>>,
    pub(super) turned_back: u64,
    pub(super) index: Index,
    pub(super) threads: Option<Arc<rayon::ThreadPool>>,
    pub(super) scratch: OwnScratch,
}

/// Where a plume moves its filaments. It holds nothing from one step to the next, so a copy of a plume has a new one.
#[derive(Default)]
pub(super) struct OwnScratch(pub(super) Box<Scratch>);

impl Clone for OwnScratch {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl std::fmt::Debug for OwnScratch {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("OwnScratch")
    }
}

impl Plume {
    /// Clean water with the sources in place. They open at the first step.
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
            releases: sources.iter().map(|s| ReleaseTimes::new(&s.release, seed, &s.id)).collect(),
            keys: sources.iter().map(|s| seeds::key(seed, &s.id, "drift")).collect(),
            stores: sources.iter().map(|s| Store::new(Size::new(&s.release), s.filament_kg)).collect(),
            sources,
            bands: Bands::single(0.0, 0.0),
            cells: Lookup::new(&grid),
            room: Domain::new(&grid),
            sampled: SampledFlow::new(&grid),
            carrier: None,
            small: None,
            grid,
            refresh_s: settings.refresh_s,
            next_refresh_s: None,
            stirred: false,
            steps: 0,
            now_s: 0.0,
            path: InstructionSet::detect(),
            turned_back: 0,
            index: Index::default(),
            threads: None,
            scratch: OwnScratch::default(),
        })
    }

    fn question(&self) -> Question<'_> {
        Question {
            stores: &self.stores,
            bands: &self.bands,
            room: &self.room,
            lookup: &self.cells,
            path: self.path,
            now_s: self.now_s,
        }
    }

    /// Lets the small eddies of a flume carry the filaments, if there are any.
    #[must_use]
    pub fn carried_by(mut self, small: Option<&Arc<Small>>) -> Self {
        self.small = small.cloned();
        for store in &mut self.stores {
            store.labels = small.map(|small| EddyCoordinates::new(small));
        }
        self
    }

    /// Lets buoyant releases rise, and those with structure be stirred. `flow` is the water into which they go.
    ///
    /// # Errors
    /// If a release cannot be made, if one that is buoyant or has structure does not say its volume, or if a probe would
    /// average over eddies of that water. The field is a path such as
    /// `sources[0].release.buoyancy.solutes[0].g_l`.
    pub fn with_buoyancy(mut self, flow: &dyn Flow) -> Result<Self, PlumeError> {
        for (n, (store, source)) in self.stores.iter_mut().zip(&self.sources).enumerate() {
            let [x, y, _] = self.grid.local(&source.p_W);
            let bed_m = f64::from(self.cells.bed(x, y));
            store.rise = Rise::new(flow, n, source, bed_m)?;
            let share = source.release.structure.get();
            store.structure = match &store.rise {
                Some(rise) if share > 0.0 => {
                    let released_kg_m3 = source.filament_kg / rise.volume_m3();
                    Some(Structure { share, released_kg_m3, key: self.keys[n] })
                }
                _ => None,
            };
        }
        Ok(self)
    }

    /// Adds solids to the water.
    ///
    /// # Errors
    /// If a source stands inside a solid.
    pub fn with_obstacles(mut self, obstacles: Obstacles) -> Result<Self, PlumeError> {
        clear(&self.sources, &obstacles)?;
        self.room.solids = Solids::new(obstacles, self.grid.datum);
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
    pub fn led_round(mut self, blocked: Option<&ObstacleFlow>) -> Result<Self, PlumeError> {
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
        self.carrier = Some(Pollock::new(blocked));
        for (n, source) in self.sources.iter().enumerate() {
            if let Some(problem) = cut_off::problem(&self.grid, &self.room, &self.cells, n, source) {
                return Err(problem);
            }
        }
        Ok(self)
    }
}

impl Concentration for Plume {
    fn concentration(&self, p: &Vector3<f64>) -> f64 {
        self.index.concentration(&self.question(), self.grid.local(p))
    }

    fn sensed(&self, p: &Vector3<f64>, across_m: f64) -> f64 {
        self.index.sensed(&self.question(), self.grid.local(p), across_m)
    }
}
