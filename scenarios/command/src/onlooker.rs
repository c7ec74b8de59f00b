//! Everything that follows a run: recording, tables, live state, progress, pace, and the report at its end.
#![allow(
    clippy::disallowed_methods,
    reason = "pace and wall time are for people; neither enters the run"
)]

use super::args::{RunArgs, Speed};
use super::company::Company;
use super::progress::Progress;
use output::files::{ReportError, begin_folder};
use output::live::{Live, LiveController, LiveMeta, LiveOptions, Plane, run_id};
use output::record::Recorder;
use output::report::write_all;
use output::results::{
    BeliefTrack, Echoes, MassBalance, ObstacleOutline, Pictures, ProbeTables, RobotInfo, RunEnd,
    RunInfo, RunReport, SourceTruth, SummaryBuilder, Totals, TrackTable,
};
use rheotaxis::control::{Consultation, Heard};
use rheotaxis::frame::{Frame, PictureFrame, PingFrame, PlumeFrame};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Ended, Trial, Watch};
use robots::sense::FluorometerSpec;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use world::files::Folder;

use super::gantry_info::gantries;
use super::run::RunError;
use super::say;

/// All that follows one run.
pub(super) struct Onlooker {
    out: Folder,
    text: String,
    builder: SummaryBuilder,
    track: TrackTable,
    probes: ProbeTables,
    beliefs: BeliefTrack,
    pictures: Pictures,
    echoes: Echoes,
    recorder: Option<Recorder>,
    live: Option<Live>,
    progress: Progress,
    plane: Arc<Plane>,
    /// It ends after so many steps.
    last_step: Option<u64>,
    /// What came of the last question of each robot.
    heard: BTreeMap<String, &'static str>,
    stop: &'static AtomicBool,
    failure: Option<ReportError>,
    last_plume: Option<PlumeFrame>,
    begun: Instant,
    mission_begun: Instant,
    spin_up_s: f64,
    spin_up_kept: bool,
    permeable: Vec<String>,
    interfaces: Vec<f64>,
}

impl Onlooker {
    /// Opens folder, files and port, so that an error in them comes before the run starts.
    pub(super) fn new(
        loaded: &Loaded,
        args: &RunArgs,
        out: &Path,
        company: &mut Company,
        stop: &'static AtomicBool,
    ) -> Result<Self, RunError> {
        let scenario = &loaded.scenario;
        let run = RunInfo {
            scenario_name: loaded.name.clone(),
            title: scenario.title.clone(),
            success: scenario.success.words(),
            scenario_text: loaded.text.clone(),
            seed: args.key.seed(args.seed),
            version: env!("CARGO_PKG_VERSION").to_string(),
        };
        let gantries = gantries(loaded)?;
        let progress = Progress::new(loaded, args, &company.bars);
        let times = match args.speed {
            Speed::Max => None,
            Speed::Times(times) => Some(times),
        };
        let plane = Arc::new(Plane::new(args.control.allow_control, times));
        let live = live(args, &run, &progress, company, &plane)?;
        // The folder comes last: a run that cannot start must not remove the files of an earlier run.
        let out = begin_folder(out, "run")?;
        if let Some(removed) = say::removed(out.dir(), out.removed()) {
            progress.say(&removed);
        }
        let robots = scenario.robots.iter().map(|spec| {
            let dye = spec.sensors.get::<FluorometerSpec>();
            RobotInfo {
                id: spec.id.as_str().to_string(),
                full_scale_ug_l: dye.map(|f| f.full_scale_ug_l.get()),
                threshold: dye.map(|f| f.threshold.get()),
                regions: spec.strategy.has_regions(),
                layered: spec.strategy.has_layers(),
            }
        });
        let path = out.file("track.csv").map_err(ReportError::from)?;
        let track = TrackTable::create(&path, robots.collect())?;
        let probes = ProbeTables::create(&out, gantries)?;
        let recorder = (!args.no_record)
            .then(|| recording(&out, &run))
            .transpose()?;
        let recorder = recorder.map(|r| r.with_map_period(scenario.record.map_period_s.get()));
        let now = Instant::now();
        Ok(Self {
            text: loaded.text.clone(),
            builder: SummaryBuilder::new(&run),
            track,
            probes,
            beliefs: BeliefTrack::default(),
            pictures: Pictures::new(&out, scenario.record.pictures),
            out,
            echoes: Echoes::default(),
            recorder,
            live,
            progress,
            plane,
            last_step: None,
            heard: BTreeMap::new(),
            stop,
            failure: None,
            last_plume: None,
            begun: now,
            mission_begun: now,
            spin_up_s: scenario.time.spin_up_s.get(),
            spin_up_kept: false,
            permeable: scenario.permeable.clone(),
            interfaces: (scenario.water.currents.iter())
                .flat_map(|c| c.interfaces_m())
                .map(|depth_m| -depth_m)
                .collect(),
        })
    }

    /// Ends the run after so many steps, as another has ended.
    pub(super) fn end_after(&mut self, steps: u64) {
        self.last_step = Some(steps);
    }

    /// Whoever controls a robot from another process; `None` without live state.
    pub(super) fn controller(
        &self,
        robot: &str,
        deadline_s: f64,
        args: &RunArgs,
    ) -> Result<Option<LiveController>, RunError> {
        let Some(live) = &self.live else {
            return Ok(None);
        };
        let stop = self.stop;
        let times = [deadline_s, args.control.control_wait].map(Duration::from_secs_f64);
        let going = Arc::new(move || !stop.load(Ordering::Relaxed));
        let controller = live.controller(robot, times, going)?;
        let most_s = args.control.control_wait;
        let key = controller.key();
        self.progress.say(&format!(
            "{robot} asks at {key}; it waits up to {most_s} s for a controller"
        ));
        Ok(Some(controller))
    }

    fn going(&self) -> bool {
        self.failure.is_none() && !self.stop.load(Ordering::Relaxed)
    }

    /// Keeps the first write error. The run then ends and reports what it has.
    fn note(&mut self, result: Result<(), ReportError>) {
        if let Err(error) = result {
            self.failure.get_or_insert(error);
        }
    }

    /// Writes the results of the run and prints where they are. Its live state stays with those of the other lanes.
    pub(super) fn finish(
        mut self,
        trial: &Trial,
        ended: &Ended,
        company: &mut Company,
    ) -> Result<RunOutcome, ReportError> {
        let mission_wall = self.mission_begun.elapsed();
        let spin_up_wall = self.mission_begun - self.begun;
        if let Some(live) = &self.live {
            self.plane.ended();
            live.end(&ended.digest);
        }
        if let Some(recorder) = self.recorder.take() {
            let closed = recorder.finish(&ended.digest, ended.steps).map(drop);
            self.note(closed);
        }
        let ocean = trial.simulation.ocean();
        let plume = ocean.plume();
        let sources = SourceTruth::of(trial, ended);
        let outcome = match self.failure {
            Some(_) => RunOutcome::Failed,
            None => ended.outcome,
        };
        self.builder.added(trial);
        let summary = self.builder.finish(
            &RunEnd {
                outcome,
                error: self.failure.as_ref().map(ToString::to_string),
                digest: ended.digest.clone(),
                score: trial.score().clone(),
                totals: Totals {
                    mission_s: ended.t_s,
                    spin_up_s: self.spin_up_s,
                    mission_wall_s: mission_wall.as_secs_f64(),
                    spin_up_wall_s: spin_up_wall.as_secs_f64(),
                    spin_up_kept: self.spin_up_kept,
                    steps: ended.steps,
                    filaments: plume.len(),
                    mass: (!sources.is_empty()).then(|| {
                        MassBalance::new(
                            plume.mass_released_kg(),
                            plume.mass_in_kg(),
                            plume.mass_left_kg(),
                        )
                    }),
                },
            },
            &sources,
        );
        let track = self.track.finish();
        let gantries = self.probes.finish();
        let obstacles: Vec<ObstacleOutline> = (ocean.obstacles.0.iter())
            .map(|o| ObstacleOutline {
                id: o.id.clone(),
                corners: o.outline(),
                z: {
                    let (low, high) = o.bounds();
                    [low.z, high.z]
                },
                permeable: self.permeable.contains(&o.id),
            })
            .collect();
        let written = write_all(
            &self.out,
            &RunReport {
                pictures: self.pictures.shown(),
                echoes: &self.echoes,
                summary: &summary,
                track: &track,
                gantries: &gantries,
                beliefs: &self.beliefs,
                plume: self.last_plume.as_ref(),
                dye: (!sources.is_empty()).then_some(plume),
                area: &ocean.area,
                terrain: &ocean.terrain,
                sources: &sources,
                interfaces: &self.interfaces,
                obstacles: &obstacles,
                solids: Some(&ocean.obstacles),
                scenario_text: &self.text,
            },
        );
        self.progress.finish(&summary, self.out.dir());
        if let Some(live) = self.live.take() {
            company.keep(live);
        }
        let failures = self.failure.into_iter().chain(written.err()).collect();
        ReportError::of(failures).map_or(Ok(outcome), Err)
    }
}

/// Opens the recording. Its temporary file is listed too, so that the next run removes it if this one is killed.
fn recording(out: &Folder, run: &RunInfo) -> Result<Recorder, ReportError> {
    let recorder = Recorder::create(&out.file("run.mcap")?, run)?;
    if let Some(name) = recorder.temporary().file_name() {
        out.file(&name.to_string_lossy())?;
    }
    Ok(recorder)
}

/// Starts publishing over zenoh.
fn live(
    args: &RunArgs,
    run: &RunInfo,
    progress: &Progress,
    company: &mut Company,
    plane: &Arc<Plane>,
) -> Result<Option<Live>, RunError> {
    if args.no_zenoh {
        return Ok(None);
    }
    let mut options = LiveOptions::new(run_id(&run.scenario_name, args.seed));
    options.listen = args.zenoh_listen.clone();
    options.config_file = args.zenoh_config.clone();
    options.plane = Arc::clone(plane);
    let meta = LiveMeta {
        scenario_text: run.scenario_text.clone(),
        scenario_name: run.scenario_name.clone(),
        seed: run.seed.number(),
        version: run.version.clone(),
    };
    let live = company.live(&options, meta)?;
    progress.say(&format!(
        "live on {} under rheotaxis/{}",
        live.endpoint(),
        options.run_id
    ));
    if let Some(notice) = live.notice() {
        progress.say(notice);
    }
    Ok(Some(live))
}

impl Watch for Onlooker {
    fn spun_up(&mut self, share: f64) -> bool {
        self.progress.spun_up(share);
        self.mission_begun = Instant::now();
        self.going()
    }

    fn developed(&mut self, kept: bool) {
        self.mission_begun = Instant::now();
        self.spin_up_kept = kept;
        if kept {
            self.progress.say("spin-up taken from the cache");
        }
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
        if let Some(live) = &self.live {
            live.publish(frame);
        }
        self.progress.frame(frame);
    }

    fn plume(&mut self, plume: &PlumeFrame) {
        if let Some(recorder) = &mut self.recorder {
            let recorded = recorder.plume(plume);
            self.note(recorded);
        }
        if let Some(live) = &self.live {
            live.plume(plume);
        }
        self.beliefs.plume(plume);
        self.last_plume = Some(plume.clone());
    }

    fn consulted(&mut self, told: &Consultation) {
        if let Some(recorder) = &mut self.recorder {
            let recorded = recorder.consulted(told);
            self.note(recorded);
        }
        let name = told.heard.name();
        if self.heard.insert(told.robot.clone(), name) != Some(name) {
            let why = match &told.heard {
                Heard::Nonsense(why) => format!(": {why}"),
                _ => String::new(),
            };
            let line = format!("  {} asked at {:.1} s: {name}{why}", told.robot, told.t_s);
            self.progress.say(&line);
        }
    }

    fn picture(&mut self, picture: &PictureFrame) {
        if let Some(live) = &self.live {
            live.picture(picture);
        }
        let kept = self.pictures.push(picture);
        if let (Ok(Some(png)), Some(recorder)) = (&kept, &mut self.recorder) {
            let recorded = recorder.picture(picture, png);
            self.note(recorded);
        }
        self.note(kept.map(drop));
    }

    fn ping(&mut self, ping: &PingFrame) {
        if let Some(live) = &self.live {
            live.ping(ping);
        }
        if let Some(line) = self.echoes.push(ping)
            && let Some(recorder) = &mut self.recorder
        {
            let recorded = recorder.echo(&ping.robot, line);
            self.note(recorded);
        }
    }

    fn go_on(&mut self, t_s: f64) -> bool {
        let last = self.last_step.as_mut().is_some_and(|left| {
            *left = left.saturating_sub(1);
            *left == 0
        });
        // Ctrl-C must end a wait of any length.
        !last && self.plane.hold(t_s, || self.going())
    }
}
