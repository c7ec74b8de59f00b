//! Surge and cast: up-stream while spikes are met, otherwise across the stream to both sides, ever farther.
//!
//! *Source*: surge-cast, Lochmatter & Martinoli 2009 (Tracking odor plumes in a laminar wind field with
//! bio-inspired algorithms, ISER 2008, 473); active zigzag, `angle_deg` above 0, Li et al. 2001.
//!
//! *Parameters*: `surge_m`, m, 0.125: published steps are about a metre, by robots of half a metre; here a step is
//! the span of the probes, which stands for the size of the searcher. Time without a spike after which a cast
//! begins, `lost_s`, s, 2, as long as a surge takes; angle of a surge from the way up-stream, `angle_deg`, °, 0:
//! each surge runs to the other side. First excursion of a cast, and how much farther each is than the one before,
//! `cast_m`, m, 0.125; way up-stream at each reversal, `step_m`, m, 0.03 (all ours). Speeds `speed_m_s`, 0.061 in
//! both directions: that of the blue-crab tracker up-stream. `threshold` and `at_end` are the tracker's, so that
//! only the motion differs, and `empty_casts` over the whole width are as many as its sweeps, 3. So is the rule of
//! stopping `stop`: `Experience`, which knows the end of a trail, or `SpikeRate`.
//!
//! *Deviations*: it begins with a cast. A surge is finished before the next one begins, and the rule of stopping
//! is asked between them. A cast begins to the side of the latest spike; a coin decides if that lies ahead. With
//! the tracker's `Experience`, a cast over the whole width without a spike means the end of the trail: the head
//! goes back to the most up-stream spikes, and stops. The papers declare nothing. A blocked cast counts as one to
//! the end of the travel. After a blocked surge, spikes are not heeded until the first reversal.

use super::acquire::Acquisition;
use super::command::{MotionCommand, Progress};
use super::crab::builder::DataBuilder;
use super::crab::decide::AtEnd;
use super::crab::spikes::SpikeAnalyser;
use super::crab::stop::{Experience, StopRule, StopSpec};
use super::crab::threshold::{ThresholdAnalyser, ThresholdSpec};
use super::spec::GantryStrategyParams;
use crate::error::{RobotError, require};
use crate::handoff::{
    Behaviour, Decision, GantryLayout, GantryObservation, HeadGoal, JointReadings, ProbeScan, TrackerState,
};
use crate::searcher::Strategy;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::catalogue::Entry;
use world::math;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;

/// A shorter motion than this counts as none, m.
const STILL_M: f64 = 1e-3;

/// Parameters of the searcher.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SurgeCastSpec {
    /// Length of a surge, m.
    #[default(Positive::new(0.125))]
    pub surge_m: Positive,
    /// Angle of a surge from the way up-stream, °; each surge runs to the other side. 0 is straight.
    #[default(NonNegative::new(0.0))]
    pub angle_deg: NonNegative,
    /// A cast begins after this time without a spike, s.
    #[default(NonNegative::new(2.0))]
    pub lost_s: NonNegative,
    /// First excursion of a cast, and how much farther each is than the one before, m.
    #[default(Positive::new(0.125))]
    pub cast_m: Positive,
    /// Way up-stream at each reversal of a cast, m.
    #[default(NonNegative::new(0.03))]
    pub step_m: NonNegative,
    /// Casts over the whole width without a spike before it gives up.
    #[default(NonZeroUsize::new(3).expect("3 is not zero"))]
    pub empty_casts: NonZeroUsize,
    /// Speeds (along, across), m/s.
    #[default([Positive::new(0.061), Positive::new(0.061)])]
    pub speed_m_s: [Positive; 2],
    /// What counts as a spike.
    pub threshold: ThresholdSpec,
    /// When the source is near.
    #[default(StopSpec::Experience(Experience::default()))]
    pub stop: StopSpec,
    /// What the up-stream end of the travel means.
    #[default(AtEnd::Fails)]
    pub at_end: AtEnd,
}

impl Listed for SurgeCastSpec {
    const ENTRY: Entry = Entry {
        name: "SurgeCast",
        what: "up-stream while spikes are met, straight or obliquely; otherwise across the stream, ever farther",
        source: "Lochmatter & Martinoli 2009; Li et al. 2001",
    };
}

impl GantryStrategyParams for SurgeCastSpec {
    fn build(&self, layout: &GantryLayout) -> Result<Box<dyn Strategy<HeadGoal>>, RobotError> {
        Ok(Box::new(SurgeCast::new(self, layout)?))
    }
}

/// What the head does.
#[derive(Clone, Copy, Debug)]
enum Phase {
    Begin,
    Surge,
    Cast(Cast),
    /// Back to the most up-stream spikes, to stop there.
    Last,
}

/// A cast about a place across the stream.
#[derive(Clone, Copy, Debug)]
struct Cast {
    home_left_m: f64,
    /// The present side, left 1 and right -1, and how far it goes there, m.
    side: f64,
    reach_m: f64,
    /// Whether the ends of the travel (left, right) have been reached.
    ends: [bool; 2],
    /// Until the first reversal after a blocked surge.
    heedless: bool,
}

/// The searcher.
#[derive(Debug)]
pub struct SurgeCast {
    spec: SurgeCastSpec,
    travel_m: [[f64; 2]; 2],
    bottom_v: f64,
    acquisition: Acquisition,
    spikes: SpikeAnalyser,
    threshold: ThresholdAnalyser,
    stop: StopRule,
    map: DataBuilder,
    command: MotionCommand,
    phase: Phase,
    /// Side of the next oblique surge.
    side: f64,
    /// Whether there was a spike since the present surge or cast began; when and where across the latest was, s and m;
    /// and the head's most up-stream place with one, m.
    met: bool,
    met_s: f64,
    met_left_m: Option<f64>,
    farthest_m: f64,
    empty: usize,
    working: TrackerState,
    stopped: Option<bool>,
}

impl SurgeCast {
    /// The searcher on a machine, before its first tick.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the machine cannot do what the searcher needs.
    pub fn new(spec: &SurgeCastSpec, layout: &GantryLayout) -> Result<Self, RobotError> {
        let travel_m = layout.travel_m;
        let [along, across] = travel_m.map(|[least, greatest]| greatest - least);
        for (field, value, most) in [
            ("surge_m", spec.surge_m.get(), along),
            ("cast_m", spec.cast_m.get(), across),
            ("step_m", spec.step_m.get(), along),
        ] {
            let problem = format!("must be at most {most}, the gantry's travel in m, got {value}");
            require(value <= most, format!("tracker.SurgeCast.{field}"), problem)?;
        }
        let angle = spec.angle_deg.get();
        require(angle < 90.0, "tracker.SurgeCast.angle_deg", format!("must be from 0 to below 90, got {angle}"))?;
        spec.stop.check("tracker.SurgeCast.stop")?;
        Ok(Self {
            acquisition: Acquisition::new(layout)?,
            spikes: SpikeAnalyser::default(),
            threshold: ThresholdAnalyser::new(&spec.threshold, layout.range_v[0]),
            stop: StopRule::new(&spec.stop),
            map: DataBuilder::default(),
            command: MotionCommand::new(layout),
            phase: Phase::Begin,
            side: 1.0,
            met: false,
            met_s: 0.0,
            met_left_m: None,
            farthest_m: travel_m[0][0],
            empty: 0,
            working: TrackerState::default(),
            stopped: None,
            travel_m,
            bottom_v: layout.range_v[0],
            spec: spec.clone(),
        })
    }

    /// Looks for spikes in a scan.
    fn analyse(&mut self, scan: &ProbeScan, joints: &JointReadings) {
        let now = self.acquisition.sample(scan, joints);
        self.stop.scan(&now);
        self.working.spike = Default::default();
        if let Some((middle, tops)) = self.spikes.next(&now) {
            for probe in (0..now.count).filter(|i| tops[*i]) {
                let top = self.acquisition.spike(&middle, probe);
                if self.threshold.accepts(&top) {
                    self.working.spike[probe] = true;
                    self.map.add(&top);
                    self.stop.spike(&top);
                    (self.met, self.met_s, self.met_left_m) = (true, top.t_s, Some(top.place_m.y));
                    self.farthest_m = self.farthest_m.max(middle.head_m.x);
                }
            }
        }
        for (i, v) in self.working.threshold_v.iter_mut().enumerate().take(now.count) {
            *v = self.bottom_v + self.threshold.above_v(i);
        }
        self.working.spike_hz = self.stop.hz();
    }

    fn go(&mut self, t_s: f64, behaviour: Behaviour, to: Vector2<f64>) {
        self.command.go(t_s, behaviour, to, Vector2::from(self.spec.speed_m_s.map(Positive::get)));
    }

    fn end(&mut self, t_s: f64, here: Vector2<f64>, found: bool) {
        self.stopped = Some(found);
        self.go(t_s, Behaviour::Done, here);
    }

    /// A surge up-stream from a place.
    fn surge(&mut self, t_s: f64, from: Vector2<f64>) {
        if self.travel_m[0][1] - from.x < STILL_M {
            return self.end(t_s, from, self.spec.at_end == AtEnd::Stops);
        }
        (self.phase, self.met, self.empty) = (Phase::Surge, false, 0);
        self.side = -self.side;
        let (sin, cos) = math::sin_cos(self.spec.angle_deg.get().to_radians());
        self.go(t_s, Behaviour::StepUp, from + Vector2::new(cos, self.side * sin) * self.spec.surge_m.get());
    }

    /// A cast begins.
    fn cast(&mut self, t_s: f64, from: Vector2<f64>, heedless: bool, rng: &mut Stream) {
        let aside_m = self.met_left_m.map_or(0.0, |left_m| left_m - from.y);
        let coin = if rng.uniform() < 0.5 { 1.0 } else { -1.0 };
        let side = if aside_m.abs() < STILL_M { coin } else { aside_m.signum() };
        let reach_m = self.spec.cast_m.get();
        self.phase = Phase::Cast(Cast { home_left_m: from.y, side, reach_m, ends: [false; 2], heedless });
        self.met = false;
        self.go(t_s, Behaviour::Cast, Vector2::new(from.x, from.y + side * reach_m));
    }

    /// The end of an excursion: to the other side, or the end of the search.
    fn turn(&mut self, t_s: f64, at: &Progress, mut cast: Cast) {
        self.met = false;
        let [least, greatest] = self.travel_m[1];
        let left = cast.side > 0.0;
        let room_m = if left { greatest - at.here_m.y } else { at.here_m.y - least };
        cast.ends[usize::from(!left)] = at.blocked || room_m < STILL_M;
        if cast.ends == [true; 2] {
            // A spike would have ended the cast: there was none over the whole width.
            cast.ends[usize::from(left)] = false;
            self.empty += 1;
            if let Some(left_m) = self.stop.trail_end().and_then(|n| self.map.trail_end_left_m(n)) {
                self.phase = Phase::Last;
                return self.go(t_s, Behaviour::ToBest, Vector2::new(self.farthest_m, left_m));
            }
            if self.empty >= self.spec.empty_casts.get() {
                return self.end(t_s, at.here_m, false);
            }
        }
        (cast.side, cast.reach_m, cast.heedless) = (-cast.side, cast.reach_m + self.spec.cast_m.get(), false);
        self.phase = Phase::Cast(cast);
        let left_m = cast.home_left_m + cast.side * cast.reach_m;
        self.go(t_s, Behaviour::Cast, Vector2::new(at.here_m.x + self.spec.step_m.get(), left_m));
    }

    /// The next motion, if one is due.
    fn next(&mut self, t_s: f64, at: &Progress, joints: &JointReadings, rng: &mut Stream) {
        let (rest, lost) = (at.rest_s.is_some(), t_s - self.met_s >= self.spec.lost_s.get());
        match self.phase {
            Phase::Begin => self.cast(t_s, at.here_m, false, rng),
            Phase::Surge if rest && (self.met || lost || at.blocked) => {
                if self.stop.near() {
                    self.end(t_s, at.here_m, true);
                } else if self.met && !at.blocked {
                    self.surge(t_s, at.here_m);
                } else {
                    self.cast(t_s, at.here_m, at.blocked, rng);
                }
            }
            Phase::Cast(cast) if self.met && !cast.heedless => {
                self.stop.swept();
                self.surge(t_s, joints.position_m);
            }
            Phase::Cast(cast) if rest => self.turn(t_s, at, cast),
            Phase::Last if rest => self.end(t_s, at.here_m, true),
            _ => {}
        }
    }
}

impl Strategy<HeadGoal> for SurgeCast {
    fn step(&mut self, seen: &GantryObservation, rng: &mut Stream) -> Decision<HeadGoal> {
        let (t, joints) = (seen.t_s, &seen.readings.joints);
        if self.stopped.is_none() {
            if let Some(scan) = &seen.readings.scan {
                self.analyse(scan, joints);
            }
            let at = self.command.progress(t, joints);
            self.next(t, &at, joints, rng);
        }
        self.command.decision(joints, self.stopped)
    }

    fn shown(&self) -> TrackerState {
        self.working
    }
}

#[cfg(test)]
mod tests;
