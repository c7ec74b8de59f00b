//! A pinhole camera: the direction of each pixel, its sensor, and the lamp beside it.
//!
//! *Source:* the pinhole camera of any text on computer vision, e.g. Hartley & Zisserman 2003, Multiple View
//! Geometry, section 6.1. Its axes: x right in the picture, y down, z into the scene.
//!
//! *Parameters:* `width`, `height` in pixels 640 × 480; `view_deg` full horizontal angle of view in the water 60°;
//! `pan_deg` to the left and `tilt_deg` down from the mount's x axis, 0° and 20°; `lamp`: luminous intensity on its
//! axis `candela` 2000 cd, angle from the axis at which half of it is left `half_deg` 30°, place beside the camera
//! `right_m` 0.2, `down_m` 0 (m); those of the sensor: see `sensor.rs` of the crate `eyes`.
//!
//! *Deviations:* no distortion and no blur by lens or motion; the angle of view is that behind a flat port, already
//! narrowed. The lamp is a point.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::frames::Pose;
use world::math;
use world::ranges::{Finite, Fraction, NonNegative, Positive};

/// Parameters of a camera.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CameraSpec {
    /// Most pictures per second, Hz; a picture is taken only on request.
    #[default(Positive::new(1.0))]
    pub rate_hz: Positive,
    /// Pixels side by side, at most 4096.
    #[default(640)]
    pub width: u32,
    /// Pixels one above the other, at most 4096.
    #[default(480)]
    pub height: u32,
    /// Full horizontal angle of view in the water, °, less than 170.
    #[default(Positive::new(60.0))]
    pub view_deg: Positive,
    /// To the left of the mount's x axis, °.
    #[default(Finite::new(0.0))]
    pub pan_deg: Finite,
    /// Down from the mount's x axis, °: 90 looks straight down.
    #[default(Finite::new(20.0))]
    pub tilt_deg: Finite,
    /// Exposure and noise.
    pub sensor: SensorSpec,
    /// A lamp beside it.
    pub lamp: Option<LampSpec>,
}

impl CameraSpec {
    /// Full horizontal angle of view, rad.
    pub fn view_rad(&self) -> f64 {
        self.view_deg.get().to_radians()
    }

    /// Focal length, pixels.
    pub fn focal_px(&self) -> f64 {
        0.5 * f64::from(self.width) / math::tan(0.5 * self.view_rad())
    }

    /// Direction of a place in the picture (pixels from its upper left corner): a unit vector in camera axes.
    pub fn ray(&self, x: f64, y: f64) -> Vector3<f64> {
        let middle = [self.width, self.height].map(|n| 0.5 * f64::from(n));
        Vector3::new(x - middle[0], y - middle[1], self.focal_px()).normalize()
    }
}

/// A lamp that shines in the camera's direction.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LampSpec {
    /// Luminous intensity on its axis, cd.
    #[default(Positive::new(2000.0))]
    pub candela: Positive,
    /// Angle from its axis at which half of that intensity is left, °.
    #[default(Positive::new(30.0))]
    pub half_deg: Positive,
    /// Its place to the right of the camera, m.
    #[default(Finite::new(0.2))]
    pub right_m: Finite,
    /// Its place below the camera, m.
    #[default(Finite::new(0.0))]
    pub down_m: Finite,
}

/// Parameters of the sensor.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SensorSpec {
    /// Exposure, s; automatic without it.
    pub exposure_s: Option<Positive>,
    /// Mean of the picture that the automatic exposure aims for, as a share of full scale, before the transfer curve.
    #[default(Fraction::new(0.2))]
    pub target: Fraction,
    /// Longest automatic exposure, s.
    #[default(Positive::new(1.0 / 30.0))]
    pub max_exposure_s: Positive,
    /// Greatest automatic gain.
    #[default(Positive::new(16.0))]
    pub max_gain: Positive,
    /// Focal length over aperture.
    #[default(Positive::new(2.0))]
    pub f_number: Positive,
    /// Electrons of a pixel and colour for 1 lx s.
    #[default(Positive::new(10_000.0))]
    pub electrons_per_lux_s: Positive,
    /// Electrons at full scale.
    #[default(Positive::new(10_000.0))]
    pub full_well_e: Positive,
    /// Standard deviation of the reading noise, electrons.
    #[default(NonNegative::new(5.0))]
    pub read_noise_e: NonNegative,
    /// Greatest factor by which red and blue are multiplied to reach green's mean; 1: none.
    #[default(Positive::new(4.0))]
    pub white_balance: Positive,
    /// Factor on a colour's distance from grey.
    #[default(NonNegative::new(1.7))]
    pub saturation: NonNegative,
}

/// Rotation from camera axes to those of a body (FLU), for a camera turned to the left and down from the body's x
/// axis, rad.
pub fn turned(pan_rad: f64, tilt_rad: f64) -> UnitQuaternion<f64> {
    // Camera x, y, z are the body's right, down and forward.
    let forward = Matrix3::new(0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0);
    UnitQuaternion::from_euler_angles(0.0, tilt_rad, pan_rad)
        * UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(forward))
}

/// Pose of a camera in the world (its axes: x right in the picture, y down, z into the scene) at a place, looking along
/// a yaw (rad, from east to the left) and an angle down from the horizon (rad).
pub fn looking(p_W: Vector3<f64>, yaw_rad: f64, down_rad: f64) -> Pose {
    Pose { p_WB: p_W, R_WB: turned(yaw_rad, down_rad) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn the_axes_lie_as_said() {
        let near = |a: Vector3<f64>, b: [f64; 3]| assert!((a - Vector3::from(b)).norm() < 1e-12, "{a}");
        let east = looking(Vector3::zeros(), 0.0, 0.0).R_WB;
        near(east * Vector3::z(), [1.0, 0.0, 0.0]);
        near(east * Vector3::x(), [0.0, -1.0, 0.0]);
        near(east * Vector3::y(), [0.0, 0.0, -1.0]);
        near(turned(FRAC_PI_2, 0.0) * Vector3::z(), [0.0, 1.0, 0.0]);
        near(turned(0.0, FRAC_PI_2) * Vector3::z(), [0.0, 0.0, -1.0]);
        near(turned(0.0, FRAC_PI_2) * Vector3::y(), [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn the_picture_spans_the_angle_of_view() {
        let camera = CameraSpec::default();
        let (left, right) = (camera.ray(0.0, 240.0), camera.ray(640.0, 240.0));
        assert!((math::acos(left.dot(&right)) - camera.view_rad()).abs() < 1e-12);
        assert!((camera.ray(320.0, 240.0) - Vector3::z()).norm() < 1e-12);
    }
}
