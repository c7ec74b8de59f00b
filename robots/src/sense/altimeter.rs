//! Altimeter: height above the bed by an echo along the body's down axis.
//!
//! *Source:* echo sounders of coastal AUVs (500 kHz class: some centimetres of noise, blind below half a metre, some
//! tens of metres of range); Pang 2009, section 6, flies at 1.5–2 m altitude.
//!
//! *Parameters:* rate `rate_hz` 5 Hz; noise `noise_m` 0.02 m; range from `min_range_m` 0.3 m to `max_range_m` 30 m.
//!
//! *Deviations:* the beam has no width; it meets the bed, or an obstacle before it. The slant range is converted to
//! height with the vehicle's tilt, here without the small noise of the tilt.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use super::tools::EchoTarget;
use crate::error::{RobotError, require};
use crate::handoff::{AltimeterReading, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::frames::Truth;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Parameters of the altimeter.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AltimeterSpec {
    /// Readings per second, Hz.
    #[default(Positive::new(5.0))]
    pub rate_hz: Positive,
    /// Standard deviation of the noise, m.
    #[serde(with = "world::limits::error_m")]
    #[default(NonNegative::new(0.02))]
    pub noise_m: NonNegative,
    /// Least range, m.
    #[default(NonNegative::new(0.3))]
    pub min_range_m: NonNegative,
    /// Greatest range, m.
    #[serde(with = "world::limits::sonar_m")]
    #[default(Positive::new(30.0))]
    pub max_range_m: Positive,
}

impl Listed for AltimeterSpec {
    const ENTRY: Entry = Entry {
        name: "altimeter",
        what: "Height above the bed by an echo along the body's down axis.",
        source: "500 kHz echo sounder class; Pang 2009, section 6",
    };
}

impl SensorParams for AltimeterSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Altimeter::new(self, on.place("altimeter")?, &on.robot)?))
    }
}

impl Sensor for Altimeter {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.altimeter = self.read(around.clock, around.truth, &around.below());
    }
}

/// An altimeter on a vehicle.
#[derive(Clone, Debug)]
pub struct Altimeter {
    spec: AltimeterSpec,
    at: Sampler,
    range_m: std::ops::RangeInclusive<f64>,
}

impl Altimeter {
    /// An altimeter at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step, or if the range is empty.
    pub fn new(spec: &AltimeterSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        let range_m = spec.min_range_m.get()..=spec.max_range_m.get();
        require(
            !range_m.is_empty(),
            "sensors.altimeter.max_range_m",
            format!("must be at least min_range_m, {} m", range_m.start()),
        )?;
        Ok(Self { at: Sampler::new("altimeter", spec.rate_hz, p_BS, on)?, spec: spec.clone(), range_m })
    }

    /// The reading of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, below: &EchoTarget) -> Option<AltimeterReading> {
        if !self.at.due(clock) {
            return None;
        }
        // Drawn also without an echo, so that a lost ping does not change later numbers.
        let noise = self.spec.noise_m.get() * self.at.rng.normal();
        let p = self.at.place(truth);
        let down = truth.pose.R_WB * -Vector3::z();
        let echo = super::tools::range_down(below, &p, &down).filter(|range| self.range_m.contains(range));
        Some(match echo {
            Some(range) => AltimeterReading { altitude_m: (range + noise) * -down.z, valid: true },
            None => AltimeterReading { altitude_m: 0.0, valid: false },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{BED, assert_normal, at, bare, nose_up, run, slope};
    use super::*;
    use world::terrain::Terrain;

    fn altimeter(noise_m: f64) -> Altimeter {
        let spec = AltimeterSpec { noise_m: NonNegative::new(noise_m), ..Default::default() };
        Altimeter::new(&spec, Vector3::new(0.0, 0.0, -0.1), &OnBoard::new("auv0", 1, 0.02)).unwrap()
    }

    fn read(t: Truth, bed: &Terrain) -> AltimeterReading {
        altimeter(0.0).read(&Clock::new(0.02), &t, &bare(bed)).unwrap()
    }

    #[test]
    fn reads_height_with_its_noise() {
        let mut a = altimeter(0.02);
        let t = at(0.0, 0.0, -6.0);
        let v = run(50_000, 0.02, |c| a.read(c, &t, &bare(&BED)));
        assert_eq!(v.len(), 5_000);
        let got: Vec<f64> = v.iter().map(|r| r.altitude_m).collect();
        assert_normal(&got, 1.9, 0.02);
    }

    #[test]
    fn is_valid_within_its_range_only() {
        let deep = Terrain::Level { depth_m: 40.0 };
        assert!(read(at(0.0, 0.0, -9.95), &deep).valid && !read(at(0.0, 0.0, -9.85), &deep).valid);
        assert!(read(at(0.0, 0.0, -7.55), &BED).valid && !read(at(0.0, 0.0, -7.65), &BED).valid);
        assert!(!read(nose_up(at(0.0, 0.0, -6.0), 70.0), &BED).valid);
    }

    /// With the nose up over a bed that rises northward, the beam looks forward and down and hits the bed where it is
    /// higher.
    #[test]
    fn on_a_slope_the_beam_ends_on_the_bed() {
        let slope = slope(0.0, 9.0);
        let t = nose_up(at(0.0, 0.0, -5.0), 20.0);
        let p = t.pose.point(Vector3::new(0.0, 0.0, -0.1));
        let down = t.pose.R_WB * -Vector3::z();
        let got = read(t, &slope);
        let end = p + down * (got.altitude_m / -down.z);
        assert!((end.z - slope.bed_z(end.x, end.y)).abs() < 1e-6, "{end:?}");
        assert!(end.y > 0.5, "the beam leads forward: {end:?}");
    }

    #[test]
    fn over_a_block_it_reads_the_block() {
        use crate::plan::testing::block;
        use world::obstacles::Obstacles;
        let t = at(10.0, 10.0, -2.0);
        // On a bed at 8 m depth, 4 m high: two metres of water less a tenth of a metre for the hull.
        let bed = Terrain::Level { depth_m: 8.0 };
        let solids = Obstacles(vec![block("b", 10.0, 10.0, [4.0, 4.0, 4.0])]);
        let read = |obstacles: &Obstacles| {
            let below = EchoTarget { terrain: &bed, obstacles };
            altimeter(0.0).read(&Clock::new(0.02), &t, &below).unwrap().altitude_m
        };
        assert!((read(&solids) - 1.9).abs() < 1e-9, "{}", read(&solids));
        assert!((read(&Obstacles::default()) - 5.9).abs() < 1e-9);
    }
}
