//! Follows a run and gathers all that it leaves: summary, tables, figures, pictures, recording. It keeps them in
//! memory, and writes them into a folder if it is given one.
#![allow(
    clippy::disallowed_methods,
    reason = "wall times are shown to people and stand in the summary; none enters the run"
)]

mod gathered;
mod machines;

pub use gathered::Gathered;

use crate::files::ReportError;
use crate::record::Recorder;
use crate::results::{
    BeliefTrack, Echoes, GantryInfo, Pictures, PlumeFilm, ProbeTables, RobotInfo, RunInfo,
    SummaryBuilder, TrackTable,
};
use crate::scene::Scene;
use rheotaxis::control::Consultation;
use rheotaxis::error::AssembleError;
use rheotaxis::frame::{Frame, PictureFrame, PingFrame, PlumeFrame, WaterFrame};
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Ended, Trial, Watch};
use std::sync::Arc;
use std::time::{Duration, Instant};
use world::files::Folder;
use world::seeds::Seed;

/// Gathers the results of one run. It is told all that a [`Watch`] is told; [`Follower::finish`] returns them.
pub struct Follower {
    run: RunInfo,
    loaded: Loaded,
    scene: Option<Arc<Scene>>,
    robots: Vec<RobotInfo>,
    gantries: Vec<GantryInfo>,
    out: Option<Folder>,
    builder: SummaryBuilder,
    track: TrackTable,
    probes: ProbeTables,
    beliefs: BeliefTrack,
    pictures: Option<Pictures>,
    echoes: Echoes,
    recorder: Option<Recorder>,
    failure: Option<ReportError>,
    last_plume: Option<PlumeFrame>,
    plume_film: PlumeFilm,
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
            success: scenario.success.words(),
            scenario_text: loaded.text.clone(),
            seed,
            version: env!("CARGO_PKG_VERSION").to_string(),
        };
        let (robots, gantries) = (machines::robots(loaded), machines::gantries(loaded)?);
        let now = Instant::now();
        Ok(Self {
            builder: SummaryBuilder::new(&run),
            track: TrackTable::in_memory(robots.clone()),
            probes: ProbeTables::in_memory(gantries.clone()),
            beliefs: BeliefTrack::default(),
            pictures: None,
            echoes: Echoes::default(),
            recorder: None,
            failure: None,
            last_plume: None,
            plume_film: PlumeFilm::default(),
            begun: now,
            mission_begun: now,
            spin_up_kept: false,
            out: None,
            loaded: loaded.clone(),
            scene: None,
            run,
            robots,
            gantries,
        })
    }

    /// Writes all that it gathers into a folder, before the run begins: tables and, if wanted, a recording grow there
    /// while the run goes on.
    ///
    /// # Errors
    /// If the files cannot be written.
    pub fn write_into(&mut self, out: &Folder, recording: bool) -> Result<(), ReportError> {
        let path = out.file("track.csv").map_err(ReportError::from)?;
        self.track = TrackTable::create(&path, self.robots.clone())?;
        self.probes = ProbeTables::create(out, self.gantries.clone())?;
        if recording {
            // First, so that a scene that cannot be made leaves no file behind.
            let scene = self.scene().map_err(Box::new)?;
            let mut begun = begin_recording(out, &self.run)?
                .with_map_period(self.loaded.scenario.record.map_period_s.get());
            begun.scene(&scene)?;
            self.recorder = Some(begun);
        }
        let record = &self.loaded.scenario.record;
        self.pictures = Some(Pictures::new(out, record.pictures));
        self.out = Some(out.clone());
        Ok(())
    }

    /// What tables and figures know beforehand about the robots, in the scenario's order.
    #[must_use]
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
        let scene = Arc::new(Scene::of(&self.loaded)?);
        Ok(Arc::clone(self.scene.insert(scene)))
    }

    /// The identity of the run.
    #[must_use]
    pub fn run(&self) -> &RunInfo {
        &self.run
    }

    /// Whether all that was gathered so far could be written. If not, the run should end.
    #[must_use]
    pub fn well(&self) -> bool {
        self.failure.is_none()
    }

    /// Keeps the first error of writing.
    fn note(&mut self, result: Result<(), ReportError>) {
        if let Err(error) = result {
            self.failure.get_or_insert(error);
        }
    }

    /// The results of the run at its end. A recording is closed; the other files are written by [`Gathered::write`].
    #[must_use]
    pub fn finish(mut self, trial: &Trial, ended: &Ended) -> Gathered {
        let walls: [Duration; 2] = [
            self.mission_begun - self.begun,
            self.mission_begun.elapsed(),
        ];
        if let Some(recorder) = self.recorder.take() {
            let closed = recorder.finish(&ended.digest, ended.steps).map(drop);
            self.note(closed);
        }
        Gathered::of(self, trial, ended, walls)
    }
}

/// Opens the recording. Its temporary file is listed too, so that the next run removes it if this one is killed.
fn begin_recording(out: &Folder, run: &RunInfo) -> Result<Recorder, ReportError> {
    let recorder = Recorder::create(&out.file("run.mcap")?, run)?;
    if let Some(name) = recorder.temporary().file_name() {
        out.file(&name.to_string_lossy())?;
    }
    Ok(recorder)
}

impl Watch for Follower {
    fn spun_up(&mut self, _share: f64) -> bool {
        self.mission_begun = Instant::now();
        self.well()
    }

    fn developed(&mut self, kept: bool) {
        self.mission_begun = Instant::now();
        self.spin_up_kept = kept;
    }

    fn frame(&mut self, frame: &Frame) {
        self.builder.observe(frame);
        let rows = self.track.push(frame);
        self.note(rows);
        let scans = self.probes.push(frame);
        self.note(scans);
        self.beliefs.push(frame);
        if let Some(recorder) = &mut self.recorder {
            let recorded = recorder.frame(frame);
            self.note(recorded);
        }
    }

    fn plume(&mut self, plume: &PlumeFrame) {
        if let Some(recorder) = &mut self.recorder {
            let recorded = recorder.plume(plume);
            self.note(recorded);
        }
        self.beliefs.plume(plume);
        self.plume_film.push(plume);
        self.last_plume = Some(plume.clone());
    }

    fn water(&mut self, look: &dyn Fn() -> WaterFrame) {
        if let Some(recorder) = &mut self.recorder {
            let recorded = recorder.water(&look());
            self.note(recorded);
        }
    }

    fn consulted(&mut self, told: &Consultation) {
        if let Some(recorder) = &mut self.recorder {
            let recorded = recorder.consulted(told);
            self.note(recorded);
        }
    }

    fn picture(&mut self, picture: &PictureFrame) {
        let Some(pictures) = &mut self.pictures else {
            return;
        };
        let kept = pictures.push(picture);
        if let (Ok(Some(png)), Some(recorder)) = (&kept, &mut self.recorder) {
            let recorded = recorder.picture(picture, png);
            self.note(recorded);
        }
        self.note(kept.map(drop));
    }

    fn ping(&mut self, ping: &PingFrame) {
        if let Some(line) = self.echoes.push(ping)
            && let Some(recorder) = &mut self.recorder
        {
            let recorded = recorder.echo(&ping.robot, line);
            self.note(recorded);
        }
    }

    fn go_on(&mut self, _t_s: f64) -> bool {
        self.well()
    }
}
