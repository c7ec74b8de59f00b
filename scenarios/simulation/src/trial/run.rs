//! The state of a run, its spin-up, and what each of its ticks shows.

use super::observer::{Event, Observer};
use super::progress::{Progress, RunPhase};
use super::water::pictured;
use crate::assemble::Simulation;
use crate::control::Controller;
use crate::error::AssembleError;
use crate::fleet::Fleet;
use crate::frame::{Frame, PlumeFrame};
use crate::machines::Machine;
use crate::ocean::{Mismatch, Ocean, SpunUp};
use crate::outbox::Outbox;
use crate::outcome::RunOutcome;
use crate::scenario::{Loaded, Scenario, SuccessSpec};
use crate::score::Score;
use crate::topic::{TopicValue, Topics};
use nalgebra::Vector3;
use robots::handoff::{Declaration, Outcome, Verdict};
use std::collections::BTreeMap;
use std::sync::Arc;
use world::clock::Clock;
use world::digest::Digest;
use world::fields::Flow;
use world::seeds::Seed;

/// What is known at the end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunEnd {
    /// How it ended.
    pub outcome: RunOutcome,
    /// Digest of all states of the run, of what was declared in it and of its outcome.
    pub digest: String,
    /// Ticks of the mission.
    pub steps: u64,
    /// Mission time, s.
    pub t_s: f64,
    /// Declarations by robot or gantry.
    pub declarations: BTreeMap<String, Vec<Declaration>>,
    /// Flow at each source, averaged over the mission at the times the plume was pictured, m/s; zero in a run without
    /// frames.
    pub flow_at_sources: Vec<Vector3<f64>>,
}

/// One run of a scenario.
pub struct Trial {
    /// Its world and its tick.
    pub simulation: Simulation,
    pub(super) scenario: Scenario,
    pub(super) controllers: BTreeMap<String, Box<dyn Controller>>,
    pub(crate) progress: Progress,
}

impl Trial {
    /// Assembles a scenario for a seed, with everything that the registry carries under which it was read.
    ///
    /// # Errors
    /// See [`Simulation::assemble_with`].
    pub fn assemble(loaded: &Loaded, seed: impl Into<Seed>) -> Result<Self, AssembleError> {
        let scenario: &Scenario = &loaded.scenario;
        let simulation = Simulation::assemble_with(&loaded.registry, scenario, &loaded.base_dir, seed)?;
        let sources = simulation.ocean().sources();
        Ok(Self::from_simulation(scenario, simulation, sources))
    }

    /// A run of a scenario that is assembled, in an ocean with these sources (ENU, m).
    pub(crate) fn from_simulation(scenario: &Scenario, simulation: Simulation, sources: Vec<Vector3<f64>>) -> Self {
        Self { simulation, scenario: scenario.clone(), progress: Progress::new(sources), controllers: BTreeMap::new() }
    }

    /// Lets water and plume develop and returns a copy of them, which other runs can
    /// [take over](Self::take_over); `None` if `observer` stopped the spin-up. [`Self::run`] spins up by itself if this
    /// was not called before.
    ///
    /// # Panics
    /// If the run has been spun up before.
    pub fn spin_up(&mut self, observer: &mut dyn Observer) -> Option<SpunUp> {
        self.run_spin_up(observer);
        (self.progress.phase == RunPhase::SpunUp).then(|| {
            let state = self.simulation.ocean().state();
            SpunUp::new(self.simulation.origin.clone(), state)
        })
    }

    /// Takes over the spin-up of another run instead of its own. The result is the same, bit for bit. The state is
    /// copied.
    ///
    /// # Errors
    /// If the two runs differ in something that the spin-up depends on. The run is then unchanged and can spin up
    /// itself.
    ///
    /// # Panics
    /// If the run has been spun up before.
    pub fn take_over(&mut self, spun_up: &SpunUp) -> Result<(), Mismatch> {
        let state = spun_up.copy_for(&self.simulation.origin)?;
        self.start_afresh();
        self.simulation.ocean_mut().put_state(state);
        self.begin_mission(false);
        Ok(())
    }

    pub(super) fn run_spin_up(&mut self, observer: &mut dyn Observer) {
        self.start_afresh();
        let mut stopped = false;
        self.simulation.ocean_mut().spin_up(|share| {
            observer.see(&Event::SpinUp(share));
            stopped = !observer.goes_on();
            !stopped
        });
        self.begin_mission(stopped);
    }

    fn start_afresh(&self) {
        assert!(
            self.progress.phase == RunPhase::Assembled,
            "a trial is spun up once: assemble another for another run"
        );
    }

    /// Begins the mission in the ocean as it is, unless an observer has stopped the spin-up.
    pub(crate) fn begin_mission(&mut self, stopped: bool) {
        self.progress.phase = if stopped { RunPhase::Stopped } else { RunPhase::SpunUp };
        self.simulation.ocean_mut().set_out();
        self.digest_plume();
    }

    /// Begins the mission in an ocean that others have used before, in this step of theirs.
    pub(crate) fn begin_at(&mut self, step: u64) {
        self.progress.phase = RunPhase::SpunUp;
        let mut clock = self.simulation.world.resource_mut::<Clock>();
        clock.step = step;
        self.progress.began_s = clock.t_s();
        self.digest_plume();
    }

    fn digest_plume(&mut self) {
        let world = &mut self.simulation.world;
        world.resource_scope::<Digest, ()>(|world, mut digest| {
            world.resource::<Ocean>().plume().digest_into(&mut digest);
        });
    }

    /// Whether the mission has begun and lasts.
    pub(crate) fn going(&self) -> bool {
        self.progress.phase == RunPhase::SpunUp
    }

    /// Shows an observer what a tick has made; `false` once the run is over or the observer stopped it.
    pub(crate) fn close_tick(&mut self, observer: &mut dyn Observer) -> bool {
        self.show(observer);
        let t_s = self.simulation.t_s();
        observer.see(&Event::Tick(t_s));
        let goes_on = observer.goes_on();
        // A run that is over ended by itself, whoever would stop it then.
        let limit_s = self.scenario.time.limit_s.get();
        if self.all_over() || t_s - self.progress.began_s >= limit_s - 1e-9 {
            self.progress.phase = RunPhase::Ended;
        } else if !goes_on {
            self.progress.phase = RunPhase::Stopped;
        }
        self.going()
    }

    /// The result of the run so far. Before its end the outcome is the one that it would have at the time limit.
    pub fn ended(&self) -> RunEnd {
        let world = &self.simulation.world;
        let samples = f64::from(self.progress.flow_samples.max(1));
        let outcome = match self.progress.phase {
            RunPhase::Stopped => RunOutcome::Interrupted,
            _ => self.outcome(),
        };
        RunEnd {
            outcome,
            flow_at_sources: self.progress.flow_sums.iter().map(|sum| sum / samples).collect(),
            digest: self.digest(outcome),
            steps: world.resource::<Clock>().step,
            t_s: self.simulation.t_s(),
            declarations: self.declarations(),
        }
    }

    /// The digest of the states, with the run's answers: a declaration need not move anything.
    fn digest(&self, outcome: RunOutcome) -> String {
        let mut digest = self.simulation.world.resource::<Digest>().clone();
        for searcher in &self.score().searchers {
            digest.text(&searcher.id);
            for declaration in &searcher.declarations {
                declaration.digest_into(&mut digest);
            }
        }
        digest.text(outcome.label());
        digest.hex()
    }

    /// The newest frame; `None` before the first. `record.frame_period_s` of the scenario says how often there is one.
    pub fn frame(&self) -> Option<&Frame> {
        self.progress.frame.as_deref()
    }

    /// The newest value of every key that was published, sorted by key.
    pub fn published(&self) -> impl Iterator<Item = &TopicValue> {
        self.simulation.world.resource::<Topics>().newest()
    }

    /// What the summary shows of each machine that has its own part in it, by id.
    pub fn apparatus(&self) -> BTreeMap<String, serde_json::Value> {
        let all = Fleet::from_scenario(&self.scenario);
        let part = |a: &dyn Machine| Some((a.id().to_string(), a.summary(&self.simulation.world)?));
        all.all().filter_map(part).collect()
    }

    /// How near each searcher came to a source, what it declared, and how its mission ended.
    pub fn score(&self) -> &Score {
        self.simulation.world.resource()
    }

    fn show(&mut self, observer: &mut dyn Observer) {
        if !self.simulation.waits() {
            return;
        }
        let mut outbox = self.simulation.world.resource_mut::<Outbox>();
        let (frame, due) = (outbox.frame.take(), outbox.plume_due.take());
        let most = outbox.plume_points;
        for picture in std::mem::take(&mut outbox.pictures) {
            observer.see(&Event::Picture(Arc::new(picture)));
        }
        for ping in std::mem::take(&mut outbox.pings) {
            observer.see(&Event::Ping(Arc::new(ping)));
        }
        if let Some(frame) = frame.map(Arc::new) {
            observer.see(&Event::Frame(Arc::clone(&frame)));
            self.progress.frame = Some(frame);
        }
        if let Some(t_s) = due {
            self.progress.flow_samples += 1;
            let Progress { flow_sums, sources, .. } = &mut self.progress;
            for (sum, p_W) in flow_sums.iter_mut().zip(&*sources) {
                *sum += self.simulation.velocity(p_W);
            }
            let wants = observer.wants();
            if wants.plume {
                let ocean = self.simulation.ocean();
                let plume = ocean.plume();
                let frame =
                    PlumeFrame { t_s, total: plume.len(), points: plume.decimated(most), centre: ocean.area.centre };
                observer.see(&Event::Plume(Arc::new(frame)));
            }
            // A steady flow is shown once.
            let shown = std::mem::replace(&mut self.progress.water_shown, true);
            if wants.water && !(shown && self.simulation.ocean().is_steady()) {
                observer.see(&Event::Water(Arc::new(pictured(self.simulation.ocean(), t_s))));
            }
        }
    }

    /// Whether all searchers have ended their missions. Without searchers the run goes on to its time limit.
    fn all_over(&self) -> bool {
        let mut decisions = self.simulation.outcomes().peekable();
        decisions.peek().is_some() && decisions.all(|d| d.is_some())
    }

    /// Declarations so far, by searcher.
    fn declarations(&self) -> BTreeMap<String, Vec<Declaration>> {
        let all = self.score().searchers.iter();
        all.filter(|s| !s.declarations.is_empty()).map(|s| (s.id.clone(), s.declarations.clone())).collect()
    }

    fn outcome(&self) -> RunOutcome {
        let missions: Vec<_> = self.simulation.outcomes().collect();
        let declarations = self.declarations();
        // A declaration that the vehicle itself has rejected does not count.
        let stands = |d: &&Declaration| d.verdict != Verdict::Rejected;
        let standing = || declarations.values().flatten().filter(stands);
        let declared = |s: &Vector3<f64>, within_m: f64| standing().any(|d| (s.xy() - d.position).norm() <= within_m);
        if let SuccessSpec::Declared(wanted) = &self.scenario.success
            && !declarations.is_empty()
        {
            let within_m = wanted.within_m.get();
            return if self.progress.sources.iter().any(|s| declared(s, within_m)) {
                RunOutcome::Found
            } else {
                RunOutcome::NotFound
            };
        }
        if let SuccessSpec::Reached(wanted) = &self.scenario.success
            && self.score().closest_m() <= wanted.within_m.get()
        {
            return RunOutcome::Found;
        }
        if missions.contains(&Some(Outcome::Aborted)) {
            RunOutcome::Aborted
        } else if missions.contains(&None) {
            RunOutcome::TimeOut
        } else {
            match &self.scenario.success {
                SuccessSpec::Completed => RunOutcome::Completed,
                SuccessSpec::AllDeclared(wanted)
                    if (self.progress.sources.iter()).all(|s| declared(s, wanted.within_m.get())) =>
                {
                    RunOutcome::Found
                }
                _ => RunOutcome::NotFound,
            }
        }
    }
}
