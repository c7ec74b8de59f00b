//! What all trials have in common: what one found and looked like, and how a vehicle is brought under way.
//!
//! *Source*, *Deviations*: see `manoeuvres.rs`. *Parameters*: cruise at three quarters of the greatest speed.

use super::sail::{DEPTH_M, STEP_S, Sailing};
use nalgebra::Vector3;
use robots::handoff::{Capabilities, Command, MoveSetpoint, Setpoint, Vertical};
use robots::vehicles::Vehicle;
use world::units::Heading;

/// A curve keeps a point each so many steps: 0.2 s.
pub(super) const THINNED: u64 = 10;

/// A number that a trial found.
#[derive(Clone, Debug, PartialEq)]
pub struct TrialNumber {
    /// What it is.
    pub what: &'static str,
    /// Its value, `None` if the trial did not come so far.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: &'static str,
}

/// A line of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Title, label of x, label of y.
    pub labels: [&'static str; 3],
    /// Points.
    pub points: Vec<[f64; 2]>,
    /// Whether one unit is as long on both axes.
    pub plan: bool,
    /// Points of the rudder's line in the same panel, if it is a trial by rudder against time.
    pub rudder: Vec<[f64; 2]>,
}

/// A trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Its name.
    pub name: &'static str,
    /// What was found.
    pub found: Vec<TrialNumber>,
    /// What it looked like.
    pub curve: Curve,
    /// Heading, rudder and place every 0.2 s, if it is a trial by rudder.
    pub rows: Vec<SteeringRow>,
}

pub(super) fn measured(what: &'static str, value: impl Into<Option<f64>>, unit: &'static str) -> TrialNumber {
    TrialNumber { what, value: value.into(), unit }
}

/// A vehicle at one moment of a trial by rudder; all since the first order to the rudder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SteeringRow {
    /// Time, s.
    pub t_s: f64,
    /// Way along the first course, m.
    pub ahead_m: f64,
    /// Way across it, to starboard, m.
    pub starboard_m: f64,
    /// How far it has turned to starboard, degrees; more than 360 after more than one circle.
    pub heading_deg: f64,
    /// Where the rudder is, degrees, positive to starboard.
    pub rudder_deg: f64,
    /// Speed through the water, m/s.
    pub speed_m_s: f64,
}

/// Whether it goes up and down, and holds no depth.
pub(super) fn glides(able: &Capabilities) -> bool {
    able.dives && !able.holds_depth
}

/// How long a turn may take, s.
pub(super) fn patience_s(able: &Capabilities) -> f64 {
    if glides(able) { 2000.0 } else { 240.0 }
}

/// A command of heading and speed for the vehicle's kind.
pub(super) fn command(able: &Capabilities, heading: Heading, speed_m_s: f64, depth_m: f64) -> Command {
    let vertical = Vertical::Depth(depth_m);
    if able.hovers {
        Command::Move(MoveSetpoint { heading, over_ground_m_s: heading.unit() * speed_m_s, vertical })
    } else {
        Command::Steer(Setpoint { heading, water_speed_m_s: speed_m_s, vertical })
    }
}

pub(super) fn depth_of(able: &Capabilities) -> f64 {
    if able.dives { DEPTH_M } else { 0.0 }
}

/// Cruise: three quarters of the greatest speed, but not below what it can be steered at.
pub(super) fn cruise(able: &Capabilities) -> f64 {
    (0.75 * able.top_speed_m_s).max(able.least_speed_m_s)
}

/// Brought to cruise.
pub(super) fn cruising(craft: &Vehicle, able: &Capabilities) -> Sailing {
    let mut sailing = Sailing::new(craft, able, Vector3::zeros());
    let north = command(able, Heading::from_deg(0.0), cruise(able), depth_of(able));
    for _ in 0..(90.0 / STEP_S) as u32 {
        sailing.obeying(&north);
    }
    sailing
}

/// Under way to the north: at cruise, or on a glide.
pub(super) fn approach(craft: &Vehicle, able: &Capabilities) -> Sailing {
    if !glides(able) {
        return cruising(craft, able);
    }
    let mut sailing = Sailing::new(craft, able, Vector3::zeros());
    let north = command(able, Heading::from_deg(0.0), able.top_speed_m_s, DEPTH_M);
    for _ in 0..(60.0 / STEP_S) as u32 {
        sailing.obeying(&north);
    }
    sailing
}
