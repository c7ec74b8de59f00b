//! The schema of a scenario file. Each block belongs to the part that it configures.

use super::gantry::GantryBlock;
use super::id::Id;
use super::success::SuccessSpec;
use super::version::Version;
use crate::machines::ApparatusSpec;
use eyes::StandardEyes;
use eyes::camera::OpticsSpec;
use nalgebra::{Vector2, Vector3};
use plumes::flow::WaterSpec;
use plumes::release::SourceSpec;
use robots::actuate::AutopilotSpec;
use robots::estimate::EstimatorSpec;
use robots::faults::FaultSpec;
use robots::guide::GuidanceSpec;
use robots::map::MapSpec;
use robots::sense::SensorsSpec;
use robots::strategy::{Setting, StrategySpec};
use robots::vehicles::{EnergySpec, VehicleSpec};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use world::area::Area;
use world::obstacles::{Obstacle, ObstacleSpec, Obstacles};
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::terrain::Terrain;

/// An experiment: the place, its water, the chemical sources, the vehicles that search, and the time limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Version of scenario files; the first field of every file.
    pub version: Version,
    /// Title in lists and reports, one line.
    pub title: String,
    /// The publication that the experiment comes from: paper, section, figure, table.
    pub citation: String,
    /// The operating area.
    pub area: AreaSpec,
    /// The bed.
    pub terrain: TerrainSpec,
    /// Currents, stratification, mixing.
    pub water: WaterSpec,
    /// How clear the water is and how light falls into it, for cameras.
    #[serde(default)]
    pub optics: OpticsSpec,
    /// Chemical sources; any number.
    #[serde(default)]
    pub sources: Vec<SourceSpec>,
    /// Solid things in the water; any number.
    #[serde(default)]
    pub obstacles: Vec<ObstacleSpec>,
    /// Ids of obstacles that water and dye pass through, as in a paper whose plume ignores its obstacle. Vehicles touch
    /// them and ranging sees them all the same.
    #[serde(default)]
    pub permeable: Vec<String>,
    /// Vehicles that search; any number.
    #[serde(default)]
    pub robots: Vec<RobotSpec>,
    /// Two-axis gantries that search; any number.
    #[serde(default)]
    pub gantries: Vec<GantryBlock>,
    /// Machines of kinds that other crates add; any number.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub apparatus: Vec<ApparatusSpec>,
    /// Steps, spin-up and the longest mission.
    pub time: TimeSpec,
    /// When the mission counts as a success.
    #[serde(default)]
    pub success: SuccessSpec,
    /// What is recorded, and how often.
    #[serde(default)]
    pub record: RecordSpec,
}

/// The operating area: a rectangle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaSpec {
    /// Extent along the axis, m.
    pub length_m: Positive,
    /// Extent across the axis, m.
    pub width_m: Positive,
    /// Direction of the axis.
    pub axis_heading_deg: HeadingDeg,
    /// Its centre east of the datum, m.
    #[serde(default = "zero", with = "world::limits::place_m")]
    pub east_m: Finite,
    /// Its centre north of the datum, m.
    #[serde(default = "zero", with = "world::limits::place_m")]
    pub north_m: Finite,
}

fn zero() -> Finite {
    Finite::new(0.0)
}

impl AreaSpec {
    /// The area itself.
    pub fn build(&self) -> Area {
        Area {
            centre: Vector2::new(self.east_m.get(), self.north_m.get()),
            length_m: self.length_m.get(),
            width_m: self.width_m.get(),
            axis: self.axis_heading_deg.heading(),
        }
    }
}

/// The bed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum TerrainSpec {
    /// The same depth everywhere.
    Level(LevelSpec),
    /// A plane rising towards the shore across the area.
    Slope(SlopeSpec),
}

/// A level bed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LevelSpec {
    /// Water depth, m.
    pub depth_m: Positive,
}

/// A sloping bed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlopeSpec {
    /// Direction in which the water gets shallower.
    pub shoreward_heading_deg: HeadingDeg,
    /// Depth at the shoreward edge of the area, m.
    pub shallow_m: Positive,
    /// Depth at the seaward edge of the area, m.
    pub deep_m: Positive,
}

impl TerrainSpec {
    /// The bed itself.
    pub fn build(&self, area: &Area) -> Terrain {
        match self {
            TerrainSpec::Level(level) => Terrain::Level { depth_m: level.depth_m.get() },
            TerrainSpec::Slope(slope) => Terrain::sloping_over(
                area,
                slope.shoreward_heading_deg.heading(),
                slope.shallow_m.get(),
                slope.deep_m.get(),
            ),
        }
    }
}

/// A robot: a vehicle, its instruments, and its strategy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RobotSpec {
    /// Name, unique among the robots.
    pub id: Id,
    /// Its vehicle.
    pub vehicle: VehicleSpec,
    /// Where it is when the mission starts.
    pub start: StartSpec,
    /// Its instruments.
    #[serde(default)]
    pub sensors: SensorsSpec,
    /// How it estimates its state from readings.
    pub estimator: EstimatorSpec,
    /// How it turns goals into headings and speeds.
    #[serde(default)]
    pub guidance: GuidanceSpec,
    /// How it turns headings and speeds into commands for rudder, stern plane and propeller.
    #[serde(default)]
    pub autopilot: AutopilotSpec,
    /// Its map of where the source may be, if it keeps one.
    #[serde(default)]
    pub map: Option<MapSpec>,
    /// Ids of the obstacles on its chart. It must find other obstacles by its ranging. The bed is always charted.
    #[serde(default)]
    pub chart: Vec<String>,
    /// Its strategy.
    pub strategy: StrategySpec,
    /// Its battery and what empties it. Without it, energy is not counted and never ends.
    #[serde(default)]
    pub energy: Option<EnergySpec>,
    /// What fails on its mission; any number. The robot learns of a fault only by its readings.
    #[serde(default)]
    pub faults: Vec<FaultSpec>,
}

impl RobotSpec {
    /// What the strategy knows before the mission.
    pub fn setting(&self, area: &Area, terrain: &Terrain, obstacles: &Obstacles) -> Setting {
        let charted = |o: &&Obstacle| self.chart.contains(&o.id);
        Setting {
            area: *area,
            bed: terrain.clone(),
            chart: Obstacles(obstacles.0.iter().filter(charted).cloned().collect()),
            maps: self.map.is_some(),
            outlook: self.map.as_ref().is_some_and(|map| map.looks_ahead()),
            eyes: Arc::new(StandardEyes),
        }
    }
}

/// Where a robot starts. Give either its depth or its altitude.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartSpec {
    /// East of the datum, m.
    #[serde(with = "world::limits::place_m")]
    pub east_m: Finite,
    /// North of the datum, m.
    #[serde(with = "world::limits::place_m")]
    pub north_m: Finite,
    /// Depth below the still surface, m.
    #[serde(default)]
    pub depth_m: Option<NonNegative>,
    /// Height above the bed, m.
    #[serde(default)]
    pub altitude_m: Option<NonNegative>,
    /// Direction of its nose.
    pub heading_deg: HeadingDeg,
    /// Speed over ground, forward, m/s.
    #[serde(default = "still", with = "world::limits::vehicle_m_s::<NonNegative>")]
    pub speed_m_s: NonNegative,
    /// Standard deviation, east and north, of the position fix that its navigation starts from, m.
    #[serde(default = "still", with = "world::limits::error_m")]
    pub fix_noise_m: NonNegative,
}

fn still() -> NonNegative {
    NonNegative::new(0.0)
}

impl StartSpec {
    /// Position in the world. If both are given, altitude counts; if neither is, the surface. [`check`](super::check)
    /// refuses both cases.
    pub fn p_W(&self, terrain: &Terrain) -> Vector3<f64> {
        let (x, y) = (self.east_m.get(), self.north_m.get());
        let z = match (self.altitude_m, self.depth_m) {
            (Some(altitude), _) => terrain.bed_z(x, y) + altitude.get(),
            (None, Some(depth)) => -depth.get(),
            (None, None) => 0.0,
        };
        Vector3::new(x, y, z)
    }
}

/// Steps, spin-up and the longest mission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSpec {
    /// Step of the physics, s: 0.001 to 0.1, and up to 1 where all robots are kinematic. Every slower stage takes a
    /// whole number of these steps.
    #[serde(default = "step")]
    pub step_s: Positive,
    /// Time in which the plume develops before the mission, s.
    #[serde(default = "still")]
    pub spin_up_s: NonNegative,
    /// The mission ends after this time at the latest, s.
    pub limit_s: Positive,
    /// Longest step of a filament during the mission, s. Young filaments, and all in water that changes over short
    /// distances, take shorter ones.
    #[serde(default = "drift_period")]
    pub drift_period_s: Positive,
    /// Longest step of a filament during the spin-up, s.
    #[serde(default = "spin_up_period")]
    pub spin_up_period_s: Positive,
    /// Period at which the plume renews its currents from the water, s. It should be short against meander and waves.
    #[serde(default = "flow_period")]
    pub flow_period_s: NonNegative,
}

fn step() -> Positive {
    Positive::new(0.02)
}

fn drift_period() -> Positive {
    Positive::new(5.0)
}

fn flow_period() -> NonNegative {
    NonNegative::new(5.0)
}

fn spin_up_period() -> Positive {
    Positive::new(5.0)
}

/// What is recorded, and how often.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RecordSpec {
    /// Period of the recorded and published states of the robots, and of the rows in `track.csv`, s.
    pub frame_period_s: Positive,
    /// Period of the recorded and published plume, s.
    pub plume_period_s: Positive,
    /// Most filaments in one recorded or published plume.
    pub plume_points: u32,
    /// Period of the recorded maps of where the source may be, s.
    pub map_period_s: Positive,
    /// Most camera pictures that a run keeps, as files and in the recording.
    pub pictures: u32,
}

impl Default for RecordSpec {
    fn default() -> Self {
        Self {
            frame_period_s: Positive::new(0.1),
            plume_period_s: Positive::new(10.0),
            plume_points: 2000,
            map_period_s: Positive::new(10.0),
            pictures: 40,
        }
    }
}
