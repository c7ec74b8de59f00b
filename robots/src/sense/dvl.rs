//! Doppler velocity log: velocity over ground by bottom track.
//!
//! *Source:* Teledyne RD Instruments, Workhorse Navigator data sheet, 1200 kHz: single-ping standard deviation 3–4
//! mm/s at 1–3 m/s, long-term accuracy 0.2 %, altitude 0.5–30 m; the REMUS dead-reckons on such acoustic Doppler
//! data: Pang 2009, section 4.
//!
//! *Parameters:* rate `rate_hz` 5 Hz; noise per axis `noise_m_s` 0.004 m/s; scale error `scale_error` 0.002, the
//! standard deviation of a factor drawn once per run; bottom lock between `min_altitude_m` 0.5 m and `max_altitude_m`
//! 30 m of slant range.
//!
//! *Deviations:* the four beams are replaced by one along the body's down axis, which decides bottom lock (lost
//! beyond 60° of tilt). The velocity is that of the body's origin: the part caused by the instrument's place and the
//! vehicle's rotation is removed with the gyros, as vehicles do, here without the small noise of the gyros.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use super::tools::EchoTarget;
use crate::error::{RobotError, require};
use crate::handoff::{DvlReading, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::frames::Truth;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Parameters of the Doppler log.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DvlSpec {
    /// Readings per second, Hz.
    #[default(Positive::new(5.0))]
    pub rate_hz: Positive,
    /// Standard deviation of the noise on each axis, m/s.
    #[serde(with = "world::limits::stream_m_s")]
    #[default(NonNegative::new(0.004))]
    pub noise_m_s: NonNegative,
    /// Standard deviation of the relative scale error, drawn once per run.
    #[default(NonNegative::new(0.002))]
    pub scale_error: NonNegative,
    /// Least range to the bed for bottom lock, m.
    #[default(NonNegative::new(0.5))]
    pub min_altitude_m: NonNegative,
    /// Greatest range to the bed for bottom lock, m.
    #[serde(with = "world::limits::sonar_m")]
    #[default(Positive::new(30.0))]
    pub max_altitude_m: Positive,
}

impl Listed for DvlSpec {
    const ENTRY: Entry = Entry {
        name: "dvl",
        what: "Velocity over ground by bottom track: noise, scale error, bottom lock by range.",
        source: "Teledyne RD Instruments, Workhorse Navigator 1200 kHz data sheet",
    };
}

impl SensorParams for DvlSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Dvl::new(self, on.place("dvl")?, &on.robot)?))
    }
}

impl Sensor for Dvl {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.dvl = self.read(around.clock, around.truth, &around.below());
    }
}

/// A Doppler log on a vehicle.
#[derive(Clone, Debug)]
pub struct Dvl {
    spec: DvlSpec,
    at: Sampler,
    scale: f64,
    lock_m: std::ops::RangeInclusive<f64>,
}

impl Dvl {
    /// A Doppler log at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step, or if the range is empty.
    pub fn new(spec: &DvlSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        let lock_m = spec.min_altitude_m.get()..=spec.max_altitude_m.get();
        require(
            !lock_m.is_empty(),
            "sensors.dvl.max_altitude_m",
            format!("must be at least min_altitude_m, {} m", lock_m.start()),
        )?;
        let mut at = Sampler::new("dvl", spec.rate_hz, p_BS, on)?;
        let scale = 1.0 + spec.scale_error.get() * at.rng.normal();
        Ok(Self { spec: spec.clone(), at, scale, lock_m })
    }

    /// The reading of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, below: &EchoTarget) -> Option<DvlReading> {
        if !self.at.due(clock) {
            return None;
        }
        // Drawn also without lock, so that a lost ping does not change later numbers.
        let noise = super::tools::normal3(&mut self.at.rng, self.spec.noise_m_s.get());
        let p = self.at.place(truth);
        let down = truth.pose.R_WB * -Vector3::z();
        let valid = super::tools::range_down(below, &p, &down).is_some_and(|range| self.lock_m.contains(&range));
        let v_body_m_s = if valid { truth.v_WB_B * self.scale + noise } else { Vector3::zeros() };
        Some(DvlReading { v_body_m_s, valid })
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{BED, assert_normal, at, bare, nose_up, run};
    use super::*;
    use world::terrain::Terrain;

    fn dvl(spec: &DvlSpec, seed: u64) -> Dvl {
        Dvl::new(spec, Vector3::new(0.0, 0.0, -0.1), &OnBoard::new("auv0", seed, 0.02)).unwrap()
    }

    fn moving(z: f64) -> Truth {
        Truth { v_WB_B: Vector3::new(2.0, -0.3, 0.1), ..at(0.0, 0.0, z) }
    }

    #[test]
    fn noise_is_as_specified_on_each_axis_and_the_scale_constant() {
        let mut d = dvl(&DvlSpec::default(), 5);
        let v = run(50_000, 0.02, |c| d.read(c, &moving(-6.0), &bare(&BED)));
        assert_eq!(v.len(), 5_000);
        assert!(v.iter().all(|r| r.valid));
        for axis in 0..3 {
            let got: Vec<f64> = v.iter().map(|r| r.v_body_m_s[axis]).collect();
            assert_normal(&got, moving(-6.0).v_WB_B[axis] * d.scale, 0.004);
        }
    }

    #[test]
    fn scale_errors_of_many_runs_have_the_specified_spread() {
        let scales: Vec<f64> = (0..1000).map(|seed| dvl(&DvlSpec::default(), seed).scale).collect();
        assert_normal(&scales, 1.0, 0.002);
    }

    #[test]
    fn bottom_lock_depends_on_range_and_tilt() {
        let deep = Terrain::Level { depth_m: 40.0 };
        let valid = |t: Truth, bed: &Terrain| {
            let mut d = dvl(&DvlSpec::default(), 1);
            run(1, 0.02, |c| d.read(c, &t, &bare(bed)))[0].valid
        };
        // The mount hangs 0.1 m below the origin.
        assert!(valid(moving(-9.95), &deep) && !valid(moving(-9.85), &deep));
        assert!(valid(moving(-7.35), &BED) && !valid(moving(-7.45), &BED));
        // The beam is longer by 1/cos of the tilt: 26.9 m become 31.
        assert!(valid(moving(-13.0), &deep) && !valid(nose_up(moving(-13.0), 30.0), &deep));
        assert!(!valid(nose_up(moving(-6.0), 70.0), &BED));
        assert!(!valid(nose_up(moving(-6.0), 180.0), &BED));
    }

    #[test]
    fn a_lost_ping_does_not_shift_the_noise() {
        let spec = DvlSpec::default();
        let (mut a, mut b) = (dvl(&spec, 1), dvl(&spec, 1));
        let bad = moving(-7.9);
        let clear = run(50, 0.02, |c| a.read(c, &moving(-6.0), &bare(&BED)));
        let gapped = run(50, 0.02, |c| {
            let t = if c.step == 10 { bad } else { moving(-6.0) };
            b.read(c, &t, &bare(&BED))
        });
        assert!(!gapped[1].valid && clear[1].valid);
        assert_eq!(clear[2..], gapped[2..]);
    }
}
