//! Trials by rudder: the turning circle at full rudder, and the zigzags 10/10 and 20/20.
//!
//! *Source*: International Maritime Organization, "Standards for ship manoeuvrability", MSC.137(76), 2002, sections 4
//! and 5; "Explanatory notes", MSC/Circ.1053, 2002.
//!
//! *Parameters*: 10 and 20 degrees of rudder and of heading, or the rudder's limit where it goes less far; full rudder
//! in the circle, always to starboard.
//!
//! *Deviations*: the approach is at cruise, not at 90 % of full speed, and the propeller stays as it was on it. Depth is
//! held by the autopilot. Lengths are those of the body's origin.

use super::rudder::Rudder;
use super::sail::STEP_S;
use super::trial::{Curve, SteeringRow, THINNED, Trial, TrialNumber, approach, command, cruise, depth_of, measured};
use robots::handoff::Capabilities;
use robots::vehicles::Vehicle;

/// The turning circle, to 540 degrees or for `most_s`.
pub(super) fn circle(craft: &Vehicle, able: &Capabilities, rudder: &Rudder, most_s: f64) -> Trial {
    let full = rudder.limit_rad.to_degrees();
    let rows = steered(craft, able, rudder, most_s, |row| (row.heading_deg < 540.0).then_some(full));
    let mut found = circled(&rows).to_vec();
    found.push(measured("rudder", full, "degrees"));
    Trial {
        name: "turning circle",
        found,
        curve: Curve {
            labels: ["turning circle", "to starboard, m", "ahead, m"],
            points: thin(&rows).map(|r| [r.starboard_m, r.ahead_m]).collect(),
            plan: true,
            rudder: Vec::new(),
        },
        rows: thin(&rows).copied().collect(),
    }
}

/// What a turning circle's rows say.
fn circled(rows: &[SteeringRow]) -> [TrialNumber; 6] {
    let at = |deg: f64| rows.iter().position(|r| r.heading_deg >= deg);
    let quarter = at(90.0).map(|k| rows[k]);
    let half = at(180.0).map(|k| rows[k]);
    // The last half circle is steady: its way is half the circumference.
    let steady = at(360.0).zip(at(540.0)).map(|(from, to)| {
        let way = |w: &[SteeringRow]| {
            let [dx, dy] = [w[1].ahead_m - w[0].ahead_m, w[1].starboard_m - w[0].starboard_m];
            (dx * dx + dy * dy).sqrt()
        };
        let turned = (rows[to].heading_deg - rows[from].heading_deg).to_radians();
        2.0 * rows[from..=to].windows(2).map(way).sum::<f64>() / turned
    });
    let last = rows.last().copied().unwrap_or_default();
    [
        measured("advance", quarter.map(|r| r.ahead_m), "m"),
        measured("transfer", quarter.map(|r| r.starboard_m), "m"),
        measured("tactical diameter", half.map(|r| r.starboard_m), "m"),
        measured("steady diameter", steady, "m"),
        measured("time to 90 degrees", quarter.map(|r| r.t_s), "s"),
        measured("speed at the end", last.speed_m_s, "m/s"),
    ]
}

/// The zigzag of an angle for rudder and heading, until the fifth order or for `most_s`.
pub(super) fn zigzag(craft: &Vehicle, able: &Capabilities, rudder: &Rudder, angle_deg: f64, most_s: f64) -> Trial {
    let name = if angle_deg < 15.0 { "zigzag 10/10" } else { "zigzag 20/20" };
    let helm_deg = angle_deg.min(rudder.limit_rad.to_degrees());
    let mut orders = Zigzag::new(angle_deg);
    let rows = steered(craft, able, rudder, most_s, |row| {
        let side = orders.side(row.t_s, row.heading_deg)?;
        Some(side * helm_deg)
    });
    let over = |k| orders.overshoot(&rows, k);
    let at = |k: usize| orders.times_s.get(k).copied();
    Trial {
        name,
        found: vec![
            measured("first overshoot angle", over(1).map(|o| o.0), "degrees"),
            measured("second overshoot angle", over(2).map(|o| o.0), "degrees"),
            measured("time to check yaw", over(1).map(|o| o.1), "s"),
            measured("rudder", helm_deg, "degrees"),
            measured("time to the first heading", at(1), "s"),
            measured("period", at(3).zip(at(1)).map(|(b, a)| b - a), "s"),
        ],
        curve: Curve {
            labels: [name, "time, s", "heading and rudder, degrees"],
            points: thin(&rows).map(|r| [r.t_s, r.heading_deg]).collect(),
            plan: false,
            rudder: thin(&rows).map(|r| [r.t_s, r.rudder_deg]).collect(),
        },
        rows: thin(&rows).copied().collect(),
    }
}

/// The orders of a zigzag: the rudder goes over whenever the heading has passed the angle on its side.
#[derive(Clone, Debug, PartialEq)]
struct Zigzag {
    angle_deg: f64,
    /// When each order was given, s: to starboard, to port, and so on.
    times_s: Vec<f64>,
}

impl Zigzag {
    const MOST: usize = 5;

    fn new(angle_deg: f64) -> Self {
        Self { angle_deg, times_s: Vec::new() }
    }

    /// Side of the order that is followed from a time on, 1 to starboard; `None` once all have been given.
    fn side(&mut self, t_s: f64, heading_deg: f64) -> Option<f64> {
        let side = |orders: usize| if orders % 2 == 1 { 1.0 } else { -1.0 };
        let now = side(self.times_s.len());
        if self.times_s.is_empty() || now * heading_deg >= self.angle_deg {
            self.times_s.push(t_s);
        }
        (self.times_s.len() < Self::MOST).then(|| side(self.times_s.len()))
    }

    /// How far the heading went beyond the angle after an order (1 is the second one), and how long after it; `None` if
    /// it did not come back to the other side.
    fn overshoot(&self, rows: &[SteeringRow], order: usize) -> Option<(f64, f64)> {
        let (from, to) = (*self.times_s.get(order)?, *self.times_s.get(order + 1)?);
        let side = if order % 2 == 1 { 1.0 } else { -1.0 };
        let during = rows.iter().filter(|r| r.t_s >= from && r.t_s <= to);
        let worst = during.max_by(|a, b| {
            let swung = |r: &SteeringRow| side * r.heading_deg;
            swung(a).total_cmp(&swung(b))
        })?;
        Some((side * worst.heading_deg - self.angle_deg, worst.t_s - from))
    }
}

/// A row for each step from cruise on, while `order` gives an angle for the rudder, degrees.
fn steered(
    craft: &Vehicle,
    able: &Capabilities,
    rudder: &Rudder,
    most_s: f64,
    mut order: impl FnMut(&SteeringRow) -> Option<f64>,
) -> Vec<SteeringRow> {
    let mut sailing = approach(craft, able);
    let thrust = sailing.set;
    let begun = sailing.truth.pose;
    let (begun_s, ahead) = (sailing.t_s(), begun.heading().unit());
    let mut last = begun.heading();
    let mut turned = 0.0f64;
    let mut rows = Vec::new();
    loop {
        let now = sailing.truth.pose.heading();
        turned += last.turn_to(now);
        last = now;
        let way = sailing.truth.pose.p_WB.xy() - begun.p_WB.xy();
        let row = SteeringRow {
            t_s: sailing.t_s() - begun_s,
            ahead_m: way.dot(&ahead),
            starboard_m: way.x * ahead.y - way.y * ahead.x,
            heading_deg: turned.to_degrees(),
            rudder_deg: sailing.rudder_rad(rudder).to_degrees(),
            speed_m_s: sailing.truth.v_WB_B.norm(),
        };
        rows.push(row);
        let Some(angle_deg) = order(&row).filter(|_| row.t_s + 0.5 * STEP_S < most_s) else {
            return rows;
        };
        let steady = command(able, now, cruise(able), depth_of(able));
        sailing.by_rudder(rudder, angle_deg.to_radians(), &thrust, &steady);
    }
}

/// Rows for pictures and tables.
fn thin(rows: &[SteeringRow]) -> impl Iterator<Item = &SteeringRow> {
    rows.iter().step_by(THINNED as usize)
}

#[cfg(test)]
#[path = "steering_tests.rs"]
mod tests;
