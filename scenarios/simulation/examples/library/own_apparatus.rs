//! An apparatus of your own, beside robots and gantries: a moored buoy that measures the dye at its place.
//!
//! `cargo run --release --example library own_apparatus`

use bevy_ecs::prelude::{Component, Query, Res, ResMut, World};
use nalgebra::Vector3;
use rheotaxis::error::AssembleError;
use rheotaxis::extend::{Extend, Systems};
use rheotaxis::machines::{Apparatuses, Launch, Machine};
use rheotaxis::ocean::Ocean;
use rheotaxis::scenario::{Id, load_with};
use rheotaxis::topic::{Topic, Topics};
use rheotaxis::trial::{Trial, Unwatched};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use world::catalogue::Entry;
use world::clock::{Clock, Every};
use world::fields::Concentration;
use world::ranges::{Finite, NonNegative};
use world::registry::{Listed, Registry};
use world::stage::Stage;

/// What a scenario says of a buoy, in its list `apparatus`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Buoy {
    /// Name, unique in the scenario.
    id: Id,
    /// East of the datum, m.
    east_m: Finite,
    /// North of the datum, m.
    north_m: Finite,
    /// Depth of its sensor, m.
    depth_m: NonNegative,
}

/// The name in scenario files, and what `rheotaxis list` says about it.
impl Listed for Buoy {
    const ENTRY: Entry =
        Entry { name: "Buoy", what: "a moored buoy that measures the dye at its place", source: "an example" };
}

/// A buoy in the world: an entity with this component.
#[derive(Component)]
struct Moored {
    id: String,
    p_W: Vector3<f64>,
    every: Every,
    readings: u64,
    mean_kg_m3: f64,
}

/// The system of all buoys. A buoy is no searcher, so it may read the ocean; it would add noise if it were a real one.
fn measure(clock: Res<Clock>, ocean: Res<Ocean>, mut buoys: Query<&mut Moored>, mut topics: ResMut<Topics>) {
    let t_s = clock.t_s();
    for mut buoy in &mut buoys {
        if buoy.every.due(&clock) {
            let now_kg_m3 = ocean.dye(t_s).concentration(&buoy.p_W);
            buoy.readings += 1;
            buoy.mean_kg_m3 += (now_kg_m3 - buoy.mean_kg_m3) / buoy.readings as f64;
            topics.publish(&DYE, &buoy.id, t_s, &Dye { t_s, dye_kg_m3: now_kg_m3 });
        }
    }
}

/// What a buoy measures.
#[derive(Serialize, JsonSchema)]
struct Dye {
    /// Simulated time, s.
    t_s: f64,
    /// Concentration, kg/m³.
    dye_kg_m3: f64,
}

/// Its topic; a buoy `b1` publishes under `buoy/b1/dye`.
const DYE: Topic = Topic::of::<Dye>("buoy_dye", "buoy/<id>/dye", "once a second");

/// What a buoy brings into a run: an entity, a system, a part of the summary.
impl Machine for Buoy {
    fn id(&self) -> &str {
        self.id.as_str()
    }

    fn spawn(&self, world: &mut World, launch: &Launch) -> Result<(), AssembleError> {
        let (x, y) = (self.east_m.get(), self.north_m.get());
        let bed_z = world.resource::<Ocean>().terrain.bed_z(x, y);
        if -self.depth_m.get() < bed_z {
            return Err(AssembleError::Apparatus {
                id: self.id().to_string(),
                problem: format!("depth_m must be at most {} there", -bed_z),
            });
        }
        world.spawn(Moored {
            id: self.id().to_string(),
            p_W: Vector3::new(x, y, -self.depth_m.get()),
            every: Every::period(1.0, launch.dt_s),
            readings: 0,
            mean_kg_m3: 0.0,
        });
        Ok(())
    }

    fn systems(&self, systems: &mut Systems) {
        systems.add(Stage::Sense, measure);
    }

    fn summary(&self, world: &World) -> Option<Value> {
        let mut all = world.try_query::<&Moored>()?;
        let own = all.iter(world).find(|b| b.id == self.id())?;
        Some(json!({ "readings": own.readings, "mean_kg_m3": own.mean_kg_m3 }))
    }
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let registry = (Registry::default().with::<Apparatuses, Buoy>()?).with_topic(DYE)?;
    let buoys = r#"[
        Buoy(id: "b1", east_m: -145, north_m: 0, depth_m: 8),
        Buoy(id: "b2", east_m: -145, north_m: 50, depth_m: 8),
    ]"#;
    let scenario = load_with(&registry, "uniform_channel".as_ref())?
        .set("apparatus", buoys)?
        .set("time", "(spin_up_s: 300, limit_s: 60)")?;

    let mut trial = Trial::assemble(&scenario, 1)?;
    trial.run(&mut Unwatched);
    let summary = trial.apparatus();
    for (id, part) in &summary {
        println!("{id}: {part}");
    }
    let mean = |id: &str| summary[id]["mean_kg_m3"].as_f64();
    if !(mean("b1") > Some(0.0) && mean("b2") == Some(0.0)) {
        return Err("the buoy in the plume must smell it, and the one beside it must not".into());
    }
    Ok(())
}
