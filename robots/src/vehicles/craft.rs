//! A vehicle of any kind that a scenario can choose for a robot.

use super::files::Files;
use super::folder::{FolderVehicle, of_folder, shipped};
use super::kinematic::Kinematic;
use super::kinematic_spec::Moves;
use super::spec::VehicleSpec;
use super::vehicle::Remus100;
use crate::error::RobotError;
use crate::handoff::{
    Actuation, ActuatorCommand, Capabilities, Control, NamedDrive, RateCommand, RateLimits, TurnLimit,
};
use nalgebra::Vector3;
use world::fields::Flow;
use world::frames::{Pose, Truth};
use world::physics::BodySpec;

/// A vehicle of any kind.
#[derive(Clone, Debug)]
pub enum Vehicle {
    /// With fins, a propeller and an equation of motion.
    Finned(Box<Remus100>),
    /// Without dynamics.
    Kinematic(Box<Kinematic>),
    /// Of a folder.
    Described(Box<FolderVehicle>),
}

/// Below this speed through the water the fins of a REMUS have little effect, m/s (see its autopilot).
const LEAST_FIN_M_S: f64 = 0.8;
impl Vehicle {
    /// Builds the vehicle that a scenario asks for; `files` gives the URDF and its meshes, if it names one.
    ///
    /// # Errors
    /// If a file cannot be read, or if the URDF is wrong or does not fit the vehicle.
    pub fn load(spec: &VehicleSpec, files: &dyn Files) -> Result<Self, RobotError> {
        Ok(match spec {
            VehicleSpec::Remus100(remus) => Self::Finned(Box::new(Remus100::load(remus, files)?)),
            VehicleSpec::Kinematic(spec) => Self::Kinematic(Box::new(Kinematic::load(spec, files)?)),
            VehicleSpec::Shipped(name) => Self::Described(Box::new(shipped(name, files)?)),
            VehicleSpec::File(folder) => Self::Described(Box::new(of_folder(folder, files)?)),
        })
    }

    /// Its limits, if it is kinematic.
    pub fn limits(&self) -> Option<RateLimits> {
        match self {
            Self::Finned(_) | Self::Described(_) => None,
            Self::Kinematic(vehicle) => Some(vehicle.limits()),
        }
    }

    /// What its autopilot knows of it.
    pub fn control(&self) -> Control {
        match self {
            Self::Finned(_) => Control::Fins,
            Self::Kinematic(vehicle) => Control::Rates(vehicle.limits()),
            Self::Described(vehicle) => Control::Drives(Box::new(vehicle.plant().clone())),
        }
    }

    /// What it can do; `turn_radius_m` is that of a REMUS under its guidance.
    pub fn capabilities(&self, turn_radius_m: f64) -> Capabilities {
        let swims = |least_speed_m_s, top_speed_m_s, turning_radius_m| Capabilities {
            least_speed_m_s,
            top_speed_m_s,
            turning_radius_m,
            ..Capabilities::default()
        };
        match self {
            Self::Finned(vehicle) => swims(LEAST_FIN_M_S, vehicle.top_speed_m_s(f64::MAX), turn_radius_m),
            Self::Kinematic(vehicle) => {
                let limits = vehicle.limits();
                let radius = match limits.turn {
                    TurnLimit::Rate(rad_s) => limits.speed_m_s / rad_s,
                    TurnLimit::Radius(m) => m,
                };
                swims(0.0, limits.speed_m_s, radius)
            }
            Self::Described(vehicle) => vehicle.capabilities(),
        }
    }

    /// Its drives that can fail; none of a kinematic vehicle, which moves as its helm asks.
    pub fn named_drives(&self) -> Vec<NamedDrive> {
        match self {
            Self::Finned(_) => NamedDrive::fins(),
            Self::Kinematic(_) => Vec::new(),
            Self::Described(vehicle) => vehicle.named_drives(),
        }
    }

    /// Electric power of its drives now, W; none of a kinematic vehicle.
    pub fn power_w(&self) -> f64 {
        match self {
            Self::Finned(vehicle) => vehicle.power_w(),
            Self::Kinematic(_) => 0.0,
            Self::Described(vehicle) => vehicle.power_w(),
        }
    }

    /// Set-points at which nothing moves it.
    pub fn idle(&self) -> Actuation {
        match self {
            Self::Finned(_) => Actuation::Fins(ActuatorCommand::default()),
            Self::Kinematic(_) => Actuation::Rates(RateCommand::default()),
            Self::Described(vehicle) => Actuation::Drives(vehicle.idle()),
        }
    }

    /// Whether the water carries it.
    pub fn is_carried(&self) -> bool {
        match self {
            Self::Finned(_) | Self::Described(_) => true,
            Self::Kinematic(vehicle) => vehicle.moves() == Moves::ThroughWater,
        }
    }

    /// Greatest speed with the propeller at `rpm`, or at its own limit, m/s: through still water, or over ground if
    /// the water does not carry it.
    pub fn top_speed_m_s(&self, rpm: f64) -> f64 {
        match self {
            Self::Finned(vehicle) => vehicle.top_speed_m_s(rpm),
            Self::Kinematic(vehicle) => vehicle.limits().speed_m_s,
            Self::Described(vehicle) => vehicle.capabilities().top_speed_m_s,
        }
    }

    /// Where the URDF's mass differs from that of the hydrodynamic parameters, and what is done about it.
    pub fn doubts(&self) -> &[String] {
        match self {
            Self::Finned(vehicle) => vehicle.doubts(),
            Self::Kinematic(_) => &[],
            Self::Described(vehicle) => vehicle.doubts(),
        }
    }

    /// Pose of an instrument (a link of the URDF), in body axes.
    pub fn mount(&self, name: &str) -> Option<Pose> {
        match self {
            Self::Finned(vehicle) => vehicle.mount(name),
            Self::Kinematic(vehicle) => vehicle.mount(name),
            Self::Described(vehicle) => vehicle.mount(name),
        }
    }

    /// The body for the physics.
    pub fn body_spec(&self, id: &str, truth: Truth) -> BodySpec {
        match self {
            Self::Finned(vehicle) => vehicle.body_spec(id, truth),
            Self::Kinematic(vehicle) => vehicle.body_spec(id, truth),
            Self::Described(vehicle) => vehicle.body_spec(id, truth),
        }
    }

    /// The state after `dt_s` if the vehicle touches nothing, for `Physics::push`; `t_s` is the time in the water.
    ///
    /// # Panics
    /// If the set-points are those of a vehicle of another kind.
    pub fn step(&mut self, truth: &Truth, water: &dyn Flow, t_s: f64, set: &Actuation, dt_s: f64) -> Truth {
        match (self, set) {
            (Self::Finned(vehicle), Actuation::Fins(set)) => {
                let sample = water.sample(&truth.pose.p_WB, t_s);
                vehicle.step(truth, &sample, set, dt_s)
            }
            (Self::Kinematic(vehicle), Actuation::Rates(set)) => {
                let water_m_s = match vehicle.moves() {
                    Moves::ThroughWater => water.velocity(&truth.pose.p_WB, t_s),
                    // What does not carry it need not be computed.
                    Moves::OverGround => Vector3::zeros(),
                };
                vehicle.step(truth, &water_m_s, set, dt_s)
            }
            (Self::Described(vehicle), Actuation::Drives(set)) => {
                let sample = water.sample(&truth.pose.p_WB, t_s);
                vehicle.step(truth, &sample, set, dt_s)
            }
            (_, set) => {
                panic!("a vehicle was given {set:?}; build its pilot with what the vehicle tells")
            }
        }
    }
}
