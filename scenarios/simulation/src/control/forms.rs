//! The forms in which answers are written: JSON, SI units, radians, compass headings.
//!
//! A field that is left out, or `null`, stays as it is. [`answers`](super::answers) turns them into what a robot takes.

use robots::handoff::{Manoeuvre, Outcome};
use serde::{Deserialize, Serialize};

/// An answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AnswerForm {
    /// The question's number, if it is repeated.
    pub(super) number: Option<u64>,
    pub(super) goal: Option<GoalForm>,
    pub(super) steer: Option<SteerForm>,
    pub(super) slide: Option<SlideForm>,
    pub(super) drives: Option<DrivesForm>,
    pub(super) head: Option<HeadForm>,
    pub(super) behaviour: Option<String>,
    pub(super) declare: Option<DeclareForm>,
    pub(super) picture: Option<bool>,
    pub(super) end: Option<Outcome>,
}

/// A goal for the guidance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalForm {
    pub(super) manoeuvre: Manoeuvre,
    pub(super) depth_m: Option<f64>,
    pub(super) altitude_m: Option<f64>,
    pub(super) speed_m_s: Option<f64>,
    pub(super) id: Option<u32>,
}

/// A set-point for the autopilot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SteerForm {
    pub(super) heading_rad: f64,
    pub(super) depth_m: Option<f64>,
    pub(super) altitude_m: Option<f64>,
    pub(super) speed_m_s: Option<f64>,
    pub(super) id: Option<u32>,
}

/// A set-point for the autopilot of a vehicle that hovers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SlideForm {
    pub(super) heading_rad: f64,
    pub(super) velocity_m_s: [f64; 2],
    pub(super) depth_m: Option<f64>,
    pub(super) altitude_m: Option<f64>,
    pub(super) id: Option<u32>,
}

/// Set-points of the vehicle's drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DrivesForm {
    pub(super) set: Vec<f64>,
    pub(super) id: Option<u32>,
}

/// Where a gantry's head goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HeadForm {
    pub(super) target_m: [f64; 2],
    pub(super) speed_m_s: Option<[f64; 2]>,
    pub(super) behaviour: Option<String>,
    pub(super) id: Option<u32>,
}

/// A declaration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DeclareForm {
    pub(super) position_m: [f64; 2],
    pub(super) rule: Option<String>,
    #[serde(default)]
    pub(super) number: u32,
}
