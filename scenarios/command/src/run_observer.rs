//! Everything that follows a run: its results, live state, progress, pace.
#![allow(clippy::disallowed_methods, reason = "pace and wall time are for people; neither enters the run")]

use super::args::RunArgs;
use super::failure::Failure;
use super::lane_observers::LaneObservers;
use super::progress::Progress;
use super::say;
use crate::args::values::Speed;
use output::files::{ReportError, begin_run};
use output::follow::Follower;
use output::live::{Live, LiveController, LiveMeta, LiveOptions, Plane, Ros2, run_id, topics};
use output::report::is_result;
use rheotaxis::control::{Exchange, Response};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, RunEnd, Trial, Wants, controlled};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;
use std::time::Duration;
use world::files::Folder;
use world::registry::Registry;

/// All that follows one run.
pub(super) struct RunObserver {
    results: Follower,
    live: Option<Live>,
    progress: Progress,
    plane: Arc<Plane>,
    /// Steps after which it ends, if it is to end like another run.
    left: Option<u64>,
    /// What came of the last question of each robot.
    heard: BTreeMap<String, &'static str>,
    stop: &'static AtomicBool,
    /// Whether the last tick was not to be the last.
    held: bool,
}

impl RunObserver {
    /// Opens folder, files and port, so that an error in them comes before the run starts. Without a folder, nothing is
    /// written.
    pub(super) fn new(
        loaded: &Loaded,
        args: &RunArgs,
        out: Option<&Path>,
        company: &mut LaneObservers,
        stop: &'static AtomicBool,
    ) -> Result<Self, Failure> {
        let mut results = Follower::new(loaded, args.key.seed(args.seed))?;
        let progress = Progress::new(loaded, args, &company.bars);
        let times = match args.speed {
            Speed::Max => None,
            Speed::Times(times) => Some(times),
        };
        let plane = Arc::new(Plane::new(args.control.allow_control, times));
        let live = live(args, &loaded.registry, &mut results, &progress, company, &plane)?;
        // The folder comes last: a run that cannot start must not remove the files of an earlier run.
        if let Some(out) = out {
            let own = |name: &str| is_result(&loaded.scenario, name);
            let out = begin_run(out, (!args.overwrite).then_some(&own))?;
            if let Some(removed) = say::removed(out.dir(), out.removed()) {
                progress.say(&removed);
            }
            results.write_into(&out, !args.no_record)?;
        }
        // Where somebody keeps pace with the run, each frame is written at once.
        let at_once = times.is_some() || !controlled(&loaded.scenario).is_empty();
        if cores(args) > 1 && !at_once {
            results = results.beside();
        }
        Ok(Self { results, live, progress, plane, left: None, heard: BTreeMap::new(), stop, held: true })
    }

    /// Ends the run after so many steps, as another has ended.
    pub(super) fn end_after(&mut self, steps: u64) {
        self.left = Some(steps);
    }

    /// Whoever controls a robot from another process; `None` without live state.
    pub(super) fn controller(
        &self,
        robot: &str,
        deadline_s: f64,
        args: &RunArgs,
    ) -> Result<Option<LiveController>, Failure> {
        let Some(live) = &self.live else {
            return Ok(None);
        };
        let stop = self.stop;
        let times = [deadline_s, args.control.control_wait].map(Duration::from_secs_f64);
        let going = Arc::new(move || !stop.load(Ordering::Relaxed));
        let controller = live.controller(robot, times, going)?;
        let most_s = args.control.control_wait;
        let key = controller.key();
        self.progress.say(&format!("{robot} asks at {key}; it waits up to {most_s} s for a controller"));
        Ok(Some(controller))
    }

    /// Says what came of a question, unless it is as the time before.
    fn tell(&mut self, exchange: &Exchange) {
        let name = exchange.response.name();
        if self.heard.insert(exchange.robot.clone(), name) != Some(name) {
            let why = match &exchange.response {
                Response::Nonsense(why) => format!(": {why}"),
                _ => String::new(),
            };
            self.progress.say(&format!("  {} asked at {:.1} s: {name}{why}", exchange.robot, exchange.t_s));
        }
    }

    fn going(&self) -> bool {
        self.results.well() && !self.stop.load(Ordering::Relaxed)
    }

    /// Writes the results of the run and prints where they are. Its live state stays with those of the other lanes.
    pub(super) fn finish(
        mut self,
        trial: &Trial,
        ended: &RunEnd,
        company: &mut LaneObservers,
    ) -> Result<RunOutcome, ReportError> {
        if let Some(live) = &self.live {
            self.plane.ended();
            live.end(&ended.digest);
        }
        let mut gathered = self.results.finish(trial, ended);
        let written = gathered.write(trial.simulation.ocean());
        self.progress.finish(&gathered.summary, gathered.out().map(Folder::dir));
        if let Some(live) = self.live.take() {
            company.keep(live);
        }
        written.map(|()| gathered.summary.outcome)
    }
}

/// How many cores the run may use.
fn cores(args: &RunArgs) -> usize {
    let here = available_parallelism().map_or(1, usize::from);
    match args.threads {
        0 => here,
        asked => asked.min(here),
    }
}

/// Starts publishing over zenoh.
fn live(
    args: &RunArgs,
    registry: &Registry,
    results: &mut Follower,
    progress: &Progress,
    company: &mut LaneObservers,
    plane: &Arc<Plane>,
) -> Result<Option<Live>, Failure> {
    if args.no_zenoh {
        return Ok(None);
    }
    let scene = results.scene()?;
    let run = results.run();
    let mut options = LiveOptions::new(run_id(&run.scenario_name, args.seed));
    options.listen = args.zenoh_listen.clone();
    options.config_file = args.zenoh_config.clone();
    options.plane = Arc::clone(plane);
    options.control_from_anywhere = args.control.control_from_anywhere;
    if args.ros2.ros2 {
        options.ros2 = Some(Ros2 { domain: args.ros2.domain, scene: Arc::clone(&scene) });
    }
    let meta = LiveMeta {
        scenario_text: run.scenario_text.clone(),
        scenario_name: run.scenario_name.clone(),
        seed: run.seed.number(),
        version: run.version.clone(),
        scene: Some(scene.document(run.seed.number())),
        topics: topics(registry),
    };
    let live = company.live(&options, meta)?;
    progress.say(&format!("live on {} under rheotaxis/{}", live.endpoint(), options.run_id));
    if let Some(notice) = live.notice() {
        progress.say(notice);
    }
    if let Some(warning) = live.warning() {
        progress.warn(warning);
    }
    Ok(Some(live))
}

impl Observer for RunObserver {
    fn see(&mut self, event: &Event) {
        self.results.see(event);
        if let Some(live) = &self.live {
            live.see(event);
        }
        self.progress.see(event);
        match event {
            Event::Exchange(exchange) => self.tell(exchange),
            Event::Tick(t_s) => {
                let last = self.left.as_mut().is_some_and(|left| {
                    *left = left.saturating_sub(1);
                    *left == 0
                });
                // Ctrl-C must end a wait of any length.
                self.held = !last && self.plane.hold(*t_s, || self.going());
            }
            _ => {}
        }
    }

    fn goes_on(&mut self) -> bool {
        self.held && self.going()
    }

    fn wants(&self) -> Wants {
        self.results.wants().or(Wants { plume: true, water: self.live.is_some() })
    }
}
