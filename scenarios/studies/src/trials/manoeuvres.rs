//! The trials: speed, turning circle, zigzags, turns by the autopilot, dive, stop, station keeping; of a glider its
//! sawtooth.
//!
//! *Source*: International Maritime Organization, "Standards for ship manoeuvrability", MSC.137(76), 2002: turning
//! circle, zigzag, stopping; dive and station keeping likewise for vehicles under water.
//!
//! *Parameters*: beside each trial.
//!
//! *Deviations*: those of circle and zigzag stand in `steering.rs`. In all others the vehicle's own autopilot steers, as
//! in a mission.

use super::kinds::{sawtooth, station};
use super::rudder::Rudder;
use super::sail::{DEPTH_M, STEP_S, Sailing};
use super::steering::{SteeringRow, circle, zigzag};
use super::straight::{dive, speed, stop};
use super::turns::{headings, turn};
use nalgebra::Vector3;
use robots::guide::GuidanceSpec;
use robots::handoff::{Capabilities, Command, MoveSetpoint, Setpoint, Vertical};
use robots::vehicles::Craft;
use world::units::Heading;

/// A curve keeps a point each so many steps: 0.2 s.
pub(super) const THINNED: u64 = 10;

/// A number that a trial found.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
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
    pub found: Vec<Measured>,
    /// What it looked like.
    pub curve: Curve,
    /// Heading, rudder and place every 0.2 s, if it is a trial by rudder.
    pub rows: Vec<SteeringRow>,
}

pub(super) fn measured(
    what: &'static str,
    value: impl Into<Option<f64>>,
    unit: &'static str,
) -> Measured {
    Measured {
        what,
        value: value.into(),
        unit,
    }
}

/// All trials that make sense for a vehicle. One without a rudder has no turning circle and no zigzag.
#[must_use]
pub fn trials(craft: &Craft) -> Vec<Trial> {
    let able = craft.capabilities(GuidanceSpec::default().tightest_turn_m());
    let mut all = Vec::new();
    if glides(&able) {
        all.push(sawtooth(craft, &able));
    } else {
        all.push(speed(craft, &able));
    }
    if let Some(rudder) = Rudder::fitted(craft) {
        let most_s = patience_s(&able);
        all.push(circle(craft, &able, &rudder, most_s));
        for angle_deg in [10.0, 20.0] {
            all.push(zigzag(craft, &able, &rudder, angle_deg, most_s));
        }
    }
    all.push(turn(craft, &able));
    if glides(&able) {
        return all;
    }
    all.push(headings(craft, &able));
    if able.dives {
        all.push(dive(craft, &able));
    }
    all.push(stop(craft, &able));
    if able.hovers {
        all.push(station(craft, &able));
    }
    all
}

/// Whether a vehicle has a rudder, which turning circle and zigzag need.
#[must_use]
pub fn has_rudder(craft: &Craft) -> bool {
    Rudder::fitted(craft).is_some()
}

fn glides(able: &Capabilities) -> bool {
    able.dives && !able.holds_depth
}

/// How long a turn may take, s.
pub(super) fn patience_s(able: &Capabilities) -> f64 {
    if glides(able) { 2000.0 } else { 240.0 }
}

/// A command of heading and speed for the vehicle's kind.
pub(super) fn command(
    able: &Capabilities,
    heading: Heading,
    speed_m_s: f64,
    depth_m: f64,
) -> Command {
    let vertical = Vertical::Depth(depth_m);
    if able.hovers {
        Command::Move(MoveSetpoint {
            heading,
            over_ground_m_s: heading.unit() * speed_m_s,
            vertical,
        })
    } else {
        Command::Steer(Setpoint {
            heading,
            water_speed_m_s: speed_m_s,
            vertical,
        })
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
pub(super) fn cruising(craft: &Craft, able: &Capabilities) -> Sailing {
    let mut sailing = Sailing::new(craft, able, Vector3::zeros());
    let north = command(able, Heading::from_deg(0.0), cruise(able), depth_of(able));
    for _ in 0..(90.0 / STEP_S) as u32 {
        sailing.obeying(&north);
    }
    sailing
}

/// Under way to the north: at cruise, or on a glide.
pub(super) fn approach(craft: &Craft, able: &Capabilities) -> Sailing {
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
