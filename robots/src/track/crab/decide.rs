//! Decision unit: sweep, go to the best place, step up-stream, cast to both sides, sweep again, stop.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4 (decision unit), Fig. 9; its rules (pace,
//! up-stream motion, steering, stopping) are in files of their own.
//!
//! *Parameters*: step `step_m`, m, 0.1 along and 0.05 across; number of blocked motions in a row before it gives up
//! `blocked_limit` (ours), 6: thirty centimetres aside; length of a sweep from the data builder.
//!
//! *Deviations*: if the contrast is zero, a coin decides the first side of a cast. A blocked motion counts as done at
//! the head's place. If it led up-stream, the next motion goes to the side, first to that of the contrast, and stays on
//! that side until the way is free. If the head reaches the up-stream end of the travel without a stop, the search has
//! failed, or (`at_end: Stops`) ends there as found: the paper's steps of 10 cm from 114 cm lead to 14 cm, its mean
//! final distance is 14.3 cm, and it does not say how far its travel went beyond. A neighbouring place is judged as any
//! other step. None of these is in the paper.

use super::advance::AdvanceSpec;
use super::builder::DataBuilder;
use super::pace::PaceSpec;
use super::steer::{ContrastSpec, Pull};
use super::stop::StopRule;
use crate::handoff::Behaviour;
use crate::track::command::Progress;
use crate::track::data::{StepRecord, Tally};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::seeds::Stream;

/// A shorter motion than this counts as none, m.
const STILL_M: f64 = 1e-3;

/// What the up-stream end of the travel means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum AtEnd {
    /// The search has failed.
    Fails,
    /// The head stops there, as it does where the rule of stopping says so.
    Stops,
}

/// The rules and limits of the unit.
#[derive(Clone, Debug)]
pub struct Rules {
    /// Step (forward, left), m.
    pub step_m: Vector2<f64>,
    /// Ends of a sweep (left, right), m.
    pub sweep_left_m: [f64; 2],
    /// Empty sweeps in a row before giving up.
    pub empty_sweeps: usize,
    /// Blocked motions in a row before giving up.
    pub blocked_limit: usize,
    /// Up-stream end of the travel, m.
    pub end_m: f64,
    /// What that end means.
    pub at_end: AtEnd,
    /// Ends of the travel across the stream (least, greatest), m.
    pub across_m: [f64; 2],
    /// Speeds and the end of a step.
    pub pace: PaceSpec,
    /// Up-stream motion.
    pub advance: AdvanceSpec,
    /// Steering.
    pub contrast: ContrastSpec,
}

/// What the unit asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ask {
    /// A motion to a place (forward, left), m, with speeds, m/s.
    Go(Behaviour, Vector2<f64>, Vector2<f64>),
    /// The end, found or not.
    Stop(bool),
}

/// What the short-term history does after an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Memory {
    /// Go on collecting.
    Keep,
    /// A step has ended: it becomes the previous one.
    Next,
    /// Nothing to compare with.
    Forget,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum TrackPhase {
    Start,
    ToLeftmost,
    Sweeping,
    ToBest,
    Step { up: bool },
    Last,
    Done(bool),
}

/// A cast from a place to both its sides.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cast {
    home_left_m: f64,
    side: f64,
    second: bool,
}

/// The unit.
#[derive(Clone, Debug)]
pub struct DecisionUnit {
    rules: Rules,
    /// Stopping.
    pub stop: StopRule,
    phase: TrackPhase,
    cast: Option<Cast>,
    empty: usize,
    blocked: usize,
    dodge: Option<f64>,
    /// Whether the plume was followed for at least one step.
    followed: bool,
    /// Spikes on the sides (left, right) since the head last moved aside, and its place across at that time, m.
    gathered: [Tally; 2],
    lane_m: f64,
}

impl DecisionUnit {
    /// At the start.
    pub fn new(rules: Rules, stop: StopRule) -> Self {
        Self {
            rules,
            stop,
            phase: TrackPhase::Start,
            cast: None,
            empty: 0,
            blocked: 0,
            dodge: None,
            followed: false,
            gathered: Default::default(),
            lane_m: 0.0,
        }
    }

    /// Contrast of a step, left positive, -1 to 1.
    pub fn contrast(&self, step: &StepRecord) -> f64 {
        self.pull(step).contrast
    }

    /// The side to which the contrast pulls, from this step or from all steps on this lane.
    fn pull(&self, step: &StepRecord) -> Pull {
        if !self.rules.contrast.gathers() {
            return self.rules.contrast.pull(step);
        }
        let [left, right] = &self.gathered;
        self.rules.contrast.pull(&StepRecord { left: step.left.with(left), right: step.right.with(right), ..*step })
    }

    /// Speeds after a step without spikes, m/s.
    pub fn speed_m_s(&self) -> Vector2<f64> {
        self.rules.pace.speed_m_s(0)
    }

    /// The next motion, if one is due, and what the history must do.
    pub fn next(
        &mut self,
        at: &Progress,
        step: &StepRecord,
        map: &mut DataBuilder,
        rng: &mut Stream,
    ) -> Option<(Ask, Memory)> {
        let rest = at.rest_s.is_some();
        match self.phase {
            TrackPhase::Start => Some(self.sweep(at)),
            TrackPhase::ToLeftmost if rest => {
                map.begin_sweep();
                self.phase = TrackPhase::Sweeping;
                let end = Vector2::new(at.here_m.x, self.rules.sweep_left_m[1]);
                let speed = self.rules.pace.sweep_m_s(self.followed);
                Some((Ask::Go(Behaviour::Sweep, end, speed), Memory::Forget))
            }
            TrackPhase::Sweeping if rest => Some(self.swept(at, step, map)),
            TrackPhase::ToBest if rest => {
                self.stop.swept();
                Some((self.up(at.here_m, 0.0, step.spikes), Memory::Forget))
            }
            TrackPhase::Last if rest => Some(self.end(true)),
            TrackPhase::Step { up } if self.rules.pace.over(at.rest_s, at.to_go_s, step.spikes) => {
                Some(self.stepped(up, at, step, map, rng))
            }
            _ => None,
        }
    }

    fn end(&mut self, found: bool) -> (Ask, Memory) {
        self.phase = TrackPhase::Done(found);
        (Ask::Stop(found), Memory::Keep)
    }

    /// Moves to the leftmost place, for a full sweep.
    fn sweep(&mut self, at: &Progress) -> (Ask, Memory) {
        self.phase = TrackPhase::ToLeftmost;
        self.cast = None;
        let start = Vector2::new(at.here_m.x, self.rules.sweep_left_m[0]);
        let speed = self.rules.pace.speed_m_s(0);
        (Ask::Go(Behaviour::Sweep, start, speed), Memory::Keep)
    }

    /// A sweep has ended.
    fn swept(&mut self, at: &Progress, step: &StepRecord, map: &DataBuilder) -> (Ask, Memory) {
        let speed = self.rules.pace.speed_m_s(step.spikes);
        if self.followed
            && let Some(n) = self.stop.trail_end()
            && map.sweep_spikes() < n
            && let Some(last) = self.trail_end(at.here_m.x, n, map)
        {
            return last;
        }
        if let Some(left_m) = map.best_left_m() {
            self.empty = 0;
            self.phase = TrackPhase::ToBest;
            let best = Vector2::new(at.here_m.x, left_m);
            return (Ask::Go(Behaviour::ToBest, best, speed), Memory::Keep);
        }
        self.empty += 1;
        if self.empty >= self.rules.empty_sweeps {
            return self.end(false);
        }
        self.sweep(at)
    }

    /// A step has ended that led up-stream or only aside.
    fn stepped(
        &mut self,
        up: bool,
        at: &Progress,
        step: &StepRecord,
        map: &DataBuilder,
        rng: &mut Stream,
    ) -> (Ask, Memory) {
        if self.stop.near() {
            return self.end(true);
        }
        if (at.here_m.y - self.lane_m).abs() > STILL_M {
            (self.gathered, self.lane_m) = (Default::default(), at.here_m.y);
        }
        let pull = self.pull(step);
        let [left, right] = &mut self.gathered;
        (*left, *right) = (left.with(&step.left), right.with(&step.right));
        if at.blocked {
            self.blocked += 1;
            if self.blocked >= self.rules.blocked_limit {
                return self.end(false);
            }
            if up {
                return (self.dodge(at, step, &pull, rng), Memory::Next);
            }
            self.dodge = self.dodge.map(|side| -side);
        } else if up {
            (self.blocked, self.dodge) = (0, None);
        }
        if self.rules.advance.allows(step) {
            self.cast = None;
            self.followed = true;
            // Beside an obstacle the contrast would lead back to it.
            let side = if self.dodge.is_some() { 0.0 } else { pull.side };
            return (self.up(at.here_m, side, step.spikes), Memory::Next);
        }
        let cast = match self.cast {
            None => Cast { home_left_m: at.here_m.y, side: first_side(&pull, rng), second: false },
            Some(first) if !first.second => Cast { side: -first.side, second: true, ..first },
            Some(_) => {
                let last = self.stop.silent().and_then(|n| self.trail_end(at.here_m.x, n, map));
                return last.unwrap_or_else(|| self.sweep(at));
            }
        };
        self.cast = Some(cast);
        let left_m = cast.home_left_m + cast.side * self.rules.step_m.y;
        (self.aside(at.here_m.x, left_m, step.spikes), Memory::Next)
    }

    /// The trail has ended: moves across to its middle, to stop there.
    fn trail_end(&mut self, forward_m: f64, n: usize, map: &DataBuilder) -> Option<(Ask, Memory)> {
        let place = Vector2::new(forward_m, map.trail_end_left_m(n)?);
        self.phase = TrackPhase::Last;
        let speed = self.rules.pace.speed_m_s(n);
        Some((Ask::Go(Behaviour::ToBest, place, speed), Memory::Keep))
    }

    /// A step up-stream.
    fn up(&mut self, here: Vector2<f64>, side: f64, spikes: usize) -> Ask {
        if self.rules.end_m - here.x < STILL_M {
            return self.end(self.rules.at_end == AtEnd::Stops).0;
        }
        self.phase = TrackPhase::Step { up: true };
        let place = Vector2::new(here.x + self.rules.step_m.x, here.y + side * self.rules.step_m.y);
        let speed = self.rules.pace.speed_m_s(spikes);
        Ask::Go(Behaviour::StepUp, place, speed)
    }

    fn aside(&mut self, forward_m: f64, left_m: f64, spikes: usize) -> Ask {
        self.phase = TrackPhase::Step { up: false };
        let speed = self.rules.pace.speed_m_s(spikes);
        let place = Vector2::new(forward_m, left_m);
        Ask::Go(Behaviour::Cast, place, speed)
    }

    /// There is an obstacle up-stream: moves to the side.
    fn dodge(&mut self, at: &Progress, step: &StepRecord, pull: &Pull, rng: &mut Stream) -> Ask {
        self.cast = None;
        let [least, greatest] = self.rules.across_m;
        let mut side = self.dodge.unwrap_or_else(|| first_side(pull, rng));
        let room = if side > 0.0 { greatest - at.here_m.y } else { at.here_m.y - least };
        if room < STILL_M {
            side = -side;
        }
        self.dodge = Some(side);
        let left_m = at.here_m.y + side * self.rules.step_m.y;
        self.aside(at.here_m.x, left_m, step.spikes)
    }
}

/// The side of the contrast, however small; without contrast, a coin's.
fn first_side(pull: &Pull, rng: &mut Stream) -> f64 {
    if pull.contrast != 0.0 {
        pull.contrast.signum()
    } else if rng.uniform() < 0.5 {
        1.0
    } else {
        -1.0
    }
}

#[cfg(test)]
mod tests;
