//! From a scenario to a world that ticks: everything that takes part in a run is put into its place here.

use crate::error::AssembleError;
use crate::extend::Addition;
use crate::fleet::Fleet;
use crate::machines::{Launch, Systems};
use crate::ocean::system::drift;
use crate::ocean::{Ocean, Origin};
use crate::outbox::{Frames, Outbox};
use crate::registry::topics;
use crate::scenario::Scenario;
use crate::score::Score;
use crate::searchers::Roster;
use crate::tick::Tick;
use crate::topic::Topics;
use bevy_ecs::component::ComponentId;
use bevy_ecs::prelude::{Mut, Resource, World};
use eyes::camera::Optics;
use nalgebra::Vector3;
use robots::handoff::Outcome;
use std::mem::swap;
use std::path::Path;
use world::clock::{Clock, Every};
use world::digest::Digest;
use world::fields::Flow;
use world::frames::Truth;
use world::physics::Physics;
use world::registry::Registry;
use world::seeds::Seed;

/// A scenario brought to life: the world of entities and resources, and the tick that moves it.
pub struct Simulation {
    /// All entities and resources.
    pub world: World,
    tick: Tick,
    pub(crate) origin: Origin,
}

impl Simulation {
    /// Assembles a scenario for a seed, with what comes with the program. Mission time is zero, and
    /// nothing is released yet.
    ///
    /// # Errors
    /// If a part of the scenario cannot be built. A scenario without errors in [`crate::scenario::check`] can be.
    pub fn assemble(scenario: &Scenario, base_dir: &Path, seed: impl Into<Seed>) -> Result<Self, AssembleError> {
        Self::assemble_with(&Registry::default(), scenario, base_dir, seed)
    }

    /// The same with what a registry carries: systems, resources and topics of other crates.
    ///
    /// # Errors
    /// As [`Simulation::assemble`]; also if a system for a searcher reads the truth, or if the order of two systems
    /// is not defined.
    pub fn assemble_with(
        registry: &Registry,
        scenario: &Scenario,
        base_dir: &Path,
        seed: impl Into<Seed>,
    ) -> Result<Self, AssembleError> {
        let origin = Origin::from_scenario(scenario, base_dir, seed);
        let mut world = World::new();
        world.insert_resource(origin.build(base_dir)?);
        let seed = origin.seed();
        let tick = Self::furnish(&mut world, registry, scenario, base_dir, seed, Frames::Made)?;
        Ok(Self::from_world(world, tick, origin))
    }

    /// Puts everything into a world that has an ocean.
    ///
    /// # Errors
    /// As [`Simulation::assemble_with`].
    pub(crate) fn furnish(
        world: &mut World,
        registry: &Registry,
        scenario: &Scenario,
        base_dir: &Path,
        seed: Seed,
        frames: Frames,
    ) -> Result<Tick, AssembleError> {
        furnish(world, scenario)?;
        world.insert_resource(Topics::new(topics(registry)));
        let fleet = Fleet::from_scenario(scenario);
        launch(world, &fleet, scenario, base_dir, seed)?;
        schedule(world, &fleet, registry, frames)
    }

    /// Of a world that is furnished.
    pub(crate) fn from_world(world: World, tick: Tick, origin: Origin) -> Self {
        Self { world, tick, origin }
    }

    /// The ocean as it is.
    pub fn ocean(&self) -> &Ocean {
        self.world.resource()
    }

    /// The ocean, to let it develop before the mission.
    pub fn ocean_mut(&mut self) -> Mut<'_, Ocean> {
        self.world.resource_mut()
    }

    /// One tick, in which nobody outside is asked.
    pub fn tick(&mut self) {
        self.observe();
        self.act();
        self.drift();
        self.report();
    }

    /// The step of the ocean.
    pub(crate) fn drift(&mut self) {
        let clock = self.clock();
        drift(&clock, &mut self.ocean_mut());
    }

    /// The part of a tick before the answers from outside.
    pub(crate) fn observe(&mut self) {
        self.tick.observe(&mut self.world);
    }

    /// The part from there to the step of the ocean.
    pub(crate) fn act(&mut self) {
        self.tick.act(&mut self.world);
    }

    /// The part after it.
    pub(crate) fn report(&mut self) {
        self.tick.report(&mut self.world);
    }

    /// Makes the tick fit for use again after a system has panicked in it.
    pub(crate) fn recover(&mut self) {
        self.tick.recover();
    }

    /// Whether the latest tick has left anything to be shown.
    pub(crate) fn waits(&self) -> bool {
        self.tick.waits
    }

    /// The time.
    pub(crate) fn clock(&self) -> Clock {
        *self.world.resource()
    }

    /// Mission time, s.
    pub fn t_s(&self) -> f64 {
        self.world.resource::<Clock>().t_s()
    }

    /// Flow at a point (ENU, m) now, m/s.
    pub fn velocity(&self, p_W: &Vector3<f64>) -> Vector3<f64> {
        self.ocean().velocity(p_W, self.t_s())
    }

    /// How the mission of each searcher ended, in the order of [`Score::searchers`]; `None` while it lasts.
    pub fn outcomes(&self) -> impl Iterator<Item = Option<Outcome>> {
        let score = self.world.resource::<Score>();
        score.searchers.iter().map(|s| s.outcome)
    }
}

/// Light in the water, for cameras. Apart, because a world sets aside the room of many for each of its resources.
#[derive(Resource, Clone, Debug)]
pub struct WaterLight(pub Box<Optics>);

/// What every run has of its own beside the ocean: time, bodies, score, digest and what waits to be shown.
pub(crate) struct RunParts {
    clock: Clock,
    score: Score,
    outbox: Outbox,
    physics: Physics,
    digest: Digest,
}

impl RunParts {
    /// At the beginning of a run in an ocean.
    pub(crate) fn new(scenario: &Scenario, ocean: &Ocean) -> Self {
        let dt_s = scenario.time.step_s.get();
        let every = |period_s: f64| Every::period(period_s, dt_s);
        let mut physics = Physics::new(dt_s);
        physics.add_bed(&ocean.bed);
        for obstacle in &ocean.obstacles.0 {
            physics.add_obstacle(obstacle);
        }
        Self {
            clock: Clock::new(dt_s),
            score: Score::new(ocean.sources()),
            outbox: Outbox::new(
                every(scenario.record.frame_period_s.get()),
                every(scenario.record.plume_period_s.get()),
                scenario.record.plume_points as usize,
            ),
            physics,
            digest: Digest::default(),
        }
    }

    fn put_into(self, world: &mut World) {
        world.insert_resource(self.clock);
        world.insert_resource(self.score);
        world.insert_resource(self.outbox);
        world.insert_resource(self.physics);
        world.insert_resource(self.digest);
    }

    /// Takes what is in a world, and leaves this in its place; but for what waits to be shown, which runs without frames
    /// do not touch.
    pub(crate) fn exchange(&mut self, world: &mut World) {
        swap(&mut *world.resource_mut::<Clock>(), &mut self.clock);
        swap(&mut *world.resource_mut::<Score>(), &mut self.score);
        swap(&mut *world.resource_mut::<Physics>(), &mut self.physics);
        swap(&mut *world.resource_mut::<Digest>(), &mut self.digest);
    }
}

/// Puts in what every run has beside the ocean.
fn furnish(world: &mut World, scenario: &Scenario) -> Result<(), AssembleError> {
    let optics = Optics::new(&scenario.optics).map_err(AssembleError::Optics)?;
    let mut ocean = world.resource_mut::<Ocean>();
    ocean.step_at_most(scenario.time.drift_period_s.get());
    RunParts::new(scenario, world.resource()).put_into(world);
    world.insert_resource(Roster::default());
    world.insert_resource(WaterLight(Box::new(optics)));
    Ok(())
}

/// Puts the machines of a scenario into a world.
pub(crate) fn launch(
    world: &mut World,
    fleet: &Fleet,
    scenario: &Scenario,
    base_dir: &Path,
    seed: Seed,
) -> Result<(), AssembleError> {
    let launch = Launch { base_dir, seed, dt_s: scenario.time.step_s.get() };
    fleet.all().try_for_each(|a| a.spawn(world, &launch))
}

/// The tick with the systems of each kind of apparatus and of each extension.
fn schedule(world: &mut World, fleet: &Fleet, registry: &Registry, frames: Frames) -> Result<Tick, AssembleError> {
    let additions: Vec<&Addition> = registry.carried().collect();
    let kinds = fleet.kinds();
    let mut tick = Tick::new(kinds.len() + additions.len(), fleet.own_kinds(), frames);
    let truth = truth(world);
    let mut faults = Vec::new();
    for (turn, kind) in kinds.iter().enumerate() {
        let mut systems = Systems::new(tick.parts(), world, &truth, turn, frames);
        kind.systems(&mut systems);
        faults.extend(systems.faults());
    }
    for (turn, addition) in (kinds.len()..).zip(additions) {
        let mut systems = Systems::new(tick.parts(), world, &truth, turn, frames);
        (addition.0)(&mut systems);
        faults.extend(systems.faults());
    }
    if let Some(problem) = faults.into_iter().next() {
        return Err(AssembleError::Systems { problem });
    }
    let ordered = tick.initialize(world);
    ordered.map_err(|problem| AssembleError::Systems { problem })?;
    Ok(tick)
}

/// The types that hold the truth, which no system for a searcher may read.
fn truth(world: &mut World) -> [(ComponentId, &'static str); 5] {
    [
        (world.register_component::<Truth>(), "Truth"),
        (world.register_component::<Ocean>(), "Ocean"),
        (world.register_component::<Physics>(), "Physics"),
        (world.register_component::<Score>(), "Score"),
        (world.register_component::<Outbox>(), "Outbox"),
    ]
}
