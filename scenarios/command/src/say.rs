//! How errors and other messages are printed.

use console::{Term, colors_enabled_stderr};
use miette::Report;
use output::shown::{self, Shown};
use rheotaxis::scenario::{Fault, ScenarioError};
use std::io::Write;
use std::path::Path;

/// Sets how this process prints errors.
pub(super) fn set_up() {
    // Fails only if a hook is set already; then that one stays.
    let _ = miette::set_hook(Box::new(|_| look()));
}

fn look() -> Box<dyn miette::ReportHandler> {
    let terminal = Term::stderr();
    let look = if terminal.is_term() {
        shown::look()
            .color(colors_enabled_stderr())
            .width(terminal.size().1.into())
    } else {
        shown::plain()
    };
    Box::new(look.build())
}

/// Prints each mistake of a scenario to standard error.
pub(super) fn scenario_error(error: ScenarioError) {
    match error {
        ScenarioError::Many { faults, .. } => warnings(faults),
        ScenarioError::Text(fault) => warnings(vec![*fault]),
        ScenarioError::File { ref help, .. } => self::error(&error, help.as_deref()),
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
pub(super) fn warnings(faults: Vec<Fault>) {
    for fault in faults {
        eprintln!("{:?}", Report::new(Shown::from(fault)));
    }
}

/// Prints any other error: what is wrong and, if known, how to correct it.
pub(super) fn error(problem: impl std::fmt::Display, help: Option<&str>) {
    let mut diagnostic = miette::MietteDiagnostic::new(problem.to_string());
    if let Some(help) = help {
        diagnostic = diagnostic.with_help(help);
    }
    eprintln!("{:?}", Report::new(diagnostic));
}
