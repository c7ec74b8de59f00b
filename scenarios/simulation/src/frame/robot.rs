//! A robot at one instant, the pictures of its camera and the pings of its sidescan.

use super::NewestReadings;
use robots::handoff::{
    Actuation, Behaviour, Belief, ChemicalReading, Command, Declaration, Estimate, Goal, Layer, LayerState, Picture,
    Shown, SidescanPing, Vertical,
};
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
    /// Whether it keeps the height that is asked for: not a glider, nor a craft on the surface.
    pub keeps_height: bool,
    /// What the vehicle's drives are set to.
    pub actuators: Actuation,
    /// What its other instruments reported since the previous frame.
    pub readings: NewestReadings,
    /// Newest chemical reading.
    pub chemical: Option<ChemicalReading>,
    /// Whether there was a detection since the previous frame.
    pub detected: bool,
    /// What it is doing.
    pub behaviour: Behaviour,
    /// What its strategy shows of itself.
    pub shown: Shown,
    /// Its map of where the source may be, if it keeps one. It is new only if [`Belief::updates`] has grown.
    pub belief: Option<Belief>,
    /// Its declarations so far, by number.
    pub declarations: Vec<Declaration>,
    /// The largest shift of its estimate by a position fix since the previous frame, m; `None` without a fix.
    pub fix_m: Option<f64>,
}

impl RobotFrame {
    /// Depth or altitude that its guidance asks for, of a vehicle that keeps one.
    pub fn asked_height(&self) -> Option<Vertical> {
        let asked = match self.command? {
            Command::Steer(s) => s.vertical,
            Command::Move(s) => s.vertical,
            Command::Direct(_) | Command::Drives(_) => return None,
        };
        self.keeps_height.then_some(asked)
    }

    /// Name of the layer that controls the vehicle.
    pub fn holding_layer(&self) -> Option<&'static str> {
        let holds = |l: &&Layer| l.state == LayerState::Holds;
        self.shown.layers.iter().find(holds).map(|l| l.name)
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
    /// From a picture that was taken in this step.
    pub fn new(t_s: f64, id: &str, picture: &Picture, truth: &Truth, estimate: &Estimate) -> Self {
        Self { t_s, robot: id.to_owned(), picture: picture.clone(), truth: truth.pose, estimate: *estimate }
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
    /// From a ping of this step.
    pub fn new(t_s: f64, id: &str, ping: &SidescanPing, estimate: &Estimate) -> Self {
        Self { t_s, robot: id.to_owned(), ping: ping.clone(), estimate: *estimate }
    }
}
