//! A battery, and what empties it.
//!
//! *Source*: none; power is that of the vehicle's own drives.
//!
//! *Parameters*: [`EnergySpec`].
//!
//! *Deviations*: the battery gives the same energy at any power and any age; kinematic vehicles have no drives that need
//! power.

use bevy_ecs::prelude::Component;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{NonNegative, Positive};

/// A battery and what always runs.
// Both defaults are ours: about what a vehicle of the REMUS's size carries and takes.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EnergySpec {
    /// Energy of the full battery, Wh. At its end the drives stop.
    #[default(Positive::new(1000.0))]
    pub battery_wh: Positive,
    /// Hotel load: computer, instruments, lights, W.
    #[default(NonNegative::new(30.0))]
    pub hotel_w: NonNegative,
}

/// A battery at work.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Battery {
    spec: EnergySpec,
    /// Used by drives and by the hotel load so far, Wh.
    used_wh: [f64; 2],
}

impl Battery {
    /// A full one.
    pub fn new(spec: &EnergySpec) -> Self {
        Self { spec: spec.clone(), used_wh: [0.0; 2] }
    }

    /// The drives take a power, W, for a time, s.
    pub fn use_w(&mut self, drives_w: f64, dt_s: f64) {
        if !self.is_empty() {
            self.used_wh[0] += drives_w * dt_s / 3600.0;
            self.used_wh[1] += self.spec.hotel_w.get() * dt_s / 3600.0;
        }
    }

    /// Used by drives and by the hotel load so far, Wh.
    pub fn used_wh(&self) -> [f64; 2] {
        self.used_wh
    }

    /// Energy when full, Wh.
    pub fn full_wh(&self) -> f64 {
        self.spec.battery_wh.get()
    }

    /// Whether nothing is left.
    pub fn is_empty(&self) -> bool {
        self.used_wh.iter().sum::<f64>() >= self.full_wh()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_gives_what_it_has_and_no_more() {
        let mut battery =
            Battery::new(&EnergySpec { battery_wh: Positive::new(10.0), hotel_w: NonNegative::new(20.0) });
        battery.use_w(80.0, 180.0);
        assert_eq!(battery.used_wh(), [4.0, 1.0]);
        assert!(!battery.is_empty());
        battery.use_w(80.0, 180.0);
        assert!(battery.is_empty());
        battery.use_w(80.0, 180.0);
        assert_eq!(battery.used_wh(), [8.0, 2.0]);
    }
}
