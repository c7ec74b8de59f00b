//! Follows a run and gathers all that it leaves: summary, tables, figures, pictures, recording. It keeps them in
//! memory, and writes them into a folder if it is given one.
#![allow(
    clippy::disallowed_methods,
    reason = "wall times are shown to people and stand in the summary; none enters the run"
)]

mod gathered;
mod gatherer;
mod machines;
mod worker;

pub use gathered::RunResults;

use crate::files::ReportError;
use crate::results::{RobotInfo, RunInfo};
use crate::scene::Scene;
use gatherer::Gatherer;
use rheotaxis::error::AssembleError;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, RunEnd, Trial, Wants};
use std::sync::Arc;
use std::time::{Duration, Instant};
use worker::GatherWorker;
use world::files::Folder;
use world::seeds::Seed;

/// Gathers the results of one run. [`Follower::finish`] returns them.
pub struct Follower {
    run: RunInfo,
    loaded: Loaded,
    scene: Option<Arc<Scene>>,
    robots: Vec<RobotInfo>,
    out: Option<Folder>,
    /// Whether there is a recording, for which the flow is looked at.
    recording: bool,
    worker: GatherWorker,
    begun: Instant,
    mission_begun: Instant,
    spin_up_kept: bool,
}

impl Follower {
    /// Follows a run of a scenario for a seed, in memory.
    ///
    /// # Errors
    /// If a gantry of the scenario cannot be read.
    pub fn new(loaded: &Loaded, seed: Seed) -> Result<Self, AssembleError> {
        let scenario = &loaded.scenario;
        let run = RunInfo {
            scenario_name: loaded.name.clone(),
            title: scenario.title.clone(),
            success: scenario.success.describe(),
            scenario_text: loaded.text().into_owned(),
            seed,
            version: env!("CARGO_PKG_VERSION").to_string(),
        };
        let gatherer = Gatherer::new(loaded, &run)?;
        let now = Instant::now();
        Ok(Self {
            robots: gatherer.robots.clone(),
            worker: GatherWorker::Here(Box::new(gatherer)),
            begun: now,
            mission_begun: now,
            spin_up_kept: false,
            recording: false,
            out: None,
            loaded: loaded.clone(),
            scene: None,
            run,
        })
    }

    /// Writes all that it gathers into a folder, before the run begins: tables and, if wanted, a recording grow there
    /// while the run goes on.
    ///
    /// # Errors
    /// If the files cannot be written.
    ///
    /// # Panics
    /// If it gathers [beside the run](Self::beside) by now.
    pub fn write_into(&mut self, out: &Folder, recording: bool) -> Result<(), ReportError> {
        // First, so that a scene that cannot be made leaves no file behind.
        let scene = recording.then(|| self.scene().map_err(Box::new));
        let scene = scene.transpose()?;
        let GatherWorker::Here(gatherer) = &mut self.worker else {
            panic!("files are opened before the run");
        };
        let record = &self.loaded.scenario.record;
        gatherer.write_into(out, record, &self.run, scene.as_ref())?;
        self.recording = recording;
        self.out = Some(out.clone());
        Ok(())
    }

    /// Gathers in a thread of its own from now on, and so writes tables and recording while the run goes on. They are
    /// the same; but a few simulated seconds wait to be written, and are lost if the process is killed.
    #[must_use]
    pub fn beside(mut self) -> Self {
        self.worker = self.worker.move_beside();
        self
    }

    /// What tables and figures know beforehand about the robots, in the scenario's order.
    pub fn robots(&self) -> &[RobotInfo] {
        &self.robots
    }

    /// What is there before the run. It is made once, when it is first asked for.
    ///
    /// # Errors
    /// If a file that the scenario names is missing or wrong.
    pub fn scene(&mut self) -> Result<Arc<Scene>, AssembleError> {
        if let Some(scene) = &self.scene {
            return Ok(Arc::clone(scene));
        }
        let scene = Arc::new(Scene::from_scenario(&self.loaded)?);
        Ok(Arc::clone(self.scene.insert(scene)))
    }

    /// The identity of the run.
    pub fn run(&self) -> &RunInfo {
        &self.run
    }

    /// Whether all that was gathered so far could be written. If not, the run should end.
    pub fn well(&self) -> bool {
        self.worker.well()
    }

    /// The results of the run at its end. A recording is closed; the other files are written by [`RunResults::write`].
    ///
    /// # Panics
    /// As the thread [beside the run](Self::beside) has, if it has.
    pub fn finish(self, trial: &Trial, ended: &RunEnd) -> RunResults {
        let walls: [Duration; 2] = [self.mission_begun - self.begun, self.mission_begun.elapsed()];
        let mut gatherer = self.worker.finish();
        if let Some(recorder) = gatherer.recorder.take() {
            let closed = recorder.finish(&ended.digest, ended.steps).map(drop);
            gatherer.note(closed);
        }
        let run = gathered::ResultsOwner { loaded: self.loaded, out: self.out, spin_up_kept: self.spin_up_kept };
        RunResults::assemble(*gatherer, run, trial, ended, walls)
    }
}

impl Observer for Follower {
    fn see(&mut self, event: &Event) {
        match event {
            Event::SpinUp(_) => self.mission_begun = Instant::now(),
            Event::SpinUpFromCache(kept) => {
                self.mission_begun = Instant::now();
                self.spin_up_kept = *kept;
            }
            Event::Tick(_) => {}
            other => self.worker.take(other.clone()),
        }
    }

    fn goes_on(&mut self) -> bool {
        self.well()
    }

    fn wants(&self) -> Wants {
        Wants { plume: true, water: self.recording }
    }
}
