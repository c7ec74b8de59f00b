//! The topics of a run itself, and their messages.

use super::{Payload, Topic};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};

/// Rate of what is published with each state.
pub const STATE_RATE: &str = "with the state, at most 20 a second";
/// Rate of what never changes.
pub const ONCE: &str = "once, kept for those who come later";
/// How numbers are packed: little-endian f32.
pub const DTYPE: &str = "<f4";

/// Time; it is published last, so that whoever has it also has the state that belongs to it.
pub const CLOCK: &[Topic] = &[Topic::of::<ClockMessage>("clock", "clock", STATE_RATE)];

/// The plume, the maps and what is published once.
pub const RUN: &[Topic] = &[
    Topic::of::<PlumeMessage>("plume", "plume", "at most 2 a second").packed(Payload::PackedF32),
    Topic::of::<WaterMessage>("water", "water", "with the plume; once if the flow is steady")
        .packed(Payload::PackedF32),
    Topic::of::<MapMessage>("map", "map/<id>", "at most 2 a second, of a robot that keeps a map")
        .packed(Payload::PackedF32),
    Topic::of::<ScenarioMessage>("scenario", "meta/scenario", ONCE),
    Topic::of::<SceneMessage>("scene", "meta/scene", ONCE),
    Topic::of::<VersionMessage>("version", "meta/version", ONCE),
    Topic::of::<DigestMessage>("digest", "meta/digest", "once, at the end"),
    Topic::of::<SchemaMessage>("schema", "meta/schema/<name>", ONCE).packed(Payload::Schema),
];

/// Simulated time, and what became of the states.
#[derive(Serialize, JsonSchema)]
pub struct ClockMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Step of the mission.
    pub step: u64,
    /// True in the last message of a run that came to its end.
    pub ended: bool,
    /// States published so far, this one included.
    pub sent: u64,
    /// States replaced by a newer one before they were sent.
    pub superseded: u64,
}

/// Some of the plume's filaments: of each x y z (m, ENU, x and y from origin_m), size (m), mass (kg) of all filaments
/// it stands for, how many those are; packed little-endian f32. The masses sum to what is in the water.
#[derive(Serialize, JsonSchema)]
pub struct PlumeMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// How many filaments there are in all.
    pub total: usize,
    /// How many are in the payload.
    pub shown: usize,
    /// Centre of the area (east, north), m; x and y are relative to it.
    pub origin_m: [f64; 2],
    /// What the numbers of a filament are, in their order.
    pub fields: Vec<&'static str>,
    /// How a number is packed.
    #[schemars(extend("enum" = [DTYPE]))]
    pub dtype: &'static str,
}

/// Flow of the water on a coarse grid at three heights: of each place x y z (m, ENU, x and y from origin_m) and
/// velocity east, north, up (m/s), packed little-endian f32.
#[derive(Serialize, JsonSchema)]
pub struct WaterMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// How many places are in the payload.
    pub shown: usize,
    /// Centre of the area (east, north), m; x and y are relative to it.
    pub origin_m: [f64; 2],
    /// What the numbers of a place are, in their order.
    pub fields: Vec<&'static str>,
    /// How a number is packed.
    #[schemars(extend("enum" = [DTYPE]))]
    pub dtype: &'static str,
}

/// Where a robot believes the source may be: the probability of each cell, first axis fastest, then the second, then
/// upwards, packed little-endian f32.
#[derive(Serialize, JsonSchema)]
pub struct MapMessage {
    /// Simulated time of its last update, s.
    pub t_s: f64,
    /// Updates so far.
    pub updates: u64,
    /// A detection went into it.
    pub informed: bool,
    /// Cells along the first and the second axis, and upwards; 1 in the third for a map of the plane.
    pub cells: [usize; 3],
    /// Size of a cell along them, m; larger than the robot's own where the map would not fit into a message.
    pub cell_m: [f64; 3],
    /// Lowest corner of the first cell (east, north, up), m.
    pub corner_m: [f64; 3],
    /// Direction of the first axis, clockwise from north, rad; the second lies to its left.
    pub axis_heading_rad: f64,
    /// Middle of the most probable cell (east, north, up), m.
    pub best_m: [f64; 3],
    /// Entropy, nat.
    pub entropy_nat: f64,
    /// Size of the smallest set of cells with 95 % of the probability, m²; m³ for a map of the space.
    pub credible_95: f64,
    /// How a number is packed.
    #[schemars(extend("enum" = [DTYPE]))]
    pub dtype: &'static str,
}

/// What is run.
#[derive(Serialize, JsonSchema)]
pub struct ScenarioMessage {
    /// Name of the scenario.
    pub name: String,
    /// The seed.
    pub seed: u64,
    /// The scenario as written (RON).
    pub ron: String,
}

/// What is there before the run, to be drawn; scene.json in the recording. See docs/interfaces.md.
#[derive(Serialize, JsonSchema)]
pub struct SceneMessage {
    /// Version of the form of this document.
    pub version: u32,
    /// Id of the run in keys.
    pub run: String,
    /// Name of the scenario.
    pub scenario: String,
    /// Its title.
    pub title: String,
    /// The seed.
    pub seed: u64,
    /// Operating area: corners_m (east, north), m.
    pub area: Map<String, Value>,
    /// Its centre (east, north), m; bed and solids are placed from there.
    pub origin_m: [f64; 2],
    /// Bed as a grid: shape [rows, columns]; points_m, base64 of f32 (east, north, up), m.
    pub bed: Map<String, Value>,
    /// Whether the surface of the water is worth drawing.
    pub surface: bool,
    /// Obstacles: name, color, vertices_m (base64 of f32), triangles (base64 of u32).
    pub solids: Vec<Map<String, Value>>,
    /// True sources: name, position_m.
    pub sources: Vec<Map<String, Value>>,
    /// Interfaces between layers of the water: name, z_m.
    pub layers: Vec<Map<String, Value>>,
    /// Robots and gantries: links with shapes, joints, drives, sensors.
    pub machines: Vec<Map<String, Value>>,
}

/// By what it is run.
#[derive(Serialize, JsonSchema)]
pub struct VersionMessage {
    /// The program.
    pub program: &'static str,
    /// Its version.
    pub version: String,
}

/// Digest of all states, declarations and the outcome: equal digests, equal runs.
#[derive(Serialize, JsonSchema)]
pub struct DigestMessage {
    /// The digest.
    pub digest: String,
}

/// JSON Schema of a topic.
#[derive(JsonSchema)]
pub struct SchemaMessage {
    /// Version of JSON Schema.
    #[schemars(rename = "$schema")]
    pub draft: String,
    /// Name of the topic.
    pub title: String,
    /// What it contains.
    pub description: String,
    /// Type of a message.
    pub r#type: String,
}
