//! How a run ends.

use serde::Serialize;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RunOutcome {
    /// Success as the scenario defines it: a source declared near enough.
    Found,
    /// Declared, but not near enough, or came to its end without declaring.
    NotFound,
    /// Came to its planned end; the scenario asks for no more.
    Completed,
    /// The vehicle gave up: too far outside the area.
    Aborted,
    /// The scenario's time limit came first.
    TimeOut,
    /// Stopped from outside (Ctrl-C, remote stop).
    Interrupted,
    /// An error ended the run; `error` says which.
    Failed,
}

impl RunOutcome {
    /// In words, for people.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            RunOutcome::Found => "source found",
            RunOutcome::NotFound => "source not found",
            RunOutcome::Completed => "completed",
            RunOutcome::Aborted => "aborted: too far outside the area",
            RunOutcome::TimeOut => "time limit reached",
            RunOutcome::Interrupted => "interrupted",
            RunOutcome::Failed => "failed",
        }
    }
}
