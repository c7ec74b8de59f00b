//! The score: what happens in a tick, every system in its stage.
//!
//! One thread, one order, one writer for each type; an ambiguity between two systems is an error
//! when the schedule is built. Parallelism is across runs, so a run is the same on any machine load.

use crate::abnormal::system::watch;
use crate::frame::system::take_frame;
use crate::gantry::system as gantry;
use crate::score::system::keep_score;
use crate::system;
use bevy_ecs::prelude::{IntoScheduleConfigs, Schedule};
use bevy_ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, SingleThreadedExecutor};
use world::stage::Stage;

/// Label of the tick's schedule.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tick;

/// The tick: `Sense → Estimate → Map → Decide → Guide → Actuate → Physics → Drift → Report`.
#[must_use]
pub fn tick() -> Schedule {
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
    tick.add_systems((
        (system::read_instruments, gantry::read_probes).in_set(Stage::Sense),
        system::estimate_state.in_set(Stage::Estimate),
        system::update_map.in_set(Stage::Map),
        (system::decide, gantry::track).in_set(Stage::Decide),
        system::guide.in_set(Stage::Guide),
        (system::actuate, gantry::drive_gantries).in_set(Stage::Actuate),
        system::move_bodies.in_set(Stage::Physics),
        system::drift_plume.in_set(Stage::Drift),
        (
            system::digest_state,
            gantry::digest_gantries,
            keep_score,
            watch,
            take_frame,
            system::pass_time,
        )
            .chain()
            .in_set(Stage::Report),
    ));
    tick
}
