//! Forward ranging: a fan of sound beams that measures the distance to the next solid or the bed in each direction.
//!
//! *Source:* multi-beam forward-looking sonar for obstacle avoidance and path planning of underwater vehicles:
//! Petillot, Tena Ruiz & Lane 2001, IEEE J. Oceanic Eng. 26, 240.
//!
//! *Parameters:* pings per second `rate_hz` 2; `beams` 41 over `width_deg` 120°, in `rows` 1 over `height_deg` 20°;
//! range from `min_range_m` 0.5 m to `max_range_m` 40 m; noise `noise_m` 0.1 m, one standard deviation; share of
//! beams that drop out, `dropout`, 0.02. Values of the class, not of one instrument.
//!
//! *Deviations:* beams have no width and are resolved in both directions; there are no side lobes and no echoes from
//! or by way of the surface. A beam that drops out is not reported; a beam without an echo means that the way is
//! free.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use super::tools::EchoTarget;
use crate::error::{RobotError, require};
use crate::handoff::{Beam, RangeScan, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::cost::{Cost, Part, Times};
use world::frames::Truth;
use world::math;
use world::ranges::{Fraction, NonNegative, Positive};
use world::registry::Listed;
use world::terrain::Terrain;

/// Most beams in a ping.
const MOST: u32 = 1024;
/// Step of the search for the bed along a beam, m, and number of halvings of the step that met it.
const BED_STEP: (f64, u32) = (0.5, 20);

/// Time for a beam, for an obstacle on its way, and for a metre of the search for the bed, s (see `world::cost`).
const BEAM_S: [f64; 3] = [0.5e-6, 0.15e-6, 30e-9];

/// Parameters of the ranging.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RangingSpec {
    /// Pings per second, Hz.
    #[default(Positive::new(2.0))]
    pub rate_hz: Positive,
    /// Beams side by side.
    #[default(41)]
    pub beams: u32,
    /// Angle from the outermost beam on the left to the outermost on the right, °, at most 360.
    #[default(NonNegative::new(120.0))]
    pub width_deg: NonNegative,
    /// Rows of beams, one above the other.
    #[default(1)]
    pub rows: u32,
    /// Angle from the lowest row to the highest, °, at most 180.
    #[default(NonNegative::new(20.0))]
    pub height_deg: NonNegative,
    /// Least range, m.
    #[default(NonNegative::new(0.5))]
    pub min_range_m: NonNegative,
    /// Greatest range, m.
    #[serde(with = "world::limits::sonar_m")]
    #[default(Positive::new(40.0))]
    pub max_range_m: Positive,
    /// Standard deviation of the noise, m.
    #[serde(with = "world::limits::error_m")]
    #[default(NonNegative::new(0.1))]
    pub noise_m: NonNegative,
    /// Share of the beams that drop out.
    #[default(Fraction::new(0.02))]
    pub dropout: Fraction,
}

impl Listed for RangingSpec {
    const ENTRY: Entry = Entry {
        name: "ranging",
        what: "Ranges ahead in a fan of beams against solids and bed: noise, range, drop-outs.",
        source: "Petillot, Tena Ruiz & Lane 2001, IEEE J. Oceanic Eng. 26, 240",
    };
}

impl SensorParams for RangingSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Ranging::new(self, on.place("ranging")?, &on.robot)?))
    }

    fn cost(&self, obstacles: f64, _: f64, times: &Times) -> Cost {
        let beams = f64::from(self.beams) * f64::from(self.rows);
        let each_s = BEAM_S[0] + obstacles * BEAM_S[1] + self.max_range_m.get() * BEAM_S[2];
        let rate_hz = self.rate_hz.get();
        let what = format!("{:.0} beams per second", beams * rate_hz);
        Cost::single(Part::new("rate_hz", what).takes(times.mission_s * rate_hz * beams * each_s).by(rate_hz, 1.0))
    }
}

impl Sensor for Ranging {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.ranging = self.read(around.clock, around.truth, &around.below());
    }
}

/// Forward ranging on a vehicle.
#[derive(Clone, Debug)]
pub struct Ranging {
    spec: RangingSpec,
    at: Sampler,
    dirs_B: Vec<Vector3<f64>>,
}

impl Ranging {
    /// A ranging at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step, or if the fan is out of range.
    pub fn new(spec: &RangingSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        let must =
            |holds: bool, field: &str, problem: String| require(holds, format!("sensors.ranging.{field}"), problem);
        for (field, n) in [("beams", spec.beams), ("rows", spec.rows)] {
            let fits = n > 0 && spec.beams.saturating_mul(spec.rows) <= MOST;
            must(fits, field, format!("must be at least 1, and beams times rows at most {MOST}, got {n}"))?;
        }
        for (field, angle, most) in [("width_deg", spec.width_deg, 360.0), ("height_deg", spec.height_deg, 180.0)] {
            must(angle.get() <= most, field, format!("must be from 0 to {most}, got {}", angle.get()))?;
        }
        let (min_m, max_m) = (spec.min_range_m.get(), spec.max_range_m.get());
        let problem = format!("must be greater than min_range_m, {min_m} m, got {max_m}");
        must(min_m < max_m, "max_range_m", problem)?;
        let spread = |k: u32, n: u32, whole_deg: f64| {
            let part = if n > 1 { f64::from(k) / f64::from(n - 1) - 0.5 } else { 0.0 };
            math::sin_cos((part * whole_deg).to_radians())
        };
        let dirs_B = (0..spec.rows)
            .flat_map(|row| (0..spec.beams).map(move |beam| (row, beam)))
            .map(|(row, beam)| {
                let (up, flat) = spread(row, spec.rows, spec.height_deg.get());
                let (left, forward) = spread(beam, spec.beams, spec.width_deg.get());
                Vector3::new(flat * forward, flat * left, up)
            })
            .collect();
        Ok(Self { at: Sampler::new("ranging", spec.rate_hz, p_BS, on)?, spec: spec.clone(), dirs_B })
    }

    /// The ping of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, target: &EchoTarget) -> Option<RangeScan> {
        if !self.at.due(clock) {
            return None;
        }
        let from = self.at.place(truth);
        let (min_m, max_m) = (self.spec.min_range_m.get(), self.spec.max_range_m.get());
        let (noise_m, dropout) = (self.spec.noise_m.get(), self.spec.dropout.get());
        let mut beams = Vec::with_capacity(self.dirs_B.len());
        for dir_B in &self.dirs_B {
            // Drawn for every beam, so that the scene changes no later numbers.
            let (lost, noise) = (self.at.rng.uniform() < dropout, self.at.rng.normal());
            if lost {
                continue;
            }
            let dir = truth.pose.R_WB * dir_B;
            let solid = target.obstacles.ray(&from, &dir, max_m);
            let bed = way_to_bed(target.terrain, &from, &dir, solid.unwrap_or(max_m));
            let echo_m = solid.into_iter().chain(bed).min_by(f64::total_cmp);
            match echo_m {
                Some(range) if range < min_m => {}
                Some(range) => beams.push(Beam { dir_B: *dir_B, echo_m: Some((range + noise_m * noise).max(0.0)) }),
                None => beams.push(Beam { dir_B: *dir_B, echo_m: None }),
            }
        }
        Some(RangeScan { p_BS: self.at.p_BS, max_m, beams: beams.into() })
    }
}

/// Distance along a unit vector to the bed within `max_m`, m.
fn way_to_bed(terrain: &Terrain, from: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> Option<f64> {
    let above = |range: f64| {
        let p = from + dir * range;
        p.z - terrain.bed_z(p.x, p.y)
    };
    // Over the whole beam the bed is no higher than the least depth at its ends allows: most beams end here.
    let lowest = from.z.min(from.z + dir.z * max_m);
    if lowest > -terrain.shallowest_m() {
        return None;
    }
    let (step, halvings) = BED_STEP;
    let n = (max_m / step).ceil().max(1.0) as u32;
    let at = |k: u32| max_m * f64::from(k) / f64::from(n);
    let met = (1..=n).find(|k| above(at(*k)) <= 0.0)?;
    let (mut free, mut under) = (at(met - 1), at(met));
    for _ in 0..halvings {
        let middle = 0.5 * (free + under);
        if above(middle) <= 0.0 {
            under = middle;
        } else {
            free = middle;
        }
    }
    Some(under)
}

#[cfg(test)]
mod tests;
