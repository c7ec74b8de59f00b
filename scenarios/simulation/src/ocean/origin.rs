//! Everything that the water and the plume of a run depend on.
//!
//! It must all be in fields of [`Origin`]. Runs with the same origin share a spin-up (see [`SpunUp`](super::SpunUp));
//! a value outside it could differ between them without notice.

use super::Ocean;
use crate::error::AssembleError;
use crate::scenario::{AreaSpec, Scenario, TerrainSpec};
use plumes::filaments::{Plume, PlumeSettings};
use plumes::flow::WaterSpec;
use plumes::release::SourceSpec;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use world::digest::Digest;
use world::error::WorldError;
use world::obstacles::{Obstacle, ObstacleSpec, Obstacles};
use world::ranges::{NonNegative, Positive};
use world::seeds::Seed;

/// Everything that a run's water and plume depend on, up to the start of the mission.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Origin {
    seed: Seed,
    area: AreaSpec,
    terrain: TerrainSpec,
    water: WaterSpec,
    obstacles: Vec<ObstacleSpec>,
    permeable: Vec<String>,
    sources: Vec<SourceSpec>,
    #[serde(rename = "time.spin_up_s")]
    spin_up_s: NonNegative,
    #[serde(rename = "time.spin_up_period_s")]
    spin_up_period_s: Positive,
    #[serde(rename = "time.flow_period_s")]
    flow_period_s: NonNegative,
    /// Digests of the files that the obstacles name, by name; `None` for a file that cannot be read. Building reports
    /// that.
    files: BTreeMap<String, Option<String>>,
}

impl Origin {
    /// The origin of a run of a scenario; paths are relative to `base_dir`.
    pub fn from_scenario(scenario: &Scenario, base_dir: &Path, seed: impl Into<Seed>) -> Self {
        let files = scenario.obstacles.iter().filter_map(ObstacleSpec::file);
        let time = &scenario.time;
        Self {
            seed: seed.into(),
            area: scenario.area.clone(),
            terrain: scenario.terrain.clone(),
            water: scenario.water.clone(),
            obstacles: scenario.obstacles.clone(),
            permeable: scenario.permeable.clone(),
            sources: scenario.sources.clone(),
            spin_up_s: time.spin_up_s,
            spin_up_period_s: time.spin_up_period_s,
            flow_period_s: time.flow_period_s,
            files: files.map(|name| (name.to_string(), content(&base_dir.join(name)))).collect(),
        }
    }

    /// Builds the ocean; paths are relative to `base_dir`.
    ///
    /// # Errors
    /// If a part of it cannot be built.
    pub fn build(&self, base_dir: &Path) -> Result<Ocean, AssembleError> {
        let area = self.area.build();
        let terrain = self.terrain.build(&area);
        let obstacles = (self.obstacles.iter())
            .map(|spec| Obstacle::build(spec, &terrain, base_dir))
            .collect::<Result<Vec<_>, _>>()?;
        for (name, before) in &self.files {
            if content(&base_dir.join(name)) != *before {
                return Err(AssembleError::World(WorldError::File {
                    path: name.clone(),
                    place: String::new(),
                    problem: "it was changed while it was read: run again".to_string(),
                }));
            }
        }
        let obstacles = Obstacles(obstacles);
        let solids = obstacles.without(&self.permeable);
        let water = (self.water).build_round(&area, &terrain, &solids, self.seed)?;
        let settings = PlumeSettings {
            refresh_s: self.flow_period_s.get(),
            grid: self.water.grid_shape(&area, terrain.deepest_m()),
        };
        let plume = Plume::new(&self.sources, &area, &terrain, self.seed, settings)?
            .with_obstacles(solids)?
            .led_round(water.blocked())?
            .carried_by(water.small())
            .with_buoyancy(&water)?;
        Ok(Ocean::new(area, terrain, obstacles, water, plume, self))
    }

    /// How long the plume develops before the mission, s.
    pub fn spin_up_s(&self) -> f64 {
        self.spin_up_s.get()
    }

    /// Longest step of the plume during the spin-up, s.
    pub fn spin_up_period_s(&self) -> f64 {
        self.spin_up_period_s.get()
    }

    /// The run's seed.
    pub fn seed(&self) -> Seed {
        self.seed
    }

    /// The first field, except the seed, that differs from another origin's.
    pub fn unlike(&self, other: &Self) -> Option<String> {
        let [ours, theirs] = [self, other].map(Self::fields);
        let mut names = ours.keys().filter(|name| *name != "seed");
        // Compared as text, so that -0 differs from 0.
        let differs = |name: &&String| {
            let text = |value: Option<&serde_json::Value>| value.map(ToString::to_string);
            text(ours.get(*name)) != text(theirs.get(*name))
        };
        names.find(differs).cloned()
    }

    /// All of it but the seed's key, as text: the same for the same origin.
    pub(crate) fn text(&self) -> String {
        serde_json::to_string(self).expect("every scenario can be written")
    }

    fn fields(&self) -> serde_json::Map<String, serde_json::Value> {
        match serde_json::to_value(self) {
            Ok(serde_json::Value::Object(fields)) => fields,
            other => unreachable!("every scenario can be written as an object: {other:?}"),
        }
    }
}

/// Digest of a file's bytes.
fn content(path: &Path) -> Option<String> {
    let bytes = world::files::read(path, 1 << 30).ok()?;
    let mut digest = Digest::default();
    digest.bytes(&bytes);
    Some(digest.hex())
}
