//! The topics that robots publish, and their messages.

use crate::topic::run::{DTYPE, STATE_RATE};
use crate::topic::{Payload, Topic};
use robots::handoff::Behaviour;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The topics of each robot.
pub const TOPICS: &[Topic] = &[
    Topic::of::<TruthMessage>("truth", "auv/<id>/truth", STATE_RATE),
    Topic::of::<EstimateMessage>("estimate", "auv/<id>/estimate", STATE_RATE),
    Topic::of::<GoalMessage>("goal", "auv/<id>/goal", STATE_RATE),
    Topic::of::<CommandMessage>("command", "auv/<id>/command", STATE_RATE),
    Topic::of::<ChemicalMessage>("chemical", "auv/<id>/chemical", STATE_RATE),
    Topic::of::<FlowMessage>("flow", "auv/<id>/flow", STATE_RATE),
    Topic::of::<BehaviourMessage>("behaviour", "auv/<id>/behaviour", STATE_RATE),
    Topic::of::<RangingMessage>("ranging", "auv/<id>/ranging", STATE_RATE),
    Topic::of::<ReadingsMessage>("readings", "auv/<id>/readings", STATE_RATE),
    Topic::of::<LayersMessage>("layers", "auv/<id>/layers", STATE_RATE),
    Topic::of::<DeclarationMessage>("declaration", "auv/<id>/declaration/<number>", "with the state, once made"),
    Topic::of::<PictureMessage>(
        "picture",
        "auv/<id>/picture",
        "at most 2 a second, of a vehicle with a camera; as PNG, without loss, in the recording",
    )
    .packed(Payload::Jpeg),
    Topic::of::<SidescanMessage>("sidescan", "auv/<id>/sidescan", "at most 20 a second, of a vehicle with a sidescan")
        .packed(Payload::PackedF32),
];

/// The manoeuvres of a goal.
const MANOEUVRES: [&str; 10] = [
    "go_to_point",
    "follow_line",
    "go_to_point_with_heading",
    "hold",
    "slide_to",
    "course",
    "steer",
    "slide",
    "drives",
    "direct",
];
/// What the vertical part of a goal keeps.
const VERTICALS: [&str; 2] = ["altitude", "depth"];

/// The schemas of a behaviour's name: one of ours, or one that a strategy of another crate gives its own.
fn behaviours() -> [Value; 2] {
    let ours = json!({"type": "string", "enum": Behaviour::ALL.map(Behaviour::name)});
    [ours, json!({"type": "string", "pattern": "^[a-z0-9_]+$"})]
}

/// Where the vehicle is.
#[derive(Serialize, JsonSchema)]
pub struct TruthMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Origin of the body frame (east, north, up), m; z = 0 is the still surface.
    pub position_m: [f64; 3],
    /// Rotation taking body axes (forward, left, up) to world axes (ENU).
    pub quaternion_xyzw: [f64; 4],
    /// Compass heading, clockwise from north, rad.
    pub heading_rad: f64,
    /// Velocity over ground (east, north, up), m/s.
    pub velocity_m_s: [f64; 3],
    /// Angular velocity in body axes (forward, left, up), rad/s.
    pub rates_rad_s: [f64; 3],
    /// Height above the bed, m.
    pub altitude_m: f64,
}

/// Where the vehicle believes it is.
#[derive(Serialize, JsonSchema)]
pub struct EstimateMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Believed position (east, north), m.
    pub position_m: [f64; 2],
    /// Believed depth below the still surface, m.
    pub depth_m: f64,
    /// Believed height above the bed, m; absent until the altimeter first heard the bed.
    pub altitude_m: Option<f64>,
    /// Believed compass heading, clockwise from north, rad.
    pub heading_rad: f64,
    /// Believed roll, right side down positive, rad.
    pub roll_rad: f64,
    /// Believed pitch, nose up positive, rad.
    pub pitch_rad: f64,
    /// Believed velocity over ground (east, north), m/s.
    pub velocity_m_s: [f64; 2],
    /// How far the newest position fix moved the estimate, m, in the step in which it came; else zero.
    pub fix_jump_m: f64,
}

/// What the strategy asks of the guidance.
#[derive(Default, Serialize, JsonSchema)]
pub struct GoalMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Number of the goal, growing by one with each new one.
    pub id: u32,
    /// Horizontal part.
    #[schemars(extend("enum" = MANOEUVRES))]
    pub manoeuvre: &'static str,
    /// Destination, or end of the line (east, north), m.
    pub point_m: Option<[f64; 2]>,
    /// Start of the line (east, north), m.
    pub from_m: Option<[f64; 2]>,
    /// Arrival radius, m; absent for the guidance's own.
    pub radius_m: Option<f64>,
    /// Heading on arrival, to hold or to steer, or course over ground, clockwise from north, rad.
    pub heading_rad: Option<f64>,
    /// Velocity over ground to slide with (east, north), m/s.
    pub velocity_m_s: Option<[f64; 2]>,
    /// Set-points of the vehicle's own drives, in their order.
    pub drives: Option<Vec<f64>>,
    /// What the vertical part keeps.
    #[schemars(extend("enum" = VERTICALS))]
    pub vertical: &'static str,
    /// Height above the bed or depth to keep, m.
    pub vertical_m: f64,
    /// Speed over ground wished for, m/s.
    pub speed_m_s: f64,
}

/// What the guidance asks of the autopilot, and the autopilot of the vehicle's drives.
#[derive(Default, Serialize, JsonSchema)]
pub struct CommandMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Through the autopilot as heading and speed or as a velocity over ground, or straight to the actuators.
    #[schemars(extend("enum" = ["steer", "move", "direct"]))]
    pub kind: &'static str,
    /// Heading to steer, clockwise from north, rad.
    pub heading_rad: Option<f64>,
    /// Speed through the water, m/s; over ground for a vehicle that the water does not carry.
    pub water_speed_m_s: Option<f64>,
    /// Velocity over ground of a vehicle that hovers, eastwards, m/s.
    pub east_m_s: Option<f64>,
    /// The same northwards, m/s.
    pub north_m_s: Option<f64>,
    /// What the vertical part keeps, if the vehicle keeps a height.
    #[schemars(extend("enum" = VERTICALS))]
    pub vertical: Option<&'static str>,
    /// Height above the bed or depth to keep, m.
    pub vertical_m: Option<f64>,
    /// Rudder asked for, positive turns to starboard, rad; of a vehicle with fins, as the next two.
    pub rudder_rad: Option<f64>,
    /// Stern plane asked for, positive pitches the nose down, rad.
    pub stern_rad: Option<f64>,
    /// Propeller speed asked for, 1/min.
    pub rpm: Option<f64>,
    /// Turn rate asked for, positive to starboard, rad/s; of a kinematic vehicle, as the next two.
    pub turn_rad_s: Option<f64>,
    /// Upward speed asked for, m/s.
    pub climb_m_s: Option<f64>,
    /// Speed ahead asked for, m/s.
    pub speed_m_s: Option<f64>,
    /// Set-points of the drives of a folder's vehicle, in the order of its file: inputs of thrusters, angles of fins in
    /// rad, volumes in m3, places of masses in m.
    pub drives: Option<Vec<f64>>,
}

/// Newest reading of the chemical sensor.
#[derive(Serialize, JsonSchema)]
pub struct ChemicalMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Output, V.
    pub volts: f64,
    /// Output as a share of full scale, 0 to 1.
    pub of_full_scale: f64,
    /// The newest reading is above the detection threshold.
    pub above_threshold: bool,
    /// A detection happened since the message before, superseded states included.
    pub detected: bool,
}

/// Flow at the vehicle, as it believes; absent until first measured.
#[derive(Serialize, JsonSchema)]
pub struct FlowMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Velocity of the water over ground (east, north), m/s; where it goes.
    pub velocity_m_s: [f64; 2],
    /// Where the water goes, clockwise from north, rad.
    pub heading_rad: f64,
    /// Age of the newest measurement in it, s.
    pub age_s: f64,
}

/// What the vehicle is doing.
#[derive(Default, Serialize, JsonSchema)]
pub struct BehaviourMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Its name.
    #[schemars(extend("anyOf" = behaviours()))]
    pub behaviour: &'static str,
    /// Where it lost the plume, as it believes (east, north), m.
    pub lost_points_m: Vec<[f64; 2]>,
    /// Last detection points that its declaration rule looked at last (east, north), m; absent while they are too few.
    pub zone_points_m: Option<Vec<[f64; 2]>>,
    /// Corners of the zone that they make for the rule (east, north), m.
    pub zone_m: Option<Vec<[f64; 2]>>,
    /// Subregion it searches, from 0; absent in transits and where the area is one.
    pub region: Option<u32>,
    /// Its name on maps and in tables: a letter, in the order of search.
    pub region_name: Option<String>,
    /// The corners of that subregion (east, north), m.
    pub region_m: Option<Vec<[f64; 2]>>,
    /// What is wrong now: left the area, no bottom lock, no altitude, no flow, touched the bed or an obstacle, touched
    /// another vehicle, thrusters saturated, battery empty, behaviours alternated without progress, fault: and what
    /// fails; absent where nothing is.
    pub abnormal: Option<Vec<String>>,
}

/// Newest ping of the forward ranging; absent before the first.
#[derive(Serialize, JsonSchema)]
pub struct RangingMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// The instrument in body axes (forward, left, up), m.
    pub place_body_m: [f64; 3],
    /// Echoes in the same axes, m.
    pub echoes_body_m: Vec<[f64; 3]>,
    /// Its range, m.
    pub max_m: f64,
    /// Beams without an echo.
    pub free: usize,
}

/// Newest numbers of instruments of other crates; absent for a vehicle that has none.
#[derive(Serialize, JsonSchema)]
pub struct ReadingsMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// The numbers by name.
    pub numbers: BTreeMap<&'static str, f64>,
}

/// Who holds the vehicle among the layers of its planner; absent for a strategy without layers.
#[derive(Serialize, JsonSchema)]
pub struct LayersMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Their names, lowest first.
    pub layers: Vec<&'static str>,
    /// How each stands: silent, holds (the vehicle), suppressed (its command is replaced by a higher layer's) or
    /// inhibited (its input is taken away).
    pub states: Vec<&'static str>,
    /// Name of the one that holds.
    pub holds: Option<&'static str>,
}

/// A source the vehicle declared, or (rule up_flow_edge) where it traced a plume out of a subregion; said again under
/// the same number when it was looked at.
#[derive(Serialize, JsonSchema)]
pub struct DeclarationMessage {
    /// Simulated time of the declaration, s.
    pub t_s: f64,
    /// Its number among the vehicle's declarations, from 0.
    pub number: u32,
    /// Where, as the vehicle believes (east, north), m.
    pub position_m: [f64; 2],
    /// By which rule.
    pub rule: &'static str,
    /// What a look at it said.
    #[schemars(extend("enum" = ["unchecked", "verified", "rejected", "cannot_tell"]))]
    pub verdict: &'static str,
    /// Subregion in which it was made, from 0; absent where the area is one.
    pub region: Option<u32>,
    /// The subregion's name: a letter, in the order of search.
    pub region_name: Option<String>,
    /// Where the sidescan, or its pictures added up, have the source, as the vehicle believes (east, north), m.
    pub surveyed_m: Option<[f64; 2]>,
    /// Pictures that were added up for the verdict.
    pub pictures: Option<u32>,
    /// Natural logarithm of their Bayes factor: positive speaks for a source.
    pub log_factor: Option<f64>,
}

/// Newest picture of the vehicle's camera, as JPEG; halved in size until it fits into a message.
#[derive(Serialize, JsonSchema)]
pub struct PictureMessage {
    /// Simulated time at which it was taken, s.
    pub t_s: f64,
    /// Pictures the vehicle has taken so far, this one and those superseded included.
    pub taken: u64,
    /// Its width, pixels.
    pub width: u32,
    /// Its height, pixels.
    pub height: u32,
    /// Full horizontal angle of view, rad.
    pub view_rad: f64,
    /// The camera, as the vehicle believes (east, north, up), m.
    pub position_m: [f64; 3],
    /// Rotation taking camera axes (right in the picture, down, into the scene) to world axes (ENU), as the vehicle
    /// believes.
    pub quaternion_xyzw: [f64; 4],
}

/// Newest ping of the vehicle's sidescan sonar: strength of the echo (dB above the noise floor's reference), nearest
/// first, to port and then to starboard, packed little-endian f32.
#[derive(Serialize, JsonSchema)]
pub struct SidescanMessage {
    /// Simulated time of the ping, s.
    pub t_s: f64,
    /// Pings so far, this one and those superseded included.
    pub taken: u64,
    /// Samples to port.
    pub port: usize,
    /// Samples to starboard.
    pub starboard: usize,
    /// Slant range of the last sample's far end, m; the samples of a side divide it evenly.
    pub max_m: f64,
    /// The sonar, as the vehicle believes (east, north, up), m.
    pub position_m: [f64; 3],
    /// Believed compass heading, clockwise from north, rad; port lies to its left.
    pub heading_rad: f64,
    /// Believed height of the vehicle above the bed, m; absent until the altimeter first heard the bed.
    pub altitude_m: Option<f64>,
    /// How a number is packed.
    #[schemars(extend("enum" = [DTYPE]))]
    pub dtype: &'static str,
}
