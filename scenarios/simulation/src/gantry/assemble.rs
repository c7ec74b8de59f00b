//! Brings gantries into a run.

use super::system::{self, Head, Rig};
use crate::control::exchanges::ExchangeState;
use crate::error::AssembleError;
use crate::machines::system as common;
use crate::machines::{Launch, Machine, NewSearcher, Systems};
use crate::ocean::Ocean;
use crate::ocean::system::digest_plume;
use crate::scenario::{FolderFiles, GantryBlock};
use crate::searchers::Roster;
use bevy_ecs::prelude::{IntoScheduleConfigs, World};
use robots::error::RobotError;
use robots::handoff::{Behaviour, Decision, GantryReadings, HeadGoal};
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
            .add_blind(Stage::Decide, common::decide::<HeadGoal>)
            .add(Stage::Actuate, system::drive_gantries)
            .add(Stage::Report, system::report.after(digest_plume))
            .add_to_frame(system::picture);
        if systems.has::<ExchangeState>() {
            systems.add_blind(Stage::Map, common::ask::<HeadGoal>);
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
    let searcher = NewSearcher {
        id,
        strategy: block.tracker.build(&layout)?,
        name: block.tracker.name(),
        is_own: block.tracker.is_own(),
        first: Decision::new(Behaviour::Idle, HeadGoal { target_m: block.start_m(), ..HeadGoal::default() }),
        consulted: block.tracker.consulted(),
        drives: None,
    };
    let rig = Rig { gantry, joints, base, rng: Stream::new(seed, id, "drives") };
    let gantry = searcher.join(world, launch, (rig, Head::new(probes), GantryReadings::default()));
    world.resource_mut::<Roster>().gantries.push(gantry);
    Ok(())
}
