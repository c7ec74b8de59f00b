//! Readings of instruments to publish: a ping of the ranging, one of the sidescan, a picture.

use super::kit::frame;
use image::{Rgb, RgbImage};
use nalgebra::{UnitQuaternion, Vector3};
use rheotaxis::frame::{PictureFrame, PingFrame, TimedReading};
use robots::handoff::{Beam, Picture, RangeScan, SidescanPing};
use std::sync::Arc;

/// A ping with an echo 3 m ahead of the instrument and a free beam.
pub(super) fn ping_ahead() -> TimedReading<RangeScan> {
    let beam = |echo_m| Beam { dir_B: Vector3::x(), echo_m };
    TimedReading {
        t_s: 0.5,
        value: RangeScan {
            p_BS: Vector3::new(0.5, 0.0, 0.0),
            max_m: 40.0,
            beams: Arc::new([beam(Some(3.0)), beam(None)]),
        },
    }
}

/// A small red picture.
pub(super) fn picture(t_s: f64) -> PictureFrame {
    let robot = &frame(0).robots[0];
    PictureFrame {
        t_s,
        robot: robot.id.clone(),
        picture: Picture {
            image: Arc::new(RgbImage::from_pixel(16, 8, Rgb([200, 30, 20]))),
            p_BC: Vector3::new(0.5, 0.0, -0.1),
            R_BC: UnitQuaternion::identity(),
            view_rad: 1.0,
        },
        truth: robot.truth.pose,
        estimate: robot.estimate,
    }
}

/// Two samples to port, one to starboard.
pub(super) fn ping(t_s: f64) -> PingFrame {
    let robot = &frame(0).robots[0];
    PingFrame {
        t_s,
        robot: robot.id.clone(),
        ping: SidescanPing {
            p_BS: Vector3::zeros(),
            max_m: 20.0,
            port_db: [1.0, 2.0].into(),
            starboard_db: [3.0].into(),
        },
        estimate: robot.estimate,
    }
}
