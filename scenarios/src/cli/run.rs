//! `rheotaxis run`: runs scenarios, shows them, and leaves a folder for each.

use super::args::RunArgs;
use super::exit::Exit;
use super::onlooker::Onlooker;
use super::say;
use crate::assemble::AssembleError;
use crate::live::LiveError;
use crate::report::{ReportError, RunOutcome};
use crate::scenario::{Loaded, ScenarioError, load};
use crate::trial::Trial;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by Ctrl-C or a termination signal; the run in hand then ends as it should.
static STOP: AtomicBool = AtomicBool::new(false);

/// Why a run could not be made or finished.
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
}

/// Runs every file; a broken one is reported and the next one tried.
pub(super) fn run(args: &RunArgs) -> Exit {
    // Fails only if a handler is there already, and that one is ours.
    let _ = ctrlc::set_handler(|| STOP.store(true, Ordering::Relaxed));
    let mut exit = Exit::Success;
    for file in &args.files {
        exit = exit.worse(match one(file, args) {
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
        if STOP.load(Ordering::Relaxed) {
            break;
        }
    }
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

fn one(file: &Path, args: &RunArgs) -> Result<RunOutcome, RunError> {
    let loaded = load(file)?;
    say::warnings(loaded.check()?);
    let mut trial = Trial::assemble(&loaded, args.seed)?;
    let mut onlooker = Onlooker::new(&loaded, args, &folder(&loaded, args), &STOP)?;
    let ended = trial.run(&mut onlooker);
    Ok(onlooker.finish(&trial, &ended)?)
}

/// Where the results go: as asked, or `runs/<scenario>-<seed>`.
fn folder(loaded: &Loaded, args: &RunArgs) -> PathBuf {
    match &args.out {
        Some(out) if args.files.len() == 1 => out.clone(),
        Some(out) => out.join(&loaded.name),
        None => Path::new("runs").join(format!("{}-{}", loaded.name, args.seed)),
    }
}
