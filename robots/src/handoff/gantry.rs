//! What the parts of a gantry hand to each other: probe samples, joint readings, what is known of the machine, and the
//! state of its tracker. Where the head is to go is a [`HeadGoal`](super::HeadGoal).
//!
//! All positions are in the gantry's own frame: forward along x of its URDF's base (up-stream in the usual set-up in
//! a flume), left along y, zero where the URDF has both joints at zero. The searcher has no other frame: it knows
//! neither the flume's coordinates nor the flow.

use super::ReplyOutcome;
use bevy_ecs::prelude::Component;
use nalgebra::{Vector2, Vector3};

/// Most probes a head can carry.
pub const MAX_PROBES: usize = 8;

/// One scan of all probes, in the order of [`GantryLayout::probes`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbeScan {
    /// When it was taken, s.
    pub t_s: f64,
    /// Output of each probe, V; entries beyond `count` are meaningless.
    pub volts: [f64; MAX_PROBES],
    /// How many probes there are.
    pub count: usize,
}

/// What the encoders and drives report.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointReadings {
    /// Encoder positions (forward, left), m.
    pub position_m: Vector2<f64>,
    /// Speeds (forward, left), m/s.
    pub speed_m_s: Vector2<f64>,
    /// The commanded target is reached on both axes.
    pub arrived: bool,
    /// A drive gave up because something is in the way.
    pub blocked: bool,
}

/// Readings of a gantry in one tick.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct GantryReadings {
    /// A scan, in ticks when one was taken.
    pub scan: Option<ProbeScan>,
    /// Joints.
    pub joints: JointReadings,
}

/// A probe's place on the head.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeMount {
    /// Name of its link in the URDF.
    pub name: String,
    /// Tip, relative to the head's reference point (forward, left, up), m.
    pub offset_m: Vector3<f64>,
}

/// What a searcher may know of its machine.
#[derive(Clone, Debug, PartialEq)]
pub struct GantryLayout {
    /// Travel of each axis (forward, left): least and greatest position, m.
    pub travel_m: [[f64; 2]; 2],
    /// Greatest speed of each axis, m/s.
    pub max_speed_m_s: [f64; 2],
    /// Probes, in the order of a scan.
    pub probes: Vec<ProbeMount>,
    /// Output range of the probes, V.
    pub range_v: [f64; 2],
    /// Scans per second, Hz.
    pub scan_hz: f64,
}

/// What a gantry's searcher sees in one tick.
#[derive(Clone, Debug, PartialEq)]
pub struct GantryObservation {
    /// Time, s.
    pub t_s: f64,
    /// Readings.
    pub readings: GantryReadings,
    /// What a searcher outside this program was heard to say in this tick, if it was asked.
    pub told: Option<ReplyOutcome>,
}

/// Present state of the tracker's units, for records and figures. A searcher without such a unit leaves the default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrackerState {
    /// Dynamic threshold of each probe, V.
    pub threshold_v: [f64; MAX_PROBES],
    /// A spike was found on the probe in this scan.
    pub spike: [bool; MAX_PROBES],
    /// Spikes a second lately, Hz.
    pub spike_hz: f64,
    /// Mean spike magnitude since the latest step, V above the bottom of the range.
    pub magnitude_v: f64,
    /// Predicted magnitude of the present step, V above the bottom of the range.
    pub predicted_v: Option<f64>,
    /// Bilateral contrast, left positive, -1 to 1.
    pub contrast: f64,
}
