//! The forms in which answers are written: JSON, SI units, radians, compass headings.
//!
//! A field that is left out stays as it is. [`answers`](super::answers) turns them into what a robot takes.

use serde::{Deserialize, Serialize};

/// An answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AnswerForm {
    /// The question's number, if it is repeated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) number: Option<u64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) goal: Option<GoalForm>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) steer: Option<SteerForm>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) slide: Option<SlideForm>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) drives: Option<DrivesForm>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) head: Option<HeadForm>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) behaviour: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) declare: Option<DeclareForm>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) picture: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) end: Option<EndForm>,
}

/// A goal for the guidance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalForm {
    pub(super) manoeuvre: ManoeuvreForm,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) depth_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) altitude_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) speed_m_s: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) id: Option<u32>,
}

/// The manoeuvres of a goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub(super) enum ManoeuvreForm {
    GoToPoint {
        point_m: [f64; 2],
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_m: Option<f64>,
    },
    FollowLine {
        from_m: [f64; 2],
        to_m: [f64; 2],
    },
    GoToPointWithHeading {
        point_m: [f64; 2],
        heading_rad: f64,
    },
    Hold {
        point_m: [f64; 2],
        #[serde(default, skip_serializing_if = "Option::is_none")]
        heading_rad: Option<f64>,
    },
    SlideTo {
        point_m: [f64; 2],
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_m: Option<f64>,
        heading_rad: f64,
    },
    Course {
        heading_rad: f64,
    },
    Direct {
        rudder_rad: f64,
        stern_rad: f64,
        rpm: f64,
    },
}

/// A set-point for the autopilot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SteerForm {
    pub(super) heading_rad: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) depth_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) altitude_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) speed_m_s: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) id: Option<u32>,
}

/// A set-point for the autopilot of a vehicle that hovers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SlideForm {
    pub(super) heading_rad: f64,
    pub(super) velocity_m_s: [f64; 2],
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) depth_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) altitude_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) id: Option<u32>,
}

/// Set-points of the vehicle's drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DrivesForm {
    pub(super) set: Vec<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) id: Option<u32>,
}

/// Where a gantry's head goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HeadForm {
    pub(super) target_m: [f64; 2],
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) speed_m_s: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) behaviour: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) id: Option<u32>,
}

/// A declaration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DeclareForm {
    pub(super) position_m: [f64; 2],
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) rule: Option<String>,
    #[serde(default)]
    pub(super) number: u32,
}

/// The end of a mission.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum EndForm {
    Completed,
    Aborted,
}
