//! `rheotaxis run`: runs scenarios, shows their progress, and writes a folder of results for each.

use super::cache;
use crate::args::RunArgs;
use crate::exit::Exit;
use crate::failure::{Failure, of_run, refused};
use crate::lane_observers::LaneObservers;
use crate::run_observer::RunObserver;
use crate::{say, stop};
use output::files::{ReportError, could_begin_run};
use output::report::is_result;
use rheotaxis::cache::SpinUps;
use rheotaxis::lanes::{Lanes, group_by_ocean};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::{Loaded, cost};
use rheotaxis::trial::{consulted, controlled};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use world::cost::memory;
use world::registry::Registry;

/// Runs every file, those with the same ocean in lanes. An error is reported, and the other files are run all the same.
/// But none is run if two of them have one folder for their results, or if a folder is in use or holds files of others:
/// hours may pass before the last of the folders is opened.
pub(crate) fn run(registry: &Registry, args: &RunArgs) -> Result<Exit, Failure> {
    if args.ros2.ros2 && args.files.len() > 1 {
        return Err("--ros2 shows one run, because topics of ROS 2 do not name a run: give one scenario".into());
    }
    say::hush_lost_states();
    let stop = stop::listen();
    let kept = cache::opened(&args.cache);
    let mut exit = Exit::Success;
    let mut ready: Vec<(Loaded, PathBuf)> = Vec::new();
    for file in &args.files {
        match prepared(registry, file, args) {
            Ok(one) => ready.push(one),
            Err(error) => exit = exit.worse(refused(&error)),
        }
    }
    for (n, (_, folder)) in ready.iter().enumerate() {
        if ready[..n].iter().any(|(_, taken)| taken == folder) {
            return Err(
                format!("{}: another scenario of this command writes its results there", folder.display()).into()
            );
        }
    }
    let mut writable = Vec::new();
    for (loaded, folder) in ready {
        let own = |name: &str| is_result(&loaded.scenario, name);
        match could_begin_run(&folder, (!args.overwrite).then_some(&own)) {
            Ok(()) => writable.push((loaded, folder)),
            Err(ReportError::Write(error)) if error.is_foreign() || error.is_busy() => {
                return Err(of_run(ReportError::Write(error).into()));
            }
            Err(error) => exit = exit.worse(refused(&error.into())),
        }
    }
    let ready = writable;
    let seed = args.key.seed(args.seed);
    let runs: Vec<_> = ready.iter().map(|(loaded, _)| (loaded, seed)).collect();
    for group in group_by_ocean(&runs, cost::limit(registry)) {
        let group: Vec<_> = group.into_iter().map(|n| &ready[n]).collect();
        exit = exit.worse(together(&group, args, kept.as_ref(), stop));
        if stop.load(Ordering::Relaxed) {
            break;
        }
    }
    cache::tell_fault(kept.as_ref());
    Ok(exit)
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
fn prepared(registry: &Registry, file: &Path, args: &RunArgs) -> Result<(Loaded, PathBuf), Failure> {
    let loaded = say::checked(registry, file)?;
    let asking = controlled(&loaded.scenario);
    if !asking.is_empty() && !args.control.allow_control {
        return Err(format!(
            "{} of {} asks a searcher outside the program: start the run with --allow-control, or give it another \
             strategy",
            asking.join(", "),
            loaded.name
        )
        .into());
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
        let onlooker = || RunObserver::new(loaded, args, Some(folder), &mut company, stop);
        let added = lanes.add(loaded, args.key.seed(args.seed), onlooker);
        let added = added.and_then(|()| controllers(&mut lanes, loaded, args));
        if let Err(error) = added {
            exit = exit.worse(refused(&of_run(error)));
        }
    }
    if let Some(kept) = kept {
        lanes.spin_up_with(kept);
    }
    lanes.run(|onlooker, run| {
        let ended = match run {
            Ok(trial) => onlooker.finish(trial, &trial.ended(), &mut company).map_err(Failure::from),
            Err(error) => Err(error.into()),
        };
        exit = exit.worse(ended.map_or_else(|error| refused(&of_run(error)), code));
    });
    let linger = Duration::try_from_secs_f64(args.zenoh_linger).unwrap_or(Duration::ZERO);
    company.part(linger, stop);
    exit
}

/// Connects the robots of the run that was added last with their controllers.
fn controllers(lanes: &mut Lanes<RunObserver>, loaded: &Loaded, args: &RunArgs) -> Result<(), Failure> {
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
