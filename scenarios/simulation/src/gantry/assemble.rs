//! Brings gantries into a run.

use super::Gantries;
use super::system::{self, Head, Rig, Searcher};
use crate::control::exchanges::{ExchangeState, Exchanges};
use crate::error::AssembleError;
use crate::machines::{Launch, Machine, Systems};
use crate::ocean::Ocean;
use crate::ocean::system::digest_plume;
use crate::scenario::{FolderFiles, GantryBlock};
use crate::score::Score;
use crate::searchers::SearcherId;
use bevy_ecs::prelude::{IntoScheduleConfigs, World};
use nalgebra::Vector2;
use robots::error::RobotError;
use robots::handoff::{Bounds, GantryBehaviour, GantryDecision, GantryReadings, TrackerState};
use robots::sense::{OnBoard, Probes};
use robots::vehicles::Gantry;
use world::catalogue::Entry;
use world::physics::Physics;
use world::registry::Listed;
use world::seeds::Stream;
use world::stage::Stage;

impl Listed for GantryBlock {
    const ENTRY: Entry = Entry {
        name: "Gantry",
        what: "A sensor head on a two-axis gantry in a flume",
        source: "Webster, Volyanskyy & Weissburg 2012",
    };
}

impl Machine for GantryBlock {
    fn id(&self) -> &str {
        self.id.as_str()
    }

    fn spawn(&self, world: &mut World, launch: &Launch) -> Result<(), AssembleError> {
        spawn(self, world, launch).map_err(|source| AssembleError::Robot { id: self.id.as_str().to_string(), source })
    }

    fn systems(&self, systems: &mut Systems) {
        systems
            .add(Stage::Sense, system::read_probes)
            .add_blind(Stage::Decide, system::track)
            .add(Stage::Actuate, system::drive_gantries)
            .add(Stage::Report, (system::digest_gantries.after(digest_plume), system::keep_score).chain())
            .add_to_frame(system::picture);
        if systems.has::<ExchangeState>() {
            systems.add_blind(Stage::Map, system::ask);
        }
    }
}

fn spawn(block: &GantryBlock, world: &mut World, launch: &Launch) -> Result<(), RobotError> {
    let id = block.id.as_str();
    let Launch { base_dir, seed, dt_s } = *launch;
    let gantry = Gantry::load(&block.gantry, &FolderFiles(base_dir))?;
    gantry.check_step(dt_s)?;
    let layout = block.layout(&gantry);
    let base = block.base(&world.resource::<Ocean>().terrain);
    let body = gantry.body_spec(id, &base, block.start_m())?;
    let joints = world.resource_mut::<Physics>().add_gantry(body);
    let names: Vec<String> = layout.probes.iter().map(|p| p.name.clone()).collect();
    let probes = Probes::new(&block.probes, &names, &OnBoard::new(id, seed, dt_s))?;
    let strategy = block.tracker.build(&layout)?;
    let place = world.resource_mut::<Score>().join(id);
    let mut gantry = world.spawn((
        SearcherId { name: id.to_string(), place },
        Rig { gantry, joints, base, rng: Stream::new(seed, id, "drives") },
        Head::new(probes),
        GantryReadings::default(),
        Searcher {
            strategy,
            name: block.tracker.name(),
            bounds: Bounds::for_origin(block.tracker.is_own()),
            rng: Stream::new(seed, id, "tracker"),
            stopped_s: None,
        },
        GantryDecision {
            behaviour: GantryBehaviour::Idle,
            id: 0,
            target_m: block.start_m(),
            speed_m_s: Vector2::zeros(),
            working: TrackerState::default(),
            stopped: None,
        },
    ));
    let consulted = block.tracker.consulted();
    if let Some(consulted) = consulted {
        gantry.insert(ExchangeState::gantry(consulted, dt_s));
    }
    let gantry = gantry.id();
    if consulted.is_some() {
        world.get_resource_or_init::<Exchanges>().0.push(gantry);
    }
    world.get_resource_or_init::<Gantries>().0.push(gantry);
    Ok(())
}
