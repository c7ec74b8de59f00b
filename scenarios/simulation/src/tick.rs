//! The tick: what happens in a step, every system in its stage.
//!
//! One thread, one order, and one writer for each type. If the order of two systems that touch the same data is not
//! defined, the run is refused. Runs are parallel to each other, not inside, so a run is the same on any machine.
//!
//! Here stand only the systems that every run has. Each apparatus of the scenario and each extension of the registry
//! adds its own to the stages, in a fixed order of turns.

use crate::apparatus::{BodiesMove, Turn};
use crate::ocean::system as ocean;
use crate::outbox::system::{close_frame, open_frame};
use bevy_ecs::prelude::{IntoScheduleConfigs, ResMut, Schedule};
use bevy_ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, SingleThreadedExecutor};
use world::clock::Clock;
use world::physics::Physics;
use world::stage::Stage;

/// Label of the tick's schedule.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tick;

/// The tick: `Sense → Estimate → Map → Decide → Guide → Actuate → Physics → Drift → Report`. It has room for so many
/// turns, of which the first `own` are of this program.
#[must_use]
pub(crate) fn tick(turns: usize, own: usize) -> Schedule {
    let [
        sense,
        estimate,
        map,
        decide,
        guide,
        actuate,
        physics,
        drift,
        report,
    ] = Stage::ALL;

    let mut tick = Schedule::new(Tick);
    tick.set_executor(SingleThreadedExecutor::new());
    tick.set_build_settings(ScheduleBuildSettings {
        ambiguity_detection: LogLevel::Error,
        ..Default::default()
    });
    tick.configure_sets(
        (
            sense, estimate, map, decide, guide, actuate, physics, drift, report,
        )
            .chain(),
    );
    for stage in Stage::ALL {
        tick.configure_sets(Turn::Added(stage).in_set(stage));
        for n in 0..turns {
            let turn = Turn::Of(stage, n);
            if n < own {
                tick.configure_sets(turn.in_set(stage).before(Turn::Added(stage)));
            } else {
                tick.configure_sets(turn.in_set(Turn::Added(stage)));
            }
            if n > 0 {
                tick.configure_sets(turn.after(Turn::Of(stage, n - 1)));
            }
        }
    }
    tick.add_systems((
        move_bodies
            .in_set(BodiesMove)
            .in_set(physics)
            .before(Turn::Added(physics)),
        ocean::drift.in_set(drift).before(Turn::Added(drift)),
        ocean::digest_plume
            .in_set(report)
            .before(Turn::Added(report)),
        (open_frame, close_frame, pass_time).chain().after(report),
    ));
    for n in 0..turns {
        tick.configure_sets(Turn::Frame(n).after(open_frame).before(close_frame));
        if n > 0 {
            tick.configure_sets(Turn::Frame(n).after(Turn::Frame(n - 1)));
        }
    }
    tick
}

/// One step of the physics for all bodies.
fn move_bodies(mut physics: ResMut<Physics>) {
    physics.step();
}

fn pass_time(mut clock: ResMut<Clock>) {
    clock.advance();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::AssembleError;
    use crate::extend::{Extend, Systems};
    use crate::scenario::{load_text, template};
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
        let text = template("uniform_channel").expect("in the catalogue").text;
        let text = text.replace("spin_up_s: 2000, limit_s: 1800", "spin_up_s: 2, limit_s: 1");
        let loaded = load_text(registry, "short", &text).expect("legal");
        Trial::assemble(&loaded, 1)
    }

    fn with(add: impl Fn(&mut Systems) + Send + Sync + 'static) -> Registry {
        Registry::default().with_systems(move |systems| {
            systems.insert(Noted::default());
            add(systems);
        })
    }

    fn refused(registry: &Registry) -> String {
        match trial(registry) {
            Ok(_) => panic!("this order must be refused"),
            Err(error) => error.to_string(),
        }
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
            assert_eq!(
                world.resource::<Noted>().1,
                now,
                "seen before the bodies moved"
            );
        }
        let noted = &trial.simulation.world.resource::<Noted>().0;
        assert_eq!(*noted, ["first", "second", "first", "second"]);
    }

    #[test]
    fn systems_that_only_look_leave_the_digest_alone() {
        let watched = with(|systems| {
            systems.add(Stage::Physics, place);
        });
        let [plain, watched] = [Registry::default(), watched]
            .map(|registry| trial(&registry).expect("one order").finish_quietly().digest);
        assert_eq!(plain, watched);
    }

    #[test]
    fn an_order_that_is_not_defined_is_refused() {
        let said = refused(&with(|systems| {
            systems.add(Stage::Decide, (first, second));
        }));
        assert!(
            said.contains("Noted") || said.contains("conflict"),
            "{said}"
        );
        let chained = with(|systems| {
            systems.add(Stage::Decide, (first, second).chain());
        });
        assert!(trial(&chained).is_ok());
    }

    #[test]
    fn a_system_for_a_searcher_does_not_read_the_truth() {
        let said = refused(&with(|systems| {
            systems.add_blind(Stage::Decide, place);
        }));
        assert!(
            said.contains("reads Truth, which holds the truth"),
            "{said}"
        );
        let knows_nothing = with(|systems| {
            systems.add_blind(Stage::Decide, first);
        });
        assert!(trial(&knows_nothing).is_ok());
    }
}
