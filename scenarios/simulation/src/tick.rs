//! The score: what happens in a tick, every system in its stage.
//!
//! One thread, one order, one writer for each type; an ambiguity between two systems is an error
//! when the schedule is built. Parallelism is across runs, so a run is the same on any machine load.

use crate::auv::system as auv;
use crate::frame::system::take_frame;
use crate::gantry::system as gantry;
use crate::ocean::system as ocean;
use bevy_ecs::prelude::{IntoScheduleConfigs, ResMut, Schedule};
use bevy_ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, SingleThreadedExecutor};
use world::clock::Clock;
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
        (auv::read_instruments, gantry::read_probes).in_set(Stage::Sense),
        auv::estimate_state.in_set(Stage::Estimate),
        auv::update_map.in_set(Stage::Map),
        (auv::decide, gantry::track).in_set(Stage::Decide),
        auv::guide.in_set(Stage::Guide),
        (auv::actuate, gantry::drive_gantries).in_set(Stage::Actuate),
        auv::move_bodies.in_set(Stage::Physics),
        ocean::drift.in_set(Stage::Drift),
        (
            auv::digest_robots,
            ocean::digest_plume,
            gantry::digest_gantries,
            auv::keep_score,
            gantry::keep_score,
            auv::watch,
            take_frame,
            pass_time,
        )
            .chain()
            .in_set(Stage::Report),
    ));
    tick
}

fn pass_time(mut clock: ResMut<Clock>) {
    clock.advance();
}
