//! A picture of the whole run at one instant, as plain data: what recording, live state, files and
//! figures are made from. Made in the Report stage; nobody who reads it can reach back.

pub mod system;

pub use crate::auv::{PictureFrame, PingFrame, RobotFrame};
pub use crate::gantry::GantryFrame;

use crate::abnormal::Abnormal;

/// The run at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Simulated time, s; zero is the start of the mission, after the spin-up.
    pub t_s: f64,
    /// Step of the mission.
    pub step: u64,
    /// All robots, in the scenario's order.
    pub robots: Vec<RobotFrame>,
    /// All gantries, in the scenario's order.
    pub gantries: Vec<GantryFrame>,
    /// What went wrong so far, whether over or not.
    pub abnormal: Vec<Abnormal>,
}

/// Some of the plume's filaments at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlumeFrame {
    /// Simulated time, s.
    pub t_s: f64,
    /// How many filaments there are in all.
    pub total: usize,
    /// Of each filament shown: x, y, z (m, ENU), size (m), the mass (kg) of all filaments that it stands for, so that the masses
    /// sum to what is in the water, and how many those are.
    pub points: Vec<[f32; 6]>,
}
