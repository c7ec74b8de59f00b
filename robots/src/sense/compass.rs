//! Compass and inertial unit: heading, roll, pitch and rates.
//!
//! *Source:* electronic compasses of the class of PNI's TCM2: heading within 1°, tilt within 0.2°; values typical of
//! the class, because the paper does not specify its vehicle's compass.
//!
//! *Parameters:* rate `rate_hz` 25 Hz; heading noise `noise_deg` 0.3°; heading bias `bias_deg` 1.0°, the standard
//! deviation of an angle drawn once per run; `tilt_noise_deg` 0.2°; `gyro_noise_deg_s` 0.1 °/s.
//!
//! *Deviations:* the bias is the same on all headings; gyros have no bias.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use crate::error::RobotError;
use crate::handoff::{Attitude, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::frames::Truth;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Parameters of the compass.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CompassSpec {
    /// Readings per second, Hz.
    #[default(Positive::new(25.0))]
    pub rate_hz: Positive,
    /// Standard deviation of the heading noise, degrees.
    #[default(NonNegative::new(0.3))]
    pub noise_deg: NonNegative,
    /// Standard deviation of the heading bias, drawn once per run, degrees.
    #[default(NonNegative::new(1.0))]
    pub bias_deg: NonNegative,
    /// Standard deviation of the noise of roll and pitch, degrees.
    #[default(NonNegative::new(0.2))]
    pub tilt_noise_deg: NonNegative,
    /// Standard deviation of the noise of each rate, degrees/s.
    #[default(NonNegative::new(0.1))]
    pub gyro_noise_deg_s: NonNegative,
}

impl Listed for CompassSpec {
    const ENTRY: Entry = Entry {
        name: "compass",
        what: "Heading with noise and bias, roll, pitch and rates.",
        source: "Electronic compasses of the class of PNI's TCM2",
    };
}

impl SensorParams for CompassSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Compass::new(self, &on.robot)?))
    }
}

impl Sensor for Compass {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.attitude = self.read(around.clock, around.truth);
    }
}

/// A compass with inertial unit on a vehicle.
#[derive(Clone, Debug)]
pub struct Compass {
    at: Sampler,
    noise_rad: f64,
    bias_rad: f64,
    tilt_noise_rad: f64,
    gyro_noise_rad_s: f64,
}

impl Compass {
    /// A compass of the robot `on`; its place does not matter.
    ///
    /// # Errors
    /// If the rate does not fit the step.
    pub fn new(spec: &CompassSpec, on: &OnBoard) -> Result<Self, RobotError> {
        let mut at = Sampler::new("compass", spec.rate_hz, Vector3::zeros(), on)?;
        Ok(Self {
            bias_rad: spec.bias_deg.get().to_radians() * at.rng.normal(),
            at,
            noise_rad: spec.noise_deg.get().to_radians(),
            tilt_noise_rad: spec.tilt_noise_deg.get().to_radians(),
            gyro_noise_rad_s: spec.gyro_noise_deg_s.get().to_radians(),
        })
    }

    /// The reading of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth) -> Option<Attitude> {
        if !self.at.due(clock) {
            return None;
        }
        let turn = self.bias_rad + self.noise_rad * self.at.rng.normal();
        let (roll, pitch_down) = truth.pose.roll_pitch();
        Some(Attitude {
            heading: truth.pose.heading().turned(turn),
            roll_rad: roll + self.tilt_noise_rad * self.at.rng.normal(),
            // The pitch of the world's FLU axes is nose down positive, that of a vehicle nose up.
            pitch_rad: -pitch_down + self.tilt_noise_rad * self.at.rng.normal(),
            rates_rad_s: truth.w_WB_B + super::tools::normal3(&mut self.at.rng, self.gyro_noise_rad_s),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_normal, at, nose_up, run};
    use super::*;
    use nalgebra::{UnitQuaternion, Vector3};
    use world::units::Heading;

    fn compass(seed: u64) -> Compass {
        Compass::new(&CompassSpec::default(), &OnBoard::new("auv0", seed, 0.02)).unwrap()
    }

    #[test]
    fn noise_is_as_specified_about_one_bias() {
        let mut c = compass(2);
        let mut t = nose_up(at(0.0, 0.0, -5.0), 10.0);
        t.w_WB_B = Vector3::new(0.01, -0.02, 0.1);
        let v = run(20_000, 0.02, |clock| c.read(clock, &t));
        assert_eq!(v.len(), 10_000);
        let of = |f: &dyn Fn(&Attitude) -> f64| v.iter().map(f).collect::<Vec<f64>>();
        let north = Heading::from_deg(0.0);
        assert_normal(&of(&|r| north.turn_to(r.heading)), c.bias_rad, 0.3_f64.to_radians());
        assert_normal(&of(&|r| r.roll_rad), 0.0, 0.2_f64.to_radians());
        assert_normal(&of(&|r| r.pitch_rad), 10_f64.to_radians(), 0.2_f64.to_radians());
        for axis in 0..3 {
            assert_normal(&of(&|r| r.rates_rad_s[axis]), t.w_WB_B[axis], 0.1_f64.to_radians());
        }
    }

    #[test]
    fn biases_of_many_runs_have_the_specified_spread() {
        let biases: Vec<f64> = (0..1000).map(|seed| compass(seed).bias_rad).collect();
        assert_normal(&biases, 0.0, 1_f64.to_radians());
    }

    #[test]
    fn signs_are_the_vehicles() {
        let none = NonNegative::new(0.0);
        let exact = CompassSpec {
            noise_deg: none,
            bias_deg: none,
            tilt_noise_deg: none,
            gyro_noise_deg_s: none,
            ..Default::default()
        };
        let mut c = Compass::new(&exact, &OnBoard::new("auv0", 1, 0.02)).unwrap();
        let mut t = at(0.0, 0.0, -5.0);
        // East, nose 15° up, right side 5° down.
        let (roll, pitch) = (5_f64.to_radians(), 15_f64.to_radians());
        t.pose.R_WB = UnitQuaternion::from_euler_angles(roll, -pitch, 0.0);
        assert!((t.pose.R_WB * Vector3::x()).z > 0.25, "the nose is up");
        assert!((t.pose.R_WB * -Vector3::y()).z < -0.08, "the right side is down");
        let r = c.read(&Clock::new(0.02), &t).unwrap();
        assert!((r.heading.deg() - 90.0).abs() < 1e-9);
        assert!((r.pitch_rad - pitch).abs() < 1e-12 && (r.roll_rad - roll).abs() < 1e-12);
    }
}
