//! A system of your own: it runs in every tick, in a stage of its choice, with data of its own.
//!
//! This one counts how often each robot turned sharply. A second one tries to read the truth for a searcher, which is
//! refused.
//!
//! `cargo run --release --example library own_system`

use bevy_ecs::prelude::{Query, ResMut, Resource};
use rheotaxis::extend::{Extend, Systems};
use rheotaxis::scenario::{Loaded, ScenarioError, load_with};
use rheotaxis::trial::Trial;
use robots::handoff::Estimate;
use world::frames::Truth;
use world::registry::Registry;
use world::stage::Stage;

/// The data of the system. A run starts with what is inserted below.
#[derive(Resource, Default)]
struct Turns {
    sharp: u64,
    ticks: u64,
}

/// The system. Its arguments say what it reads (`Query<&…>`, `Res<…>`) and what it writes (`&mut`, `ResMut<…>`).
fn count_turns(robots: Query<&Estimate>, mut turns: ResMut<Turns>) {
    turns.ticks += 1;
    for estimate in &robots {
        if estimate.attitude.rates_rad_s.z.abs() > 0.05 {
            turns.sharp += 1;
        }
    }
}

/// A system that no searcher may have: it knows where the robot really is.
fn peek(_robots: Query<&Truth>) {}

/// A minute in a channel of the catalogue.
fn minute(registry: &Registry) -> Result<Loaded, ScenarioError> {
    load_with(registry, "uniform_channel".as_ref())?.set("time", "(spin_up_s: 60, limit_s: 60)")
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The registry carries the system into every run, also into those of campaigns and of the command.
    let registry = Registry::default().with_systems(|systems: &mut Systems| {
        systems.insert(Turns::default());
        // `add_blind` refuses a system that reads the truth. `add` is for those that only measure, judge or publish.
        systems.add_blind(Stage::Estimate, count_turns);
    });
    let mut trial = Trial::assemble(&minute(&registry)?, 1)?;
    while trial.step() {}
    let turns = trial.simulation.world.resource::<Turns>();
    println!("turned sharply in {} of {} ticks", turns.sharp, turns.ticks);
    if turns.ticks != trial.ended().steps || turns.sharp == 0 {
        return Err("the system did not run in every tick".into());
    }

    let peeking = registry.with_systems(|systems: &mut Systems| {
        systems.add_blind(Stage::Decide, peek);
    });
    match Trial::assemble(&minute(&peeking)?, 1) {
        Ok(_) => Err("a searcher may read the truth".into()),
        Err(refused) => {
            println!("refused, as it should be: {refused}");
            Ok(())
        }
    }
}
