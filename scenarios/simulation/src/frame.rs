//! The state of a run at one instant, as plain data.
//!
//! Recordings, live state, tables and figures are made from frames. A frame is a copy: nothing that is done with it
//! changes the run. Robots and gantries have their own types here; any other apparatus publishes values of
//! [topics](crate::topic), which are in [`Frame::published`].

mod gantry;
mod readings;
mod robot;

pub use gantry::GantryFrame;
pub use readings::{NewestReadings, TimedReading};
pub use robot::{PictureFrame, PingFrame, RobotFrame};

use crate::incidents::Incident;
use crate::topic::TopicValue;
use nalgebra::Vector2;

/// The run at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Simulated time, s; zero is the start of the mission, after the spin-up.
    pub t_s: f64,
    /// Step of the mission.
    pub step: u64,
    /// All robots, in the scenario's order.
    pub robots: Vec<RobotFrame>,
    /// All gantries, in the scenario's order.
    pub gantries: Vec<GantryFrame>,
    /// All abnormal events so far, including those that are over.
    pub abnormal: Vec<Incident>,
    /// The newest value of each topic that was published since the previous frame, sorted by key.
    pub published: Vec<TopicValue>,
}

/// Some of the plume's filaments at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlumeFrame {
    /// Simulated time, s.
    pub t_s: f64,
    /// Number of all filaments.
    pub total: usize,
    /// For each filament shown: x, y, z (m, ENU), size (m), the mass (kg) of all filaments that it stands for, and
    /// their number. The masses sum to the mass in the water.
    pub points: Vec<[f64; 6]>,
    /// Centre of the area (east, north), m. Clouds of single precision are relative to it.
    pub centre: Vector2<f64>,
}

/// The flow of the water at one instant, on a coarse grid of places and heights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaterFrame {
    /// Simulated time, s.
    pub t_s: f64,
    /// x, y, z (m, ENU) and the velocity there, east, north, up (m/s).
    pub points: Vec<[f64; 6]>,
    /// Centre of the area (east, north), m. Clouds of single precision are relative to it.
    pub centre: Vector2<f64>,
}

impl PlumeFrame {
    /// The points in single precision, east and north relative to the centre of the area.
    pub fn local(&self) -> Vec<[f32; 6]> {
        local(&self.points, self.centre)
    }
}

impl WaterFrame {
    /// The points in single precision, east and north relative to the centre of the area.
    pub fn local(&self) -> Vec<[f32; 6]> {
        local(&self.points, self.centre)
    }
}

fn local(points: &[[f64; 6]], centre: Vector2<f64>) -> Vec<[f32; 6]> {
    let near = |&[x, y, a, b, c, d]: &[f64; 6]| [x - centre.x, y - centre.y, a, b, c, d];
    points.iter().map(|p| near(p).map(|v| v as f32)).collect()
}
