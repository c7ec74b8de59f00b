//! The blue-crab tracker: the eight units of the flow chart, one after the other, in each scan and each tick.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4, Fig. 7.
//!
//! *Parameters*: those of the units, see [`CrabSpec`].
//!
//! *Deviations*: see the units.

pub mod advance;
pub mod builder;
#[cfg(test)]
mod closed_loop_tests;
pub mod decide;
pub mod history;
pub mod pace;
pub mod predictor;
pub mod rate;
pub(super) mod spec;
pub mod spikes;
pub mod steer;
pub mod stop;
pub mod threshold;

use super::acquire::Acquisition;
use super::command::MotionCommand;
use super::spec::GantryStrategyParams;
use crate::error::RobotError;
use crate::handoff::{
    Behaviour, Decision, GantryLayout, GantryObservation, HeadGoal, JointReadings, ProbeScan, TrackerState,
};
use crate::searcher::Strategy;
use builder::DataBuilder;
use decide::{Ask, DecisionUnit, Memory};
use history::History;
use predictor::Predictor;
use spec::CrabSpec;
use spikes::SpikeAnalyser;
use stop::StopRule;
use threshold::ThresholdAnalyser;
use world::catalogue::Entry;
use world::registry::Listed;
use world::seeds::Stream;

impl Listed for CrabSpec {
    const ENTRY: Entry = Entry {
        name: "Crab",
        what: "blue-crab tracker: sweep, step up-stream on rising spikes, cast, bilateral steering, stop by spike \
            frequency",
        source: "Webster et al. 2012, section 4, Fig. 7",
    };
}

impl GantryStrategyParams for CrabSpec {
    fn build(&self, layout: &GantryLayout) -> Result<Box<dyn Strategy<HeadGoal>>, RobotError> {
        Ok(Box::new(CrabTracker::new(self, layout)?))
    }
}

/// The tracker.
#[derive(Debug)]
pub struct CrabTracker {
    acquisition: Acquisition,
    bottom_v: f64,
    spikes: SpikeAnalyser,
    threshold: ThresholdAnalyser,
    predictor: Predictor,
    map: DataBuilder,
    history: History,
    decision: DecisionUnit,
    command: MotionCommand,
    working: TrackerState,
    stopped: Option<bool>,
}

impl CrabTracker {
    /// The tracker on a machine, before its first tick.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the machine cannot do what the tracker needs.
    pub fn new(spec: &CrabSpec, layout: &GantryLayout) -> Result<Self, RobotError> {
        let acquisition = Acquisition::new(layout)?;
        let rules = spec.rules(layout)?;
        let bottom_v = layout.range_v[0];
        Ok(Self {
            bottom_v,
            spikes: SpikeAnalyser::default(),
            threshold: ThresholdAnalyser::new(&spec.threshold, bottom_v),
            predictor: Predictor::new(&spec.predictor, spec.history.over),
            map: DataBuilder::default(),
            history: History::new(&spec.history, acquisition.left, acquisition.right),
            decision: DecisionUnit::new(rules, StopRule::new(&spec.stop)),
            command: MotionCommand::new(layout),
            working: TrackerState::default(),
            stopped: None,
            acquisition,
        })
    }

    /// Analyses a scan: which of the samples before it were spikes.
    fn analyse(&mut self, scan: &ProbeScan, joints: &JointReadings) {
        let now = self.acquisition.sample(scan, joints);
        self.decision.stop.scan(&now);
        self.working.spike = Default::default();
        if let Some((middle, tops)) = self.spikes.next(&now) {
            for probe in (0..now.count).filter(|i| tops[*i]) {
                let top = self.acquisition.spike(&middle, probe);
                if self.threshold.accepts(&top) {
                    self.working.spike[probe] = true;
                    self.predictor.add(&top, self.history.weight(probe));
                    self.map.add(&top);
                    self.history.add(&top);
                    self.decision.stop.spike(&top);
                }
            }
        }
        for (i, v) in self.working.threshold_v.iter_mut().enumerate().take(now.count) {
            *v = self.bottom_v + self.threshold.above_v(i);
        }
        self.working.spike_hz = self.decision.stop.hz();
    }
}

impl Strategy<HeadGoal> for CrabTracker {
    fn step(&mut self, seen: &GantryObservation, rng: &mut Stream) -> Decision<HeadGoal> {
        let (t, joints) = (seen.t_s, &seen.readings.joints);
        if self.stopped.is_some() {
            return self.command.decision(joints, self.stopped);
        }
        if let Some(scan) = &seen.readings.scan {
            self.analyse(scan, joints);
        }
        let at = self.command.progress(t, joints);
        let step = self.history.record(t);
        self.working.magnitude_v = step.mean_v;
        self.working.predicted_v = step.predicted_v;
        self.working.contrast = self.decision.contrast(&step);
        if let Some((ask, memory)) = self.decision.next(&at, &step, &mut self.map, rng) {
            match memory {
                Memory::Keep => {}
                Memory::Next => self.history.next(t, self.predictor.predict(t)),
                Memory::Forget => self.history.forget(t, self.predictor.predict(t)),
            }
            match ask {
                Ask::Go(behaviour, target, speed) => self.command.go(t, behaviour, target, speed),
                Ask::Stop(found) => {
                    let hold = joints.position_m;
                    let speed = self.decision.speed_m_s();
                    self.command.go(t, Behaviour::Done, hold, speed);
                    self.stopped = Some(found);
                }
            }
        }
        self.command.decision(joints, self.stopped)
    }

    fn shown(&self) -> TrackerState {
        self.working
    }
}
