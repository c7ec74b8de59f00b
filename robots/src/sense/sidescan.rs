//! Sidescan sonar: at each ping, the strength of the echo from either side by slant range, with water column, bottom,
//! objects and their shadows.
//!
//! *Source:* the sonar equation for bottom reverberation with Lambert's law, S = μ + 10 log sin² γ (Lambert 1760,
//! Photometria; Urick 1983, Principles of Underwater Sound, sections 8.2 and 8.11); contents and speckle of the
//! picture: Blondel 2009, The Handbook of Sidescan Sonar, sections 2.3 and 4.2. Speckle: many scatterers in a cell
//! make the amplitude Rayleigh, the intensity exponential.
//!
//! *Parameters:* pings per second `rate_hz` 10; slant range `range_m` 20 m in `samples` 400, the pulse's resolution;
//! beam `beam_deg` 0.6° along the track, `aperture_deg` 50° in the vertical about an axis `tilt_deg` 20° below the
//! horizontal (REMUS 100 carried a Marine Sonic of 600 or 900 kHz; class values, because no data sheet was
//! available); bed `bed_db` μ = −27 dB (Urick 1983, section 8.11: −27 to −29 dB fit many bottoms; sand in APL-UW TR
//! 9407, section IV, lies near it at 10 to 40° and tens of kHz); obstacles by their own `surface.backscatter_db`;
//! noise `floor_db` −60 dB: the backscatter strength whose echo from the greatest range equals the noise (thermal
//! noise alone at 600 kHz gives −77 dB with 210 dB source level, 20 kHz bandwidth and 30 dB directivity; the rest is
//! for electronics and propeller); absorption `absorption_db_m` 0.17 dB/m (sea water at 600 kHz, 10 °C: François &
//! Garrison 1982). `always` false: it pings only during a survey.
//!
//! *Deviations:* the time-varied gain is exact, so that a bed of one strength varies with grazing angle and beam
//! only; noise grows with it. Rays are straight; there is no echo by way of the surface, no side lobe along the
//! track, and the bed is smooth without ripples. The ping is instantaneous: in the 27 ms to 20 m and back a vehicle
//! at 2 m/s moves 5 cm.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use super::tools::EchoTarget;
use crate::error::{RobotError, require};
use crate::handoff::{Readings, SidescanPing};
use fan::{Fan, from_db};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::LN_10;
use std::sync::Arc;
use world::catalogue::Entry;
use world::clock::Clock;
use world::cost::{Cost, Part, Times};
use world::frames::Truth;
use world::math;
use world::ranges::{Finite, NonNegative, Positive};
use world::registry::Listed;

/// Most samples on a side.
const MOST: u32 = 4096;
/// Speed of sound that limits the rate, m/s.
const SOUND_M_S: f64 = 1500.0;

/// Time for a sample, and for an obstacle on its way, s (see `world::cost`).
const SAMPLE_S: [f64; 2] = [0.2e-6, 0.1e-6];
/// Memory of the kept pictures of passes, bytes: the number of their lines is limited, see the crate `eyes`.
const PASSES_BYTES: f64 = 5e6;

/// Parameters of the sidescan sonar.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SidescanSpec {
    /// Pings per second, Hz.
    #[default(Positive::new(10.0))]
    pub rate_hz: Positive,
    /// Greatest slant range, m.
    #[serde(with = "world::limits::sonar_m")]
    #[default(Positive::new(20.0))]
    pub range_m: Positive,
    /// Samples on a side, nearest to farthest.
    #[default(400)]
    pub samples: u32,
    /// Width of the beam along the track, °.
    #[default(Positive::new(0.6))]
    pub beam_deg: Positive,
    /// Width of the beam in the vertical, to half of the one-way power, °.
    #[default(Positive::new(50.0))]
    pub aperture_deg: Positive,
    /// Angle of the beam's axis below the horizontal, °.
    #[default(NonNegative::new(20.0))]
    pub tilt_deg: NonNegative,
    /// Backscatter strength of a square metre of bed at a grazing angle of 90°, dB.
    #[serde(with = "world::limits::level_db")]
    #[default(Finite::new(-27.0))]
    pub bed_db: Finite,
    /// Backscatter strength whose echo from the greatest range equals the noise, dB.
    #[serde(with = "world::limits::level_db")]
    #[default(Finite::new(-60.0))]
    pub floor_db: Finite,
    /// Absorption, dB/m.
    #[default(NonNegative::new(0.17))]
    pub absorption_db_m: NonNegative,
    /// Whether it pings all the time, not only while the vehicle surveys.
    pub always: bool,
}

impl Listed for SidescanSpec {
    const ENTRY: Entry = Entry {
        name: "sidescan",
        what: "Echo strength to either side by slant range: Lambert's law, shadows, water column, speckle, noise.",
        source: "Urick 1983, sections 8.2 and 8.11; Blondel 2009, The Handbook of Sidescan Sonar",
    };
}

impl SensorParams for SidescanSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Sidescan::new(self, on.place("sidescan")?, &on.robot)?))
    }

    fn cost(&self, obstacles: f64, used: f64, times: &Times) -> Cost {
        let rate_hz = self.rate_hz.get();
        let samples = 2.0 * f64::from(self.samples) * rate_hz;
        let each_s = SAMPLE_S[0] + obstacles * SAMPLE_S[1];
        let used = if self.always { 1.0 } else { used };
        let part = Part::new("rate_hz", format!("{samples:.0} samples per second"))
            .holds(PASSES_BYTES)
            .takes(times.mission_s * used * samples * each_s)
            .by(rate_hz, 1.0);
        Cost::single(part)
    }
}

impl Sensor for Sidescan {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.sidescan = self.read(around.clock, around.truth, &around.below(), around.asked.survey);
    }
}

/// A sidescan sonar on a vehicle.
#[derive(Clone, Debug)]
pub struct Sidescan {
    at: Sampler,
    fan: Fan,
    /// Noise of each sample, and the reference of 0 dB, as backscatter strengths.
    noise: Vec<f64>,
    floor: f64,
    always: bool,
    /// Strength of each sample of the present side, before speckle.
    echo: Vec<f64>,
}

impl Sidescan {
    /// A sidescan sonar at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit range or step, or if the beam is out of range.
    pub fn new(spec: &SidescanSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        let must =
            |holds: bool, field: &str, problem: String| require(holds, format!("sensors.sidescan.{field}"), problem);
        let samples = spec.samples;
        must((1..=MOST).contains(&samples), "samples", format!("must be from 1 to {MOST}, got {samples}"))?;
        for (field, angle, most) in [
            ("beam_deg", spec.beam_deg.get(), 20.0),
            ("aperture_deg", spec.aperture_deg.get(), 180.0),
            ("tilt_deg", spec.tilt_deg.get(), 90.0),
        ] {
            must(angle <= most, field, format!("must be at most {most}, got {angle}"))?;
        }
        let (range_m, rate_hz) = (spec.range_m.get(), spec.rate_hz.get());
        let most_hz = SOUND_M_S / (2.0 * range_m);
        let problem =
            format!("an echo from {range_m} m takes longer than the time between two pings; at most {most_hz:.1} Hz");
        must(rate_hz <= most_hz, "rate_hz", problem)?;
        let n = samples as usize;
        let floor = from_db(spec.floor_db.get());
        let noise = |k: usize| {
            let r = (k as f64 + 0.5) / n as f64 * range_m;
            let part = r / range_m;
            floor * part * part * part * from_db(2.0 * spec.absorption_db_m.get() * (r - range_m))
        };
        Ok(Self {
            at: Sampler::new("sidescan", spec.rate_hz, p_BS, on)?,
            fan: Fan {
                range_m,
                samples: n,
                beam_rad: spec.beam_deg.get().to_radians(),
                half_aperture_rad: 0.5 * spec.aperture_deg.get().to_radians(),
                tilt_rad: spec.tilt_deg.get().to_radians(),
                bed: from_db(spec.bed_db.get()),
            },
            noise: (0..n).map(noise).collect(),
            floor,
            always: spec.always,
            echo: vec![0.0; n],
        })
    }

    /// The ping of this step, if one is due; `surveying` says whether the vehicle is on a survey.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, target: &EchoTarget, surveying: bool) -> Option<SidescanPing> {
        if !self.at.due(clock) || !(surveying || self.always) {
            return None;
        }
        let (from, p_BS) = (self.at.place(truth), self.at.p_BS);
        let mut side = |port: bool| -> Arc<[f32]> {
            self.echo.fill(0.0);
            (self.fan).sound(&from, &truth.pose.R_WB, port, target, &mut self.echo);
            let heard = self.echo.iter().zip(&self.noise).map(|(echo, noise)| {
                // Echo and noise are sums of many waves of random phase, so the intensity of their sum is
                // exponential.
                let speckle = -math::ln(1.0 - self.at.rng.uniform());
                let level = ((echo + noise) * speckle / self.floor).max(1e-15);
                (10.0 / LN_10 * math::ln(level)) as f32
            });
            heard.collect()
        };
        Some(SidescanPing { p_BS, max_m: self.fan.range_m, port_db: side(true), starboard_db: side(false) })
    }
}

mod fan;
#[cfg(test)]
mod tests;
