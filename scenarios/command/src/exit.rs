//! What the exit code says.

use std::process::ExitCode;

/// How the command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Every mission ended as its scenario defines success; or, without a mission, all is well.
    Success,
    /// Ran to the end, but not to success: no source declared, or too far from the true one.
    NotFound,
    /// Something is wrong: the text on standard error says what.
    Error,
    /// A campaign was stopped before its end: the same command goes on where it stopped.
    Unfinished,
    /// Ctrl-C or a termination signal.
    Interrupted,
}

impl Exit {
    /// The number the shell sees; wrong usage is 2, from the argument parser.
    #[must_use]
    pub fn code(self) -> u8 {
        match self {
            Exit::Success => 0,
            Exit::Error => 1,
            Exit::NotFound => 3,
            Exit::Unfinished => 75,
            Exit::Interrupted => 130,
        }
    }

    /// Of two, the one that matters more.
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
