//! Puts a gantry into the world.

use super::system::{Head, Rig, Searcher};
use crate::scenario::{Beside, GantryBlock};
use crate::searchers::SearcherId;
use bevy_ecs::prelude::{Entity, World};
use nalgebra::Vector2;
use robots::error::RobotError;
use robots::handoff::{GantryBehaviour, GantryDecision, GantryReadings, TrackerState};
use robots::sense::{OnBoard, Probes};
use robots::vehicles::Gantry;
use std::path::Path;
use world::physics::Physics;
use world::seeds::{Seed, Stream};
use world::terrain::Terrain;

/// Spawns it; its joints go into `physics`.
pub(crate) fn spawn(
    world: &mut World,
    physics: &mut Physics,
    block: &GantryBlock,
    terrain: &Terrain,
    base_dir: &Path,
    seed: Seed,
) -> Result<Entity, RobotError> {
    let id = block.id.as_str();
    let dt_s = physics.dt_s();
    let gantry = Gantry::load(&block.gantry, &Beside(base_dir))?;
    gantry.check_step(dt_s)?;
    let layout = block.layout(&gantry);
    let base = block.base(terrain);
    let joints = physics.add_gantry(gantry.body_spec(id, &base, block.start_m())?);
    let names: Vec<String> = layout.probes.iter().map(|p| p.name.clone()).collect();
    let probes = Probes::new(&block.probes, &names, &OnBoard::new(id, seed, dt_s))?;
    let strategy = block.tracker.build(&layout)?;
    let gantry = world.spawn((
        SearcherId(id.to_string()),
        Rig {
            gantry,
            joints,
            base,
            rng: Stream::new(seed, id, "drives"),
        },
        Head::new(probes),
        GantryReadings::default(),
        Searcher {
            strategy,
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
    Ok(gantry.id())
}
