//! What a strategy decides in a tick.

use super::Goal;
use bevy_ecs::prelude::Component;
use nalgebra::{Vector2, Vector3};
use serde::Serialize;
use std::sync::Arc;

/// What the vehicle is doing, in the field's words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Hash, PartialOrd, Ord)]
#[serde(rename_all = "snake_case")]
pub enum Behaviour {
    /// Before the first decision.
    #[default]
    Idle,
    /// Actuators driven by a time table.
    OpenLoop,
    /// Going to a place, detections ignored.
    GoTo,
    /// Looking for the plume.
    Find,
    /// In the plume.
    TrackIn,
    /// Just lost the plume.
    TrackOut,
    /// Looking round the points where it was lost.
    Reacquire,
    /// Going home after the declaration, or giving up.
    GoHome,
    /// Mission over.
    Done,
    /// On a planned path to where the source is believed.
    FollowPath,
}

impl Behaviour {
    /// All behaviours, for tables and legends.
    pub const ALL: [Behaviour; 10] = [
        Behaviour::Idle,
        Behaviour::OpenLoop,
        Behaviour::GoTo,
        Behaviour::Find,
        Behaviour::TrackIn,
        Behaviour::TrackOut,
        Behaviour::Reacquire,
        Behaviour::GoHome,
        Behaviour::Done,
        Behaviour::FollowPath,
    ];

    /// Name as it stands in files and topics.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Behaviour::Idle => "idle",
            Behaviour::OpenLoop => "open_loop",
            Behaviour::GoTo => "go_to",
            Behaviour::Find => "find",
            Behaviour::TrackIn => "track_in",
            Behaviour::TrackOut => "track_out",
            Behaviour::Reacquire => "reacquire",
            Behaviour::GoHome => "go_home",
            Behaviour::Done => "done",
            Behaviour::FollowPath => "follow_path",
        }
    }
}

/// A declared source.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Declaration {
    /// When, s.
    pub t_s: f64,
    /// Where, as the vehicle believes (east, north), m.
    pub position: Vector2<f64>,
    /// By which rule.
    pub rule: &'static str,
}

/// How a mission ended, as the strategy sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Came to its planned end.
    Completed,
    /// Given up: too far outside the area.
    Aborted,
}

/// What a strategy decides in a tick.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Decision {
    /// What it is doing.
    pub behaviour: Behaviour,
    /// What it asks of the guidance.
    pub goal: Goal,
    /// Newly declared in this tick.
    pub declared: Option<Declaration>,
    /// Points where the plume was lost (east, north), m; changes seldom.
    pub lost_points: Vec<Vector2<f64>>,
    /// The path it means to take (ENU), m, the vehicle's place when it was planned first; empty without one.
    pub planned: Arc<Vec<Vector3<f64>>>,
    /// Set when the mission is over.
    pub outcome: Option<Outcome>,
}
