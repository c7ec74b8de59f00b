//! Trials on a straight course: full ahead, dive, stop.
//!
//! *Source*, *Parameters*, *Deviations*: see `manoeuvres.rs`.

use super::sail::{STEP_S, Sailing};
use super::trial::{Curve, THINNED, Trial, command, cruise, cruising, depth_of, measured};
use nalgebra::Vector3;
use robots::handoff::Capabilities;
use robots::vehicles::Vehicle;
use world::units::Heading;

/// Full ahead from rest, 120 s.
pub(super) fn speed(craft: &Vehicle, able: &Capabilities) -> Trial {
    let mut sailing = Sailing::new(craft, able, Vector3::zeros());
    let ahead = command(able, Heading::from_deg(0.0), 2.0 * able.top_speed_m_s, depth_of(able));
    let mut points = Vec::new();
    let mut all = Vec::new();
    for k in 0..(120.0 / STEP_S) as u64 {
        sailing.obeying(&ahead);
        all.push(sailing.speed_m_s());
        if k % THINNED == 0 {
            points.push([sailing.t_s(), sailing.speed_m_s()]);
        }
    }
    let last = &all[all.len() - (10.0 / STEP_S) as usize..];
    let top = last.iter().sum::<f64>() / last.len() as f64;
    let risen = all.iter().position(|v| *v >= 0.632 * top);
    let pitch = -sailing.truth.pose.roll_pitch().1;
    Trial {
        name: "speed",
        found: vec![
            measured("steady speed at full ahead", top, "m/s"),
            measured("time to 63 % of it", risen.map(|k| (k + 1) as f64 * STEP_S), "s"),
            measured("pitch at full ahead", pitch.to_degrees(), "degrees"),
        ],
        curve: Curve { labels: ["full ahead", "time, s", "speed, m/s"], points, plan: false, rudder: Vec::new() },
        rows: Vec::new(),
    }
}

/// 5 m down at cruise.
pub(super) fn dive(craft: &Vehicle, able: &Capabilities) -> Trial {
    const BY_M: f64 = 5.0;
    let mut sailing = cruising(craft, able);
    let begun_s = sailing.t_s();
    let from_m = -sailing.truth.pose.p_WB.z;
    let down = command(able, Heading::from_deg(0.0), cruise(able), from_m + BY_M);
    let mut points = Vec::new();
    let (mut reached, mut deepest, mut sum, mut n) = (None, 0.0f64, 0.0, 0u32);
    for k in 0..(180.0 / STEP_S) as u64 {
        sailing.obeying(&down);
        let by = -sailing.truth.pose.p_WB.z - from_m;
        let t_s = sailing.t_s() - begun_s;
        if k % THINNED == 0 {
            points.push([t_s, -by]);
        }
        deepest = deepest.max(by);
        if by >= 0.9 * BY_M && reached.is_none() {
            reached = Some(t_s);
        }
        if t_s > 150.0 {
            sum += by - BY_M;
            n += 1;
        }
    }
    Trial {
        name: "dive",
        found: vec![
            measured("time to 90 % of 5 m", reached, "s"),
            measured("overshoot", reached.map(|_| (deepest - BY_M).max(0.0)), "m"),
            measured("error after 150 s", sum / f64::from(n), "m"),
        ],
        curve: Curve { labels: ["dive of 5 m", "time, s", "height, m"], points, plan: false, rudder: Vec::new() },
        rows: Vec::new(),
    }
}

/// From cruise to speed zero.
pub(super) fn stop(craft: &Vehicle, able: &Capabilities) -> Trial {
    let mut sailing = cruising(craft, able);
    let begun_s = sailing.t_s();
    let from = sailing.truth.pose.p_WB;
    let first = sailing.speed_m_s();
    let halt = command(able, Heading::from_deg(0.0), 0.0, depth_of(able));
    let mut points = Vec::new();
    let (mut slow, mut way) = (None, 0.0f64);
    for k in 0..(120.0 / STEP_S) as u64 {
        sailing.obeying(&halt);
        let t_s = sailing.t_s() - begun_s;
        if k % THINNED == 0 {
            points.push([t_s, sailing.speed_m_s()]);
        }
        way = way.max((sailing.truth.pose.p_WB - from).xy().norm());
        if sailing.speed_m_s() <= 0.1 * first && slow.is_none() {
            slow = Some((t_s, way));
        }
    }
    Trial {
        name: "stop",
        found: vec![
            measured("speed before", first, "m/s"),
            measured("time to a tenth of it", slow.map(|s| s.0), "s"),
            measured("way until then", slow.map(|s| s.1), "m"),
        ],
        curve: Curve { labels: ["stop", "time, s", "speed, m/s"], points, plan: false, rudder: Vec::new() },
        rows: Vec::new(),
    }
}
