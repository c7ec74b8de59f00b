//! Conductivity, temperature and depth: the density of the water at its mount, with a first-order response.
//!
//! *Source:* a pumped profiler for vehicles, Sea-Bird SBE 49 FastCAT (data sheet: 16 Hz, accuracies 0.0003 S/m and
//! 0.002 °C); the need for a fast one: Pang 2009, sections 6 and 7 (the CTD on board "was not used due to its slow
//! response time").
//!
//! *Parameters:* rate `rate_hz` 10 Hz; time constant `response_s` 0.1 s; noise `noise_kg_m3` 0.01 kg/m³. Density
//! changes by about 7 kg/m³ for 1 S/m and 1 kg/m³ for 1 °C, so the accuracies amount to 0.003 kg/m³; the rest
//! accounts for the different responses of the two sensors where conductivity and temperature change together.
//!
//! *Deviations:* it reports the density itself, not conductivity and temperature, because the simulated water has no
//! salt and heat of its own. The depth comes from the depth sensor; this instrument measures none.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use crate::error::RobotError;
use crate::handoff::{CtdReading, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::fields::Flow;
use world::frames::Truth;
use world::math;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Parameters of the CTD.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CtdSpec {
    /// Readings per second, Hz.
    #[default(Positive::new(10.0))]
    pub rate_hz: Positive,
    /// Time constant of its response, s.
    #[default(NonNegative::new(0.1))]
    pub response_s: NonNegative,
    /// Standard deviation of the noise, kg/m³.
    #[default(NonNegative::new(0.01))]
    pub noise_kg_m3: NonNegative,
}

impl Listed for CtdSpec {
    const ENTRY: Entry = Entry {
        name: "ctd",
        what: "Density of the water at the vehicle: response, noise, rate.",
        source: "Sea-Bird SBE 49 FastCAT data sheet; Pang 2009, section 7",
    };
}

impl SensorParams for CtdSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Ctd::new(self, on.place("ctd")?, &on.robot)?))
    }
}

impl Sensor for Ctd {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.ctd = self.read(around.clock, around.truth, around.flow);
    }
}

/// A CTD on a vehicle.
#[derive(Clone, Debug)]
pub struct Ctd {
    spec: CtdSpec,
    at: Sampler,
    /// Share of the difference from the density outside that is left from one reading to the next.
    lag: f64,
    /// Density in the cell, kg/m³; `None` before the first reading.
    inside: Option<f64>,
}

impl Ctd {
    /// A CTD at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step.
    pub fn new(spec: &CtdSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        let at = Sampler::new("ctd", spec.rate_hz, p_BS, on)?;
        let response_s = spec.response_s.get();
        Ok(Self {
            lag: if response_s > 0.0 { math::exp(-at.period_s(on.dt_s) / response_s) } else { 0.0 },
            at,
            spec: spec.clone(),
            inside: None,
        })
    }

    /// The reading of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, flow: &dyn Flow) -> Option<CtdReading> {
        if !self.at.due(clock) {
            return None;
        }
        let p = self.at.place(truth);
        // Out of the water the cell keeps its content.
        let p = Vector3::new(p.x, p.y, p.z.min(0.0));
        let outside = flow.density(&p, clock.t_s());
        assert!(
            outside.is_finite(),
            "the density at {p:?} is not a finite number: the water model or the vehicle's position broke before the \
            CTD"
        );
        let inside = outside + (self.inside.unwrap_or(outside) - outside) * self.lag;
        self.inside = Some(inside);
        Some(CtdReading {
            density_kg_m3: inside + self.spec.noise_kg_m3.get() * self.at.rng.normal(),
            below_m: -self.at.p_BS.z,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{TwoLayers, assert_normal, at, run};
    use super::*;

    #[test]
    fn reads_the_density_at_its_mount_with_its_noise() {
        let mount = Vector3::new(0.0, 0.0, 0.2);
        let mut c = Ctd::new(&CtdSpec::default(), mount, &OnBoard::new("auv0", 1, 0.02)).expect("10 Hz fit");
        for (z, want) in [(-3.1, 1020.0), (-5.0, 1024.0)] {
            let t = at(0.0, 0.0, z);
            let all = run(30_000, 0.02, |k| c.read(k, &t, &TwoLayers));
            assert_eq!(all.len(), 6000);
            // The first of them still show the layer before.
            let got: Vec<f64> = all.iter().skip(20).map(|r| r.density_kg_m3).collect();
            assert_normal(&got, want, 0.01);
        }
    }

    #[test]
    fn follows_a_step_by_its_time_constant() {
        let spec =
            CtdSpec { response_s: NonNegative::new(0.5), noise_kg_m3: NonNegative::new(0.0), ..Default::default() };
        let mut c = Ctd::new(&spec, Vector3::zeros(), &OnBoard::new("auv0", 1, 0.02)).expect("10 Hz fit");
        let read = |c: &mut Ctd, n: u64, z: f64| {
            let t = at(0.0, 0.0, z);
            let all = run(n, 0.02, |k| c.read(k, &t, &TwoLayers));
            all.last().expect("due at once").density_kg_m3
        };
        assert_eq!(read(&mut c, 1, -2.0), 1020.0);
        // Five readings, half a second: 1 - 1/e of the 4 kg/m³.
        let want = 1020.0 + 4.0 * (1.0 - math::exp(-1.0));
        assert!((read(&mut c, 25, -4.0) - want).abs() < 1e-9);
        // Above the surface the reading is held.
        assert!(read(&mut c, 1, 0.3) < want);
    }
}
