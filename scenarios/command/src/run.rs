//! `rheotaxis run`: runs scenarios, shows their progress, and writes a folder of results for each.

use super::args::RunArgs;
use super::exit::Exit;
use super::onlooker::Onlooker;
use super::{cache, say, stop};
use output::files::ReportError;
use output::live::LiveError;
use rheotaxis::cache::SpinUps;
use rheotaxis::error::AssembleError;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::{Loaded, ScenarioError, cost, load};
use rheotaxis::trial::Trial;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Why a run could not start or finish.
#[derive(Debug, thiserror::Error)]
pub(super) enum RunError {
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    #[error(transparent)]
    Assemble(#[from] AssembleError),
    #[error(transparent)]
    Live(#[from] LiveError),
    #[error(transparent)]
    Report(#[from] ReportError),
    #[error("{}: another scenario of this command has written its results there", .0.display())]
    Taken(PathBuf),
}

/// Runs every file. An error is reported, and the next file is run all the same.
pub(super) fn run(args: &RunArgs) -> Exit {
    let stop = stop::listen();
    let kept = cache::opened(&args.cache);
    let mut exit = Exit::Success;
    let mut taken = Vec::new();
    for file in &args.files {
        exit = exit.worse(match one(file, args, &mut taken, kept.as_ref(), stop) {
            Ok(outcome) => code(outcome),
            Err(RunError::Scenario(error)) => {
                say::scenario_error(error);
                Exit::Error
            }
            Err(error) => {
                say::error(error, None);
                Exit::Error
            }
        });
        if stop.load(Ordering::Relaxed) {
            break;
        }
    }
    cache::tell_fault(kept.as_ref());
    exit
}

fn code(outcome: RunOutcome) -> Exit {
    match outcome {
        RunOutcome::Found | RunOutcome::Completed => Exit::Success,
        RunOutcome::NotFound | RunOutcome::Aborted | RunOutcome::TimeOut => Exit::NotFound,
        RunOutcome::Interrupted => Exit::Interrupted,
        RunOutcome::Failed => Exit::Error,
    }
}

/// Runs one file, unless another file of this command has used its folder.
fn one(
    file: &Path,
    args: &RunArgs,
    taken: &mut Vec<PathBuf>,
    kept: Option<&SpinUps>,
    stop: &AtomicBool,
) -> Result<RunOutcome, RunError> {
    let loaded = load(file)?;
    say::warnings(loaded.check()?);
    let folder = folder(&loaded, args);
    if taken.contains(&folder) {
        return Err(RunError::Taken(folder));
    }
    taken.push(folder.clone());
    if !args.quiet {
        let estimate = cost::estimate(&cost::cost(&loaded.scenario));
        eprintln!("{}: takes at most {estimate}", loaded.name);
    }
    let mut trial = Trial::assemble(&loaded, args.key.seed(args.seed))?;
    let mut onlooker = Onlooker::new(&loaded, args, &folder, stop)?;
    if let Some(kept) = kept {
        let developed = trial.spin_up_with(kept, &mut onlooker);
        onlooker.developed(developed.is_some_and(|d| d.kept));
    }
    let ended = trial.run(&mut onlooker);
    Ok(onlooker.finish(&trial, &ended)?)
}

/// The folder of the results: `--out`, or `runs/<scenario>-<seed>`.
fn folder(loaded: &Loaded, args: &RunArgs) -> PathBuf {
    match &args.out {
        Some(out) if args.files.len() == 1 => out.clone(),
        Some(out) => out.join(&loaded.name),
        None => Path::new("runs").join(format!("{}-{}", loaded.name, args.seed)),
    }
}
