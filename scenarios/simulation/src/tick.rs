//! The tick: what happens in a step, every system in its stage.
//!
//! One thread, one order, and one writer for each type. If the order of two systems that touch the same data is not
//! defined, the run is refused. Runs are parallel to each other, not inside, so a run is the same on any machine.
//!
//! The tick has three parts. Between the first and the second, searchers outside this program answer: see
//! [`control`](crate::control). Between the second and the third the ocean makes its step, which runs in the same ocean
//! share: see [`lanes`](crate::lanes). A tick in which a frame is due ends with that frame.
//!
//! Here stand only the systems that every run has. Each apparatus of the scenario and each extension of the registry
//! adds its own to the stages, in a fixed order of turns.

mod in_order;

use crate::machines::{BodiesMove, SystemTurn};
use crate::ocean::system as ocean;
use crate::outbox::{Frames, close_frame, open_frame};
use bevy_ecs::prelude::{IntoScheduleConfigs, ResMut, Schedule, World};
use bevy_ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, SingleThreadedExecutor};
use world::clock::Clock;
use world::physics::Physics;
use world::stage::Stage;

/// Label of the schedule of a part of a tick.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// What the searchers see of the water as it is: up to their maps.
    Observe,
    /// What they do: from their decisions to the physics.
    Act,
    /// What follows the step of the ocean.
    Report,
    /// What is shown, in a tick in which a frame is due.
    Frame,
}

/// The tick: `Sense → Estimate → Map`, then answers from outside, then `Decide → Guide → Actuate → Physics`, then the
/// ocean, then `Drift → Report`, then the frame if one is due.
pub(crate) struct Tick {
    observe: Schedule,
    act: Schedule,
    report: Schedule,
    frame: Schedule,
    /// Which of these parts need nothing but to run their systems in order.
    in_order: [bool; 4],
    /// Whether it makes frames.
    frames: Frames,
    /// Whether anything waits in the outbox after the latest report.
    pub(crate) waits: bool,
}

impl Tick {
    /// A tick with room for so many turns, of which the first `own` are of this program.
    pub(crate) fn new(turns: usize, own: usize, frames: Frames) -> Self {
        let [sense, estimate, map, before @ .., drift, report] = Stage::ALL;
        let mut tick = Self {
            observe: part(Part::Observe, &[sense, estimate, map], turns, own),
            act: part(Part::Act, &before, turns, own),
            report: part(Part::Report, &[drift, report], turns, own),
            frame: part(Part::Frame, &[], turns, own),
            in_order: [false; 4],
            frames,
            waits: false,
        };
        tick.act.add_systems(
            move_bodies.in_set(Stage::Physics).in_set(BodiesMove).before(SystemTurn::Added(Stage::Physics)),
        );
        tick.report.add_systems(ocean::digest_plume.in_set(report).before(SystemTurn::Added(report)));
        for n in 1..turns {
            let after = SystemTurn::Frame(n).after(SystemTurn::Frame(n - 1));
            tick.frame.configure_sets(after);
        }
        tick
    }

    /// Its parts, for what is added to them.
    pub(crate) fn parts(&mut self) -> [&mut Schedule; 4] {
        [&mut self.observe, &mut self.act, &mut self.report, &mut self.frame]
    }

    /// Fixes the order of all systems; an error says why there is none.
    pub(crate) fn initialize(&mut self, world: &mut World) -> Result<(), String> {
        let mut in_order = [false; 4];
        for (part, in_order) in self.parts().into_iter().zip(&mut in_order) {
            *in_order = in_order::without_conditions(part);
            let done = part.initialize(world);
            done.map_err(|error| error.to_string(part.graph(), world))?;
            *in_order &= !in_order::puts_off(part);
        }
        self.in_order = in_order;
        self.recover();
        Ok(())
    }

    /// Makes it fit for use again after a system has panicked.
    pub(crate) fn recover(&mut self) {
        let in_order = self.in_order;
        for (part, in_order) in self.parts().into_iter().zip(in_order) {
            in_order::execute(part, in_order);
        }
    }

    /// The part before the answers from outside.
    pub(crate) fn observe(&mut self, world: &mut World) {
        self.observe.run(world);
    }

    /// The part from there to the step of the ocean.
    pub(crate) fn act(&mut self, world: &mut World) {
        self.act.run(world);
    }

    /// The part after it, with a frame if one is due. Then the time passes.
    pub(crate) fn report(&mut self, world: &mut World) {
        self.report.run(world);
        if self.frames == Frames::Made {
            let (due, waits) = open_frame(world);
            if due {
                self.frame.run(world);
                close_frame(world);
            }
            self.waits = waits;
        }
        world.resource_mut::<Clock>().advance();
    }
}

/// These stages one after the other, each with its turns.
fn part(label: Part, stages: &[Stage], turns: usize, own: usize) -> Schedule {
    let mut part = Schedule::new(label);
    part.set_executor(SingleThreadedExecutor::new());
    part.set_build_settings(ScheduleBuildSettings { ambiguity_detection: LogLevel::Error, ..Default::default() });
    for pair in stages.windows(2) {
        part.configure_sets(pair[0].before(pair[1]));
    }
    for &stage in stages {
        part.configure_sets(SystemTurn::Added(stage).in_set(stage));
        for n in 0..turns {
            let turn = SystemTurn::Of(stage, n);
            if n < own {
                part.configure_sets(turn.in_set(stage).before(SystemTurn::Added(stage)));
            } else {
                part.configure_sets(turn.in_set(SystemTurn::Added(stage)));
            }
            if n > 0 {
                part.configure_sets(turn.after(SystemTurn::Of(stage, n - 1)));
            }
        }
    }
    part
}

/// One step of the physics for all bodies.
fn move_bodies(mut physics: ResMut<Physics>) {
    physics.step();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::AssembleError;
    use crate::extend::{Extend, Systems};
    use crate::testing::short_channel;
    use crate::trial::Trial;
    use bevy_ecs::prelude::{Query, Resource};
    use nalgebra::Vector3;
    use world::frames::Truth;
    use world::registry::Registry;

    #[derive(Resource, Default)]
    struct Noted(Vec<&'static str>, Vector3<f64>);

    fn first(mut noted: ResMut<Noted>) {
        noted.0.push("first");
    }

    fn second(mut noted: ResMut<Noted>) {
        noted.0.push("second");
    }

    fn place(robots: Query<&Truth>, mut noted: ResMut<Noted>) {
        noted.1 = robots.iter().next().expect("a robot").pose.p_WB;
    }

    /// A short run of a channel with these systems.
    fn trial(registry: &Registry) -> Result<Trial, AssembleError> {
        Trial::assemble(&short_channel(registry, 2.0, 1.0), 1)
    }

    fn with(add: impl Fn(&mut Systems) + Send + Sync + 'static) -> Registry {
        Registry::default().with_systems(move |systems| {
            systems.insert(Noted::default());
            add(systems);
        })
    }

    /// What is said of these systems, if they are refused.
    fn refused(add: impl Fn(&mut Systems) + Send + Sync + 'static) -> Option<String> {
        trial(&with(add)).err().map(|error| error.to_string())
    }

    #[test]
    fn systems_of_other_crates_run_after_ours_and_in_the_order_of_the_registry() {
        let registry = with(|systems| {
            systems.add(Stage::Physics, place).add(Stage::Decide, first);
        })
        .with_systems(|systems| {
            systems.add(Stage::Decide, second);
        });
        let mut trial = trial(&registry).expect("one order");
        for _ in 0..2 {
            assert!(trial.step());
            let world = &mut trial.simulation.world;
            let now = world.query::<&Truth>().single(world).expect("a robot");
            let now = now.pose.p_WB;
            assert_eq!(world.resource::<Noted>().1, now, "seen before the bodies moved");
        }
        let noted = &trial.simulation.world.resource::<Noted>().0;
        assert_eq!(*noted, ["first", "second", "first", "second"]);
    }

    #[test]
    fn systems_that_only_look_leave_the_digest_alone() {
        let watched = with(|systems| {
            systems.add(Stage::Physics, place);
        });
        let [plain, watched] =
            [Registry::default(), watched].map(|registry| trial(&registry).expect("one order").finish_quietly().digest);
        assert_eq!(plain, watched);
    }

    #[test]
    fn an_order_that_is_not_defined_is_refused() {
        let open = refused(|systems| _ = systems.add(Stage::Decide, (first, second))).expect("it is open");
        assert!(open.contains("Noted") || open.contains("conflict"), "{open}");
        assert_eq!(refused(|systems| _ = systems.add(Stage::Decide, (first, second).chain())), None);
    }

    #[test]
    fn a_system_for_a_searcher_does_not_read_the_truth() {
        let reads = refused(|systems| _ = systems.add_blind(Stage::Decide, place)).expect("it reads");
        assert!(reads.contains("reads Truth"), "{reads}");
        assert_eq!(refused(|systems| _ = systems.add_blind(Stage::Decide, first)), None);
    }
}
