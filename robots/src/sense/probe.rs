//! Conductivity probes: salt concentration at each tip as a voltage, with noise, quantisation and saturation.
//!
//! *Source*: Webster, Volyanskyy & Weissburg 2012 (Bioinspir. Biomim. 7:036023), section 3: fast conductivity sensors
//! (Precision Measurement Engineering) read at 20 Hz by a converter of -5 to 5 V.
//!
//! *Parameters*: rate `rate_hz` 20 Hz; output range `range_v` -5 to 5 V; concentration at its top `full_scale_kg_m3`
//! (not published), 4.7 kg/m³, a tenth of the released 47 g/L. The paper's floor of -4.98 V is then 2e-4 of the
//! source, a fifth of the mean on the centreline 1 m away. So spikes can be detected at the 1.14 m where its trials
//! began, and only undiluted effluent at the nozzle saturates. Converter `adc_bits` 12 (not published), a step of 2.4
//! mV; white noise `noise_v` (not published), 4 mV, so that the floor, whose purpose is to exclude noise, lies five
//! deviations above clean water; time constant `response_s` 0, because 800 Hz of bandwidth (0.2 ms) is far below the
//! 50 ms between scans.
//!
//! *Deviations*: the spatial resolution of 0.5 mm, [`TIP_M`], matters only where a release has structure below its
//! filaments: it is less than the smallest eddies (0.83 mm) and far less than a filament.

use super::on_board::OnBoard;
use crate::error::{RobotError, require};
use crate::handoff::{MAX_PROBES, ProbeScan};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::clock::{Clock, Every};
use world::fields::Concentration;
use world::math;
use world::ranges::{Finite, NonNegative, Positive};
use world::seeds::Stream;

/// Parameters of the probes.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProbesSpec {
    /// Scans per second, Hz.
    #[default(Positive::new(20.0))]
    pub rate_hz: Positive,
    /// Output in clean water and at full scale, V.
    #[default([Finite::new(-5.0), Finite::new(5.0)])]
    pub range_v: [Finite; 2],
    /// Concentration at the top of the range, kg/m³.
    #[default(Positive::new(4.7))]
    pub full_scale_kg_m3: Positive,
    /// Standard deviation of the output noise, V.
    #[default(NonNegative::new(0.004))]
    pub noise_v: NonNegative,
    /// Bits of the converter over the range.
    #[default(12)]
    pub adc_bits: u8,
    /// Time constant of the first-order response, s.
    #[default(NonNegative::new(0.0))]
    pub response_s: NonNegative,
}

/// What a probe averages over, m (section 3: a spatial resolution of 0.5 mm).
pub const TIP_M: f64 = 5e-4;

/// The probes of a head, scanned together.
#[derive(Clone, Debug)]
pub struct Probes {
    every: Every,
    bottom_v: f64,
    span_v: f64,
    full_scale_kg_m3: f64,
    noise_v: f64,
    levels: f64,
    /// Share of the step to a new input that is left after a scan's period, and the time constant divided by that
    /// period.
    decay: f64,
    tau_periods: f64,
    channels: Vec<Channel>,
}

/// One probe: its own noise, and its input and output at the latest scan (shares of full scale).
#[derive(Clone, Debug)]
struct Channel {
    rng: Stream,
    latest: Option<(f64, f64)>,
}

impl Probes {
    /// Probes of these names on the robot `on`, each with a random stream of its own.
    ///
    /// # Errors
    /// If there are none or too many, if the rate does not fit the step, if the range is empty or if the converter
    /// has no or too many bits.
    pub fn new(spec: &ProbesSpec, names: &[String], on: &OnBoard) -> Result<Self, RobotError> {
        let n = names.len();
        let fits = (1..=MAX_PROBES).contains(&n);
        require(fits, "probes", format!("a head carries 1 to {MAX_PROBES} probes, got {n}"))?;
        let bits = spec.adc_bits;
        require((1..=24).contains(&bits), "probes.adc_bits", format!("must be from 1 to 24, got {bits}"))?;
        let [bottom_v, top_v] = spec.range_v.map(Finite::get);
        let problem = format!("must rise from clean water to full scale, got {bottom_v} to {top_v} V");
        require(top_v > bottom_v, "probes.range_v", problem)?;
        let every = on.every("probes.rate_hz", spec.rate_hz.get())?;
        let tau_periods = spec.response_s.get() / every.period_s(on.dt_s);
        let channel = |name: &String| Channel { rng: on.stream(&format!("probe {name}")), latest: None };
        Ok(Self {
            every,
            bottom_v,
            span_v: top_v - bottom_v,
            full_scale_kg_m3: spec.full_scale_kg_m3.get(),
            noise_v: spec.noise_v.get(),
            levels: f64::from((1_u32 << spec.adc_bits) - 1),
            decay: if tau_periods > 0.0 { math::exp(-1.0 / tau_periods) } else { 0.0 },
            tau_periods,
            channels: names.iter().map(channel).collect(),
        })
    }

    /// The scan of this step, if one is due; `tips` are the probes' places in the world (m), in the order of their
    /// names.
    pub fn read(&mut self, clock: &Clock, tips: &[Vector3<f64>], dye: &dyn Concentration) -> Option<ProbeScan> {
        assert!(
            tips.len() == self.channels.len(),
            "{} tips for {} probes: the head and its probes were assembled from different descriptions",
            tips.len(),
            self.channels.len()
        );
        if !self.every.due(clock) {
            return None;
        }
        let mut scan = ProbeScan { t_s: clock.t_s(), volts: [self.bottom_v; MAX_PROBES], count: tips.len() };
        for ((channel, p), volts) in self.channels.iter_mut().zip(tips).zip(&mut scan.volts) {
            let c = dye.sensed(p, TIP_M);
            assert!(
                c.is_finite(),
                "the concentration at {p:?} is not a finite number: the plume model or the head's position broke \
                before the probes"
            );
            let input = c / self.full_scale_kg_m3;
            // First order, exact for an input that is linear between two scans.
            let output = channel.latest.map_or(input, |(before, y)| {
                let lag = (input - before) * self.tau_periods;
                input - lag + (y - before + lag) * self.decay
            });
            channel.latest = Some((input, output));
            let noisy = output + self.noise_v * channel.rng.normal() / self.span_v;
            let share = (noisy.clamp(0.0, 1.0) * self.levels).round() / self.levels;
            *volts = self.bottom_v + share * self.span_v;
        }
        Some(scan)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_normal, run};
    use super::*;

    /// Concentration that grows to the left, kg/m³ per metre, from zero at y = 0.
    struct Slope(f64);
    impl Concentration for Slope {
        fn concentration(&self, p: &Vector3<f64>) -> f64 {
            (self.0 * p.y).max(0.0)
        }
    }

    fn names(n: usize) -> Vec<String> {
        (0..n).map(|i| format!("p{i}")).collect()
    }

    fn probes(spec: &ProbesSpec, n: usize) -> Probes {
        Probes::new(spec, &names(n), &OnBoard::new("gantry0", 1, 0.01)).expect("legal")
    }

    fn tips(ys: &[f64]) -> Vec<Vector3<f64>> {
        ys.iter().map(|y| Vector3::new(0.0, *y, 0.0)).collect()
    }

    fn quiet() -> ProbesSpec {
        ProbesSpec { noise_v: NonNegative::new(0.0), ..Default::default() }
    }

    #[test]
    fn clean_water_is_minus_five_and_full_scale_five_in_steps_of_the_converter() {
        let mut p = probes(&quiet(), 4);
        let scan = run(1, 0.01, |c| p.read(c, &tips(&[-1.0, 0.5, 1.0, 7.0]), &Slope(4.7)))[0];
        assert_eq!(scan.count, 4);
        assert_eq!((scan.volts[0], scan.volts[2], scan.volts[3]), (-5.0, 5.0, 5.0));
        let step = 10.0 / 4095.0;
        assert!(scan.volts[1].abs() <= step / 2.0 + 1e-12);
        let n = (scan.volts[1] + 5.0) / step;
        assert!((n - n.round()).abs() < 1e-9, "not a level: {n}");
    }

    #[test]
    fn twenty_scans_a_second_each_probe_with_noise_of_its_own() {
        let spec = ProbesSpec { noise_v: NonNegative::new(0.1), ..Default::default() };
        let mut p = probes(&spec, 2);
        let scans = run(100_000, 0.01, |c| p.read(c, &tips(&[0.5, 0.5]), &Slope(4.7)));
        assert_eq!(scans.len(), 20_000);
        assert!((scans[1].t_s - scans[0].t_s - 0.05).abs() < 1e-12);
        for i in 0..2 {
            let v: Vec<f64> = scans.iter().map(|s| s.volts[i]).collect();
            // Rounding to 2.4 mV adds 0.7 mV of deviation: 2.5e-5 of the noise's square.
            assert_normal(&v, 0.0, 0.1);
        }
        // Correlation of two independent records: standard error 1/sqrt(n).
        let r = scans.iter().map(|s| s.volts[0] * s.volts[1]).sum::<f64>() / 20_000.0 / 0.01;
        assert!(r.abs() < 5.0 / 20_000f64.sqrt(), "correlated: {r}");
        // Another probe beside it changes nobody's numbers.
        let mut alone = probes(&spec, 1);
        let first = run(100, 0.01, |c| alone.read(c, &tips(&[0.5]), &Slope(4.7)));
        assert!(first.iter().zip(&scans).all(|(a, b)| a.volts[0] == b.volts[0]));
    }

    #[test]
    fn a_slow_probe_follows_its_time_constant() {
        let spec = ProbesSpec { response_s: NonNegative::new(0.1), ..quiet() };
        let mut p = probes(&spec, 1);
        let v = run(60, 0.01, |c| {
            let y = if c.step < 5 { 0.0 } else { 1.0 };
            p.read(c, &tips(&[y]), &Slope(4.7))
        });
        // A ramp of T = 0.05 s to 1, then held: 1 - tau/T (1 - e^(-T/tau)) e^(-(t - T)/tau) from its end on.
        for (k, scan) in v.iter().enumerate().skip(1) {
            let after = (k as f64 - 1.0) * 0.05;
            let rest = 0.1 / 0.05 * (math::exp(0.5) - 1.0) * math::exp(-0.5 - after / 0.1);
            let want = -5.0 + 10.0 * (1.0 - rest);
            assert!((scan.volts[0] - want).abs() < 5.0 / 4095.0 + 1e-9, "scan {k}");
        }
    }

    #[test]
    fn impossible_probes_are_refused() {
        let new = |spec: &ProbesSpec, n| {
            let e = Probes::new(spec, &names(n), &OnBoard::new("g", 1, 0.01)).expect_err("impossible");
            e.to_string()
        };
        let with = |change: &dyn Fn(&mut ProbesSpec)| {
            let mut spec = ProbesSpec::default();
            change(&mut spec);
            new(&spec, 3)
        };
        for (said, wanted) in [
            (new(&quiet(), 0), "probes: a head carries 1 to 8 probes, got 0"),
            (new(&quiet(), 9), "probes: a head carries 1 to 8 probes, got 9"),
            (with(&|s| s.adc_bits = 30), "probes.adc_bits: must be from 1 to 24, got 30"),
            (with(&|s| s.range_v[1] = s.range_v[0]), "probes.range_v: must rise from clean water to full scale"),
            (with(&|s| s.rate_hz = Positive::new(800.0)), "probes.rate_hz: 800 Hz is more than one reading"),
        ] {
            assert!(said.starts_with(wanted), "{said}");
        }
    }
}
