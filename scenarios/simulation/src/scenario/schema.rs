//! What a scenario file says: the whole schema, each block owned by the part it configures.

use super::gantry::GantryBlock;
use super::success::SuccessSpec;
use crate::apparatus::ApparatusSpec;
use nalgebra::{Vector2, Vector3};
use plumes::flow::WaterSpec;
use plumes::release::SourceSpec;
use robots::actuate::AutopilotSpec;
use robots::estimate::EstimatorSpec;
use robots::guide::GuidanceSpec;
use robots::handoff::Setting;
use robots::map::MapSpec;
use robots::sense::SensorsSpec;
use robots::sense::camera::OpticsSpec;
use robots::strategy::StrategySpec;
use robots::vehicles::VehicleSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::obstacles::{Obstacle, ObstacleSpec, Obstacles};
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::terrain::Terrain;

/// Version of the schema this program reads.
pub const VERSION: u32 = 1;

/// An experiment: a place, its water, what is released, who searches, and when it is over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Version of the schema; the first field of every file.
    pub version: Version,
    /// One line for lists and reports.
    pub title: String,
    /// Where the experiment comes from: paper, section, figure, table.
    pub source: String,
    /// The operating area.
    pub area: AreaSpec,
    /// The bed.
    pub terrain: TerrainSpec,
    /// Currents, stratification, mixing.
    pub water: WaterSpec,
    /// How clear the water is and how light falls into it, for cameras.
    #[serde(default)]
    pub optics: OpticsSpec,
    /// What is released; any number.
    #[serde(default)]
    pub sources: Vec<SourceSpec>,
    /// Solid things in the water; any number.
    #[serde(default)]
    pub obstacles: Vec<ObstacleSpec>,
    /// Ids of obstacles that water and dye pass through: a paper's block that its plume does not feel. Vehicles and
    /// ranging meet them all the same.
    #[serde(default)]
    pub permeable: Vec<String>,
    /// Who searches; any number.
    #[serde(default)]
    pub robots: Vec<RobotSpec>,
    /// Searchers on two-axis gantries; any number.
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
    /// What is written down, and how often.
    #[serde(default)]
    pub record: RecordSpec,
}

/// Version of the schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "u32", into = "u32")]
#[schemars(extend("const" = VERSION))]
pub struct Version(u32);

impl TryFrom<u32> for Version {
    type Error = String;
    fn try_from(v: u32) -> Result<Self, String> {
        if v == VERSION {
            Ok(Self(v))
        } else {
            Err(format!("this program reads version {VERSION}, got {v}"))
        }
    }
}

impl From<Version> for u32 {
    fn from(v: Version) -> u32 {
        v.0
    }
}

/// A name that fits into keys and file names.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "String", into = "String")]
#[schemars(extend("pattern" = "^[a-z0-9_]+$"))]
pub struct Id(String);

impl Id {
    /// The name.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl TryFrom<String> for Id {
    type Error = String;
    fn try_from(s: String) -> Result<Self, String> {
        let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if !s.is_empty() && s.chars().all(fits) {
            Ok(Self(s))
        } else {
            Err(format!(
                "must be made of a-z, 0-9 and _, and not empty, got {s:?}"
            ))
        }
    }
}

impl From<Id> for String {
    fn from(id: Id) -> String {
        id.0
    }
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
    #[serde(default = "zero", deserialize_with = "world::limits::place_m")]
    #[schemars(transform = world::limits::schema::place_m)]
    pub east_m: Finite,
    /// Its centre north of the datum, m.
    #[serde(default = "zero", deserialize_with = "world::limits::place_m")]
    #[schemars(transform = world::limits::schema::place_m)]
    pub north_m: Finite,
}

fn zero() -> Finite {
    Finite::new(0.0)
}

impl AreaSpec {
    /// The area itself.
    #[must_use]
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
    #[must_use]
    pub fn build(&self, area: &Area) -> Terrain {
        match self {
            TerrainSpec::Level(level) => Terrain::Level {
                depth_m: level.depth_m.get(),
            },
            TerrainSpec::Slope(slope) => Terrain::sloping_over(
                area,
                slope.shoreward_heading_deg.heading(),
                slope.shallow_m.get(),
                slope.deep_m.get(),
            ),
        }
    }
}

/// A robot: a body, its instruments, and what it does with them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RobotSpec {
    /// Name, unique among the robots.
    pub id: Id,
    /// Its body.
    pub vehicle: VehicleSpec,
    /// Where it is when the mission starts.
    pub start: StartSpec,
    /// Its instruments.
    #[serde(default)]
    pub sensors: SensorsSpec,
    /// How readings become what it believes.
    pub estimator: EstimatorSpec,
    /// How goals become headings and speeds.
    #[serde(default)]
    pub guidance: GuidanceSpec,
    /// How those become rudder, stern plane and propeller.
    #[serde(default)]
    pub autopilot: AutopilotSpec,
    /// Its map of where the source may be, if it keeps one.
    #[serde(default)]
    pub map: Option<MapSpec>,
    /// Ids of the obstacles on its chart; what else stands in the water it must find by its ranging. The bed is charted.
    #[serde(default)]
    pub chart: Vec<String>,
    /// What it does.
    pub strategy: StrategySpec,
}

impl RobotSpec {
    /// What its mission is told beforehand.
    #[must_use]
    pub fn setting(&self, area: &Area, terrain: &Terrain, obstacles: &Obstacles) -> Setting {
        let charted = |o: &&Obstacle| self.chart.contains(&o.id);
        Setting {
            area: *area,
            bed: terrain.clone(),
            chart: Obstacles(obstacles.0.iter().filter(charted).cloned().collect()),
            maps: self.map.is_some(),
        }
    }
}

/// Where a robot starts; either its depth or its altitude is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartSpec {
    /// East of the datum, m.
    #[serde(deserialize_with = "world::limits::place_m")]
    #[schemars(transform = world::limits::schema::place_m)]
    pub east_m: Finite,
    /// North of the datum, m.
    #[serde(deserialize_with = "world::limits::place_m")]
    #[schemars(transform = world::limits::schema::place_m)]
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
    #[serde(default = "still", deserialize_with = "world::limits::vehicle_m_s")]
    #[schemars(transform = world::limits::schema::vehicle_m_s)]
    pub speed_m_s: NonNegative,
    /// Standard deviation, east and north, of the fix its navigation starts from, m.
    #[serde(default = "still", deserialize_with = "world::limits::error_m")]
    #[schemars(transform = world::limits::schema::error_m)]
    pub fix_noise_m: NonNegative,
}

fn still() -> NonNegative {
    NonNegative::new(0.0)
}

impl StartSpec {
    /// Position in the world; altitude wins where both are given, the surface where neither is
    /// ([`check`](super::check) refuses both).
    #[must_use]
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
    /// Step of the physics, s; every slower stage divides it.
    #[serde(default = "step")]
    pub step_s: Positive,
    /// How long the plume develops before the mission, s.
    #[serde(default = "still")]
    pub spin_up_s: NonNegative,
    /// The mission is over after this, s.
    pub limit_s: Positive,
    /// Step of the plume during the mission, s.
    #[serde(default = "drift_period")]
    pub drift_period_s: Positive,
    /// Step of the plume during the spin-up, s.
    #[serde(default = "spin_up_period")]
    pub spin_up_period_s: Positive,
    /// How often the plume asks the water for its currents, s: short against meander and waves.
    #[serde(default = "flow_period")]
    pub flow_period_s: NonNegative,
}

fn step() -> Positive {
    Positive::new(0.02)
}

fn drift_period() -> Positive {
    Positive::new(0.5)
}

fn flow_period() -> NonNegative {
    NonNegative::new(5.0)
}

fn spin_up_period() -> Positive {
    Positive::new(1.0)
}

/// What is written down, and how often.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RecordSpec {
    /// Period of the recorded and published state of the robots, and of the rows of `track.csv`, s.
    pub frame_period_s: Positive,
    /// Period of the recorded and published plume, s.
    pub plume_period_s: Positive,
    /// Most filaments recorded or published at once.
    pub plume_points: u32,
    /// Period of the recorded maps of where the source may be, s.
    pub map_period_s: Positive,
    /// Most pictures of cameras that a run leaves behind, as files and in the recording.
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
