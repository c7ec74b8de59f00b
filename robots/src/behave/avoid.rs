//! Turns away from obstacles that the forward ranging shows ahead. The nearer the obstacle, the sharper the turn.
//!
//! *Source*: Tian et al. 2013, section 2, Avoid-Obstacle, which refers to Li & Carter 2006, Proc. OCEANS (soft
//! obstacle avoidance); turning away in proportion to nearness: Khatib 1986, Int. J. Robotics Research 5(1), 90.
//!
//! *Parameters*: distance from which an obstacle counts, `heed_m`, 35 m; distance from which the whole turn is taken,
//! `near_m`, 18 m (1.5 turning radii); half width of the way that must be free, `clear_m`, 8 m; how long an echo is
//! remembered, `memory_s`, 15 s; after turning away at one place for `give_up_s`, 60 s in all, the destination is given
//! up. The paper prints none of these.
//!
//! *Deviations*: only the idea is the paper's. An echo counts if it lies ahead on the way that the lower layer asks
//! for, within `clear_m` to either side and at most `near_m` beyond the destination. The commanded course is then
//! turned by the smallest turn that leads past all remembered echoes, times (heed - distance) / (heed - near) of the
//! nearest one. The vehicle keeps the side that it has taken unless the other side needs 30° less. If the short turn
//! to the new course would sweep over an echo within `near_m` and the long turn would not, the vehicle takes the long
//! turn. The avoidance is soft: it plans nothing, and a bay holds the vehicle until it gives up. The time for which it
//! turned away is counted through pauses with a free way, until the vehicle has moved on by `near_m` or the way has
//! been free for `give_up_s`; otherwise turning away and the destination could take turns for ever. Echoes within 1 m
//! of the charted bed count as the bed. A navigation fix moves the remembered echoes with the vehicle.

use crate::error::{RobotError, require};
use crate::handoff::{Manoeuvre, Observation, Side};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::collections::VecDeque;
use std::f64::consts::TAU;
use world::ranges::Positive;
use world::terrain::Terrain;
use world::units::Heading;

/// Echoes at less than this height over the charted bed count as the bed, m. It covers errors of pitch and depth over
/// the range.
const BED_M: f64 = 1.0;
/// A vehicle farther from a line than this is still on its way to the line, m.
const ON_LINE_M: f64 = 20.0;
/// Step in which turns are tried, and how much smaller the turn to the other side must be before the side is changed,
/// °.
const TURNS_DEG: (f64, f64) = (5.0, 30.0);

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "AvoidParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Obstacles count from this distance on, m.
    #[default(Positive::new(35.0))]
    pub heed_m: Positive,
    /// From this distance on the vehicle takes the whole turn, m; less than `heed_m`.
    #[default(Positive::new(18.0))]
    pub near_m: Positive,
    /// Half width of the way that must be free, m.
    #[default(Positive::new(8.0))]
    pub clear_m: Positive,
    /// How long an echo is remembered, s.
    #[default(Positive::new(15.0))]
    pub memory_s: Positive,
    /// After the vehicle has turned away at one place for this long in all, the destination counts as reached, s.
    #[default(Positive::new(60.0))]
    pub give_up_s: Positive,
}

/// Turning away at one place.
#[derive(Clone, Copy, Debug)]
struct Turning {
    /// Where it began (east, north; m).
    from: Vector2<f64>,
    /// For how long it turned away, pauses not counted, s.
    lasted_s: f64,
    /// When it was last seen, and when it last turned away, s.
    seen_s: f64,
    turned_s: f64,
}

/// State of the behaviour.
#[derive(Clone, Debug)]
pub struct SoftAvoid {
    params: Params,
    bed: Terrain,
    /// Time (s) and place (east, north; m) of each echo.
    echoes: VecDeque<(f64, Vector2<f64>)>,
    /// The side to which the vehicle turns away.
    side: Option<Side>,
    turning: Option<Turning>,
}

impl SoftAvoid {
    /// A new behaviour over a charted bed.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the distances contradict each other.
    pub fn new(params: &Params, bed: Terrain) -> Result<Self, RobotError> {
        let (near, heed) = (params.near_m.get(), params.heed_m.get());
        require(near < heed, "avoid.near_m", format!("must be less than heed_m, {heed}, got {near}"))?;
        Ok(Self { params: params.clone(), bed, echoes: VecDeque::new(), side: None, turning: None })
    }

    /// The manoeuvre to do instead of `asked`; `None` as long as the way is free.
    pub fn step(&mut self, seen: &Observation, asked: &Manoeuvre) -> Option<Manoeuvre> {
        self.listen(seen);
        let instead = self.instead_of(seen, asked);
        self.count(seen, instead.is_some());
        instead
    }

    /// Counts how long it turns away at one place.
    fn count(&mut self, seen: &Observation, turns: bool) {
        let (t_s, at) = (seen.t_s, seen.estimate.position);
        if let Some(turning) = &mut self.turning {
            turning.from += seen.estimate.fix_jump;
            if turns {
                turning.lasted_s += t_s - turning.seen_s;
                turning.turned_s = t_s;
            }
            turning.seen_s = t_s;
            let away = (at - turning.from).norm() > self.params.near_m.get();
            let over = away || t_s - turning.turned_s > self.params.give_up_s.get();
            if !turns && over {
                self.turning = None;
            }
        } else if turns {
            self.turning = Some(Turning { from: at, lasted_s: 0.0, seen_s: t_s, turned_s: t_s });
        }
    }

    fn instead_of(&mut self, seen: &Observation, asked: &Manoeuvre) -> Option<Manoeuvre> {
        let at = seen.estimate.position;
        let (wanted, reach_m) = leads_to(asked, seen)?;
        let (near_m, heed_m) = (self.params.near_m.get(), self.params.heed_m.get());
        let most_m = heed_m.min(reach_m + near_m);
        let nose = seen.estimate.attitude.heading;
        let Some(nearest_m) = self.nearest_m(at, wanted, most_m) else {
            self.side = None;
            let turned = self.round_the_free_way(at, nose, wanted);
            return turned.map(|course| Manoeuvre::Course { course });
        };
        let [left, right] = [Side::Left, Side::Right].map(|s| self.free_turn_deg(at, wanted, s));
        let favour = match self.side {
            Some(Side::Left) => -TURNS_DEG.1,
            Some(Side::Right) => TURNS_DEG.1,
            None => 0.0,
        };
        let (side, turn_deg) = if left + favour < right { (Side::Left, left) } else { (Side::Right, right) };
        self.side = Some(side);
        let share = ((heed_m - nearest_m) / (heed_m - near_m)).clamp(0.0, 1.0);
        let course = wanted.turned(side.sign() * share * turn_deg.to_radians());
        Some(Manoeuvre::Course { course: (self.round_the_free_way(at, nose, course)).unwrap_or(course) })
    }

    /// The guidance takes the shorter turn. If that turn sweeps over a near echo and the longer one does not, this
    /// gives a course to the other side.
    fn round_the_free_way(&self, at: Vector2<f64>, nose: Heading, course: Heading) -> Option<Heading> {
        let short_rad = nose.turn_to(course);
        let long_rad = short_rad - TAU.copysign(short_rad);
        let step_rad = 2.0 * TURNS_DEG.0.to_radians();
        let sweeps = |turn_rad: f64| {
            let n = (turn_rad.abs() / step_rad) as u32;
            (1..=n).any(|k| {
                let on = nose.turned(f64::from(k) * step_rad.copysign(turn_rad));
                self.nearest_m(at, on, self.params.near_m.get()).is_some()
            })
        };
        (sweeps(short_rad) && !sweeps(long_rad)).then(|| nose.turned(std::f64::consts::FRAC_PI_2.copysign(long_rad)))
    }

    /// Whether it has turned away for too long, so that the destination counts as reached. True only once.
    pub fn gives_up(&mut self) -> bool {
        let give_up_s = self.params.give_up_s.get();
        let long = |turning: &Turning| turning.lasted_s > give_up_s;
        let gives_up = self.turning.as_ref().is_some_and(long);
        if gives_up {
            self.turning = None;
        }
        gives_up
    }

    /// Distance to the nearest echo on the way along a course, m; `None` if there is none nearer than `most_m`.
    fn nearest_m(&self, at: Vector2<f64>, course: Heading, most_m: f64) -> Option<f64> {
        let (ahead, clear_m) = (course.unit(), self.params.clear_m.get());
        let ways = self.echoes.iter().map(|(_, echo)| echo - at);
        ways.filter(|w| w.dot(&ahead) > 0.0 && w.perp(&ahead).abs() < clear_m)
            .map(|w| w.norm())
            .filter(|m| *m < most_m)
            .min_by(f64::total_cmp)
    }

    /// The smallest turn to a side that leads past all echoes, °; 180° if none does.
    fn free_turn_deg(&self, at: Vector2<f64>, wanted: Heading, side: Side) -> f64 {
        let steps = (180.0 / TURNS_DEG.0) as u32;
        let turns = (1..steps).map(|k| f64::from(k) * TURNS_DEG.0);
        let mut free = turns.filter(|deg| {
            let course = wanted.turned(side.sign() * deg.to_radians());
            self.nearest_m(at, course, self.params.heed_m.get()).is_none()
        });
        free.next().unwrap_or(180.0)
    }

    /// Takes in a ping and forgets old echoes.
    fn listen(&mut self, seen: &Observation) {
        let e = &seen.estimate;
        for (_, echo) in &mut self.echoes {
            *echo += e.fix_jump;
        }
        let oldest_s = seen.t_s - self.params.memory_s.get();
        while self.echoes.front().is_some_and(|(t, _)| *t < oldest_s) {
            self.echoes.pop_front();
        }
        let Some(scan) = &seen.ranging else { return };
        let turn = e.attitude.R_WB();
        let at = e.p_WB() + turn * scan.p_BS;
        for beam in scan.beams.iter() {
            let Some(echo_m) = beam.echo_m else { continue };
            let to = at + turn * beam.dir_B * echo_m;
            if to.z - self.bed.bed_z(to.x, to.y) > BED_M {
                self.echoes.push_back((seen.t_s, to.xy()));
            }
        }
    }
}

/// The course that a manoeuvre takes from here, and the distance to go, m; `None` if it drives the actuators
/// directly.
fn leads_to(asked: &Manoeuvre, seen: &Observation) -> Option<(Heading, f64)> {
    let at = seen.estimate.position;
    let towards = |point: Vector2<f64>| {
        let way = point - at;
        (way.norm() > 0.0).then(|| (Heading::from_vector(way), way.norm()))
    };
    match *asked {
        Manoeuvre::Course { course } => Some((course, f64::INFINITY)),
        Manoeuvre::GoToPoint { point, .. }
        | Manoeuvre::GoToPointWithHeading { point, .. }
        | Manoeuvre::Hold { point, .. }
        | Manoeuvre::SlideTo { point, .. } => towards(point),
        Manoeuvre::FollowLine { from, to } => {
            let line = (to - from).try_normalize(0.0)?;
            let (along_m, off_m) = ((at - from).dot(&line), (at - from).perp(&line));
            // Before the line's start, or far from the line, the way leads to the start.
            let on = along_m > 0.0 && off_m.abs() < ON_LINE_M;
            towards(if on { to } else { from })
        }
        // These keep clear of obstacles themselves.
        _ => None,
    }
}

#[cfg(test)]
#[path = "avoid_tests.rs"]
mod tests;
