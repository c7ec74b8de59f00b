//! Turns away from obstacles that the forward ranging shows ahead. The nearer the obstacle, the sharper the turn.
//!
//! *Source*: Tian et al. 2013, section 2, Avoid-Obstacle, which refers to Li & Carter 2006, Proc. OCEANS (soft
//! obstacle avoidance); turning away in proportion to nearness: Khatib 1986, Int. J. Robotics Research 5(1), 90.
//!
//! *Parameters*: distance from which an obstacle counts, `heed_m`, 35 m; distance from which the whole turn is taken,
//! `near_m`, 18 m (1.5 turning radii); half width of the way that must be free, `clear_m`, 8 m; how long an echo is
//! remembered, `memory_s`, 15 s; after turning away for `give_up_s`, 60 s, the destination is given up. The paper
//! prints none of these.
//!
//! *Deviations*: only the idea is the paper's. An echo counts if it lies ahead on the way that the lower layer asks
//! for, within `clear_m` to either side and at most `near_m` beyond the destination. The commanded course is then
//! turned by the smallest turn that leads past all remembered echoes, times (heed - distance) / (heed - near) of the
//! nearest one. The vehicle keeps the side that it has taken unless the other side needs 30° less. If the short turn
//! to the new course would sweep over an echo within `near_m` and the long turn would not, the vehicle takes the long
//! turn. The avoidance is soft: it plans nothing, and a bay holds the vehicle until it gives up. Echoes within 1 m of
//! the charted bed count as the bed. A navigation fix moves the remembered echoes with the vehicle.

use crate::error::RobotError;
use crate::handoff::{Manoeuvre, Observation, Side};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "AvoidParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Obstacles count from this distance on, m.
    pub heed_m: Positive,
    /// From this distance on the vehicle takes the whole turn, m; less than `heed_m`.
    pub near_m: Positive,
    /// Half width of the way that must be free, m.
    pub clear_m: Positive,
    /// How long an echo is remembered, s.
    pub memory_s: Positive,
    /// After the vehicle has turned away for this long, the destination counts as reached, s.
    pub give_up_s: Positive,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            heed_m: Positive::new(35.0),
            near_m: Positive::new(18.0),
            clear_m: Positive::new(8.0),
            memory_s: Positive::new(15.0),
            give_up_s: Positive::new(60.0),
        }
    }
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
    /// Time since which it turns away, s.
    since_s: Option<f64>,
}

impl SoftAvoid {
    /// A new behaviour over a charted bed.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the distances contradict each other.
    pub fn new(params: &Params, bed: Terrain) -> Result<Self, RobotError> {
        let (near, heed) = (params.near_m.get(), params.heed_m.get());
        if near >= heed {
            return Err(RobotError::Invalid {
                field: "avoid.near_m".into(),
                problem: format!("must be less than heed_m, {heed}, got {near}"),
            });
        }
        Ok(Self {
            params: params.clone(),
            bed,
            echoes: VecDeque::new(),
            side: None,
            since_s: None,
        })
    }

    /// The manoeuvre to do instead of `asked`; `None` as long as the way is free.
    pub fn step(&mut self, seen: &Observation, asked: &Manoeuvre) -> Option<Manoeuvre> {
        self.listen(seen);
        let at = seen.estimate.position;
        let (wanted, reach_m) = leads_to(asked, seen)?;
        let (near_m, heed_m) = (self.params.near_m.get(), self.params.heed_m.get());
        let most_m = heed_m.min(reach_m + near_m);
        let nose = seen.estimate.attitude.heading;
        let Some(nearest_m) = self.nearest_m(at, wanted, most_m) else {
            self.side = None;
            let turned = self.round_the_free_way(at, nose, wanted);
            match turned {
                Some(_) => _ = self.since_s.get_or_insert(seen.t_s),
                None => self.since_s = None,
            }
            return turned.map(|course| Manoeuvre::Course { course });
        };
        self.since_s.get_or_insert(seen.t_s);
        let [left, right] = [Side::Left, Side::Right].map(|s| self.free_turn_deg(at, wanted, s));
        let favour = match self.side {
            Some(Side::Left) => -TURNS_DEG.1,
            Some(Side::Right) => TURNS_DEG.1,
            None => 0.0,
        };
        let (side, turn_deg) = if left + favour < right {
            (Side::Left, left)
        } else {
            (Side::Right, right)
        };
        self.side = Some(side);
        let share = ((heed_m - nearest_m) / (heed_m - near_m)).clamp(0.0, 1.0);
        let course = wanted.turned(side.sign() * share * turn_deg.to_radians());
        Some(Manoeuvre::Course {
            course: (self.round_the_free_way(at, nose, course)).unwrap_or(course),
        })
    }

    /// The guidance takes the shorter turn. If that turn sweeps over a near echo and the longer one does not, this
    /// gives a course to the other side.
    fn round_the_free_way(
        &self,
        at: Vector2<f64>,
        nose: Heading,
        course: Heading,
    ) -> Option<Heading> {
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
        (sweeps(short_rad) && !sweeps(long_rad))
            .then(|| nose.turned(std::f64::consts::FRAC_PI_2.copysign(long_rad)))
    }

    /// Whether it has turned away for too long, so that the destination counts as reached. True only once.
    pub fn gives_up(&mut self, t_s: f64) -> bool {
        let long = |since_s| t_s - since_s > self.params.give_up_s.get();
        let gives_up = self.since_s.is_some_and(long);
        if gives_up {
            self.since_s = Some(t_s);
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
            self.nearest_m(at, course, self.params.heed_m.get())
                .is_none()
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
        (way.norm() > 0.0).then(|| (Heading::of(way), way.norm()))
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
mod tests {
    use super::*;
    use crate::handoff::testing::seen;
    use crate::handoff::{Beam, RangeScan};
    use nalgebra::Vector3;

    const BED: Terrain = Terrain::Level { depth_m: 8.0 };

    fn avoid(params: Params) -> SoftAvoid {
        SoftAvoid::new(&params, BED).expect("legal")
    }

    /// A ping at the origin, heading north, 3 m deep, with one beam for each bearing (right positive, °) and range
    /// (m).
    fn ping(t_s: f64, echoes: &[(f64, f64)]) -> Observation {
        let mut o = seen(t_s, Vector2::zeros(), 0.0, None);
        let beam = |(bearing, range): &(f64, f64)| {
            let d = Heading::from_deg(-*bearing).unit();
            Beam {
                // FLU: forward is the unit vector's north, left is its east with the sign changed.
                dir_B: Vector3::new(d.y, d.x, 0.0),
                echo_m: Some(*range),
            }
        };
        o.ranging = Some(RangeScan {
            p_BS: Vector3::zeros(),
            max_m: 40.0,
            beams: echoes.iter().map(beam).collect(),
        });
        o
    }

    fn north() -> Manoeuvre {
        Manoeuvre::Course {
            course: Heading::from_deg(0.0),
        }
    }

    fn turn_deg(m: Option<Manoeuvre>) -> f64 {
        match m {
            Some(Manoeuvre::Course { course }) => {
                Heading::from_deg(0.0).turn_to(course).to_degrees()
            }
            other => panic!("wanted a course, got {other:?}"),
        }
    }

    #[test]
    fn turns_in_proportion_and_to_the_freer_side() {
        // Ahead, slightly to the right: 8 m off it at asin(8 / 20) = 23.6 degrees; to the left 20.6, so 25.
        let t = turn_deg(avoid(Params::default()).step(&ping(0.0, &[(3.0, 20.0)]), &north()));
        let whole_at_18 = (35.0 - 20.0) / 17.0;
        assert!((t + 25.0 * whole_at_18).abs() < 1e-9, "{t}");
        let t = turn_deg(avoid(Params::default()).step(&ping(0.0, &[(-3.0, 26.5)]), &north()));
        // asin(8 / 26.5) = 17.6: 14.6 to the right, so 15, half of it.
        assert!((t - 7.5).abs() < 1e-9, "{t}");
        // Nearer than near_m: the whole turn.
        let t = turn_deg(avoid(Params::default()).step(&ping(0.0, &[(3.0, 16.0)]), &north()));
        assert!((t + 30.0).abs() < 1e-9, "{t}");
        // A wall that goes on to the left: to the right, though most of it is straight ahead or left.
        let wall: Vec<_> = (-12..3).map(|k| (f64::from(k) * 5.0, 16.0)).collect();
        assert!(turn_deg(avoid(Params::default()).step(&ping(0.0, &wall), &north())) > 0.0);
        // Echoes all round: turn back.
        let ring: Vec<_> = (0..72).map(|k| (f64::from(k) * 5.0, 16.0)).collect();
        let t = turn_deg(avoid(Params::default()).step(&ping(0.0, &ring), &north()));
        assert!((t.abs() - 180.0).abs() < 1e-9, "{t}");
    }

    #[test]
    fn what_is_not_in_the_way_does_not_count() {
        // Too far; beside the way (30 sin 20° = 10.3 m); behind.
        for echo in [(0.0, 36.0), (20.0, 30.0), (179.0, 5.0)] {
            let o = ping(0.0, &[echo]);
            assert_eq!(
                avoid(Params::default()).step(&o, &north()),
                None,
                "{echo:?}"
            );
        }
        // The same echo counts if the destination lies there, and does not if the destination is much nearer.
        let o = ping(0.0, &[(20.0, 30.0)]);
        for (far_m, counts) in [(80.0, true), (13.0, true), (11.0, false)] {
            let there = Manoeuvre::GoToPoint {
                point: Heading::from_deg(20.0).unit() * far_m,
                radius_m: None,
            };
            let turned = avoid(Params::default()).step(&o, &there);
            assert_eq!(turned.is_some(), counts, "{far_m}");
        }
    }

    #[test]
    fn the_bed_is_no_obstacle() {
        let mut o = ping(0.0, &[(0.0, 20.0)]);
        // Nose down by 13 degrees: 4.5 m lower, 0.5 m over the bed.
        o.estimate.attitude.pitch_rad = -0.2269;
        assert_eq!(avoid(Params::default()).step(&o, &north()), None);
        o.estimate.depth_m = 2.0;
        assert!(avoid(Params::default()).step(&o, &north()).is_some());
    }

    #[test]
    fn remembers_for_a_while_keeps_its_side_and_moves_with_fixes() {
        let mut a = avoid(Params::default());
        let first = turn_deg(a.step(&ping(0.0, &[(2.0, 20.0)]), &north()));
        assert!(first < 0.0);
        // Now there is more of it on the left; the side stays left.
        let o = ping(1.0, &[(-3.0, 20.0), (-5.0, 20.0)]);
        assert!(turn_deg(a.step(&o, &north())) < 0.0);
        let quiet = |t_s| seen(t_s, Vector2::zeros(), 0.0, None);
        assert!(a.step(&quiet(15.9), &north()).is_some());
        assert_eq!(a.step(&quiet(16.1), &north()), None);
        let mut b = avoid(Params::default());
        b.step(&ping(0.0, &[(0.0, 20.0)]), &north());
        let mut jumped = quiet(1.0);
        jumped.estimate.fix_jump = Vector2::new(6.0, 0.0);
        jumped.estimate.position = Vector2::new(6.0, 0.0);
        let (before, after) = (b.clone().echoes[0].1, turn_deg(b.step(&jumped, &north())));
        assert!((b.echoes[0].1 - before - Vector2::new(6.0, 0.0)).norm() < 1e-12);
        assert!(after.abs() > 0.0);
    }

    #[test]
    fn turns_about_on_the_free_side() {
        // Nose north, a wall ahead to the right, the commanded way leads back: turn to the left.
        let mut a = avoid(Params::default());
        let wall: Vec<_> = (4..13).map(|k| (f64::from(k) * 10.0, 15.0)).collect();
        let back = Manoeuvre::Course {
            course: Heading::from_deg(170.0),
        };
        assert!((turn_deg(a.step(&ping(0.0, &wall), &back)) + 90.0).abs() < 1e-9);
        assert_eq!(avoid(Params::default()).step(&ping(0.0, &[]), &back), None);
    }

    #[test]
    fn gives_up_once_in_a_while() {
        let mut a = avoid(Params::default());
        for k in 0..600 {
            let t_s = 0.1 * f64::from(k);
            assert!(a.step(&ping(t_s, &[(0.0, 20.0)]), &north()).is_some());
            assert!(!a.gives_up(t_s));
        }
        assert!(a.gives_up(60.1) && !a.gives_up(60.2) && a.gives_up(120.3));
        a.step(&seen(200.0, Vector2::zeros(), 0.0, None), &north());
        assert!(!a.gives_up(999.0));
    }

    #[test]
    fn contradictions_are_refused() {
        let far = Params {
            near_m: Positive::new(40.0),
            ..Params::default()
        };
        assert!(SoftAvoid::new(&far, BED).is_err());
    }
}
