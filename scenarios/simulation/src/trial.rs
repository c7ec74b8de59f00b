//! One run of a scenario from spin-up to its end, without files or screens: those watch it.
//!
//! [`Trial::run`] does all of it; [`Trial::step`] and [`Trial::until`] go a part of the way, and what there is can be
//! read in between. All three give the same run, bit for bit.

use crate::assemble::Simulation;
use crate::error::AssembleError;
use crate::frame::system::Outbox;
use crate::frame::{Frame, PictureFrame, PingFrame, PlumeFrame};
use crate::ocean::{Mismatch, Ocean, SpunUp};
use crate::outcome::RunOutcome;
use crate::scenario::{Loaded, Scenario, SuccessSpec};
use crate::score::Score;
use nalgebra::Vector3;
use robots::handoff::{Declaration, Outcome, Verdict};
use std::collections::BTreeMap;
use world::clock::Clock;
use world::digest::Digest;
use world::seeds::Seed;

/// Somebody who looks on: records, publishes, paces, draws progress. Nothing it does reaches the run
/// but the wish to stop.
pub trait Watch {
    /// The share of the spin-up that is done; `false` stops the run.
    fn spun_up(&mut self, _share: f64) -> bool {
        true
    }
    /// A new picture of the robots.
    fn frame(&mut self, _frame: &Frame) {}
    /// A new picture of the plume.
    fn plume(&mut self, _plume: &PlumeFrame) {}
    /// A picture that a robot's camera took.
    fn picture(&mut self, _picture: &PictureFrame) {}
    /// A ping of a robot's sidescan sonar.
    fn ping(&mut self, _ping: &PingFrame) {}
    /// After every tick; `false` stops the run.
    fn go_on(&mut self, _t_s: f64) -> bool {
        true
    }
}

/// Nobody looks on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {}

/// What is known at the end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    /// How it ended.
    pub outcome: RunOutcome,
    /// Digest of the whole state sequence.
    pub digest: String,
    /// Ticks of the mission.
    pub steps: u64,
    /// Mission time, s.
    pub t_s: f64,
    /// Declarations by robot or gantry.
    pub declarations: BTreeMap<String, Vec<Declaration>>,
    /// Flow at each source, averaged over the mission at the times the plume was pictured, m/s.
    pub flow_at_sources: Vec<Vector3<f64>>,
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Assembled,
    SpunUp,
    /// By who looked on.
    Stopped,
    Ended,
}

/// A run, ready to start.
pub struct Trial {
    /// Everything that lives in it.
    pub simulation: Simulation,
    stage: Stage,
    success: SuccessSpec,
    limit_s: f64,
    sources: Vec<Vector3<f64>>,
    flow_sums: Vec<Vector3<f64>>,
    flow_samples: u32,
    frame: Option<Frame>,
}

impl Trial {
    /// Puts a scenario together for a seed.
    ///
    /// # Errors
    /// See [`Simulation::assemble`].
    pub fn assemble(loaded: &Loaded, seed: impl Into<Seed>) -> Result<Self, AssembleError> {
        let scenario: &Scenario = &loaded.scenario;
        let simulation = Simulation::assemble(scenario, &loaded.base_dir, seed)?;
        let sources = simulation.ocean().plume().sources();
        let sources: Vec<_> = sources.iter().map(|s| s.p_W).collect();
        Ok(Self {
            simulation,
            stage: Stage::Assembled,
            success: scenario.success.clone(),
            limit_s: scenario.time.limit_s.get(),
            flow_sums: vec![Vector3::zeros(); sources.len()],
            flow_samples: 0,
            sources,
            frame: None,
        })
    }

    /// Lets water and plume develop and returns a copy of them, for other runs to
    /// [`take over`](Self::take_over); `None` if `watch` stopped it, and then [`Self::run`] only says so.
    /// Not needed before [`Self::run`], which spins up by itself where this was not done.
    ///
    /// # Panics
    /// If the run has been spun up before.
    pub fn spin_up(&mut self, watch: &mut dyn Watch) -> Option<SpunUp> {
        self.develop(watch);
        (self.stage == Stage::SpunUp).then(|| {
            let state = self.simulation.ocean().state();
            SpunUp::new(self.simulation.origin.clone(), state)
        })
    }

    /// Takes over what another run has spun up, in place of spinning up: from here on the run is the
    /// same bit for bit. Costs a copy of the state.
    ///
    /// # Errors
    /// If the two runs differ in what the spin-up depends on; the run is then as it was, and can
    /// spin up itself.
    ///
    /// # Panics
    /// If the run has been spun up before.
    pub fn take_over(&mut self, spun_up: &SpunUp) -> Result<(), Mismatch> {
        let state = spun_up.copy_for(&self.simulation.origin)?;
        self.start_afresh();
        self.simulation.ocean_mut().put_state(state);
        self.set_out(Stage::SpunUp);
        Ok(())
    }

    fn develop(&mut self, watch: &mut dyn Watch) {
        self.start_afresh();
        let mut stopped = false;
        self.simulation.ocean_mut().spin_up(|share| {
            stopped = !watch.spun_up(share);
            !stopped
        });
        self.set_out(if stopped {
            Stage::Stopped
        } else {
            Stage::SpunUp
        });
    }

    fn start_afresh(&self) {
        assert!(
            self.stage == Stage::Assembled,
            "a trial is spun up once: assemble another for another run"
        );
    }

    fn set_out(&mut self, stage: Stage) {
        self.stage = stage;
        let world = &mut self.simulation.world;
        world.resource_scope::<Digest, ()>(|world, mut digest| {
            world.resource::<Ocean>().plume().digest_into(&mut digest);
        });
    }

    /// Runs it to its end: the spin-up, unless that is done or taken over, and the rest of the mission.
    pub fn run(&mut self, watch: &mut dyn Watch) -> Ended {
        while self.advance(watch) {}
        self.ended()
    }

    /// One tick of the mission, after the spin-up where that is not done; `false` once the run is over.
    pub fn step(&mut self) -> bool {
        self.advance(&mut Unwatched)
    }

    /// Ticks until a time of the mission, s; `false` if the run was over before.
    pub fn until(&mut self, t_s: f64) -> bool {
        while self.simulation.t_s() < t_s - 1e-9 {
            if !self.step() {
                return false;
            }
        }
        true
    }

    /// One tick with somebody who looks on; `false` once the run is over or `watch` stopped it.
    fn advance(&mut self, watch: &mut dyn Watch) -> bool {
        if self.stage == Stage::Assembled {
            self.develop(watch);
        }
        if self.stage != Stage::SpunUp {
            return false;
        }
        self.simulation.tick();
        self.show(watch);
        let t_s = self.simulation.t_s();
        if !watch.go_on(t_s) {
            self.stage = Stage::Stopped;
        } else if self.all_over() || t_s >= self.limit_s - 1e-9 {
            self.stage = Stage::Ended;
        }
        self.stage == Stage::SpunUp
    }

    /// What the run has come to by now. Before its end the outcome is as if the time limit had come.
    #[must_use]
    pub fn ended(&self) -> Ended {
        let world = &self.simulation.world;
        let samples = f64::from(self.flow_samples.max(1));
        Ended {
            outcome: match self.stage {
                Stage::Stopped => RunOutcome::Interrupted,
                _ => self.outcome(),
            },
            flow_at_sources: self.flow_sums.iter().map(|sum| sum / samples).collect(),
            digest: world.resource::<Digest>().hex(),
            steps: world.resource::<Clock>().step,
            t_s: self.simulation.t_s(),
            declarations: self.declarations(),
        }
    }

    /// Runs it to its end with nobody looking on.
    #[must_use]
    pub fn finish_quietly(mut self) -> Ended {
        self.run(&mut Unwatched)
    }

    /// The newest picture of the searchers; `None` before the first. How often one is taken says `record` of the
    /// scenario.
    #[must_use]
    pub fn frame(&self) -> Option<&Frame> {
        self.frame.as_ref()
    }

    /// How near each searcher came, and what was declared so far.
    #[must_use]
    pub fn score(&self) -> &Score {
        self.simulation.world.resource()
    }

    fn show(&mut self, watch: &mut dyn Watch) {
        let mut outbox = self.simulation.world.resource_mut::<Outbox>();
        let (frame, plume) = (outbox.frame.take(), outbox.plume.take());
        for picture in std::mem::take(&mut outbox.pictures) {
            watch.picture(&picture);
        }
        for ping in std::mem::take(&mut outbox.pings) {
            watch.ping(&ping);
        }
        if let Some(frame) = frame {
            watch.frame(&frame);
            self.frame = Some(frame);
        }
        if let Some(plume) = plume {
            self.flow_samples += 1;
            for (sum, p_W) in self.flow_sums.iter_mut().zip(&self.sources) {
                *sum += self.simulation.velocity(p_W);
            }
            watch.plume(&plume);
        }
    }

    /// Every robot has ended its mission (without robots the run goes on to its limit).
    fn all_over(&self) -> bool {
        let mut decisions = self.simulation.outcomes().peekable();
        decisions.peek().is_some() && decisions.all(|d| d.is_some())
    }

    /// Declarations so far, by the searchers that have made any.
    fn declarations(&self) -> BTreeMap<String, Vec<Declaration>> {
        let all = self.score().searchers.iter();
        all.filter(|s| !s.declarations.is_empty())
            .map(|s| (s.id.clone(), s.declarations.clone()))
            .collect()
    }

    fn outcome(&self) -> RunOutcome {
        let missions: Vec<_> = self.simulation.outcomes().collect();
        let declarations = self.declarations();
        // What the vehicle itself has rejected does not stand.
        let stands = |d: &&Declaration| d.verdict != Verdict::Rejected;
        let standing = || declarations.values().flatten().filter(stands);
        let declared = |s: &Vector3<f64>, within_m: f64| {
            standing().any(|d| (s.xy() - d.position).norm() <= within_m)
        };
        if let SuccessSpec::Declared(wanted) = &self.success
            && !declarations.is_empty()
        {
            let within_m = wanted.within_m.get();
            return if self.sources.iter().any(|s| declared(s, within_m)) {
                RunOutcome::Found
            } else {
                RunOutcome::NotFound
            };
        }
        if let SuccessSpec::Reached(wanted) = &self.success
            && self.score().closest_m() <= wanted.within_m.get()
        {
            return RunOutcome::Found;
        }
        if missions.contains(&Some(Outcome::Aborted)) {
            RunOutcome::Aborted
        } else if missions.contains(&None) {
            RunOutcome::TimeOut
        } else {
            match &self.success {
                SuccessSpec::Completed => RunOutcome::Completed,
                SuccessSpec::AllDeclared(wanted)
                    if (self.sources.iter()).all(|s| declared(s, wanted.within_m.get())) =>
                {
                    RunOutcome::Found
                }
                _ => RunOutcome::NotFound,
            }
        }
    }
}
