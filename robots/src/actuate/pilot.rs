//! Whoever steers: the autopilot of a vehicle with fins, or the helm of a kinematic one.

use super::autopilot::Autopilot;
use super::helm::Helm;
use super::spec::AutopilotSpec;
use crate::handoff::{Actuation, Command, Estimate, RateLimits};
use bevy_ecs::prelude::Component;

/// What steers a vehicle.
#[derive(Component, Clone, Debug, PartialEq)]
pub enum Pilot {
    /// Fins and a propeller.
    Fins(Autopilot),
    /// Rates.
    Rates(Helm),
}

impl Pilot {
    /// What steers a vehicle with these limits, which sets out at a speed, m/s; without limits, one with fins.
    #[must_use]
    pub fn new(spec: &AutopilotSpec, limits: Option<RateLimits>, speed_m_s: f64) -> Self {
        match limits {
            Some(limits) => Self::Rates(Helm::new(limits, spec, speed_m_s)),
            None => Self::Fins(Autopilot::new(spec)),
        }
    }

    /// Set-points of the drives for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, estimate: &Estimate, dt_s: f64) -> Actuation {
        match self {
            Self::Fins(pilot) => Actuation::Fins(pilot.step(command, estimate, dt_s)),
            Self::Rates(helm) => Actuation::Rates(helm.step(command, estimate, dt_s)),
        }
    }
}
