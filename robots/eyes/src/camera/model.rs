//! A pinhole camera: the direction of each pixel, and the lamp beside it.
//!
//! *Source:* the pinhole camera of any text on computer vision, e.g. Hartley & Zisserman 2003, Multiple View
//! Geometry, section 6.1.
//!
//! *Parameters:* `width`, `height` in pixels 640 × 480; `view_deg` full horizontal angle of view in the water 60°;
//! `pan_deg` to the left and `tilt_deg` down from the mount's x axis, 0° and 20°; `lamp`: luminous intensity on its
//! axis `candela` 2000 cd, angle from the axis at which half of it is left `half_deg` 30°, place beside the camera
//! `right_m` 0.2, `down_m` 0 (m).
//!
//! *Deviations:* no distortion and no blur by lens or motion; the angle of view is that behind a flat port, already
//! narrowed. The lamp is a point.

use nalgebra::Vector3;
use robots::sense::{CameraSpec, LampSpec, SensorSpec, turned};
use world::frames::Pose;
use world::math;

/// A camera: its lens, its sensor and its lamp. Camera axes: x right in the picture, y down, z into the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraModel {
    /// Pixels side by side.
    pub width: u32,
    /// Pixels one above the other.
    pub height: u32,
    /// Full horizontal angle of view, rad.
    pub view_rad: f64,
    /// Exposure and noise.
    pub sensor: SensorSpec,
    /// A lamp beside it.
    pub lamp: Option<LampSpec>,
}

impl CameraModel {
    /// The camera of a specification; its direction is given with each picture, see [`looking`].
    pub fn new(spec: &CameraSpec) -> Self {
        Self {
            width: spec.width,
            height: spec.height,
            view_rad: spec.view_deg.get().to_radians(),
            sensor: spec.sensor.clone(),
            lamp: spec.lamp.clone(),
        }
    }

    /// Focal length, pixels.
    pub fn focal_px(&self) -> f64 {
        0.5 * f64::from(self.width) / math::tan(0.5 * self.view_rad)
    }

    /// Direction of a place in the picture (pixels from its upper left corner): a unit vector in camera axes.
    pub fn ray(&self, x: f64, y: f64) -> Vector3<f64> {
        let middle = [self.width, self.height].map(|n| 0.5 * f64::from(n));
        Vector3::new(x - middle[0], y - middle[1], self.focal_px()).normalize()
    }
}

/// Pose of a camera in the world (its axes: see [`CameraModel`]) at a place, looking along a yaw (rad, from east to
/// the left) and an angle down from the horizon (rad).
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
        let camera = CameraModel::new(&CameraSpec::default());
        let (left, right) = (camera.ray(0.0, 240.0), camera.ray(640.0, 240.0));
        assert!((math::acos(left.dot(&right)) - camera.view_rad).abs() < 1e-12);
        assert!((camera.ray(320.0, 240.0) - Vector3::z()).norm() < 1e-12);
    }
}
