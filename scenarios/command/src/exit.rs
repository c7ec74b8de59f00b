//! Exit codes.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

/// How the command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Every mission ended as its scenario defines success. Of a command without missions: no error.
    Success,
    /// A mission ended without success: no source was declared, or too far from the true one.
    NotFound,
    /// An error; the text on standard error explains it.
    Error,
    /// A campaign was stopped before its end; the same command continues it.
    Unfinished,
    /// Ctrl-C or a termination signal ended a run.
    Interrupted,
}

impl Exit {
    /// The number that the shell sees. Wrong usage is 2, which the argument parser returns.
    pub fn code(self) -> u8 {
        match self {
            Exit::Success => 0,
            Exit::Error => 1,
            Exit::NotFound => 3,
            Exit::Unfinished => 75,
            Exit::Interrupted => 130,
        }
    }

    /// How some work ends. A panic has printed its message by now; to the shell it is an error like any other.
    pub fn guarded(work: impl FnOnce() -> Self) -> Self {
        catch_unwind(AssertUnwindSafe(work)).unwrap_or(Self::Error)
    }

    /// The more important one of two.
    #[must_use]
    pub fn worse(self, other: Self) -> Self {
        self.max(other)
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        ExitCode::from(exit.code())
    }
}
