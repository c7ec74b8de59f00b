//! Pictures and echoes from camera and sidescan sonar.

use image::RgbImage;
use nalgebra::{UnitQuaternion, Vector3};
use std::sync::Arc;

/// A picture with what the vehicle knows of the camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// 8 bits per colour, row by row from the top left.
    pub image: Arc<RgbImage>,
    /// Place of the camera in body axes (FLU), m.
    pub p_BC: Vector3<f64>,
    /// Rotation from camera axes (x right in the picture, y down, z into the scene) to body axes.
    pub R_BC: UnitQuaternion<f64>,
    /// Full horizontal angle of view, rad.
    pub view_rad: f64,
}

/// One ping of the sidescan sonar: strength of the echo by slant range.
#[derive(Clone, Debug, PartialEq)]
pub struct SidescanPing {
    /// Place of the instrument in body axes (FLU), m.
    pub p_BS: Vector3<f64>,
    /// Slant range of the last sample's far end, m; the samples divide it evenly.
    pub max_m: f64,
    /// Port side, nearest first, dB above the noise floor's reference.
    pub port_db: Arc<[f32]>,
    /// To starboard.
    pub starboard_db: Arc<[f32]>,
}
