//! Trials of some kinds of vehicle alone: station keeping of those that hover, the sawtooth of a glider.
//!
//! *Source*, *Parameters*, *Deviations*: see `manoeuvres.rs`.

use super::sail::{DEPTH_M, STEP_S, Sailing};
use super::trial::{Curve, THINNED, Trial, command, depth_of, measured};
use nalgebra::{Vector2, Vector3};
use robots::handoff::{Capabilities, Goal, Manoeuvre, Vertical};
use robots::vehicles::Vehicle;
use world::units::Heading;

/// Holds a point in a current of 0.25 m/s, from ahead, abeam and astern, 90 s each; the first 30 s do not count.
pub(super) fn station(craft: &Vehicle, able: &Capabilities) -> Trial {
    let speed = 0.25;
    let mut points = Vec::new();
    let (mut worst, mut squares, mut n) = (0.0f64, 0.0, 0u32);
    for quarter in 0..3 {
        let course = Heading::from_deg(180.0 - 90.0 * f64::from(quarter)).unit() * speed;
        let mut sailing = Sailing::new(craft, able, Vector3::new(course.x, course.y, 0.0));
        let goal = Goal {
            id: 1,
            manoeuvre: Manoeuvre::Hold { point: Vector2::zeros(), heading: Some(Heading::from_deg(0.0)) },
            vertical: Vertical::Depth(depth_of(able)),
            speed_m_s: able.top_speed_m_s,
        };
        for k in 0..(90.0 / STEP_S) as u64 {
            sailing.towards(&goal);
            let off = sailing.truth.pose.p_WB.xy();
            if k % THINNED == 0 {
                points.push([off.x, off.y]);
            }
            if sailing.t_s() > 30.0 {
                worst = worst.max(off.norm());
                squares += off.norm_squared();
                n += 1;
            }
        }
    }
    Trial {
        name: "station keeping",
        found: vec![
            measured("current, from ahead, abeam and astern", speed, "m/s"),
            measured("distance, root mean square after 30 s", (squares / f64::from(n)).sqrt(), "m"),
            measured("greatest distance after 30 s", worst, "m"),
        ],
        curve: Curve { labels: ["station keeping", "east, m", "north, m"], points, plan: true, rudder: Vec::new() },
        rows: Vec::new(),
    }
}

/// A glider's way up and down.
pub(super) fn sawtooth(craft: &Vehicle, able: &Capabilities) -> Trial {
    let mut sailing = Sailing::new(craft, able, Vector3::zeros());
    let north = command(able, Heading::from_deg(0.0), able.top_speed_m_s, DEPTH_M);
    let mut points = Vec::new();
    let mut legs: [Vec<(f64, f64, f64)>; 2] = [Vec::new(), Vec::new()];
    for k in 0..(3000.0 / STEP_S) as u64 {
        sailing.obeying(&north);
        let p = sailing.truth.pose.p_WB;
        if k % (10 * THINNED) == 0 {
            points.push([p.y, p.z]);
        }
        let v = sailing.truth.pose.R_WB * sailing.truth.v_WB_B;
        let pitch = -sailing.truth.pose.roll_pitch().1;
        // Away from the turns.
        if v.z.abs() > 0.03 && sailing.t_s() > 60.0 {
            legs[usize::from(v.z > 0.0)].push((v.xy().norm(), v.z, pitch.to_degrees()));
        }
    }
    let mean = |leg: &[(f64, f64, f64)], of: fn(&(f64, f64, f64)) -> f64| {
        (!leg.is_empty()).then(|| leg.iter().map(of).sum::<f64>() / leg.len() as f64)
    };
    let path = |leg: &[(f64, f64, f64)]| {
        let (across, up) = (mean(leg, |l| l.0)?, mean(leg, |l| l.1)?);
        Some(world::math::atan2(up, across).to_degrees())
    };
    let [down, up] = &legs;
    Trial {
        name: "sawtooth",
        found: vec![
            measured("horizontal speed downwards", mean(down, |l| l.0), "m/s"),
            measured("horizontal speed upwards", mean(up, |l| l.0), "m/s"),
            measured("path downwards", path(down), "degrees"),
            measured("path upwards", path(up), "degrees"),
            measured("pitch downwards", mean(down, |l| l.2), "degrees"),
            measured("pitch upwards", mean(up, |l| l.2), "degrees"),
        ],
        curve: Curve { labels: ["sawtooth", "north, m", "height, m"], points, plan: false, rudder: Vec::new() },
        rows: Vec::new(),
    }
}
