//! Everything that follows a run: recording, tables, live state, progress, pace, and the report at its end.
#![allow(
    clippy::disallowed_methods,
    reason = "pace and wall time are for people; neither enters the run"
)]

use super::args::{RunArgs, Speed};
use super::company::Company;
use super::progress::Progress;
use output::files::{ReportError, begin_folder};
use output::live::{Live, LiveMeta, LiveOptions, Ros2, Scene, run_id};
use output::record::Recorder;
use output::report::write_all;
use output::results::{
    BeliefTrack, Echoes, GantryInfo, MassBalance, ObstacleOutline, Pictures, ProbeTables,
    RobotInfo, RunEnd, RunInfo, RunReport, SourceTruth, SummaryBuilder, Totals, TrackTable,
};
use rheotaxis::error::AssembleError;
use rheotaxis::frame::{Frame, PictureFrame, PingFrame, PlumeFrame};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::{Beside, GantryBlock, Loaded};
use rheotaxis::trial::{Ended, Trial, Watch};
use robots::sense::FluorometerSpec;
use robots::vehicles::Gantry;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use world::files::Folder;
use world::ranges::Finite;

use super::run::RunError;
use super::say;

/// Longest wait before Ctrl-C is looked for again, while a run waits for its pace.
const NAP: Duration = Duration::from_millis(50);

/// All that follows one run.
pub(super) struct Onlooker<'a> {
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
    speed: Speed,
    stop: &'a AtomicBool,
    failure: Option<ReportError>,
    last_plume: Option<PlumeFrame>,
    begun: Instant,
    mission_begun: Instant,
    spin_up_s: f64,
    spin_up_kept: bool,
    permeable: Vec<String>,
    interfaces: Vec<f64>,
}

impl<'a> Onlooker<'a> {
    /// Opens folder, files and port, so that an error in them comes before the run starts.
    pub(super) fn new(
        loaded: &Loaded,
        args: &RunArgs,
        out: &Path,
        company: &mut Company,
        stop: &'a AtomicBool,
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
        let live = live(args, loaded, &run, &progress, company)?;
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
            speed: args.speed,
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
            live.end(&ended.digest);
        }
        if let Some(recorder) = self.recorder.take() {
            let closed = recorder.finish(&ended.digest).map(drop);
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
    loaded: &Loaded,
    run: &RunInfo,
    progress: &Progress,
    company: &mut Company,
) -> Result<Option<Live>, RunError> {
    if args.no_zenoh {
        return Ok(None);
    }
    let mut options = LiveOptions::new(run_id(&run.scenario_name, args.seed));
    options.listen = args.zenoh_listen.clone();
    options.config_file = args.zenoh_config.clone();
    if args.ros2.ros2 {
        options.ros2 = Some(Ros2 {
            domain: args.ros2.domain,
            scene: Arc::new(Scene::of(loaded)?),
        });
    }
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

/// What tables and figures need to know about the scenario's gantries.
fn gantries(loaded: &Loaded) -> Result<Vec<GantryInfo>, RunError> {
    let scenario = &loaded.scenario;
    // Of several effluents, the strongest.
    let effluent = (scenario.sources.iter())
        .filter_map(|s| Some(1e-3 * s.rate_g_s.get() / s.release.nozzle.as_ref()?.volume_m3_s()))
        .max_by(f64::total_cmp);
    let info = |block: &GantryBlock| {
        let id = block.id.as_str().to_string();
        let gantry = Gantry::load(&block.gantry, &Beside(&loaded.base_dir)).map_err(|source| {
            AssembleError::Robot {
                id: id.clone(),
                source,
            }
        })?;
        let range_v = block.probes.range_v.map(Finite::get);
        let layout = gantry.layout(block.probes.rate_hz.get(), range_v);
        Ok(GantryInfo {
            id,
            probes: layout.probes.into_iter().map(|p| p.name).collect(),
            range_v,
            full_scale_kg_m3: block.probes.full_scale_kg_m3.get(),
            effluent_kg_m3: effluent,
        })
    };
    scenario.gantries.iter().map(info).collect()
}

impl Watch for Onlooker<'_> {
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
        if let Speed::Times(speed) = self.speed {
            // Ctrl-C must end a wait of any length.
            let due = Duration::try_from_secs_f64(t_s / speed).unwrap_or(Duration::MAX);
            while self.going()
                && let Some(early) = due.checked_sub(self.mission_begun.elapsed())
            {
                std::thread::sleep(early.min(NAP));
            }
        }
        self.going()
    }
}
