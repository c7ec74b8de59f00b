//! Camera: takes a picture of the scene before its mount when the strategy asks for one.
//!
//! *Source:* a still camera triggered at a declaration or a last detection: Tian
//! et al. 2013, Sensors 13, 3776, section 6.
//!
//! *Parameters:* `rate_hz` most pictures per second, 1 Hz; the others are those of the picture, which
//! [`Imaging`](super::Imaging) makes.
//!
//! *Deviations:* a picture requested before the period of the last one is over is taken at its end.

pub(super) mod spec;

use super::on_board::OnBoard;
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use crate::error::{RobotError, require};
use crate::handoff::{Picture, Readings};
use nalgebra::{UnitQuaternion, Vector3};
use spec::{CameraSpec, turned};
use std::sync::Arc;
use world::catalogue::Entry;
use world::cost::{Cost, Part, Times};
use world::frames::Pose;
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
        readings.picture = self.read(around);
    }
}

/// A camera on a vehicle.
#[derive(Clone, Debug)]
pub struct Camera {
    spec: CameraSpec,
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
            spec: spec.clone(),
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
    pub fn read(&mut self, around: &Surroundings) -> Option<Picture> {
        let (clock, truth) = (around.clock, around.truth);
        self.asked |= around.asked.picture;
        if !self.asked || clock.step < self.next {
            return None;
        }
        self.asked = false;
        self.next = clock.step + self.wait;
        let pose_WC = Pose { p_WB: truth.pose.point(self.p_BC), R_WB: truth.pose.R_WB * self.R_BC };
        // The number of the picture, not the time, so that pictures differ at whatever times they are requested.
        let noise = self.key.wrapping_add(self.taken);
        self.taken += 1;
        let image = around.imaging.picture(&self.spec, &pose_WC, around, noise);
        Some(Picture { image: Arc::new(image), p_BC: self.p_BC, R_BC: self.R_BC, view_rad: self.spec.view_rad() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::sensor::SensorRequests;
    use super::super::testing::{around, at, run};
    use super::*;
    use world::ranges::{Finite, Positive};
    use world::units::Heading;

    #[test]
    fn the_instrument_takes_a_picture_when_asked_and_not_more_often_than_it_can() {
        let spec = CameraSpec {
            width: 16,
            height: 12,
            rate_hz: Positive::new(2.0),
            tilt_deg: Finite::new(90.0),
            ..CameraSpec::default()
        };
        let mount = Pose::level(Vector3::new(0.5, 0.0, -0.1), Heading::from_deg(90.0));
        let mut camera = Camera::new(&spec, &mount, &OnBoard::new("auv0", 3, 0.1)).unwrap();
        let truth = at(0.0, 0.0, -4.0);
        // Requested in steps 3 and 4, and then not before 20.
        let asked = [3, 4, 20];
        let said = run(40, 0.1, |clock| {
            let picture = asked.contains(&clock.step);
            let asked = SensorRequests { picture, survey: false };
            let picture = camera.read(&Surroundings { asked, ..around(clock, &truth) })?;
            Some((clock.step, picture))
        });
        let steps: Vec<u64> = said.iter().map(|s| s.0).collect();
        // Half a second is five steps: the second picture waits.
        assert_eq!(steps, [3, 8, 20]);
        assert_ne!(said[0].1.image, said[1].1.image);
        let down = said[0].1.R_BC * Vector3::z();
        assert!((down + Vector3::z()).norm() < 1e-12);
        assert!((said[0].1.p_BC - mount.p_WB).norm() < 1e-12);
    }
}
