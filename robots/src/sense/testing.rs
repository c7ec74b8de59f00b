//! Shared by the instruments' tests: a vehicle, its instruments and what is around it, a running clock, and the
//! statistics of noise.

use super::tools::EchoTarget;
use super::{
    AdcpSpec, AltimeterSpec, CameraSpec, CompassSpec, CtdSpec, DepthSpec, DvlSpec, FluorometerSpec,
    FluorometersAsideSpec, Imaging, LblSpec, OnBoard, RangingSpec, SensorRequests, SensorSuite, SensorsSpec,
    SidescanSpec, Surroundings,
};
use image::RgbImage;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector2, Vector3};
use world::clock::Clock;
use world::fields::{Clean, Flow, Still};
use world::frames::{Pose, Truth};
use world::math;
use world::obstacles::Obstacles;
use world::ranges::Positive;
use world::terrain::Terrain;
use world::units::Heading;

/// Black pictures, with the number of their noise in the first pixel.
pub(crate) struct Dark;

impl Imaging for Dark {
    fn picture(&self, camera: &CameraSpec, _: &Pose, _: &Surroundings, noise: u64) -> RgbImage {
        let mut image = RgbImage::new(camera.width, camera.height);
        image.get_pixel_mut(0, 0).0[0] = noise as u8;
        image
    }
}

static NONE: Obstacles = Obstacles(Vec::new());

/// A level bed 8 m down.
pub(crate) const BED: Terrain = Terrain::Level { depth_m: 8.0 };

/// A bed that rises by one in ten, as deep as this at the origin.
pub(super) fn slope(shoreward_deg: f64, depth_m: f64) -> Terrain {
    let shoreward = Heading::from_deg(shoreward_deg).unit();
    let (shallow_m, deep_m, run_m) = (depth_m - 5.0, depth_m + 5.0, 100.0);
    Terrain::Slope { middle: Vector2::zeros(), shoreward, shallow_m, deep_m, run_m }
}

/// A vehicle at rest, level, heading north.
pub(super) fn at(x: f64, y: f64, z: f64) -> Truth {
    let p = Vector3::new(x, y, z);
    Truth::at_rest(Pose::level(p, Heading::from_deg(0.0)))
}

/// The same vehicle with its nose up by an angle.
pub(super) fn nose_up(mut truth: Truth, angle_deg: f64) -> Truth {
    let (s, c) = math::sin_cos(angle_deg.to_radians());
    // Columns: the turned x, y, z axes in those of the level body.
    let turn = Matrix3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    truth.pose.R_WB *= turn;
    truth
}

/// Still and clean water over the bed, and nothing requested.
pub(crate) fn around<'a>(clock: &'a Clock, truth: &'a Truth) -> Surroundings<'a> {
    let (terrain, asked) = (&BED, SensorRequests::default());
    Surroundings { clock, truth, flow: &Still, dye: &Clean, terrain, obstacles: &NONE, imaging: &Dark, asked }
}

/// All instruments but the camera; the sidescan is never silent.
pub(crate) fn all() -> SensorsSpec {
    SensorsSpec::default()
        .with(FluorometerSpec::default())
        .with(FluorometersAsideSpec::default())
        .with(DvlSpec::default())
        .with(AdcpSpec::default())
        .with(CompassSpec::default())
        .with(DepthSpec::default())
        .with(CtdSpec::default())
        .with(AltimeterSpec::default())
        .with(LblSpec::default())
        .with(RangingSpec::default())
        .with(SidescanSpec { rate_hz: Positive::new(1.0), always: true, ..SidescanSpec::default() })
}

/// These instruments in the middle of a vehicle.
pub(crate) fn suite(spec: &SensorsSpec, robot: OnBoard) -> SensorSuite {
    let mounts = |_: &str| Some(Pose::level(Vector3::zeros(), Heading::from_deg(90.0)));
    SensorSuite::new(spec, &mounts, robot).expect("legal")
}

/// Northward and light above an interface 3 m down, southward and heavy below it.
pub(crate) struct TwoLayers;
pub(crate) const UPPER: Vector3<f64> = Vector3::new(0.0, 0.22, 0.0);
pub(crate) const LOWER: Vector3<f64> = Vector3::new(0.05, -0.11, 0.0);

impl Flow for TwoLayers {
    fn velocity(&self, p: &Vector3<f64>, _: f64) -> Vector3<f64> {
        if p.z > -3.0 { UPPER } else { LOWER }
    }
    fn density(&self, p: &Vector3<f64>, _: f64) -> f64 {
        if p.z > -3.0 { 1020.0 } else { 1024.0 }
    }
}

/// Collects the results of `read` in `steps` steps of `dt_s`.
pub(super) fn run<T>(steps: u64, dt_s: f64, mut read: impl FnMut(&Clock) -> Option<T>) -> Vec<T> {
    let mut clock = Clock::new(dt_s);
    let mut said = Vec::new();
    for _ in 0..steps {
        said.extend(read(&clock));
        clock.advance();
    }
    said
}

/// Mean and standard deviation within five standard errors (σ/√n and σ/√(2n)) of the expected.
pub(super) fn assert_normal(values: &[f64], mean: f64, std: f64) {
    let n = values.len() as f64;
    assert!(n > 100.0, "too few values: {n}");
    let m = values.iter().sum::<f64>() / n;
    let s = (values.iter().map(|v| (v - m) * (v - m)).sum::<f64>() / (n - 1.0)).sqrt();
    assert!((m - mean).abs() < 5.0 * std / n.sqrt(), "mean {m}, not {mean}");
    assert!((s - std).abs() < 5.0 * std / (2.0 * n).sqrt(), "deviation {s}, not {std}");
}

/// A bed without anything on it.
pub(super) fn bare(terrain: &Terrain) -> EchoTarget<'_> {
    EchoTarget { terrain, obstacles: &NONE }
}
