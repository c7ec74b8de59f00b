//! Two fluorometers beside the mount of the vehicle's own, one to the left and one to the right.
//!
//! *Source:* bilateral sensing on a robot: Russell et al. 2003, Robotics and Autonomous Systems 45, 83.
//!
//! *Parameters:* distance between the two `span_m`, m, 1 (ours): what a vehicle of two metres can carry on booms;
//! `each`, the parameters of both.
//!
//! *Deviations:* booms have neither weight nor drag. A vehicle searches and maps by its `fluorometer`; this pair is
//! only for who compares two sides.

use super::fluorometer::{Fluorometer, FluorometerSpec};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use crate::error::RobotError;
use crate::handoff::Readings;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;

const NAME: &str = "fluorometers_aside";

/// Parameters of the pair.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FluorometersAsideSpec {
    /// Distance between the two, m.
    #[serde(with = "world::limits::span_m")]
    #[default(Positive::new(1.0))]
    pub span_m: Positive,
    /// Each of them.
    pub each: FluorometerSpec,
}

impl Listed for FluorometersAsideSpec {
    const ENTRY: Entry = Entry {
        name: NAME,
        what: "Two fluorometers to the left and right of the fluorometer's mount, for who compares the sides.",
        source: "Russell et al. 2003, Robotics and Autonomous Systems 45, 83",
    };
}

impl SensorParams for FluorometersAsideSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        let middle = on.mount_for(NAME, "fluorometer")?.p_WB;
        let aside = Vector3::y() * (0.5 * self.span_m.get());
        let one = |side: &str, at| Fluorometer::of(&self.each, (&format!("{NAME}.each"), side), at, &on.robot);
        Ok(Box::new(Pair([one("fluorometer_left", middle + aside)?, one("fluorometer_right", middle - aside)?])))
    }
}

/// The left one and the right one.
#[derive(Debug)]
struct Pair([Fluorometer; 2]);

impl Sensor for Pair {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        let [left, right] = &mut self.0;
        let read = |one: &mut Fluorometer| one.read(around.clock, around.truth, around.dye);
        readings.sides = read(left).zip(read(right)).map(Into::into);
    }
}

#[cfg(test)]
mod tests {
    use super::super::on_board::OnBoard;
    use super::super::testing::{around, at, run};
    use super::*;
    use world::fields::Concentration;
    use world::frames::Pose;
    use world::ranges::NonNegative;
    use world::units::{Heading, KG_M3_PER_UG_L};

    /// Less and less dye towards the east.
    struct Slope;
    impl Concentration for Slope {
        fn concentration(&self, p: &Vector3<f64>) -> f64 {
            (5.0 - p.x + 0.1 * p.y) * KG_M3_PER_UG_L
        }
    }

    fn fitting<'a>(mounts: &'a dyn Fn(&str) -> Option<Pose>) -> Fitting<'a> {
        Fitting { mounts, robot: OnBoard::new("auv0", 1, 0.02) }
    }

    #[test]
    fn reads_what_two_single_ones_at_its_places_read() {
        let mount = Vector3::new(0.8, 0.0, -0.1);
        let mounts = |name: &str| (name == "fluorometer").then(|| Pose::level(mount, Heading::from_deg(90.0)));
        for noise_v in [0.0, 0.02] {
            let each = FluorometerSpec { noise_v: NonNegative::new(noise_v), ..Default::default() };
            let spec = FluorometersAsideSpec { span_m: Positive::new(3.0), each: each.clone() };
            let mut pair = spec.build(&fitting(&mounts)).expect("legal");
            let mut single = [1.5, -1.5].map(|y| {
                Fluorometer::new(&each, mount + Vector3::y() * y, &OnBoard::new("auv0", 1, 0.02)).expect("legal")
            });
            // Heading north: the left one is west.
            let truth = at(1.0, 0.0, -5.0);
            let all = run(5_000, 0.02, |clock| {
                let mut readings = Readings::default();
                pair.sense(&Surroundings { dye: &Slope, ..around(clock, &truth) }, &mut readings);
                assert_eq!(readings.chemical, None);
                let want = single.each_mut().map(|one| one.read(clock, &truth, &Slope));
                assert_eq!(readings.sides.is_some(), want[0].is_some());
                readings.sides.map(|got| (got, want.map(|w| w.expect("at the same time"))))
            });
            assert_eq!(all.len(), 1000);
            let mean = |of: &dyn Fn(usize) -> f64| (0..1000).map(of).sum::<f64>() / 1000.0;
            for side in [0, 1] {
                let (got, want) = (mean(&|k| all[k].0[side].volts), mean(&|k| all[k].1[side].volts));
                // The two means have a standard error of noise_v / √1000 each.
                assert!((got - want).abs() <= 5.0 * noise_v * 0.002_f64.sqrt() + 1e-12, "{got} V, {want} V");
            }
            assert!(mean(&|k| all[k].0[0].volts) > mean(&|k| all[k].0[1].volts) + 1.0);
            // Each has noise of its own.
            let off = |k: usize| all[k].0[0].volts - all[k].0[1].volts;
            assert_eq!((0..1000).all(|k| off(k) == off(0)), noise_v == 0.0);
        }
    }

    #[test]
    fn what_cannot_be_fitted_is_refused_with_its_field() {
        let mounts = |_: &str| Some(Pose::level(Vector3::zeros(), Heading::from_deg(0.0)));
        let each = FluorometerSpec { adc_bits: 0, ..Default::default() };
        for (each, mounts, said) in [
            (
                each,
                &mounts as &dyn Fn(&str) -> Option<Pose>,
                "sensors.fluorometers_aside.each.adc_bits: must be from 1",
            ),
            (
                FluorometerSpec { rate_hz: Positive::new(90.0), ..Default::default() },
                &mounts,
                "sensors.fluorometers_aside.each.rate_hz: 90 Hz is more than one",
            ),
            (
                FluorometerSpec::default(),
                &|_| None,
                "sensors.fluorometers_aside: the vehicle has no mount \"fluorometer\"",
            ),
        ] {
            let spec = FluorometersAsideSpec { each, ..Default::default() };
            let e = spec.build(&fitting(mounts)).expect_err("impossible").to_string();
            assert!(e.starts_with(said), "{e}");
        }
    }
}
