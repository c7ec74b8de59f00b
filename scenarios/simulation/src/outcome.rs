//! How a run ends.

use serde::Serialize;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RunOutcome {
    /// A source was found, as the scenario defines success.
    Found,
    /// The declarations were not near enough, or the mission ended without one.
    NotFound,
    /// The mission came to its planned end, and the scenario asks for no more.
    Completed,
    /// The vehicle gave up because it was too far outside the area.
    Aborted,
    /// The time limit of the scenario was reached.
    TimeOut,
    /// The user stopped it (Ctrl-C).
    Interrupted,
    /// An error ended the run; `error` says which.
    Failed,
}

impl RunOutcome {
    /// In words, for people.
    pub fn label(self) -> &'static str {
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
