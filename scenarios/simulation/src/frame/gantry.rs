//! A gantry at one instant.

use nalgebra::{Vector2, Vector3};
use robots::handoff::{Declaration, GantryDecision, JointReadings, ProbeScan};
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
    /// What its searcher decided.
    pub decision: GantryDecision,
    /// What it touches, by name.
    pub touching: Option<String>,
    /// Its declaration, once made.
    pub declaration: Option<Declaration>,
}
