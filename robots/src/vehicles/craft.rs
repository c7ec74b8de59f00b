//! A vehicle of any kind that a scenario can choose for a robot.

use super::files::Files;
use super::kinematic::Kinematic;
use super::kinematic_spec::Moves;
use super::spec::VehicleSpec;
use super::vehicle::Vehicle;
use crate::error::RobotError;
use crate::handoff::{Actuation, RateLimits};
use nalgebra::Vector3;
use world::fields::Flow;
use world::frames::{Pose, Truth};
use world::physics::BodySpec;

/// A vehicle of any kind.
#[derive(Clone, Debug)]
pub enum Craft {
    /// With fins, a propeller and an equation of motion.
    Finned(Box<Vehicle>),
    /// Without dynamics.
    Kinematic(Box<Kinematic>),
}

impl Craft {
    /// Builds the vehicle that a scenario asks for; `files` gives the URDF and its meshes, if it names one.
    ///
    /// # Errors
    /// If a file cannot be read, or if the URDF is wrong or does not fit the vehicle.
    pub fn load(spec: &VehicleSpec, files: &dyn Files) -> Result<Self, RobotError> {
        Ok(match spec {
            VehicleSpec::Remus100(remus) => Self::Finned(Box::new(Vehicle::load(remus, files)?)),
            VehicleSpec::Kinematic(spec) => {
                Self::Kinematic(Box::new(Kinematic::load(spec, files)?))
            }
        })
    }

    /// Its limits, if it is kinematic.
    #[must_use]
    pub fn limits(&self) -> Option<RateLimits> {
        match self {
            Self::Finned(_) => None,
            Self::Kinematic(vehicle) => Some(vehicle.limits()),
        }
    }

    /// Whether the water carries it.
    #[must_use]
    pub fn is_carried(&self) -> bool {
        match self {
            Self::Finned(_) => true,
            Self::Kinematic(vehicle) => vehicle.moves() == Moves::ThroughWater,
        }
    }

    /// Greatest speed with the propeller at `rpm`, or at its own limit, m/s: through still water, or over ground if
    /// the water does not carry it.
    #[must_use]
    pub fn top_speed_m_s(&self, rpm: f64) -> f64 {
        match self {
            Self::Finned(vehicle) => vehicle.top_speed_m_s(rpm),
            Self::Kinematic(vehicle) => vehicle.limits().speed_m_s,
        }
    }

    /// Where the URDF's mass differs from that of the hydrodynamic parameters, and what is done about it.
    #[must_use]
    pub fn told(&self) -> &[String] {
        match self {
            Self::Finned(vehicle) => vehicle.told(),
            Self::Kinematic(_) => &[],
        }
    }

    /// Pose of an instrument (a link of the URDF), in body axes.
    #[must_use]
    pub fn mount(&self, name: &str) -> Option<Pose> {
        match self {
            Self::Finned(vehicle) => vehicle.mount(name),
            Self::Kinematic(vehicle) => vehicle.mount(name),
        }
    }

    /// The body for the physics.
    #[must_use]
    pub fn body_spec(&self, id: &str, truth: Truth) -> BodySpec {
        match self {
            Self::Finned(vehicle) => vehicle.body_spec(id, truth),
            Self::Kinematic(vehicle) => vehicle.body_spec(id, truth),
        }
    }

    /// The state after `dt_s` if the vehicle touches nothing, for `Physics::push`; `t_s` is the time in the water.
    ///
    /// # Panics
    /// If the set-points are those of a vehicle of another kind.
    pub fn step(
        &mut self,
        truth: &Truth,
        water: &dyn Flow,
        t_s: f64,
        set: &Actuation,
        dt_s: f64,
    ) -> Truth {
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
            (Self::Finned(_), Actuation::Rates(_)) => {
                panic!("a vehicle with fins was given rates; build its pilot with its own limits")
            }
            (Self::Kinematic(_), Actuation::Fins(_)) => {
                panic!("a kinematic vehicle was given fins; build its pilot with its own limits")
            }
        }
    }
}
