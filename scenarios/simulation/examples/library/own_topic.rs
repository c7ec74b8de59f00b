//! A topic of your own: a system publishes a value, and everybody who watches the run gets it.
//!
//! Live state has it under `rheotaxis/<run>/own/<id>/smells`, `rheotaxis topics` lists it, `run.mcap` holds it as JSON,
//! and `summary.json` shows the last value. Publishing never changes a result.
//!
//! `cargo run --release --example library own_topic`

use bevy_ecs::prelude::{Local, Query, Res, ResMut};
use rheotaxis::extend::{Extend, Systems};
use rheotaxis::scenario::load_with;
use rheotaxis::searchers::SearcherId;
use rheotaxis::topic::{Topic, Topics};
use rheotaxis::trial::{Event, Observer, Trial, Unwatched};
use robots::handoff::Readings;
use schemars::JsonSchema;
use serde::Serialize;
use world::clock::Clock;
use world::registry::Registry;
use world::stage::Stage;

/// What a robot has smelt so far.
#[derive(Clone, Default, Serialize, JsonSchema)]
struct Smells {
    /// Simulated time, s.
    t_s: f64,
    /// Readings so far.
    readings: u64,
    /// The strongest of them, V.
    strongest_v: f64,
}

/// The row of the topic: name, key and rate. The comments above say what a message and its fields mean.
const SMELLS: Topic = Topic::of::<Smells>("smells", "own/<id>/smells", "with every reading of the chemical sensor");

/// The system that publishes. `Local` is data that only this system has.
fn publish(
    clock: Res<Clock>,
    robots: Query<(&SearcherId, &Readings)>,
    mut smells: Local<Smells>,
    mut topics: ResMut<Topics>,
) {
    for (id, readings) in &robots {
        if let Some(reading) = readings.chemical {
            smells.t_s = clock.t_s();
            smells.readings += 1;
            smells.strongest_v = smells.strongest_v.max(reading.volts);
            topics.publish(&SMELLS, &id.name, clock.t_s(), &*smells);
        }
    }
}

/// Somebody who watches the run: counts what arrives.
#[derive(Default)]
struct Arrived(usize);

impl Observer for Arrived {
    fn see(&mut self, event: &Event) {
        if let Event::Frame(frame) = event {
            self.0 += frame.published.len();
        }
    }
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let registry = (Registry::default().with_topic(SMELLS)?).with_systems(|systems: &mut Systems| {
        systems.add_blind(Stage::Report, publish);
    });
    let channel =
        |registry| load_with(registry, "uniform_channel".as_ref())?.set("time", "(spin_up_s: 300, limit_s: 60)");
    let mut trial = Trial::assemble(&channel(&registry)?, 1)?;
    let mut arrived = Arrived::default();
    let digest = trial.run(&mut arrived).digest;
    for published in trial.published() {
        println!("{}: {}", published.key, published.value);
    }
    println!("{} values in frames", arrived.0);

    // The same run without the topic has the same digest.
    let same = Trial::assemble(&channel(&Registry::default())?, 1)?.run(&mut Unwatched).digest == digest;
    if arrived.0 < 100 || trial.published().count() != 1 || !same {
        return Err("the topic did not arrive, or it changed the run".into());
    }
    Ok(())
}
