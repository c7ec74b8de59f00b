//! How systems join the tick.

use crate::outbox::Frames;
use bevy_ecs::component::ComponentId;
use bevy_ecs::prelude::{
    Component, IntoScheduleConfigs, IntoSystem, IntoSystemSet, Resource, Schedule, System, SystemSet, World,
};
use bevy_ecs::system::{ScheduleSystem, SystemAccess};
use world::stage::Stage;

/// The place of a system within its stage.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SystemTurn {
    /// The systems of one apparatus or extension in a stage, by its place in the list.
    Of(Stage, usize),
    /// All systems in a stage that other crates add. They run after ours.
    Added(Stage),
    /// The systems of one apparatus or extension that write into a frame.
    Frame(usize),
}

/// The step of the physics. What pushes bodies runs before it, what reads where they are runs after it.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BodiesMove;

/// Adds systems to the stages of a run's tick, and resources to its world.
///
/// Apparatus and extensions take their turns in a fixed order: robots, gantries, the apparatus of other crates in the
/// order of the scenario, the extensions in the order of the registry. In a stage each one's systems run after those of
/// the one before. Two systems of one turn that touch the same data need an explicit order (`(a, b).chain()`,
/// `b.after(a)`); without one the run is refused, because its result would not be defined.
pub struct Systems<'a> {
    observe: &'a mut Schedule,
    act: &'a mut Schedule,
    report: &'a mut Schedule,
    frame: &'a mut Schedule,
    world: &'a mut World,
    truth: &'a [(ComponentId, &'static str)],
    turn: usize,
    frames: Frames,
    faults: Vec<String>,
}

impl<'a> Systems<'a> {
    /// For one turn in all parts of the tick. Systems added as blind may not read `truth`.
    pub(crate) fn new(
        [observe, act, report, frame]: [&'a mut Schedule; 4],
        world: &'a mut World,
        truth: &'a [(ComponentId, &'static str)],
        turn: usize,
        frames: Frames,
    ) -> Self {
        Self { observe, act, report, frame, world, truth, turn, frames, faults: Vec::new() }
    }

    /// Adds systems to a stage. They may read everything.
    pub fn add<M>(&mut self, stage: Stage, systems: impl IntoScheduleConfigs<ScheduleSystem, M>) -> &mut Self {
        let part = match stage {
            Stage::Sense | Stage::Estimate | Stage::Map => &mut *self.observe,
            Stage::Drift | Stage::Report => &mut *self.report,
            _ => &mut *self.act,
        };
        part.add_systems(systems.in_set(SystemTurn::Of(stage, self.turn)));
        self
    }

    /// Adds systems that write into a frame. They run after all stages of a step in which a frame is made.
    pub fn add_to_frame<M>(&mut self, systems: impl IntoScheduleConfigs<ScheduleSystem, M>) -> &mut Self {
        if self.has_frames() {
            let systems = systems.in_set(SystemTurn::Frame(self.turn));
            self.frame.add_systems(systems);
        }
        self
    }

    /// Whether the run makes frames. Without them it needs no system that only prepares them.
    pub fn has_frames(&self) -> bool {
        self.frames == Frames::Made
    }

    /// Whether an entity has this component now. Systems for what nobody has can be left out.
    pub fn has<C: Component>(&mut self) -> bool {
        (self.world.query::<&C>().iter(self.world)).next().is_some()
    }

    /// Adds a system that works for a searcher. If it reads one of the types that hold the truth, the run is refused.
    pub fn add_blind<M, S>(&mut self, stage: Stage, system: S) -> &mut Self
    where
        S: IntoSystem<(), (), M>,
        S::System: Send + Sync,
    {
        let system = self.blind(system);
        self.add(stage, system)
    }

    /// The same after another system of the stage.
    pub fn add_blind_after<M, N, S>(&mut self, stage: Stage, system: S, other: impl IntoSystemSet<N>) -> &mut Self
    where
        S: IntoSystem<(), (), M>,
        S::System: Send + Sync,
    {
        let system = self.blind(system);
        self.add(stage, system.after(other))
    }

    /// A system of which it is known whether it reads the truth.
    fn blind<M, S>(&mut self, system: S) -> S::System
    where
        S: IntoSystem<(), (), M>,
    {
        let mut system = IntoSystem::into_system(system);
        let access = system.initialize(self.world);
        let name = std::any::type_name::<S>();
        for (id, what) in self.truth {
            if reads(&access, *id) {
                self.faults.push(format!(
                    "the system `{name}` works for a searcher and reads {what}, which holds the truth: let it read \
                     what instruments and navigation say, or add it with `add` if it only measures or judges"
                ));
            }
        }
        system
    }

    /// Puts a resource into the world.
    pub fn insert(&mut self, resource: impl Resource) -> &mut Self {
        self.world.insert_resource(resource);
        self
    }

    /// The world with all entities of the scenario in it.
    pub fn world(&mut self) -> &mut World {
        self.world
    }

    /// What is wrong with what was added.
    pub(crate) fn faults(self) -> Vec<String> {
        self.faults
    }
}

/// Whether a system may read a component or resource.
fn reads(access: &SystemAccess, id: ComponentId) -> bool {
    match access {
        SystemAccess::None => false,
        SystemAccess::Shared(shared) => shared.combined_access().has_read(id),
        SystemAccess::Exclusive => true,
    }
}
