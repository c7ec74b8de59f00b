//! Why a command did not do its work: what is printed of it, and the exit code.

use super::exit::Exit;
use super::say;
use output::files::ReportError;
use rheotaxis::scenario::ScenarioError;
use std::error::Error;
use studies::arena::ArenaError;
use studies::campaign::CampaignError;
use studies::reproduce::ReproduceError;
use studies::score_vision::ScoreError;
use studies::segment::PictureError;
use studies::statistics::StatisticsError;

/// What went wrong, of whatever kind.
pub(super) type Failure = Box<dyn Error>;

/// What is wrong, and what would help.
#[derive(Debug, thiserror::Error)]
#[error("{problem}")]
struct Hinted {
    problem: String,
    help: String,
}

/// A failure with what would help.
pub(super) fn hinted(problem: impl ToString, help: impl Into<String>) -> Failure {
    Hinted { problem: problem.to_string(), help: help.into() }.into()
}

/// Prints what went wrong to standard error.
pub(super) fn refused(error: &Failure) -> Exit {
    match scenario(error) {
        Some(error) => say::scenario_error(error),
        None => say::error(error, help(error)),
    }
    let interrupted = matches!(error.downcast_ref(), Some(ReproduceError::Interrupted))
        || matches!(error.downcast_ref(), Some(ScoreError::Interrupted))
        || matches!(error.downcast_ref(), Some(StatisticsError::Interrupted));
    if interrupted { Exit::Interrupted } else { Exit::Error }
}

/// The mistakes of a scenario, which are shown with their lines.
fn scenario(error: &Failure) -> Option<&ScenarioError> {
    if let Some(CampaignError::Scenario(error)) = error.downcast_ref() {
        return Some(error);
    }
    if let Some(ReproduceError::Scenario(error)) = error.downcast_ref() {
        return Some(error);
    }
    if let Some(ArenaError::Scenario(error) | ArenaError::Campaign(CampaignError::Scenario(error))) =
        error.downcast_ref()
    {
        return Some(error);
    }
    error.downcast_ref()
}

fn help(error: &Failure) -> Option<&str> {
    match error.downcast_ref() {
        Some(CampaignError::Differs { .. }) => {
            Some("give another --out; or --force, which continues here and keeps the blocks that are done")
        }
        Some(CampaignError::Write(_)) => {
            Some("blocks written before are whole; free some space or name another folder, and run again")
        }
        Some(CampaignError::Broken { .. }) => {
            Some("`rheotaxis campaign run` makes it again, unless its place is taken by something that is not a file")
        }
        _ => None,
    }
    .or_else(|| error.downcast_ref::<PictureError>()?.help())
    .or_else(|| Some(&error.downcast_ref::<Hinted>()?.help))
}

/// Adds what helps against files of others in the folder of a run's results.
pub(super) fn of_run(error: Failure) -> Failure {
    match error.downcast_ref() {
        Some(ReportError::Write(why)) if why.is_foreign() => {
            hinted(error, "--overwrite replaces files that have the names of results")
        }
        _ => error,
    }
}
