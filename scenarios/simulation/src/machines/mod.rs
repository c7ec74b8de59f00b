//! What takes part in a run beside the ocean: one trait for robots, gantries and what other crates add.
//!
//! An [`Machine`] is the part of a scenario that describes one machine. It puts its entities into the world, adds its
//! systems to the stages of the tick, and says what the summary shows of it. A robot ([`crate::auv`]) and a gantry
//! ([`crate::gantry`]) are two of them, on one common searcher; neither the tick nor the assembly knows their names.
//!
//! # A third kind
//!
//! 1. A struct of parameters with an `id`, with the derives of `examples/library/own_apparatus.rs`.
//! 2. [`Listed`](world::registry::Listed) for it: its name in scenarios, one sentence, its source.
//! 3. [`Machine`] for it.
//! 4. A row: `Registry::default().with::<Apparatuses, MyBuoy>()`.
//!
//! A scenario then has a block `apparatus: [MyBuoy(id: "b1", …)]`.
//!
//! # What a searcher must not know
//!
//! A searcher knows only what its instruments and its navigation tell it. These types hold the truth:
//!
//! | type | holds |
//! | --- | --- |
//! | [`Truth`](world::frames::Truth) | where a robot is and how it moves |
//! | [`Ocean`](crate::ocean::Ocean) | water, plume, sources, obstacles, bed |
//! | [`Physics`](world::physics::Physics) | all bodies and contacts |
//! | [`Score`](crate::score::Score) | distances to the sources, true paths |
//! | [`Outbox`](crate::outbox::Outbox) | frames, which show all of it |
//!
//! A system that decides something for a searcher must not read them. Add it with [`Systems::add_blind`], which
//! refuses it if it does. A system that only measures, judges or publishes may read the truth: add it with
//! [`Systems::add`].
//!
//! What a searcher may know are these components of `robots::handoff`: `Decision`, of a robot `Readings`, `Estimate`,
//! `Belief`, `Command`, `GuidanceStatus`, `Actuation`, and of a gantry `GantryReadings`; also
//! [`Briefing`](crate::auv::Briefing).

mod own;
mod searcher_kind;
pub(crate) mod system;
mod turns;

pub(crate) use own::{LaneComponents, own};
pub(crate) use searcher_kind::{Inputs, NewSearcher, SearcherKind};
pub use turns::{BodiesMove, SystemTurn, Systems};

use crate::error::AssembleError;
use bevy_ecs::prelude::World;
use serde_json::Value;
use std::path::Path;
use world::kind;
use world::registry::Spec;
use world::seeds::Seed;

/// What a run tells its apparatus before it begins. What else there is stands in the world as a resource: ocean,
/// physics, clock, score.
#[derive(Clone, Copy, Debug)]
pub struct Launch<'a> {
    /// Folder that paths in the scenario are relative to.
    pub base_dir: &'a Path,
    /// Seed of the run. Take random numbers from `Stream::new(seed, id, "purpose")`.
    pub seed: Seed,
    /// Step of the tick, s.
    pub dt_s: f64,
}

/// The description of one machine in a scenario, and what it brings into a run.
pub trait Machine: Spec {
    /// Its id in the scenario.
    fn id(&self) -> &str;

    /// Puts its entities into the world. Machines come in the order of the scenario: robots, gantries, then others.
    ///
    /// # Errors
    /// If it cannot be built as described.
    fn spawn(&self, world: &mut World, launch: &Launch) -> Result<(), AssembleError>;

    /// Adds the systems of all machines of this kind. It is called once for a run, for the first machine of the kind.
    fn systems(&self, systems: &mut Systems);

    /// What `summary.json` shows of it at the end of a run, under `apparatus` and its id; `None` for nothing. Robots
    /// and gantries have their own parts of the summary, made from [`Score`](crate::score::Score) and frames.
    fn summary(&self, _world: &World) -> Option<Value> {
        None
    }
}

kind! {
    /// A machine of a kind that another crate adds.
    pub ApparatusSpec = Apparatuses of Machine { heading: "Machines of other crates", rows: [] }
}
