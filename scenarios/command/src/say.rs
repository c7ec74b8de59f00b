//! How errors and other messages are printed.

use console::{Term, colors_enabled_stderr};
use output::shown::{self, Look, PLAIN};
use rheotaxis::scenario::{Fault, ScenarioError};
use std::io::Write;
use std::path::Path;

/// How messages are drawn on standard error.
fn look() -> Look {
    let terminal = Term::stderr();
    if !terminal.is_term() {
        return PLAIN;
    }
    Look {
        color: colors_enabled_stderr(),
        width: Some(terminal.size().1.into()),
    }
}

/// Prints each mistake of a scenario to standard error.
pub(super) fn scenario_error(error: &ScenarioError) {
    for drawn in shown::all(error, look()) {
        eprintln!("{drawn}");
    }
}

/// Width of what standard output goes to, characters: that of the terminal, or of `COLUMNS`; a file or a pipe has none.
pub(super) fn columns() -> Option<usize> {
    let terminal = Term::stdout();
    let told = || std::env::var("COLUMNS").ok()?.trim().parse().ok();
    let columns = if terminal.is_term() {
        terminal.size_checked().map(|(_, wide)| wide.into())
    } else {
        told()
    };
    columns.filter(|n| *n > 0)
}

/// Prints a line to standard output. A reader that closes the pipe early (`| head`) is no error.
pub(super) fn line(text: impl std::fmt::Display) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Names the files of an earlier run that were removed from a folder, if there were any.
pub(super) fn removed(folder: &Path, names: &[String]) -> Option<String> {
    (!names.is_empty()).then(|| {
        format!(
            "removed from {} what an earlier run left: {}",
            folder.display(),
            names.join(", ")
        )
    })
}

/// Prints mistakes or warnings about a scenario to standard error.
pub(super) fn warnings(faults: &[Fault]) {
    for fault in faults {
        eprintln!("{}", shown::fault(fault, look()));
    }
}

/// Prints any other error: what is wrong and, if known, how to correct it.
pub(super) fn error(problem: impl std::fmt::Display, help: Option<&str>) {
    eprintln!("{}", shown::error(&problem.to_string(), help, look()));
}
