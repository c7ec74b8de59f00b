//! The searchers of an environment: what they are, what they see as numbers, and what their actions mean.

use nalgebra::Vector3;
use rheotaxis::error::AssembleError;
use rheotaxis::ocean::Ocean;
use rheotaxis::scenario::{FolderFiles, Loaded};
use robots::handoff::GantryLayout;
use robots::strategy::{self, StrategySpec};
use robots::track::{self, GantryStrategySpec};
use robots::vehicles::Gantry;
use world::frames::Pose;
use world::ranges::Positive;

/// A number of an observation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Feature {
    pub(crate) name: String,
    pub(crate) low: f32,
    pub(crate) high: f32,
}

/// A searcher of the scenario.
#[derive(Clone, Debug)]
pub(crate) struct Agent {
    /// Its id in the scenario.
    pub(crate) id: String,
    /// What it is.
    pub(crate) machine: Machine,
    /// The numbers of its observation.
    pub(crate) features: Vec<Feature>,
}

/// What a searcher is.
#[derive(Clone, Debug)]
pub(crate) enum Machine {
    /// A vehicle; whether its set-point is an altitude rather than a depth.
    Robot { altitude: bool },
    /// A gantry, with the pose of its base.
    Gantry { layout: GantryLayout, base: Pose },
}

/// Numbers of a robot's observation, with their bounds.
const ROBOT: [(&str, f32, f32); 17] = [
    ("reading", 0.0, 1.0),
    ("mean_reading", 0.0, 1.0),
    ("highest_reading", 0.0, 1.0),
    ("hits", 0.0, 1.0),
    ("since_hit", 0.0, 1.0),
    ("flow_forward_m_s", -3.0, 3.0),
    ("flow_left_m_s", -3.0, 3.0),
    ("flow_known", 0.0, 1.0),
    ("sin_heading", -1.0, 1.0),
    ("cos_heading", -1.0, 1.0),
    ("speed_forward_m_s", -5.0, 5.0),
    ("speed_left_m_s", -5.0, 5.0),
    ("altitude_10m", 0.0, 10.0),
    ("depth_10m", 0.0, 100.0),
    ("east_of_home", -4.0, 4.0),
    ("north_of_home", -4.0, 4.0),
    ("time", 0.0, 1.0),
];

/// Numbers of a gantry's observation, before those of its probes.
const GANTRY: [(&str, f32, f32); 5] =
    [("forward", -1.0, 1.0), ("left", -1.0, 1.0), ("arrived", 0.0, 1.0), ("blocked", 0.0, 1.0), ("time", 0.0, 1.0)];

impl Agent {
    fn new(id: String, machine: Machine) -> Self {
        Self { features: machine.features(), id, machine }
    }

    /// Numbers of an action, without the declaration.
    pub(crate) fn moves(&self) -> usize {
        match &self.machine {
            Machine::Robot { .. } => 3,
            Machine::Gantry { .. } => 2,
        }
    }

    /// True place of a gantry's head (ENU), m, from its joints (forward, left), m.
    pub(crate) fn head_W(base: &Pose, joints: [f64; 2]) -> Vector3<f64> {
        base.point(Vector3::new(joints[0], joints[1], 0.0))
    }
}

impl Machine {
    /// The numbers of its observation.
    fn features(&self) -> Vec<Feature> {
        let fixed =
            |(name, low, high): &(&str, f32, f32)| Feature { name: (*name).to_string(), low: *low, high: *high };
        match self {
            Machine::Robot { .. } => ROBOT.iter().map(fixed).collect(),
            Machine::Gantry { layout, .. } => {
                let kinds = ["newest", "highest"];
                let probes = kinds.iter().flat_map(|kind| {
                    layout.probes.iter().map(move |probe| Feature {
                        name: format!("{}_{kind}", probe.name),
                        low: 0.0,
                        high: 1.0,
                    })
                });
                GANTRY.iter().map(fixed).chain(probes).collect()
            }
        }
    }
}

/// Hands all searchers of a scenario to this module: each is asked once a period. Returns them in the scenario's order.
///
/// # Errors
/// If the files of a gantry cannot be read.
pub(crate) fn take_over(loaded: &mut Loaded, ocean: &Ocean, period_s: f64) -> Result<Vec<Agent>, AssembleError> {
    let period_s = Positive::new(period_s);
    let mut agents = Vec::new();
    for robot in &mut loaded.scenario.robots {
        robot.strategy = StrategySpec::new(strategy::ExternalSpec { period_s, ..Default::default() });
        let altitude = robot.start.altitude_m.is_some();
        let id = robot.id.as_str().to_string();
        agents.push(Agent::new(id, Machine::Robot { altitude }));
    }
    for block in &mut loaded.scenario.gantries {
        block.tracker = GantryStrategySpec::new(track::ExternalSpec { period_s, ..Default::default() });
        let id = block.id.as_str().to_string();
        let gantry = Gantry::load(&block.gantry, &FolderFiles(&loaded.base_dir));
        let gantry = gantry.map_err(|source| AssembleError::Robot { id: id.clone(), source })?;
        let machine = Machine::Gantry { layout: block.layout(&gantry), base: block.base(&ocean.terrain) };
        agents.push(Agent::new(id, machine));
    }
    Ok(agents)
}
