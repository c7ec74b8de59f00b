//! Fluorometer: dye concentration at its mount as a voltage, with response time, noise, quantisation and saturation.
//!
//! *Source:* Turner Designs Cyclops-7: 0–5 V for 0–10 µg/L rhodamine WT at gain ×100 (Sea-Bird application note 74);
//! read at 10 Hz with a threshold of 4 % of full scale: Pang 2009, section 6.
//!
//! *Parameters:* rate `rate_hz` 10 Hz; full scale `full_scale_ug_l` 10 µg/L ↔ `full_scale_v` 5 V; threshold
//! `threshold` 0.04 of full scale (0.2 V); time constant `response_s`; output noise `noise_v`, one standard
//! deviation; converter `adc_bits` over full scale. The last three are not published for the vehicle: 0.2 s, 0.02 V
//! and 12 bits, values typical of the type.
//!
//! *Deviations:* none from a first-order instrument: dy/dt = (c − y)/τ is solved exactly for a concentration that is
//! linear between two samples. Power-up time and blank drift are left out.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use crate::error::{RobotError, require};
use crate::handoff::{ChemicalReading, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::fields::Concentration;
use world::frames::Truth;
use world::math;
use world::ranges::{Fraction, NonNegative, Positive};
use world::registry::Listed;
use world::units::KG_M3_PER_UG_L;

/// Parameters of the fluorometer.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FluorometerSpec {
    /// Readings per second, Hz.
    #[default(Positive::new(10.0))]
    pub rate_hz: Positive,
    /// Concentration at full scale, µg/L.
    #[default(Positive::new(10.0))]
    pub full_scale_ug_l: Positive,
    /// Output at full scale, V.
    #[default(Positive::new(5.0))]
    pub full_scale_v: Positive,
    /// Detection threshold, as a share of full scale.
    #[default(Fraction::new(0.04))]
    pub threshold: Fraction,
    /// Time constant of the first-order response, s.
    #[default(NonNegative::new(0.2))]
    pub response_s: NonNegative,
    /// Standard deviation of the output noise, V.
    #[default(NonNegative::new(0.02))]
    pub noise_v: NonNegative,
    /// Bits of the converter.
    #[default(12)]
    pub adc_bits: u8,
}

impl Listed for FluorometerSpec {
    const ENTRY: Entry = Entry {
        name: "fluorometer",
        what: "Dye concentration as a voltage: first-order response, noise, quantisation, saturation, detection \
            threshold.",
        source: "Turner Designs Cyclops-7 (Sea-Bird application note 74); Pang 2009, section 6",
    };
}

impl SensorParams for FluorometerSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Fluorometer::new(self, on.place("fluorometer")?, &on.robot)?))
    }
}

impl Sensor for Fluorometer {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.chemical = self.read(around.clock, around.truth, around.dye);
    }
}

/// A fluorometer on a vehicle.
#[derive(Clone, Debug)]
pub struct Fluorometer {
    spec: FluorometerSpec,
    at: Sampler,
    full_scale_kg_m3: f64,
    levels: f64,
    response: Response,
}

/// First-order response, exact for an input that is linear between samples.
#[derive(Clone, Debug)]
struct Response {
    period_s: f64,
    tau_s: f64,
    /// What is left of a difference after a period.
    decay: f64,
    /// Newest input and output.
    state: Option<(f64, f64)>,
}

impl Response {
    fn new(period_s: f64, tau_s: f64) -> Self {
        Self { period_s, tau_s, decay: math::exp(-period_s / tau_s), state: None }
    }

    fn next(&mut self, input: f64) -> f64 {
        let output = match self.state {
            Some((before, y)) if self.tau_s > 0.0 => {
                let lag = (input - before) / self.period_s * self.tau_s;
                input - lag + (y - before + lag) * self.decay
            }
            _ => input,
        };
        self.state = Some((input, output));
        output
    }
}

impl Fluorometer {
    /// A fluorometer at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step, or if the converter has no or too many bits.
    pub fn new(spec: &FluorometerSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        Self::of(spec, ("fluorometer", "fluorometer"), p_BS, on)
    }

    /// The same whose parameters are at a field of the sensors, and that draws from a stream of this name.
    pub(super) fn of(
        spec: &FluorometerSpec,
        (field, stream): (&str, &str),
        p_BS: Vector3<f64>,
        on: &OnBoard,
    ) -> Result<Self, RobotError> {
        let bits = spec.adc_bits;
        let problem = format!("must be from 1 to 24, got {bits}");
        require((1..=24).contains(&bits), format!("sensors.{field}.adc_bits"), problem)?;
        let mut at = Sampler::new(field, spec.rate_hz, p_BS, on)?;
        at.rng = on.stream(stream);
        Ok(Self {
            full_scale_kg_m3: spec.full_scale_ug_l.get() * KG_M3_PER_UG_L,
            levels: f64::from((1_u32 << bits) - 1),
            response: Response::new(at.period_s(on.dt_s), spec.response_s.get()),
            spec: spec.clone(),
            at,
        })
    }

    /// The reading of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, dye: &dyn Concentration) -> Option<ChemicalReading> {
        if !self.at.due(clock) {
            return None;
        }
        let p = self.at.place(truth);
        let c = dye.concentration(&p);
        assert!(
            c.is_finite(),
            "the concentration at {p:?} is not a finite number: the plume model or the vehicle's position broke \
            before the fluorometer"
        );
        let full_scale_v = self.spec.full_scale_v.get();
        let clean = self.response.next(c / self.full_scale_kg_m3) * full_scale_v;
        let noisy = clean + self.spec.noise_v.get() * self.at.rng.normal();
        let share = (noisy / full_scale_v).clamp(0.0, 1.0);
        let of_full_scale = (share * self.levels).round() / self.levels;
        Some(ChemicalReading {
            volts: of_full_scale * full_scale_v,
            of_full_scale,
            detected: of_full_scale > self.spec.threshold.get(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_normal, at, run};
    use super::*;

    /// The same concentration everywhere, µg/L.
    struct Even(f64);
    impl Concentration for Even {
        fn concentration(&self, _p: &Vector3<f64>) -> f64 {
            self.0 * KG_M3_PER_UG_L
        }
    }

    fn fluorometer(spec: FluorometerSpec) -> Fluorometer {
        Fluorometer::new(&spec, Vector3::new(0.8, 0.0, 0.0), &OnBoard::new("auv0", 1, 0.02)).unwrap()
    }

    fn quiet(response_s: f64) -> FluorometerSpec {
        FluorometerSpec {
            noise_v: NonNegative::new(0.0),
            response_s: NonNegative::new(response_s),
            ..Default::default()
        }
    }

    #[test]
    fn reads_ten_times_a_second_with_its_noise() {
        let mut f = fluorometer(FluorometerSpec::default());
        let v = run(100_000, 0.02, |c| f.read(c, &at(0.0, 0.0, -5.0), &Even(5.0)));
        assert_eq!(v.len(), 20_000);
        let volts: Vec<f64> = v.iter().map(|r| r.volts).collect();
        // Rounding to 5 V / 4095 adds a deviation of 0.35 mV, 0.02 % of the noise's square.
        assert_normal(&volts, 2.5, 0.02);
    }

    /// It detects above a fifth of a volt.
    #[test]
    fn rounds_to_the_converter_and_saturates() {
        let step = 5.0 / 4095.0;
        for (ug_l, volts) in [(0.0, 0.0), (0.39, 0.195), (0.41, 0.205), (1.234, 0.617), (7.7, 3.85), (25.0, 5.0)] {
            let mut f = fluorometer(quiet(0.0));
            let r = run(1, 0.02, |c| f.read(c, &at(0.0, 0.0, -5.0), &Even(ug_l)))[0];
            assert!((r.volts - volts).abs() <= step / 2.0 + 1e-12, "{ug_l} µg/L: {}", r.volts);
            assert!((r.volts / step - (r.volts / step).round()).abs() < 1e-9);
            assert!((r.of_full_scale - r.volts / 5.0).abs() < 1e-12);
            assert_eq!(r.detected, ug_l > 0.4, "{ug_l} µg/L, {} V", r.volts);
        }
    }

    /// Compared with the response's differential equation in steps that are ten thousand times finer.
    #[test]
    fn responds_with_its_time_constant() {
        let (period, tau) = (0.1, 0.2);
        let mut f = fluorometer(quiet(tau));
        let inputs = [0.0, 0.0, 4.0, 4.0, 4.0, 1.0, 2.5, 2.5, 2.5, 0.0];
        let got = run(50, 0.02, |c| {
            let now = inputs[(c.step / 5) as usize];
            f.read(c, &at(0.0, 0.0, -5.0), &Even(now))
        });
        let (fine, mut y) = (10_000, 0.0);
        for k in 1..inputs.len() {
            for i in 0..fine {
                let share = (f64::from(i) + 0.5) / f64::from(fine);
                let c = inputs[k - 1] + (inputs[k] - inputs[k - 1]) * share;
                y += (c - y) / tau * period / f64::from(fine);
            }
            // Half a step of the converter, and the 1e-4 of the fine integration.
            let want = y * 0.5;
            assert!((got[k].volts - want).abs() < 0.5 * 5.0 / 4095.0 + 1e-4, "sample {k}");
        }
    }

    /// Dye in the eastern half only.
    struct East;
    impl Concentration for East {
        fn concentration(&self, p: &Vector3<f64>) -> f64 {
            if p.x > 0.0 { 5.0 * KG_M3_PER_UG_L } else { 0.0 }
        }
    }

    #[test]
    fn smells_at_its_mount_not_at_the_middle() {
        let mut t = at(-0.5, 0.0, -5.0);
        t.pose.R_WB = nalgebra::UnitQuaternion::identity();
        let read = |t: Truth| {
            let mut f = fluorometer(quiet(0.0));
            run(1, 0.02, |c| f.read(c, &t, &East))[0].volts
        };
        assert!(read(t) > 2.4, "the nose, 0.8 m east, is in the dye");
        assert_eq!(read(at(-0.5, 0.0, -5.0)), 0.0, "heading north it is not");
    }
}
