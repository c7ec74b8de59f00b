//! All instruments of a robot, read in one go.

use super::camera::{Camera, CameraSpec, Scene};
use super::tools::Below;
use super::{
    Adcp, AdcpSpec, Altimeter, AltimeterSpec, Compass, CompassSpec, Ctd, CtdSpec, Depth, DepthSpec,
    Dvl, DvlSpec, Fluorometer, FluorometerSpec, Lbl, LblSpec, Ranging, RangingSpec, Sidescan,
    SidescanSpec,
};
use crate::error::RobotError;
use crate::handoff::{Behaviour, Decision, Picture, Readings};
use bevy_ecs::prelude::Component;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::clock::Clock;
use world::fields::{Concentration, Flow};
use world::frames::{Pose, Truth};
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// The instruments a scenario fits to a robot; one left out is not on board.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SensorsSpec {
    /// Chemical sensor.
    pub fluorometer: Option<FluorometerSpec>,
    /// Bottom track.
    pub dvl: Option<DvlSpec>,
    /// Water track.
    pub adcp: Option<AdcpSpec>,
    /// Compass and inertial unit.
    pub compass: Option<CompassSpec>,
    /// Depth.
    pub depth: Option<DepthSpec>,
    /// Density of the water.
    pub ctd: Option<CtdSpec>,
    /// Altitude.
    pub altimeter: Option<AltimeterSpec>,
    /// Position fixes.
    pub lbl: Option<LblSpec>,
    /// Forward ranging.
    pub ranging: Option<RangingSpec>,
    /// Sidescan sonar.
    pub sidescan: Option<SidescanSpec>,
    /// Camera; it takes a picture when the strategy asks for one.
    pub camera: Option<CameraSpec>,
}

/// What the strategy asked of the instruments in the step before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// A picture.
    pub picture: bool,
    /// The vehicle is on a survey.
    pub survey: bool,
}

impl From<&Decision> for Asked {
    fn from(decision: &Decision) -> Self {
        Self {
            picture: decision.picture,
            survey: decision.behaviour == Behaviour::Survey,
        }
    }
}

/// The instruments of a robot.
#[derive(Component, Clone, Debug)]
pub struct SensorSuite {
    fluorometer: Option<Fluorometer>,
    dvl: Option<Dvl>,
    adcp: Option<Adcp>,
    compass: Option<Compass>,
    depth: Option<Depth>,
    ctd: Option<Ctd>,
    altimeter: Option<Altimeter>,
    lbl: Option<Lbl>,
    ranging: Option<Ranging>,
    sidescan: Option<Sidescan>,
    camera: Option<Camera>,
}

impl SensorSuite {
    /// The instruments of `spec`. `mounts` gives the pose in body axes of the vehicle's mount of a
    /// name (`fluorometer`, `dvl`, `adcp`, `depth`, `ctd`, `altimeter`, `ranging`, `sidescan`, `camera`; compass and
    /// baseline need none).
    ///
    /// # Errors
    /// When a mount is missing or an instrument cannot be as described.
    pub fn new(
        spec: &SensorsSpec,
        mounts: &dyn Fn(&str) -> Option<Pose>,
        robot_id: &str,
        seed: u64,
        dt_s: f64,
    ) -> Result<Self, RobotError> {
        let mount = |name: &str| -> Result<Pose, RobotError> {
            mounts(name)
                .ok_or_else(|| RobotError::Invalid {
                    field: format!("sensors.{name}"),
                    problem: format!("the vehicle has no mount \"{name}\": add a link of that name to its URDF, or leave the sensor out"),
                })
        };
        let place =
            |name: &str| -> Result<Vector3<f64>, RobotError> { mount(name).map(|pose| pose.p_WB) };
        Ok(Self {
            fluorometer: (spec.fluorometer.as_ref())
                .map(|s| Fluorometer::new(s, place("fluorometer")?, robot_id, seed, dt_s))
                .transpose()?,
            dvl: (spec.dvl.as_ref())
                .map(|s| Dvl::new(s, place("dvl")?, robot_id, seed, dt_s))
                .transpose()?,
            adcp: (spec.adcp.as_ref())
                .map(|s| Adcp::new(s, place("adcp")?, robot_id, seed, dt_s))
                .transpose()?,
            compass: (spec.compass.as_ref())
                .map(|s| Compass::new(s, robot_id, seed, dt_s))
                .transpose()?,
            depth: (spec.depth.as_ref())
                .map(|s| Depth::new(s, place("depth")?, robot_id, seed, dt_s))
                .transpose()?,
            ctd: (spec.ctd.as_ref())
                .map(|s| Ctd::new(s, place("ctd")?, robot_id, seed, dt_s))
                .transpose()?,
            altimeter: (spec.altimeter.as_ref())
                .map(|s| Altimeter::new(s, place("altimeter")?, robot_id, seed, dt_s))
                .transpose()?,
            lbl: (spec.lbl.as_ref())
                .map(|s| Lbl::new(s, robot_id, seed, dt_s))
                .transpose()?,
            ranging: (spec.ranging.as_ref())
                .map(|s| Ranging::new(s, place("ranging")?, robot_id, seed, dt_s))
                .transpose()?,
            sidescan: (spec.sidescan.as_ref())
                .map(|s| Sidescan::new(s, place("sidescan")?, robot_id, seed, dt_s))
                .transpose()?,
            camera: (spec.camera.as_ref())
                .map(|s| Camera::new(s, &mount("camera")?, robot_id, seed, dt_s))
                .transpose()?,
        })
    }

    /// The picture of this step, if there is a camera, one was asked for and its time has come.
    pub fn look(
        &mut self,
        clock: &Clock,
        truth: &Truth,
        scene: &Scene<'_>,
        asked: Asked,
    ) -> Option<Picture> {
        (self.camera.as_mut()).and_then(|s| s.read(clock, truth, scene, asked.picture))
    }

    /// What the instruments but the camera ([`Self::look`]) say in this step, after what was asked of them.
    #[allow(
        clippy::too_many_arguments,
        reason = "the instruments see the whole world"
    )]
    pub fn read(
        &mut self,
        clock: &Clock,
        truth: &Truth,
        flow: &dyn Flow,
        dye: &dyn Concentration,
        terrain: &Terrain,
        obstacles: &Obstacles,
        asked: Asked,
    ) -> Readings {
        let below = &Below { terrain, obstacles };
        Readings {
            chemical: (self.fluorometer.as_mut()).and_then(|s| s.read(clock, truth, dye)),
            dvl: (self.dvl.as_mut()).and_then(|s| s.read(clock, truth, below)),
            adcp: (self.adcp.as_mut()).and_then(|s| s.read(clock, truth, flow, below)),
            attitude: (self.compass.as_mut()).and_then(|s| s.read(clock, truth)),
            depth: (self.depth.as_mut()).and_then(|s| s.read(clock, truth, flow)),
            ctd: (self.ctd.as_mut()).and_then(|s| s.read(clock, truth, flow)),
            altimeter: (self.altimeter.as_mut()).and_then(|s| s.read(clock, truth, below)),
            lbl: (self.lbl.as_mut()).and_then(|s| s.read(clock, truth)),
            ranging: (self.ranging.as_mut()).and_then(|s| s.read(clock, truth, obstacles, terrain)),
            sidescan: (self.sidescan.as_mut())
                .and_then(|s| s.read(clock, truth, obstacles, terrain, asked.survey)),
            picture: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{BED, at, run};
    use super::*;
    use world::fields::{Clean, Still};

    fn all() -> SensorsSpec {
        SensorsSpec {
            fluorometer: Some(FluorometerSpec::default()),
            dvl: Some(DvlSpec::default()),
            adcp: Some(AdcpSpec::default()),
            compass: Some(CompassSpec::default()),
            depth: Some(DepthSpec::default()),
            ctd: Some(CtdSpec::default()),
            altimeter: Some(AltimeterSpec::default()),
            lbl: Some(LblSpec::default()),
            ranging: Some(RangingSpec::default()),
            sidescan: Some(SidescanSpec {
                rate_hz: world::ranges::Positive::new(1.0),
                always: true,
                ..SidescanSpec::default()
            }),
            camera: None,
        }
    }

    fn readings(spec: &SensorsSpec, robot_id: &str) -> Vec<Readings> {
        let mounts = |_: &str| {
            Some(Pose::level(
                Vector3::zeros(),
                world::units::Heading::from_deg(90.0),
            ))
        };
        let mut suite = SensorSuite::new(spec, &mounts, robot_id, 1, 0.02).unwrap();
        let t = at(0.0, 0.0, -5.0);
        run(5_000, 0.02, |c| {
            let asked = Asked::default();
            Some(suite.read(c, &t, &Still, &Clean, &BED, &Obstacles::default(), asked))
        })
    }

    #[test]
    fn taking_an_instrument_off_shifts_no_other() {
        let whole = readings(&all(), "auv0");
        let mut lost = 0;
        for name in [
            "fluorometer",
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
            let (mut spec, mut want) = (all(), whole.clone());
            match name {
                "fluorometer" => spec.fluorometer = None,
                "dvl" => spec.dvl = None,
                "adcp" => spec.adcp = None,
                "compass" => spec.compass = None,
                "depth" => spec.depth = None,
                "ctd" => spec.ctd = None,
                "altimeter" => spec.altimeter = None,
                "lbl" => spec.lbl = None,
                "ranging" => spec.ranging = None,
                _ => spec.sidescan = None,
            }
            for r in &mut want {
                let before = r.clone();
                match name {
                    "fluorometer" => r.chemical = None,
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
        // 100 s at 10, 5, 1, 25, 25, 10, 5, 2 and 1 Hz, and what came through of 3 fixes.
        let fixes = whole.iter().filter(|r| r.lbl.is_some()).count();
        assert_eq!(
            lost,
            1000 + 500 + 100 + 2500 + 2500 + 1000 + 500 + 200 + 100 + fixes
        );
    }

    #[test]
    fn two_robots_have_noise_of_their_own() {
        let (a, b) = (readings(&all(), "auv0"), readings(&all(), "auv1"));
        assert_ne!(a[0].depth, b[0].depth);
        assert_eq!(a, readings(&all(), "auv0"));
    }

    #[test]
    fn a_missing_mount_is_named() {
        let none = |name: &str| {
            (name != "adcp")
                .then(|| Pose::level(Vector3::zeros(), world::units::Heading::from_deg(0.0)))
        };
        let e = SensorSuite::new(&all(), &none, "auv0", 1, 0.02).expect_err("no adcp mount");
        assert_eq!(
            e.to_string(),
            "sensors.adcp: the vehicle has no mount \"adcp\": add a link of that name to its URDF, or leave the sensor out"
        );
    }
}
