//! What is known before the run: bed, obstacles, and the machines with their URDFs.

use crate::ros::Marker;
use nalgebra::{Vector2, Vector3};
use rheotaxis::error::AssembleError;
use rheotaxis::scenario::{Beside, GantryBlock, Loaded, RobotSpec};
use robots::error::RobotError;
use robots::sense::{AltimeterSpec, RangingSpec};
use robots::vehicles::{Description, Gantry};
use world::area::Area;
use world::frames::Pose;
use world::obstacles::Obstacle;
use world::terrain::Terrain;

/// Number of fields of the bed's surface along each side of the area. Between them it is level.
const FIELDS: u32 = 24;

/// Colours: red, green, blue, opacity.
const SAND: [f32; 4] = [0.76, 0.7, 0.5, 1.0];
const ROCK: [f32; 4] = [0.45, 0.45, 0.45, 1.0];

/// The place of a run and who is in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Surfaces of bed and obstacles.
    pub solids: Vec<Marker>,
    /// Robots, then gantries, in the scenario's order.
    pub machines: Vec<Machine>,
}

/// A robot or a gantry.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Its id in the scenario.
    pub id: String,
    /// Its name in ROS.
    pub name: String,
    /// Its URDF.
    pub description: Description,
    /// Where a gantry stands; `None` for a robot.
    pub base: Option<Pose>,
    /// Names of a gantry's slides, in the order of its states.
    pub slides: Vec<String>,
    /// Names of its probes, in the order of a scan.
    pub probes: Vec<String>,
    /// Least and greatest range of its altimeter, m.
    pub altimeter_m: Option<[f64; 2]>,
    /// Least and greatest range of its forward ranging, m, and the angle that its beams cover, rad.
    pub ranging: Option<([f64; 2], f64)>,
}

impl Scene {
    /// That of a scenario.
    ///
    /// # Errors
    /// If the run could not be assembled: files of obstacles, vehicles or gantries are missing or wrong.
    pub fn of(loaded: &Loaded) -> Result<Self, AssembleError> {
        let scenario = &loaded.scenario;
        let (area, base_dir) = (scenario.area.build(), &loaded.base_dir);
        let terrain = scenario.terrain.build(&area);
        let mut solids = vec![Marker {
            name: "bed".to_owned(),
            colour: SAND,
            triangles: bed(&area, &terrain),
        }];
        for spec in &scenario.obstacles {
            let obstacle = Obstacle::build(spec, &terrain, base_dir)?;
            solids.push(Marker {
                name: format!("obstacle {}", obstacle.id),
                colour: ROCK,
                triangles: obstacle.triangles(),
            });
        }
        let files = Beside(base_dir);
        let failed = |id: &str| {
            let id = id.to_owned();
            |source| AssembleError::Robot { id, source }
        };
        let robots = (scenario.robots.iter())
            .map(|spec| Machine::of_robot(spec, &files).map_err(failed(spec.id.as_str())));
        let gantries = (scenario.gantries.iter()).map(|block| {
            Machine::of_gantry(block, &terrain, &files).map_err(failed(block.id.as_str()))
        });
        let machines = robots.chain(gantries).collect::<Result<_, _>>()?;
        Ok(Self { solids, machines })
    }

    /// The machine of an id.
    #[must_use]
    pub fn machine(&self, id: &str) -> Option<&Machine> {
        self.machines.iter().find(|m| m.id == id)
    }
}

impl Machine {
    fn of_robot(spec: &RobotSpec, files: &Beside) -> Result<Self, RobotError> {
        let id = spec.id.as_str();
        let ranging = spec.sensors.get::<RangingSpec>();
        let altimeter = spec.sensors.get::<AltimeterSpec>();
        Ok(Self {
            id: id.to_owned(),
            name: ros_name(id),
            description: Description::of_vehicle(&spec.vehicle, files)?,
            base: None,
            slides: Vec::new(),
            probes: Vec::new(),
            altimeter_m: altimeter.map(|a| [a.min_range_m.get(), a.max_range_m.get()]),
            ranging: ranging.map(|r| {
                let limits_m = [r.min_range_m.get(), r.max_range_m.get()];
                (limits_m, r.width_deg.get().to_radians())
            }),
        })
    }

    fn of_gantry(
        block: &GantryBlock,
        terrain: &Terrain,
        files: &Beside,
    ) -> Result<Self, RobotError> {
        let (id, gantry) = (block.id.as_str(), Gantry::load(&block.gantry, files)?);
        let probes = block.layout(&gantry).probes.into_iter();
        Ok(Self {
            id: id.to_owned(),
            name: ros_name(id),
            description: Description::of_gantry(&block.gantry, files)?,
            base: Some(block.base(terrain)),
            slides: gantry.joint_names().map(str::to_owned).to_vec(),
            probes: probes.map(|p| p.name).collect(),
            altimeter_m: None,
            ranging: None,
        })
    }

    /// Name of the frame of one of its links.
    #[must_use]
    pub fn frame(&self, link: &str) -> String {
        format!("{}/{link}", self.name)
    }
}

/// A machine's own name in ROS: a name there begins with a letter and has no two underscores in a row.
fn ros_name(id: &str) -> String {
    let mut name = String::new();
    if !id.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name.push('r');
    }
    for c in id.chars() {
        if !(c == '_' && name.ends_with('_')) {
            name.push(c);
        }
    }
    name
}

/// The surface of the bed over the area, seen from above.
fn bed(area: &Area, terrain: &Terrain) -> Vec<[Vector3<f64>; 3]> {
    let at = |i: u32, j: u32| {
        let share = |k: u32| f64::from(k) / f64::from(FIELDS) - 0.5;
        let p = area.world(Vector2::new(
            share(i) * area.length_m,
            share(j) * area.width_m,
        ));
        Vector3::new(p.x, p.y, terrain.bed_z(p.x, p.y))
    };
    let fields = (0..FIELDS).flat_map(|i| (0..FIELDS).map(move |j| (i, j)));
    fields
        .flat_map(|(i, j)| {
            // Along the area, then to the right of it: clockwise from above, so the other way round.
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, c, b], [a, d, c]]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn names_can_be_names_in_ros() {
        assert_eq!(ros_name("auv0"), "auv0");
        assert_eq!(ros_name("0_auv"), "r0_auv");
        assert_eq!(ros_name("_a__b"), "r_a_b");
    }

    #[test]
    fn the_bed_covers_the_area_and_looks_up() {
        let (area, terrain) = (sample::area(), sample::terrain());
        let mut covered_m2 = 0.0;
        for [a, b, c] in bed(&area, &terrain) {
            let normal = (b - a).cross(&(c - a));
            assert!(normal.z > 0.0);
            covered_m2 += normal.z / 2.0;
            assert_eq!(a.z, terrain.bed_z(a.x, a.y));
        }
        assert!((covered_m2 - area.length_m * area.width_m).abs() < 1e-6);
    }
}
