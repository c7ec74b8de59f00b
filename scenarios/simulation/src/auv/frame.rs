//! A robot at one instant, its pictures and its pings, for those who look on.

use bevy_ecs::prelude::Component;
use nalgebra::{Vector2, Vector3};
use robots::handoff::{
    ActuatorCommand, Behaviour, Belief, ChemicalReading, Command, Declaration, Estimate, Goal,
    Layer, LayerState, Picture, Regions, SidescanPing,
};
use std::sync::Arc;
use world::frames::{Pose, Truth};

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

/// A picture that a robot's camera took.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureFrame {
    /// Simulated time, s.
    pub t_s: f64,
    /// Id of the robot in the scenario.
    pub robot: String,
    /// The picture, with the camera's place on the robot.
    pub picture: Picture,
    /// Where the robot was.
    pub truth: Pose,
    /// Where it believed it was.
    pub estimate: Estimate,
}

impl PictureFrame {
    /// One just taken.
    #[must_use]
    pub fn new(t_s: f64, id: &str, picture: &Picture, truth: &Truth, estimate: &Estimate) -> Self {
        Self {
            t_s,
            robot: id.to_owned(),
            picture: picture.clone(),
            truth: truth.pose,
            estimate: *estimate,
        }
    }
}

/// A ping of a robot's sidescan sonar.
#[derive(Clone, Debug, PartialEq)]
pub struct PingFrame {
    /// Simulated time, s.
    pub t_s: f64,
    /// Id of the robot in the scenario.
    pub robot: String,
    /// What it heard.
    pub ping: SidescanPing,
    /// Where it believed it was.
    pub estimate: Estimate,
}

impl PingFrame {
    /// One just heard.
    #[must_use]
    pub fn new(t_s: f64, id: &str, ping: &SidescanPing, estimate: &Estimate) -> Self {
        Self {
            t_s,
            robot: id.to_owned(),
            ping: ping.clone(),
            estimate: *estimate,
        }
    }
}

/// What a robot's log keeps between two frames.
#[derive(Component, Clone, Debug, Default)]
pub(crate) struct Log {
    pub(crate) chemical: Option<ChemicalReading>,
    pub(crate) detected: bool,
    pub(crate) fix_m: Option<f64>,
    pub(crate) over: bool,
}
