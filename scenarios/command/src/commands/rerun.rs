//! `rheotaxis rerun`: makes a recorded run again and compares the digests.

use super::cache;
use crate::args::RunArgs;
use crate::args::control::RerunMcapArgs;
use crate::exit::Exit;
use crate::failure::{Failure, of_run};
use crate::lane_observers::LaneObservers;
use crate::run_observer::RunObserver;
use crate::{say, stop};
use output::mcap::{RecordedRun, read_recording};
use rheotaxis::control::Replay;
use rheotaxis::lanes::Lanes;
use rheotaxis::scenario::{Loaded, ScenarioError, load_text_in, load_with, template};
use rheotaxis::trial::RunEnd;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use world::registry::Registry;

/// Runs it.
pub(crate) fn rerun(registry: &Registry, args: &RerunMcapArgs) -> Result<Exit, Failure> {
    say::hush_lost_states();
    let stop = stop::listen();
    let path = match args.recording.is_dir() {
        true => args.recording.join("run.mcap"),
        false => args.recording.clone(),
    };
    let recorded = read_recording(&path)?;
    let loaded = scenario(registry, &recorded, args.base.as_deref())?;
    let ended = made(args, &recorded, &loaded, stop).map_err(of_run)?;
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
) -> Result<Option<RunEnd>, Failure> {
    let run = RunArgs {
        cache: args.cache.clone(),
        quiet: args.quiet,
        overwrite: args.overwrite,
        ..RunArgs::alone(recorded.seed, &args.key, args.out.as_deref())
    };
    let mut company = LaneObservers::default();
    let mut lanes = Lanes::default().with_threads(0);
    lanes.add(loaded, args.key.seed(recorded.seed), || {
        RunObserver::new(loaded, &run, args.out.as_deref(), &mut company, stop)
    })?;
    if let Some((trial, onlooker)) = lanes.newest() {
        let told = Replay::new(recorded.exchanges.clone());
        for robot in trial.controlled() {
            trial.control(&robot, told.clone())?;
        }
        if let Some((_, steps)) = recorded.result {
            onlooker.end_after(steps);
        }
    }
    if let Some(kept) = cache::opened(&args.cache) {
        lanes.spin_up_with(&kept);
    }
    let mut result = Ok(None);
    lanes.run(|onlooker, trial| {
        result = trial.map_err(Failure::from).and_then(|trial| {
            let ended = trial.ended();
            onlooker.finish(trial, &ended, &mut company)?;
            Ok(Some(ended))
        });
    });
    result
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
