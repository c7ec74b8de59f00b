//! `rheotaxis run`: runs scenarios, shows their progress, and writes a folder of results for each.

use super::args::RunArgs;
use super::exit::Exit;
use super::lane_observers::LaneObservers;
use super::run_observer::RunObserver;
use super::{cache, say, stop};
use output::files::{ReportError, could_begin_run};
use output::live::LiveError;
use output::report::is_result;
use rheotaxis::cache::SpinUps;
use rheotaxis::error::AssembleError;
use rheotaxis::lanes::{LaneError, Lanes, group_by_ocean};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::{Loaded, ScenarioError, cost, load_with};
use rheotaxis::trial::{NotControlled, consulted, controlled};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use world::cost::memory;
use world::registry::Registry;

/// Why a run could not start or finish.
#[derive(Debug, thiserror::Error)]
pub(super) enum RunError {
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    #[error(transparent)]
    Assemble(#[from] AssembleError),
    #[error(transparent)]
    Lane(#[from] LaneError),
    #[error(transparent)]
    Live(#[from] LiveError),
    #[error(transparent)]
    NotControlled(#[from] NotControlled),
    #[error(transparent)]
    Report(#[from] ReportError),
    #[error(
        "{robots} of {scenario} asks a searcher outside the program: start the run with --allow-control, or give it \
         another strategy"
    )]
    NotAllowed { scenario: String, robots: String },
    #[error("{}: another scenario of this command writes its results there", .0.display())]
    Taken(PathBuf),
    #[error("--ros2 shows one run, because topics of ROS 2 do not name a run: give one scenario")]
    OneForRos2,
}

impl RunError {
    /// What would help.
    fn help(&self) -> Option<&'static str> {
        let Self::Report(ReportError::Write(error)) = self else {
            return None;
        };
        (error.is_foreign()).then_some("--overwrite replaces files that have the names of results")
    }
}

/// Runs every file, those with the same ocean in lanes. An error is reported, and the other files are run all the same.
/// But none is run if two of them have one folder for their results, or if a folder is in use or holds files of others:
/// hours may pass before the last of the folders is opened.
pub(super) fn run(registry: &Registry, args: &RunArgs) -> Exit {
    if args.ros2.ros2 && args.files.len() > 1 {
        return refused(RunError::OneForRos2);
    }
    say::hush_lost_states();
    let stop = stop::listen();
    let kept = cache::opened(&args.cache);
    let mut exit = Exit::Success;
    let mut ready: Vec<(Loaded, PathBuf)> = Vec::new();
    for file in &args.files {
        match prepared(registry, file, args) {
            Ok(one) => ready.push(one),
            Err(error) => exit = exit.worse(refused(error)),
        }
    }
    for (n, (_, folder)) in ready.iter().enumerate() {
        if ready[..n].iter().any(|(_, taken)| taken == folder) {
            return refused(RunError::Taken(folder.clone()));
        }
    }
    let mut writable = Vec::new();
    for (loaded, folder) in ready {
        let own = |name: &str| is_result(&loaded.scenario, name);
        match could_begin_run(&folder, (!args.overwrite).then_some(&own)) {
            Ok(()) => writable.push((loaded, folder)),
            Err(ReportError::Write(error)) if error.is_foreign() || error.is_busy() => {
                return refused(ReportError::Write(error).into());
            }
            Err(error) => exit = exit.worse(refused(error.into())),
        }
    }
    let ready = writable;
    let seed = args.key.seed(args.seed);
    let runs: Vec<_> = ready.iter().map(|(loaded, _)| (loaded, seed)).collect();
    for group in group_by_ocean(&runs, cost::limit()) {
        let group: Vec<_> = group.into_iter().map(|n| &ready[n]).collect();
        exit = exit.worse(together(&group, args, kept.as_ref(), stop));
        if stop.load(Ordering::Relaxed) {
            break;
        }
    }
    cache::tell_fault(kept.as_ref());
    exit
}

pub(super) fn refused(error: RunError) -> Exit {
    match error {
        RunError::Scenario(error) => say::scenario_error(&error),
        error => say::error(&error, error.help()),
    }
    Exit::Error
}

fn code(outcome: RunOutcome) -> Exit {
    match outcome {
        RunOutcome::Found | RunOutcome::Completed => Exit::Success,
        RunOutcome::NotFound | RunOutcome::Aborted | RunOutcome::TimeOut => Exit::NotFound,
        RunOutcome::Interrupted => Exit::Interrupted,
        RunOutcome::Failed => Exit::Error,
    }
}

/// The scenario of a file and the folder of its results.
fn prepared(registry: &Registry, file: &Path, args: &RunArgs) -> Result<(Loaded, PathBuf), RunError> {
    let loaded = load_with(registry, file)?;
    say::warnings(&loaded.check()?);
    let asking = controlled(&loaded.scenario);
    if !asking.is_empty() && !args.control.allow_control {
        return Err(RunError::NotAllowed { scenario: loaded.name.clone(), robots: asking.join(", ") });
    }
    let folder = folder(&loaded, args);
    Ok((loaded, folder))
}

/// Runs scenarios with the same ocean in lanes.
fn together(group: &[&(Loaded, PathBuf)], args: &RunArgs, kept: Option<&SpinUps>, stop: &'static AtomicBool) -> Exit {
    let mut exit = Exit::Success;
    let mut company = LaneObservers::default();
    let mut lanes = Lanes::default().with_threads(args.threads);
    for (loaded, folder) in group {
        if !args.quiet {
            let bytes = cost::cost(&loaded.scenario).bytes();
            say::note(format_args!("{}: takes about {} of memory", loaded.name, memory(bytes)));
        }
        let onlooker = || RunObserver::new(loaded, args, folder, &mut company, stop);
        let added = lanes.add(loaded, args.key.seed(args.seed), onlooker);
        let added = added.and_then(|()| controllers(&mut lanes, loaded, args));
        if let Err(error) = added {
            exit = exit.worse(refused(error));
        }
    }
    if let Some(kept) = kept {
        lanes.spin_up_with(kept);
    }
    lanes.run(|onlooker, run| {
        let ended = match run {
            Ok(trial) => {
                let finished = onlooker.finish(trial, &trial.ended(), &mut company);
                finished.map_err(RunError::from)
            }
            Err(error) => Err(error.into()),
        };
        exit = exit.worse(ended.map_or_else(refused, code));
    });
    let linger = Duration::try_from_secs_f64(args.zenoh_linger).unwrap_or(Duration::ZERO);
    company.part(linger, stop);
    exit
}

/// Connects the robots of the run that was added last with their controllers.
fn controllers(lanes: &mut Lanes<RunObserver>, loaded: &Loaded, args: &RunArgs) -> Result<(), RunError> {
    let Some((trial, onlooker)) = lanes.newest() else {
        return Ok(());
    };
    for (robot, consulted) in consulted(&loaded.scenario) {
        if let Some(controller) = onlooker.controller(&robot, consulted.deadline_s, args)? {
            trial.control(&robot, controller)?;
        }
    }
    Ok(())
}

/// The folder of the results: `--out`, or `runs/<scenario>-<seed>`.
fn folder(loaded: &Loaded, args: &RunArgs) -> PathBuf {
    match &args.out {
        Some(out) if args.files.len() == 1 => out.clone(),
        Some(out) => out.join(&loaded.name),
        None => Path::new("runs").join(format!("{}-{}", loaded.name, args.seed)),
    }
}
