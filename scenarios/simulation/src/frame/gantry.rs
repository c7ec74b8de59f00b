//! A gantry at one instant.

use nalgebra::{Vector2, Vector3};
use robots::handoff::{Behaviour, Declaration, HeadGoal, JointReadings, Outcome, ProbeScan, TrackerState};
use world::physics::JointState;

/// One gantry at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct GantryFrame {
    /// Its id in the scenario.
    pub id: String,
    /// Names of its joints.
    pub joint_names: [String; 2],
    /// True joints, in the order of their names.
    pub joints: [JointState; 2],
    /// What its encoders and drives report.
    pub readings: JointReadings,
    /// Its forward direction in the world (east, north).
    pub forward: Vector2<f64>,
    /// True place of its head (ENU), m.
    pub head_W: Vector3<f64>,
    /// True places of its probes' tips (ENU), m.
    pub tips_W: Vec<Vector3<f64>>,
    /// Latest scan of its probes.
    pub scan: Option<ProbeScan>,
    /// What it is doing.
    pub behaviour: Behaviour,
    /// Where its searcher wants the head.
    pub goal: HeadGoal,
    /// How its search ended.
    pub outcome: Option<Outcome>,
    /// What its searcher shows of itself.
    pub shown: TrackerState,
    /// What it touches, by name.
    pub touching: Option<String>,
    /// Its declarations so far, by number.
    pub declarations: Vec<Declaration>,
}

impl GantryFrame {
    /// Set when it has stopped: whether it declared a source.
    pub fn stopped(&self) -> Option<bool> {
        self.outcome.map(|outcome| outcome == Outcome::Completed)
    }
}
