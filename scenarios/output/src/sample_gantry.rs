//! Invented gantries for tests.

use nalgebra::{Vector2, Vector3};
use rheotaxis::gantry::GantryFrame;
use robots::handoff::{Behaviour, HeadGoal, JointReadings, TrackerState};
use world::physics::JointState;

/// A gantry that faces west, with its head at (east, north), m.
pub(crate) fn gantry(east_m: f64, north_m: f64, behaviour: Behaviour) -> GantryFrame {
    let head_W = Vector3::new(east_m, north_m, -0.125);
    GantryFrame {
        id: "crab0".into(),
        joint_names: ["along".into(), "across".into()],
        joints: [JointState::default(); 2],
        readings: JointReadings::default(),
        forward: Vector2::new(-1.0, 0.0),
        head_W,
        tips_W: vec![head_W],
        scan: None,
        behaviour,
        goal: HeadGoal { id: 1, ..HeadGoal::default() },
        outcome: None,
        shown: TrackerState::default(),
        touching: None,
        declarations: Vec::new(),
    }
}
