//! Shared by the instruments' tests: a vehicle, a running clock, and the statistics of noise.

use super::tools::EchoTarget;
use super::{CameraSpec, Imaging, Surroundings};
use image::RgbImage;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use world::clock::Clock;
use world::frames::{Pose, Truth};
use world::math;
use world::obstacles::Obstacles;
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

/// A level bed 8 m down.
pub(super) const BED: Terrain = Terrain::Level { depth_m: 8.0 };

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
    static NONE: Obstacles = Obstacles(Vec::new());
    EchoTarget { terrain, obstacles: &NONE }
}
