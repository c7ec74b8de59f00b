//! A picture of the whole run at one instant, as plain data: what recording, live state, files and
//! figures are made from. Made in the Report stage; nobody who reads it can reach back.

use crate::gantry::GantryFrame;
use nalgebra::{Vector2, Vector3};
use robots::handoff::{
    ActuatorCommand, Behaviour, Belief, ChemicalReading, Command, Declaration, Estimate, Goal,
    Layer, LayerState, Regions,
};
use std::sync::Arc;
use world::frames::Truth;

/// One robot at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotFrame {
    /// Its id in the scenario.
    pub id: String,
    /// Where it is.
    pub truth: Truth,
    /// True height above the bed, m.
    pub altitude_m: f64,
    /// Where it believes it is.
    pub estimate: Estimate,
    /// What its strategy asks for.
    pub goal: Option<Goal>,
    /// What its guidance asks for.
    pub command: Option<Command>,
    /// What the autopilot asks of the actuators.
    pub actuators: ActuatorCommand,
    /// Newest chemical reading.
    pub chemical: Option<ChemicalReading>,
    /// A detection happened since the frame before.
    pub detected: bool,
    /// What it is doing.
    pub behaviour: Behaviour,
    /// Layers of its planner, lowest first; empty for a strategy without.
    pub layers: Arc<[Layer]>,
    /// Points where it lost the plume, as it believes (east, north), m.
    pub lost_points: Vec<Vector2<f64>>,
    /// The path it means to take (ENU), m; empty without one.
    pub planned: Arc<Vec<Vector3<f64>>>,
    /// Where it believes the source may be, if it keeps a map; renewed only when [`Belief::updates`] has grown.
    pub belief: Option<Belief>,
    /// The subregions of its mission; none where the area is one.
    pub regions: Regions,
    /// Its declarations so far, by number.
    pub declarations: Vec<Declaration>,
    /// How far position fixes moved what it believes since the frame before, the farthest of them, m; `None` when
    /// none came.
    pub fix_m: Option<f64>,
}

impl RobotFrame {
    /// Name of the layer that holds the vehicle.
    #[must_use]
    pub fn holding_layer(&self) -> Option<&'static str> {
        let holds = |l: &&Layer| l.state == LayerState::Holds;
        self.layers.iter().find(holds).map(|l| l.name)
    }
}

/// The run at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Simulated time, s; zero is the start of the mission, after the spin-up.
    pub t_s: f64,
    /// Step of the mission.
    pub step: u64,
    /// All robots, in the scenario's order.
    pub robots: Vec<RobotFrame>,
    /// All gantries, in the scenario's order.
    pub gantries: Vec<GantryFrame>,
}

/// Some of the plume's filaments at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlumeFrame {
    /// Simulated time, s.
    pub t_s: f64,
    /// How many filaments there are in all.
    pub total: usize,
    /// x, y, z (m, ENU), size (m), mass (kg) of each filament shown.
    pub points: Vec<[f32; 5]>,
}
