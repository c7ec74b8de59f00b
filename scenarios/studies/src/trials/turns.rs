//! Trials that turn by the autopilot, which every vehicle has: its tightest turn, and headings from side to side.
//!
//! *Source*, *Parameters*, *Deviations*: see `manoeuvres.rs`.

use super::sail::STEP_S;
use super::trial::{Curve, THINNED, Trial, approach, command, cruise, cruising, depth_of, measured, patience_s};
use robots::handoff::{Capabilities, Command, MoveSetpoint, Vertical};
use robots::vehicles::Vehicle;
use world::units::Heading;

/// From cruise, always to starboard: the heading asked is 90 degrees ahead of the nose.
pub(super) fn turn(craft: &Vehicle, able: &Capabilities) -> Trial {
    let mut sailing = approach(craft, able);
    let begun = sailing.truth.pose;
    let (mut turned, mut last) = (0.0, begun.heading());
    let (mut advance, mut diameter) = (None, None);
    let mut points = vec![];
    let most = patience_s(able);
    let mut half = None;
    for k in 0..(most / STEP_S) as u64 {
        let ahead = last.turned(std::f64::consts::FRAC_PI_2);
        let set = if able.hovers {
            // Along its own nose, so that it is a circle and not a turn on the spot.
            Command::Move(MoveSetpoint {
                heading: ahead,
                over_ground_m_s: last.unit() * cruise(able),
                vertical: Vertical::Depth(depth_of(able)),
            })
        } else {
            command(able, ahead, cruise(able), depth_of(able))
        };
        sailing.obeying(&set);
        let now = sailing.truth.pose.heading();
        turned += last.turn_to(now);
        last = now;
        let way = sailing.truth.pose.p_WB.xy() - begun.p_WB.xy();
        if k % THINNED == 0 {
            points.push([way.x, way.y]);
        }
        let degrees = turned.to_degrees();
        if degrees >= 90.0 && advance.is_none() {
            advance = Some(way.y);
        }
        if degrees >= 180.0 && diameter.is_none() {
            diameter = Some(way.x);
            half = Some(sailing.t_s());
        }
        if degrees >= 540.0 {
            break;
        }
    }
    let v = sailing.truth.v_WB_B.xy().norm();
    let steady = half
        .filter(|_| turned.to_degrees() >= 540.0)
        .map(|t_s| (turned - std::f64::consts::PI) / (sailing.t_s() - t_s));
    Trial {
        name: "turn by the autopilot",
        found: vec![
            measured("advance at 90 degrees", advance, "m"),
            measured("tactical diameter", diameter, "m"),
            measured("turn rate", steady.map(f64::to_degrees), "degrees/s"),
            measured("radius", steady.map(|r| v / r), "m"),
            measured("radius that searchers are told", able.turning_radius_m, "m"),
            measured("speed in the turn", v, "m/s"),
        ],
        curve: Curve {
            labels: ["turn by the autopilot", "east, m", "north, m"],
            points,
            plan: true,
            rudder: Vec::new(),
        },
        rows: Vec::new(),
    }
}

/// Between headings of ±20 degrees.
pub(super) fn headings(craft: &Vehicle, able: &Capabilities) -> Trial {
    let mut sailing = cruising(craft, able);
    let begun_s = sailing.t_s();
    let mut side = 1.0;
    let mut points = Vec::new();
    let mut passed: Vec<f64> = Vec::new();
    let (mut over, mut worst) = (0.0f64, Vec::new());
    for k in 0..(180.0 / STEP_S) as u64 {
        let heading = Heading::from_deg(if side > 0.0 { 20.0 } else { 340.0 });
        sailing.obeying(&command(able, heading, cruise(able), depth_of(able)));
        let off = Heading::from_deg(0.0).turn_to(sailing.truth.pose.heading()).to_degrees();
        let t_s = sailing.t_s() - begun_s;
        if k % THINNED == 0 {
            points.push([t_s, off]);
        }
        // What it swings beyond the last heading, before it comes back.
        if !passed.is_empty() {
            over = over.max(-side * off - 20.0);
        }
        if side * off >= 19.0 {
            if !passed.is_empty() {
                worst.push(over.max(0.0));
            }
            over = 0.0;
            passed.push(t_s);
            side = -side;
        }
        if passed.len() == 5 {
            break;
        }
    }
    let period = (passed.len() == 5).then(|| (passed[4] - passed[0]) / 2.0);
    Trial {
        name: "headings by the autopilot",
        found: vec![
            measured("first heading reached after", passed.first().copied(), "s"),
            measured("overshoot", worst.iter().copied().reduce(f64::max), "degrees"),
            measured("period", period, "s"),
        ],
        curve: Curve {
            labels: ["headings by the autopilot", "time, s", "heading, degrees"],
            points,
            plan: false,
            rudder: Vec::new(),
        },
        rows: Vec::new(),
    }
}
