//! A world in which several runs of one scenario take turns.
//!
//! Systems keep their state, a world its tables; both are the same for all runs of a scenario, and larger than what a
//! run has of its own. So runs share them: when a run's turn comes, its own values are exchanged for those of the run
//! before (file `run`). Then hundreds of runs fit into the processor's caches.
//!
//! Systems of other crates may keep values that nobody can exchange. Their runs have worlds of their own.

use super::{LaneError, assembled, caught, lend, take_back};
use crate::assemble::{RunParts, launch};
use crate::auv::{RobotOwn, VehiclePool};
use crate::extend::Addition;
use crate::fleet::Fleet;
use crate::gantry::GantryOwn;
use crate::machines::LaneComponents;
use crate::ocean::{Ocean, Origin};
use crate::outbox::Frames;
use crate::scenario::Loaded;
use crate::searchers::{Roster, SearcherId};
use crate::trial::{Progress, Trial};
use bevy_ecs::prelude::{Entity, With, World};
use bevy_ecs::query::QueryState;
use std::mem::swap;
use std::sync::{Mutex, PoisonError};
use world::seeds::Seed;

/// Worlds for runs of one scenario, in oceans of any seeds. There are as many as are in use at once.
pub struct Worlds {
    pub(super) loaded: Loaded,
    idle: Mutex<Vec<Box<Common>>>,
}

/// A world, and the machines in it that the runs exchange.
pub(super) struct Common {
    /// What is in the world at the moment: the run that had its turn last, or nobody's.
    trial: Trial,
    robots: Machines<RobotOwn>,
    gantries: Machines<GantryOwn>,
}

/// The machines of a kind in the world.
struct Machines<O: LaneComponents> {
    all: Vec<Entity>,
    parts: QueryState<O::Parts>,
}

/// What a run has of its own.
pub(super) struct LaneParts {
    parts: RunParts,
    robots: Vec<RobotOwn>,
    gantries: Vec<GantryOwn>,
    progress: Progress,
}

impl Worlds {
    /// For the runs of a scenario; none is made yet.
    pub fn new(loaded: &Loaded) -> Self {
        Self { loaded: loaded.clone(), idle: Mutex::default() }
    }

    /// Whether its runs can take turns in one world.
    pub(super) fn are_common(&self) -> bool {
        let (registry, scenario) = (&self.loaded.registry, &self.loaded.scenario);
        registry.carried::<Addition>().next().is_none() && scenario.apparatus.is_empty()
    }

    /// One that is not in use; if there is none, it is made with an ocean of the scenario.
    ///
    /// # Errors
    /// If the scenario cannot be assembled.
    pub(super) fn take(&self, origin: &Origin, ocean: &mut Option<Ocean>) -> Result<Box<Common>, LaneError> {
        let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let made = || Common::new(&self.loaded, origin, ocean).map(Box::new);
        idle.map_or_else(made, Ok)
    }

    /// Keeps one for the next time.
    pub(super) fn put_back(&self, common: Box<Common>) {
        (self.idle.lock().unwrap_or_else(PoisonError::into_inner)).push(common);
    }
}

impl Common {
    fn new(loaded: &Loaded, origin: &Origin, ocean: &mut Option<Ocean>) -> Result<Self, LaneError> {
        let mut world = World::new();
        world.insert_resource(VehiclePool::default());
        // Whoever steps the runs looks at them.
        let frames = Frames::Unmade;
        let mut trial = assembled(ocean, world, loaded, origin, origin.seed(), frames)?;
        let world = &mut trial.simulation.world;
        let Roster { robots, gantries, .. } = world.resource::<Roster>().clone();
        Ok(Self { robots: Machines::new(world, robots), gantries: Machines::new(world, gantries), trial })
    }

    /// A new run of the scenario in an ocean; `seed` is that of the searcher.
    ///
    /// # Errors
    /// If it cannot be put together, or panics.
    pub(super) fn launch(
        &mut self,
        loaded: &Loaded,
        seed: Seed,
        ocean: &mut Option<Ocean>,
    ) -> Result<LaneParts, LaneError> {
        lend(ocean, &mut self.trial);
        let launched = self.launched(loaded, seed);
        take_back(ocean, &mut self.trial);
        launched
    }

    fn launched(&mut self, loaded: &Loaded, seed: Seed) -> Result<LaneParts, LaneError> {
        let sources = self.trial.simulation.ocean().sources();
        let world = &mut self.trial.simulation.world;
        let mut parts = RunParts::new(&loaded.scenario, world.resource());
        parts.exchange(world);
        let mut roster = Roster::default();
        swap(&mut *world.resource_mut::<Roster>(), &mut roster);
        let fleet = Fleet::from_scenario(&loaded.scenario);
        let launched = caught(|| launch(world, &fleet, &loaded.scenario, &loaded.base_dir, seed));
        swap(&mut *world.resource_mut::<Roster>(), &mut roster);
        parts.exchange(world);
        if !matches!(launched, Ok(Ok(()))) {
            self.expel();
        }
        launched.map_err(LaneError::Panicked)??;
        let world = &mut self.trial.simulation.world;
        Ok(LaneParts {
            parts,
            robots: roster.robots.iter().map(|m| LaneComponents::take(world, *m)).collect(),
            gantries: roster.gantries.iter().map(|m| LaneComponents::take(world, *m)).collect(),
            progress: Progress::new(sources),
        })
    }

    /// Removes the machines of a run that was not put together.
    fn expel(&mut self) {
        let world = &mut self.trial.simulation.world;
        let all = world.query_filtered::<Entity, With<SearcherId>>();
        let all: Vec<Entity> = { all }.iter(world).collect();
        for machine in all {
            if !self.robots.all.contains(&machine) && !self.gantries.all.contains(&machine) {
                world.despawn(machine);
            }
        }
    }

    /// Does something in an ocean with the run that has its turn; an error is what it said in a panic.
    pub(super) fn work<T>(
        &mut self,
        ocean: &mut Option<Ocean>,
        work: impl FnOnce(&mut Trial) -> T,
    ) -> Result<T, String> {
        lend(ocean, &mut self.trial);
        let done = caught(|| work(&mut self.trial));
        take_back(ocean, &mut self.trial);
        if done.is_err() {
            self.trial.simulation.recover();
        }
        done
    }

    /// Gives a run its turn, and takes what is in the world, of whoever had it before.
    pub(super) fn exchange(&mut self, run: &mut LaneParts) {
        let world = &mut self.trial.simulation.world;
        run.parts.exchange(world);
        self.robots.exchange(world, &mut run.robots);
        self.gantries.exchange(world, &mut run.gantries);
        swap(&mut self.trial.progress, &mut run.progress);
    }
}

impl<O: LaneComponents> Machines<O> {
    fn new(world: &mut World, all: Vec<Entity>) -> Self {
        Self { all, parts: QueryState::new(world) }
    }

    fn exchange(&mut self, world: &mut World, own: &mut [O]) {
        for (machine, own) in self.all.iter().zip(own) {
            own.exchange(&mut self.parts, world, *machine);
        }
    }
}
