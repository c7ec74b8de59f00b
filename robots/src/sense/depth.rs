//! Depth: the pressure at its mount, as metres below the still surface; it includes passing waves.
//!
//! *Source:* strain-gauge pressure sensors of coastal AUVs: 0.01 % of 100 m full scale.
//!
//! *Parameters:* rate `rate_hz` 25 Hz; noise `noise_m` 0.01 m.
//!
//! *Deviations:* the density profile causes no depth errors; the pressure from the vehicle's own motion is left out.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use crate::error::RobotError;
use crate::handoff::{DepthReading, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::fields::Flow;
use world::frames::Truth;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Parameters of the depth sensor.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DepthSpec {
    /// Readings per second, Hz.
    #[default(Positive::new(25.0))]
    pub rate_hz: Positive,
    /// Standard deviation of the noise, m.
    #[serde(with = "world::limits::error_m")]
    #[default(NonNegative::new(0.01))]
    pub noise_m: NonNegative,
}

impl Listed for DepthSpec {
    const ENTRY: Entry = Entry {
        name: "depth",
        what: "Depth below the still surface from pressure.",
        source: "Strain-gauge pressure sensors, 0.01 % of full scale",
    };
}

impl SensorParams for DepthSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Depth::new(self, on.place("depth")?, &on.robot)?))
    }
}

impl Sensor for Depth {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.depth = self.read(around.clock, around.truth, around.flow);
    }
}

/// A depth sensor on a vehicle.
#[derive(Clone, Debug)]
pub struct Depth {
    spec: DepthSpec,
    at: Sampler,
}

impl Depth {
    /// A depth sensor at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step.
    pub fn new(spec: &DepthSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        Ok(Self { at: Sampler::new("depth", spec.rate_hz, p_BS, on)?, spec: spec.clone() })
    }

    /// The reading of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, flow: &dyn Flow) -> Option<DepthReading> {
        if !self.at.due(clock) {
            return None;
        }
        let p = self.at.place(truth);
        let head_m = flow.head(&p, clock.t_s());
        Some(DepthReading { depth_m: -p.z + head_m + self.spec.noise_m.get() * self.at.rng.normal() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_normal, at, nose_up, run};
    use super::*;
    use world::fields::Still;

    #[test]
    fn reads_the_depth_of_its_mount_with_its_noise() {
        let nose = Vector3::new(0.5, 0.0, 0.1);
        let mut d = Depth::new(&DepthSpec::default(), nose, &OnBoard::new("auv0", 1, 0.02)).unwrap();
        let t = nose_up(at(0.0, 0.0, -5.0), 30.0);
        let v = run(20_000, 0.02, |c| d.read(c, &t, &Still));
        assert_eq!(v.len(), 10_000);
        let got: Vec<f64> = v.iter().map(|r| r.depth_m).collect();
        let rise = 0.5 * 0.5 + 0.1 * 0.75_f64.sqrt();
        assert_normal(&got, 5.0 - rise, 0.01);
    }

    struct Swell;
    impl Flow for Swell {
        fn velocity(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
            Vector3::zeros()
        }
        fn head(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
            0.1 * t_s - 0.01 * p.z
        }
    }

    #[test]
    fn feels_the_pressure_of_waves() {
        let spec = DepthSpec { noise_m: NonNegative::new(0.0), ..Default::default() };
        let mut d = Depth::new(&spec, Vector3::zeros(), &OnBoard::new("auv0", 1, 0.02)).unwrap();
        let v = run(101, 0.02, |c| d.read(c, &at(0.0, 0.0, -5.0), &Swell));
        assert!((v[0].depth_m - 5.05).abs() < 1e-12);
        assert!((v[50].depth_m - 5.25).abs() < 1e-12);
    }
}
