//! The topics that gantries publish, and their messages.

use crate::topic::Topic;
use crate::topic::run::STATE_RATE;
use robots::handoff::Behaviour;
use schemars::JsonSchema;
use serde::Serialize;

/// The topics of each gantry.
pub const TOPICS: &[Topic] = &[
    Topic::of::<JointsMessage>("joints", "gantry/<id>/joints", STATE_RATE),
    Topic::of::<ProbesMessage>("probes", "gantry/<id>/probes", STATE_RATE),
    Topic::of::<SpikesMessage>("spikes", "gantry/<id>/spikes", STATE_RATE),
    Topic::of::<GantryBehaviourMessage>("gantry_behaviour", "gantry/<id>/behaviour", STATE_RATE),
    Topic::of::<GantryDeclarationMessage>("gantry_declaration", "gantry/<id>/declaration", "with the state, once made"),
];

/// Where a gantry's head is and what its drives do; names, positions, velocities and efforts as in a ROS JointState.
#[derive(Serialize, JsonSchema)]
pub struct JointsMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// The two joints: along the stream, across it.
    pub name: Vec<String>,
    /// True position of each joint, m.
    pub position_m: Vec<f64>,
    /// True speed of each joint, m/s.
    pub velocity_m_s: Vec<f64>,
    /// Force of each drive, N.
    pub effort_n: Vec<f64>,
    /// The head (east, north, up), m; z = 0 is the still surface.
    pub head_m: [f64; 3],
    /// The head by its encoders, in the gantry's frame (forward, left), m.
    pub encoder_m: [f64; 2],
    /// Where the head is to go, in the gantry's frame (forward, left), m.
    pub target_m: [f64; 2],
    /// Both drives have reached the target.
    pub arrived: bool,
    /// A drive gave up against something in the way.
    pub blocked: bool,
    /// What the gantry touches.
    pub touching: Option<String>,
}

/// Newest scan of a gantry's probes; absent until the first.
#[derive(Serialize, JsonSchema)]
pub struct ProbesMessage {
    /// Simulated time of the scan, s.
    pub t_s: f64,
    /// Tip of each probe (east, north, up), m, in the order of the URDF.
    pub position_m: Vec<[f64; 3]>,
    /// Output of each probe, V.
    pub volts: Vec<f64>,
}

/// What a gantry's searcher makes of its probes.
#[derive(Serialize, JsonSchema)]
pub struct SpikesMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Spike threshold of each probe, V.
    pub threshold_v: Vec<f64>,
    /// A spike was found on the probe since the message before, superseded states included.
    pub spike: Vec<bool>,
    /// Spikes a second lately, Hz.
    pub spike_hz: f64,
    /// Mean spike magnitude since the latest step, V above the bottom of the range.
    pub magnitude_v: f64,
    /// Predicted magnitude of the present step, V above the bottom of the range.
    pub predicted_v: Option<f64>,
    /// Contrast between the sides, left positive, −1 to 1.
    pub contrast: f64,
}

/// What a gantry's searcher is doing.
#[derive(Serialize, JsonSchema)]
pub struct GantryBehaviourMessage {
    /// Simulated time, s; zero is the start of the mission.
    pub t_s: f64,
    /// Its name.
    #[schemars(extend("enum" = Behaviour::OF_GANTRY.map(Behaviour::name)))]
    pub behaviour: &'static str,
    /// Number of the motion command, growing by one with each new one.
    pub r#move: u32,
    /// There once it stopped: true when it declared a source, false when it gave up.
    pub found: Option<bool>,
}

/// The source a gantry's searcher declared: where it stopped.
#[derive(Serialize, JsonSchema)]
pub struct GantryDeclarationMessage {
    /// Simulated time of the declaration, s.
    pub t_s: f64,
    /// Where its encoders have the head (east, north), m.
    pub position_m: [f64; 2],
    /// By which rule.
    pub rule: &'static str,
}
