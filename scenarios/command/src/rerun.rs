//! `rheotaxis rerun`: makes a recorded run again and compares the digests.

use super::args::RunArgs;
use super::args_control::RerunMcapArgs;
use super::exit::Exit;
use super::lane_observers::LaneObservers;
use super::progress::Progress;
use super::run::{RunError, refused};
use super::run_observer::RunObserver;
use super::{cache, say, stop};
use output::mcap::{ReadError, RecordedRun, read_recording};
use rheotaxis::control::Replay;
use rheotaxis::lanes::{LaneError, Lanes};
use rheotaxis::scenario::{Loaded, ScenarioError, load_text_in, load_with, template};
use rheotaxis::trial::{Event, Observer, RunEnd, Trial};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use world::registry::Registry;

/// Why a recording cannot be run again.
#[derive(Debug, thiserror::Error)]
enum RerunError {
    #[error(transparent)]
    Read(#[from] ReadError),
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    #[error(transparent)]
    Run(#[from] RunError),
}

/// Runs it.
pub(super) fn rerun(registry: &Registry, args: &RerunMcapArgs) -> Exit {
    match again(registry, args) {
        Ok(exit) => exit,
        Err(RerunError::Scenario(error)) => refused(error.into()),
        Err(RerunError::Run(error)) => refused(error),
        Err(error) => {
            say::error(error, None);
            Exit::Error
        }
    }
}

fn again(registry: &Registry, args: &RerunMcapArgs) -> Result<Exit, RerunError> {
    say::hush_lost_states();
    let stop = stop::listen();
    let path = match args.recording.is_dir() {
        true => args.recording.join("run.mcap"),
        false => args.recording.clone(),
    };
    let recorded = read_recording(&path)?;
    let loaded = scenario(registry, &recorded, args.base.as_deref())?;
    let ended = made(args, &recorded, &loaded, stop)?;
    let Some(ended) = ended.filter(|_| !stop.load(Ordering::Relaxed)) else {
        return Ok(Exit::Interrupted);
    };
    Ok(compared(&recorded, &ended))
}

/// The scenario of a recording: that of the program if it is one of its own, for the files that belong to it.
fn scenario(registry: &Registry, recorded: &RecordedRun, base: Option<&Path>) -> Result<Loaded, ScenarioError> {
    let (name, text) = (&recorded.scenario_name, &recorded.scenario_text);
    if base.is_none() && template(name).is_some_and(|t| t.text == text) {
        return load_with(registry, Path::new(name));
    }
    load_text_in(registry, name, text, base.unwrap_or(Path::new("")))
}

/// Makes the run again; `None` if it did not come to its end.
fn made(
    args: &RerunMcapArgs,
    recorded: &RecordedRun,
    loaded: &Loaded,
    stop: &'static AtomicBool,
) -> Result<Option<RunEnd>, RunError> {
    let run = RunArgs {
        cache: args.cache.clone(),
        quiet: args.quiet,
        overwrite: args.overwrite,
        ..RunArgs::alone(recorded.seed, &args.key, args.out.as_deref())
    };
    let seed = args.key.seed(recorded.seed);
    let steps = recorded.result.as_ref().map(|(_, steps)| *steps);
    let mut company = LaneObservers::default();
    let mut result = Ok(None);
    match &args.out {
        Some(out) => {
            let mut lanes = Lanes::default().with_threads(0);
            lanes.add(loaded, seed, || RunObserver::new(loaded, &run, out, &mut company, stop))?;
            replay(&mut lanes, recorded)?;
            if let (Some((_, onlooker)), Some(steps)) = (lanes.newest(), steps) {
                onlooker.end_after(steps);
            }
            spun_up(&mut lanes, args);
            lanes.run(|onlooker, trial| result = finished(onlooker, trial, &mut company));
        }
        None => {
            let watch = || {
                Ok::<_, RunError>(RerunObserver {
                    progress: Progress::new(loaded, &run, &company.bars),
                    left: steps,
                    over: false,
                    stop,
                })
            };
            let mut lanes = Lanes::default().with_threads(0);
            lanes.add(loaded, seed, watch)?;
            replay(&mut lanes, recorded)?;
            spun_up(&mut lanes, args);
            lanes.run(|_, trial| result = trial.map(|t| Some(t.ended())).map_err(RunError::from));
        }
    }
    result
}

fn finished(
    onlooker: RunObserver,
    trial: Result<&Trial, LaneError>,
    company: &mut LaneObservers,
) -> Result<Option<RunEnd>, RunError> {
    let trial = trial?;
    let ended = trial.ended();
    onlooker.finish(trial, &ended, company)?;
    Ok(Some(ended))
}

fn replay<O: Observer>(lanes: &mut Lanes<O>, recorded: &RecordedRun) -> Result<(), RunError> {
    let told = Replay::new(recorded.exchanges.clone());
    if let Some((trial, _)) = lanes.newest() {
        for robot in trial.controlled() {
            trial.control(&robot, told.clone())?;
        }
    }
    Ok(())
}

fn spun_up<O: Observer>(lanes: &mut Lanes<O>, args: &RerunMcapArgs) {
    if let Some(kept) = cache::opened(&args.cache) {
        lanes.spin_up_with(&kept);
    }
}

fn compared(recorded: &RecordedRun, ended: &RunEnd) -> Exit {
    let version = env!("CARGO_PKG_VERSION");
    let other = match recorded.version.as_str() {
        same if same == version => String::new(),
        other => format!(" (recorded with version {other}, this is {version})"),
    };
    let asked = recorded.exchanges.len();
    match &recorded.result {
        Some((digest, _)) if *digest == ended.digest => {
            say::line(format_args!("the same run: digest {digest}, {asked} answers from outside{other}"));
            Exit::Success
        }
        Some((digest, _)) => {
            say::line(format_args!("another run: digest {}, recorded {digest}{other}", ended.digest));
            Exit::NotFound
        }
        None => {
            say::line(format_args!(
                "the recording broke off, so there is no digest to compare with: {} after {:.0} s{other}",
                ended.digest, ended.t_s
            ));
            Exit::NotFound
        }
    }
}

/// Follows a run of which nothing is written.
struct RerunObserver {
    progress: Progress,
    /// Steps left.
    left: Option<u64>,
    over: bool,
    stop: &'static AtomicBool,
}

impl Observer for RerunObserver {
    fn see(&mut self, event: &Event) {
        self.progress.see(event);
        if let (Event::Tick(_), Some(left)) = (event, &mut self.left) {
            *left = left.saturating_sub(1);
            self.over = *left == 0;
        }
    }

    fn goes_on(&mut self) -> bool {
        !self.over && !self.stop.load(Ordering::Relaxed)
    }
}
