//! Gathers what a run shows: tables, tracks, maps, pictures and the recording.

use super::machines;
use crate::files::ReportError;
use crate::record::Recorder;
use crate::results::{
    BeliefTrack, Echoes, GantryInfo, Pictures, PlumeFilm, ProbeTables, RobotInfo, RunInfo, SummaryBuilder, TrackTable,
};
use crate::scene::Scene;
use rheotaxis::error::AssembleError;
use rheotaxis::frame::{Frame, PictureFrame, PingFrame, PlumeFrame};
use rheotaxis::scenario::{Loaded, RecordSpec};
use rheotaxis::trial::{Event, Observer};
use std::sync::Arc;
use world::files::Folder;

/// All that is gathered while a run goes on.
pub(super) struct Gatherer {
    pub(super) robots: Vec<RobotInfo>,
    gantries: Vec<GantryInfo>,
    pub(super) builder: SummaryBuilder,
    pub(super) track: TrackTable,
    pub(super) probes: ProbeTables,
    pub(super) beliefs: BeliefTrack,
    pub(super) pictures: Option<Pictures>,
    pub(super) echoes: Echoes,
    pub(super) recorder: Option<Recorder>,
    pub(super) failure: Option<ReportError>,
    /// Whether there has been a plume to see.
    pub(super) plume_seen: bool,
    pub(super) plume_film: PlumeFilm,
}

impl Gatherer {
    /// Gathers in memory.
    ///
    /// # Errors
    /// If a gantry of the scenario cannot be read.
    pub(super) fn new(loaded: &Loaded, run: &RunInfo) -> Result<Self, AssembleError> {
        let (robots, gantries) = (machines::robots(loaded), machines::gantries(loaded)?);
        Ok(Self {
            builder: SummaryBuilder::new(run),
            track: TrackTable::in_memory(robots.clone()),
            probes: ProbeTables::in_memory(gantries.clone()),
            beliefs: BeliefTrack::default(),
            pictures: None,
            echoes: Echoes::default(),
            recorder: None,
            failure: None,
            plume_seen: false,
            plume_film: PlumeFilm::default(),
            robots,
            gantries,
        })
    }

    /// Writes into a folder from now on; with a scene also a recording.
    ///
    /// # Errors
    /// If the files cannot be written.
    pub(super) fn write_into(
        &mut self,
        out: &Folder,
        record: &RecordSpec,
        run: &RunInfo,
        recorded: Option<&Arc<Scene>>,
    ) -> Result<(), ReportError> {
        let path = out.file("track.csv").map_err(ReportError::from)?;
        self.track = TrackTable::create(&path, self.robots.clone())?;
        self.probes = ProbeTables::create(out, self.gantries.clone())?;
        if let Some(scene) = recorded {
            let mut begun = begin_recording(out, run)?.with_map_period(record.map_period_s.get());
            begun.scene(scene)?;
            self.recorder = Some(begun);
        }
        self.pictures = Some(Pictures::new(out, record.pictures));
        Ok(())
    }

    /// Keeps the first error of writing.
    pub(super) fn note(&mut self, result: Result<(), ReportError>) {
        if let Err(error) = result {
            self.failure.get_or_insert(error);
        }
    }

    fn record(&mut self, write: impl FnOnce(&mut Recorder) -> Result<(), ReportError>) {
        if let Some(recorder) = &mut self.recorder {
            let recorded = write(recorder);
            self.note(recorded);
        }
    }

    fn frame(&mut self, frame: &Frame) {
        self.builder.observe(frame);
        let rows = self.track.push(frame);
        self.note(rows);
        let scans = self.probes.push(frame);
        self.note(scans);
        self.beliefs.push(frame);
        self.record(|r| r.frame(frame));
    }

    fn plume(&mut self, plume: &PlumeFrame) {
        self.record(|r| r.plume(plume));
        self.beliefs.plume(plume);
        self.plume_film.push(plume);
        self.plume_seen = true;
    }

    fn picture(&mut self, picture: &PictureFrame) {
        let Some(pictures) = &mut self.pictures else {
            return;
        };
        let kept = pictures.push(picture);
        if let Ok(Some(png)) = &kept {
            self.record(|r| r.picture(picture, png));
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
}

impl Observer for Gatherer {
    fn see(&mut self, event: &Event) {
        match event {
            Event::Frame(frame) => self.frame(frame),
            Event::Plume(plume) => self.plume(plume),
            Event::Water(water) => self.record(|r| r.water(water)),
            Event::Exchange(exchange) => self.record(|r| r.consulted(exchange)),
            Event::Picture(picture) => self.picture(picture),
            Event::Ping(ping) => self.ping(ping),
            Event::SpinUp(_) | Event::SpinUpFromCache(_) | Event::Tick(_) => {}
        }
    }
}

/// Opens the recording. Its temporary file is listed too, so that the next run removes it if this one is killed.
fn begin_recording(out: &Folder, run: &RunInfo) -> Result<Recorder, ReportError> {
    let recorder = Recorder::create(&out.file("run.mcap")?, run)?;
    if let Some(name) = recorder.temporary().file_name() {
        out.enter(&name.to_string_lossy())?;
    }
    Ok(recorder)
}
