//! The scene of a scenario.

use super::bed::Bed;
use super::frames::transform;
use super::machine::Machine;
use super::mesh::Mesh;
use crate::ros::{Marker, Transform};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rheotaxis::error::AssembleError;
use rheotaxis::scenario::{FolderFiles, Loaded, Scenario};
use std::path::Path;
use world::frames::Pose;
use world::obstacles::Obstacle;

/// Colour of solid things, and of those that the water passes through: red, green, blue, opacity.
const ROCK: [f32; 4] = [0.45, 0.45, 0.45, 1.0];
const PERMEABLE: [f32; 4] = [0.55, 0.5, 0.4, 0.6];

/// The place of a run and who is in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Name of the scenario.
    pub scenario: String,
    /// Its title.
    pub title: String,
    /// Corners of the operating area (east, north), m, in order round it.
    pub corners: Vec<Vector2<f64>>,
    /// The bed.
    pub bed: Bed,
    /// Whether the surface of the water is worth drawing: not in a flume.
    pub surface: bool,
    /// Solid things beside the bed.
    pub solids: Vec<Solid>,
    /// The true sources: name, and place (ENU), m.
    pub sources: Vec<(String, Vector3<f64>)>,
    /// Interfaces between layers of the water, from the upper one down: mean height (z, ENU), m.
    pub layers: Vec<f64>,
    /// Robots, then gantries, in the scenario's order.
    pub machines: Vec<Machine>,
}

/// A solid thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Its id in the scenario.
    pub name: String,
    /// Red, green, blue, opacity, 0 to 1.
    pub colour: [f32; 4],
    /// Its surface, in the world (ENU).
    pub mesh: Mesh,
}

impl Scene {
    /// Centre of the operating area (east, north), m.
    pub fn centre(&self) -> Vector2<f64> {
        let all = self.corners.len().max(1) as f64;
        self.corners.iter().sum::<Vector2<f64>>() / all
    }

    /// The frame of clouds, whose numbers of single precision are relative to the centre of the area.
    pub fn area_frame(&self, parent: &str, child: &str) -> Transform {
        let pose = Pose { p_WB: self.centre().push(0.0), R_WB: UnitQuaternion::identity() };
        transform(0, parent, child.to_owned(), &pose)
    }

    /// That of a scenario.
    ///
    /// # Errors
    /// If the run could not be assembled: files of obstacles, vehicles or gantries are missing or wrong.
    pub fn from_scenario(loaded: &Loaded) -> Result<Self, AssembleError> {
        let scenario = &loaded.scenario;
        let area = scenario.area.build();
        let terrain = scenario.terrain.build(&area);
        let files = FolderFiles(&loaded.base_dir);
        let failed = |id: &str| {
            let id = id.to_owned();
            |source| AssembleError::Robot { id, source }
        };
        let robots =
            (scenario.robots.iter()).map(|spec| Machine::of_robot(spec, &files).map_err(failed(spec.id.as_str())));
        let gantries = (scenario.gantries.iter())
            .map(|block| Machine::of_gantry(block, &terrain, &files).map_err(failed(block.id.as_str())));
        let mut layers: Vec<f64> = (scenario.water.currents.iter())
            .flat_map(|c| c.scales().interfaces)
            .map(|i| i.depth_m)
            .map(|depth_m| -depth_m)
            .collect();
        layers.sort_by(|a, b| b.total_cmp(a));
        let sources = scenario.sources.iter().map(|s| {
            let (x, y) = (s.east_m.get(), s.north_m.get());
            let above_bed = s.height_m.map(|m| terrain.bed_z(x, y) + m.get());
            let z = above_bed.unwrap_or_else(|| -s.depth_m.map_or(0.0, |m| m.get()));
            (s.id.clone(), Vector3::new(x, y, z))
        });
        Ok(Self {
            scenario: loaded.name.clone(),
            title: scenario.title.clone(),
            corners: area.corners().to_vec(),
            bed: Bed::from_terrain(&area, &terrain),
            surface: scenario.gantries.is_empty(),
            solids: solids(scenario, &loaded.base_dir)?,
            sources: sources.collect(),
            layers,
            machines: robots.chain(gantries).collect::<Result<_, _>>()?,
        })
    }

    /// The machine of an id.
    pub fn machine(&self, id: &str) -> Option<&Machine> {
        self.machines.iter().find(|m| m.id == id)
    }

    /// Bed and solid things as surfaces to look at.
    pub fn markers(&self) -> Vec<Marker> {
        let solids = self.solids.iter().map(|solid| Marker {
            name: format!("obstacle {}", solid.name),
            colour: solid.colour,
            colours: Vec::new(),
            triangles: solid.mesh.corners().collect(),
        });
        let bed = (!self.bed.points.is_empty()).then(|| self.bed.marker());
        bed.into_iter().chain(solids).collect()
    }
}

fn solids(scenario: &Scenario, base_dir: &Path) -> Result<Vec<Solid>, AssembleError> {
    let terrain = scenario.terrain.build(&scenario.area.build());
    let solid = |spec| {
        let obstacle = Obstacle::build(spec, &terrain, base_dir)?;
        let colour = match scenario.permeable.contains(&obstacle.id) {
            true => PERMEABLE,
            false => ROCK,
        };
        Ok(Solid { mesh: Mesh::from_triangles(&obstacle.triangles()), name: obstacle.id, colour })
    };
    scenario.obstacles.iter().map(solid).collect()
}
