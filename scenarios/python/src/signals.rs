//! Ctrl-C during a run.
#![allow(clippy::disallowed_methods, reason = "how often signals are looked for never reaches a run")]

use pyo3::prelude::*;
use std::time::{Duration, Instant};

/// Time between two looks.
const PERIOD: Duration = Duration::from_millis(50);

/// Looks for signals now and then, from a thread that does not hold the interpreter's lock.
#[derive(Debug)]
pub(crate) struct Signals {
    due: Instant,
    raised: Option<PyErr>,
}

impl Default for Signals {
    fn default() -> Self {
        Self { due: Instant::now() + PERIOD, raised: None }
    }
}

impl Signals {
    /// Whether nothing has been raised yet. Python handles signals in its main thread only; in others this is always
    /// true.
    pub(crate) fn quiet(&mut self) -> bool {
        if self.raised.is_none() && Instant::now() >= self.due {
            self.raised = Python::attach(|py| py.check_signals()).err();
            self.due = Instant::now() + PERIOD;
        }
        self.raised.is_none()
    }

    /// What a signal's handler has raised, such as `KeyboardInterrupt`.
    pub(crate) fn raised(self) -> Option<PyErr> {
        self.raised
    }
}
