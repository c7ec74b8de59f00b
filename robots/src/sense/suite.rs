//! All instruments of a robot, read together.

use super::camera::spec::CameraSpec;
use super::on_board::OnBoard;
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use super::{
    AdcpSpec, AltimeterSpec, CompassSpec, CtdSpec, DepthSpec, DvlSpec, FluorometerSpec, FluorometersAsideSpec, LblSpec,
    RangingSpec, SidescanSpec,
};
use crate::error::RobotError;
use crate::handoff::Readings;
use bevy_ecs::prelude::Component;
use world::cost::{Cost, Times};
use world::frames::Pose;
use world::registry::{Kind, Row, Set, Takes};

/// Share of a mission during which a vehicle surveys or uses its camera, if it does so at all.
const SURVEYS: f64 = 0.05;

/// The instruments that a scenario can fit to a robot.
#[derive(Clone, Copy, Debug)]
pub enum Sensors {}

/// The instruments on board; those not named are missing.
pub type SensorsSpec = Set<Sensors>;

impl Kind for Sensors {
    type Spec = dyn SensorParams;
    const NAME: &'static str = "SensorsSpec";
    const HEADING: &'static str = "Sensors";
    const WHAT: &'static str =
        "Instruments of a robot, each under its name. A robot has those that are given, and no others.";

    fn built_in() -> Vec<Row<Self>> {
        vec![
            Row::new::<FluorometerSpec>(),
            Row::new::<FluorometersAsideSpec>(),
            Row::new::<DvlSpec>(),
            Row::new::<AdcpSpec>(),
            Row::new::<CompassSpec>(),
            Row::new::<DepthSpec>(),
            Row::new::<CtdSpec>(),
            Row::new::<AltimeterSpec>(),
            Row::new::<LblSpec>(),
            Row::new::<RangingSpec>(),
            Row::new::<SidescanSpec>(),
            Row::new::<CameraSpec>(),
        ]
    }
}

impl<S: SensorParams + 'static> Takes<S> for Sensors {
    fn boxed(spec: S) -> Box<dyn SensorParams> {
        Box::new(spec)
    }
}

/// Memory and time of the instruments among so many obstacles; paths below `sensors`. `looks` says whether the
/// strategy uses sidescan or camera.
pub fn cost(sensors: &SensorsSpec, obstacles: usize, looks: bool, times: &Times) -> Cost {
    let mut cost = Cost::default();
    let used = if looks { SURVEYS } else { 0.0 };
    for sensor in sensors.iter() {
        let own = sensor.cost(obstacles as f64, used, times);
        cost.add(own.under(sensor.name()));
    }
    cost
}

/// An instrument of a robot; of one from another crate its name, too.
type InstrumentEntry = (Box<dyn Sensor>, Option<&'static str>);

/// The instruments of a robot.
#[derive(Component, Debug)]
pub struct SensorSuite {
    all: Vec<InstrumentEntry>,
    robot: String,
}

impl SensorSuite {
    /// The instruments of `spec`. `mounts` gives the pose in body axes of a mount of the vehicle by its name (that of
    /// the instrument; compass and baseline need none).
    ///
    /// # Errors
    /// If a mount is missing, or if an instrument's parameter is out of range.
    pub fn new(spec: &SensorsSpec, mounts: &dyn Fn(&str) -> Option<Pose>, robot: OnBoard) -> Result<Self, RobotError> {
        let on = Fitting { mounts, robot };
        let all = spec.iter().map(|s| {
            let own = s.is_own().then(|| s.name());
            s.build(&on).map(|sensor| (sensor, own))
        });
        Ok(Self { all: all.collect::<Result<_, _>>()?, robot: robot.robot_id.to_string() })
    }

    /// The readings of all instruments in this step.
    pub fn read(&mut self, around: &Surroundings) -> Readings {
        let mut readings = Readings::default();
        self.read_into(around, &mut readings);
        readings
    }

    /// The same in the place of earlier readings.
    ///
    /// # Panics
    /// If an instrument of another crate gives a reading that is no number.
    pub fn read_into(&mut self, around: &Surroundings, readings: &mut Readings) {
        // The list of other instruments keeps its memory.
        let mut other = std::mem::take(&mut readings.other);
        other.clear();
        *readings = Readings { other, ..Readings::default() };
        for (sensor, own) in &mut self.all {
            sensor.sense(around, readings);
            if let Some(name) = own {
                let fault = readings.fault();
                assert!(
                    fault.is_none(),
                    "robot \"{}\": its sensor {name} gave a reading that says nothing at {} s: {}; correct the sensor",
                    self.robot,
                    around.clock.t_s(),
                    fault.unwrap_or_default()
                );
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{all, around, at, run, suite};
    use super::*;
    use nalgebra::Vector3;
    use world::ranges::{Finite, NonNegative, Positive};
    use world::units::Heading;

    fn readings(spec: &SensorsSpec, robot_id: &str) -> Vec<Readings> {
        let mut fresh = suite(spec, OnBoard::new(robot_id, 1, 0.02));
        let mut again = suite(spec, OnBoard::new(robot_id, 1, 0.02));
        let mut kept = Readings::default();
        let t = at(0.0, 0.0, -5.0);
        run(5_000, 0.02, |c| {
            again.read_into(&around(c, &t), &mut kept);
            let fresh = fresh.read(&around(c, &t));
            assert!(fresh == kept, "nothing of the step before is left");
            Some(fresh)
        })
    }

    #[test]
    fn taking_an_instrument_off_shifts_no_other() {
        let whole = readings(&all(), "auv0");
        let mut lost = 0;
        for name in [
            "fluorometer",
            "fluorometers_aside",
            "dvl",
            "adcp",
            "compass",
            "depth",
            "ctd",
            "altimeter",
            "lbl",
            "ranging",
            "sidescan",
        ] {
            let (spec, mut want) = (all().without(name), whole.clone());
            for r in &mut want {
                let before = r.clone();
                match name {
                    "fluorometer" => r.chemical = None,
                    "fluorometers_aside" => r.sides = None,
                    "dvl" => r.dvl = None,
                    "adcp" => r.adcp = None,
                    "compass" => r.attitude = None,
                    "depth" => r.depth = None,
                    "ctd" => r.ctd = None,
                    "altimeter" => r.altimeter = None,
                    "lbl" => r.lbl = None,
                    "ranging" => r.ranging = None,
                    _ => r.sidescan = None,
                }
                lost += usize::from(*r != before);
            }
            assert!(readings(&spec, "auv0") == want, "without {name}");
        }
        // 100 s at 10, 10, 5, 1, 25, 25, 10, 5, 2 and 1 Hz, and the successful ones of 3 fixes.
        let fixes = whole.iter().filter(|r| r.lbl.is_some()).count();
        assert_eq!(lost, 1000 + 1000 + 500 + 100 + 2500 + 2500 + 1000 + 500 + 200 + 100 + fixes);
    }

    #[test]
    fn two_robots_have_noise_of_their_own() {
        let (a, b) = (readings(&all(), "auv0"), readings(&all(), "auv1"));
        assert_ne!(a[0].depth, b[0].depth);
        assert_eq!(a, readings(&all(), "auv0"));
    }

    /// A missing mount, a rate, numbers of one instrument that contradict each other.
    #[test]
    fn what_cannot_be_fitted_is_refused_with_its_field() {
        fn refused<S: SensorParams + 'static>(spec: S) -> String {
            let mounts = |_: &str| Some(Pose::level(Vector3::zeros(), Heading::from_deg(0.0)));
            let spec = SensorsSpec::default().with(spec);
            SensorSuite::new(&spec, &mounts, OnBoard::new("auv0", 1, 0.02)).expect_err("impossible").to_string()
        }
        let (hz, zero_to) = (Positive::new, NonNegative::new);
        for (said, wanted) in [
            (
                refused(FluorometerSpec { rate_hz: hz(100.0), ..Default::default() }),
                "fluorometer.rate_hz: 100 Hz is more than one reading per step; at most 50 Hz with steps of 0.02 s",
            ),
            (
                refused(FluorometerSpec { adc_bits: 0, ..Default::default() }),
                "fluorometer.adc_bits: must be from 1 to 24",
            ),
            (
                refused(AdcpSpec { beam_angle_deg: Finite::new(75.0), ..Default::default() }),
                "adcp.beam_angle_deg: must be from 0 to below 60 degrees, got 75",
            ),
            (
                refused(DvlSpec { max_altitude_m: Positive::new(0.2), ..Default::default() }),
                "dvl.max_altitude_m: must be at least min_altitude_m, 0.5 m",
            ),
            (refused(CameraSpec { width: 0, ..Default::default() }), "camera.width: must be from 1 to 4096, got 0"),
            (
                refused(CameraSpec { view_deg: Positive::new(170.0), ..Default::default() }),
                "camera.view_deg: must be less than 170, got 170",
            ),
            (refused(CameraSpec { rate_hz: hz(60.0), ..Default::default() }), "camera.rate_hz: 60 Hz is more than one"),
            (
                refused(RangingSpec { rate_hz: hz(80.0), ..Default::default() }),
                "ranging.rate_hz: 80 Hz is more than one",
            ),
            (refused(RangingSpec { beams: 0, ..Default::default() }), "ranging.beams: must be at least 1"),
            (refused(RangingSpec { beams: 200, rows: 200, ..Default::default() }), "at most 1024"),
            (refused(RangingSpec { width_deg: zero_to(400.0), ..Default::default() }), "from 0 to 360"),
            (refused(RangingSpec { min_range_m: zero_to(40.0), ..Default::default() }), "greater than min_range_m"),
            (refused(SidescanSpec { samples: 0, ..Default::default() }), "from 1 to 4096"),
            (refused(SidescanSpec { rate_hz: hz(40.0), ..Default::default() }), "at most 37.5 Hz"),
            (refused(SidescanSpec { tilt_deg: zero_to(100.0), ..Default::default() }), "at most 90"),
        ] {
            assert!(said.starts_with("sensors.") && said.contains(wanted), "{said}");
        }
        let none = SensorSuite::new(&all(), &|_| None, OnBoard::new("auv0", 1, 0.02)).expect_err("no mount");
        let said = none.to_string();
        assert!(said.starts_with("sensors.fluorometer: the vehicle has no mount \"fluorometer\""), "{said}");
    }
}
