//! Camera: takes a picture of the scene before its mount when the strategy asks for one.
//!
//! *Source:* the picture is that of `render.rs`; a still camera triggered at a declaration or a last detection: Tian
//! et al. 2013, Sensors 13, 3776, section 6.
//!
//! *Parameters:* `rate_hz` most pictures per second, 1 Hz; the others in `model.rs` and `sensor.rs`.
//!
//! *Deviations:* a picture requested before the period of the last one is over is taken at its end.

use super::super::on_board::OnBoard;
use super::super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use super::model::{CameraModel, CameraSpec, turned};
use super::render::render;
use super::scene::Scene;
use crate::error::{RobotError, require};
use crate::handoff::{Picture, Readings};
use nalgebra::{UnitQuaternion, Vector3};
use std::sync::Arc;
use world::catalogue::Entry;
use world::clock::Clock;
use world::cost::{Cost, Part, Times};
use world::frames::{Pose, Truth};
use world::registry::Listed;

/// Most pixels along a side.
const MOST: u32 = 4096;

/// Time for a pixel of a picture, s, and memory while the picture is made and judged, bytes (see `world::cost`).
const PIXEL: (f64, f64) = (0.5e-6, 200.0);

impl Listed for CameraSpec {
    const ENTRY: Entry = Entry {
        name: "camera",
        what: "Pictures through the water when asked for: attenuation, veil, dye, daylight or lamp, sensor noise.",
        source: "Jaffe 1990, IEEE J. Oceanic Eng. 15, 101; Williamson & Hollins 2022, Appl. Opt. 61, 9951; Zaneveld & \
            Pegau 2003, Opt. Express 11, 2997",
    };
}

impl SensorParams for CameraSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        let mount = on.mount("camera")?;
        Ok(Box::new(Camera::new(self, &mount, &on.robot)?))
    }

    fn cost(&self, _: f64, used: f64, times: &Times) -> Cost {
        let pixels = f64::from(self.width) * f64::from(self.height);
        let pictures = times.mission_s * used * self.rate_hz.get().min(1.0);
        let what = format!("about {pictures:.0} pictures of {pixels:.1e} pixels");
        let part = Part::new("width", what)
            .holds(pixels * PIXEL.1)
            .takes(pictures * pixels * PIXEL.0)
            .by(f64::from(self.width), 1.0);
        Cost::single(part)
    }
}

impl Sensor for Camera {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        let scene =
            Scene { terrain: around.terrain, obstacles: around.obstacles, dye: around.dye, optics: around.optics };
        readings.picture = self.read(around.clock, around.truth, &scene, around.asked.picture);
    }
}

/// A camera on a vehicle.
#[derive(Clone, Debug)]
pub struct Camera {
    model: CameraModel,
    p_BC: Vector3<f64>,
    R_BC: UnitQuaternion<f64>,
    /// Steps from one picture to the next.
    wait: u64,
    next: u64,
    asked: bool,
    taken: u64,
    key: u64,
}

impl Camera {
    /// A camera at the mount `pose_BM` (body axes) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step, or if the picture's size or angle is out of range.
    pub fn new(spec: &CameraSpec, pose_BM: &Pose, on: &OnBoard) -> Result<Self, RobotError> {
        let must =
            |holds: bool, field: &str, problem: String| require(holds, format!("sensors.camera.{field}"), problem);
        for (field, n) in [("width", spec.width), ("height", spec.height)] {
            must((1..=MOST).contains(&n), field, format!("must be from 1 to {MOST}, got {n}"))?;
        }
        let view = spec.view_deg.get();
        must(view < 170.0, "view_deg", format!("must be less than 170, got {view}"))?;
        let every = on.every("sensors.camera.rate_hz", spec.rate_hz.get())?;
        let look = turned(spec.pan_deg.get().to_radians(), spec.tilt_deg.get().to_radians());
        Ok(Self {
            model: CameraModel::new(spec),
            p_BC: pose_BM.p_WB,
            R_BC: pose_BM.R_WB * look,
            wait: every.steps,
            next: 0,
            asked: false,
            taken: 0,
            key: on.key("camera"),
        })
    }

    /// The picture of this step, if one was requested and its time has come.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, scene: &Scene<'_>, asked: bool) -> Option<Picture> {
        self.asked |= asked;
        if !self.asked || clock.step < self.next {
            return None;
        }
        self.asked = false;
        self.next = clock.step + self.wait;
        let pose_WC = Pose { p_WB: truth.pose.point(self.p_BC), R_WB: truth.pose.R_WB * self.R_BC };
        // The number of the picture, not the time, so that pictures differ at whatever times they are requested.
        let noise = self.key.wrapping_add(self.taken);
        self.taken += 1;
        let made = render(&self.model, &pose_WC, scene, noise);
        Some(Picture { image: Arc::new(made.image), p_BC: self.p_BC, R_BC: self.R_BC, view_rad: self.model.view_rad })
    }
}
