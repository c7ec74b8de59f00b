//! The trials: speed, turning circle, zigzag, dive, stop, station keeping; of a glider its sawtooth.
//!
//! *Source*: International Maritime Organization, "Standards for ship manoeuvrability", MSC.137(76), 2002: turning
//! circle, zigzag, stopping; dive and station keeping likewise for vehicles under water.
//!
//! *Parameters*: beside each trial.
//!
//! *Deviations*: the vehicle's own autopilot steers, as in a mission. So the circle is the tightest that it commands,
//! not one at full rudder, and the zigzag goes between headings of ±20 degrees.

use super::sail::{DEPTH_M, STEP_S, Sailing};
use nalgebra::{Vector2, Vector3};
use robots::handoff::{Capabilities, Command, Goal, Manoeuvre, MoveSetpoint, Setpoint, Vertical};
use robots::vehicles::Craft;
use world::units::Heading;

/// Turning radius of the guidance for vehicles that have none of their own, m.
const GUIDED_M: f64 = 15.0;
/// A curve keeps a point each so many steps: 0.2 s.
const THINNED: u64 = 10;

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
}

fn measured(what: &'static str, value: impl Into<Option<f64>>, unit: &'static str) -> Measured {
    Measured {
        what,
        value: value.into(),
        unit,
    }
}

/// All trials that make sense for a vehicle.
#[must_use]
pub fn trials(craft: &Craft) -> Vec<Trial> {
    let able = craft.capabilities(GUIDED_M);
    if !able.holds_depth && able.dives {
        return vec![sawtooth(craft, &able), circle(craft, &able)];
    }
    let mut all = vec![
        speed(craft, &able),
        circle(craft, &able),
        zigzag(craft, &able),
    ];
    if able.dives {
        all.push(dive(craft, &able));
    }
    all.push(stop(craft, &able));
    if able.hovers {
        all.push(station(craft, &able));
    }
    all
}

/// A command of heading and speed for the vehicle's kind.
fn command(able: &Capabilities, heading: Heading, speed_m_s: f64, depth_m: f64) -> Command {
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

fn depth_of(able: &Capabilities) -> f64 {
    if able.dives { DEPTH_M } else { 0.0 }
}

/// Cruise: three quarters of the greatest speed, but not below what it can be steered at.
fn cruise(able: &Capabilities) -> f64 {
    (0.75 * able.top_speed_m_s).max(able.least_speed_m_s)
}

/// Brought to cruise.
fn cruising(craft: &Craft, able: &Capabilities) -> Sailing {
    let mut sailing = Sailing::new(craft, able, Vector3::zeros());
    let north = command(able, Heading::from_deg(0.0), cruise(able), depth_of(able));
    for _ in 0..(90.0 / STEP_S) as u32 {
        sailing.obeying(&north);
    }
    sailing
}

/// Full ahead from rest, 120 s.
fn speed(craft: &Craft, able: &Capabilities) -> Trial {
    let mut sailing = Sailing::new(craft, able, Vector3::zeros());
    let ahead = command(
        able,
        Heading::from_deg(0.0),
        2.0 * able.top_speed_m_s,
        depth_of(able),
    );
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
            measured(
                "time to 63 % of it",
                risen.map(|k| (k + 1) as f64 * STEP_S),
                "s",
            ),
            measured("pitch at full ahead", pitch.to_degrees(), "degrees"),
        ],
        curve: Curve {
            labels: ["full ahead", "time, s", "speed, m/s"],
            points,
            plan: false,
        },
    }
}

/// From cruise, always to starboard: the heading asked is 90 degrees ahead of the nose.
fn circle(craft: &Craft, able: &Capabilities) -> Trial {
    let glides = able.dives && !able.holds_depth;
    let mut sailing = if glides {
        let mut sailing = Sailing::new(craft, able, Vector3::zeros());
        let north = command(able, Heading::from_deg(0.0), able.top_speed_m_s, DEPTH_M);
        for _ in 0..(60.0 / STEP_S) as u32 {
            sailing.obeying(&north);
        }
        sailing
    } else {
        cruising(craft, able)
    };
    let begun = sailing.truth.pose;
    let (mut turned, mut last) = (0.0, begun.heading());
    let (mut advance, mut diameter) = (None, None);
    let mut points = vec![];
    let most = if glides { 300.0 } else { 240.0 };
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
        name: "turning circle",
        found: vec![
            measured("advance at 90 degrees", advance, "m"),
            measured("tactical diameter", diameter, "m"),
            measured("turn rate", steady.map(f64::to_degrees), "degrees/s"),
            measured("radius", steady.map(|r| v / r), "m"),
            measured("speed in the turn", v, "m/s"),
        ],
        curve: Curve {
            labels: ["turning circle", "east, m", "north, m"],
            points,
            plan: true,
        },
    }
}

/// Between headings of ±20 degrees.
fn zigzag(craft: &Craft, able: &Capabilities) -> Trial {
    let mut sailing = cruising(craft, able);
    let begun_s = sailing.t_s();
    let mut side = 1.0;
    let mut points = Vec::new();
    let mut passed: Vec<f64> = Vec::new();
    let (mut over, mut worst) = (0.0f64, Vec::new());
    for k in 0..(180.0 / STEP_S) as u64 {
        let heading = Heading::from_deg(if side > 0.0 { 20.0 } else { 340.0 });
        sailing.obeying(&command(able, heading, cruise(able), depth_of(able)));
        let off = Heading::from_deg(0.0)
            .turn_to(sailing.truth.pose.heading())
            .to_degrees();
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
        name: "zigzag",
        found: vec![
            measured("first heading reached after", passed.first().copied(), "s"),
            measured(
                "overshoot",
                worst.iter().copied().reduce(f64::max),
                "degrees",
            ),
            measured("period", period, "s"),
        ],
        curve: Curve {
            labels: ["zigzag of 20 degrees", "time, s", "heading, degrees"],
            points,
            plan: false,
        },
    }
}

/// 5 m down at cruise.
fn dive(craft: &Craft, able: &Capabilities) -> Trial {
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
        curve: Curve {
            labels: ["dive of 5 m", "time, s", "height, m"],
            points,
            plan: false,
        },
    }
}

/// From cruise to speed zero.
fn stop(craft: &Craft, able: &Capabilities) -> Trial {
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
        curve: Curve {
            labels: ["stop", "time, s", "speed, m/s"],
            points,
            plan: false,
        },
    }
}

/// Holds a point in a current of half its greatest speed sideways, from ahead, abeam and astern, 60 s each.
fn station(craft: &Craft, able: &Capabilities) -> Trial {
    let speed = 0.25;
    let mut points = Vec::new();
    let (mut worst, mut squares, mut n) = (0.0f64, 0.0, 0u32);
    for quarter in 0..3 {
        let course = Heading::from_deg(180.0 - 90.0 * f64::from(quarter)).unit() * speed;
        let mut sailing = Sailing::new(craft, able, Vector3::new(course.x, course.y, 0.0));
        let goal = Goal {
            id: 1,
            manoeuvre: Manoeuvre::Hold {
                point: Vector2::zeros(),
                heading: Some(Heading::from_deg(0.0)),
            },
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
            measured(
                "distance, root mean square after 30 s",
                (squares / f64::from(n)).sqrt(),
                "m",
            ),
            measured("greatest distance after 30 s", worst, "m"),
        ],
        curve: Curve {
            labels: ["station keeping", "east, m", "north, m"],
            points,
            plan: true,
        },
    }
}

/// A glider's way up and down.
fn sawtooth(craft: &Craft, able: &Capabilities) -> Trial {
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
        curve: Curve {
            labels: ["sawtooth", "north, m", "height, m"],
            points,
            plan: false,
        },
    }
}
