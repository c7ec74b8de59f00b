//! How errors look: with the place in the file on a terminal and off it, the same each time.

use super::shown::Shown;
use miette::{MietteHandlerOpts, Report};
use rheotaxis::scenario::{Fault, ScenarioError};
use std::io::{IsTerminal, Write};
use std::path::Path;

/// Width of messages where there is no terminal to ask.
const WIDTH: usize = 100;

/// Sets the look of errors for the process.
pub(super) fn set_up() {
    // Fails only if someone set a look before: then that one holds.
    let _ = miette::set_hook(Box::new(|_| look()));
}

fn look() -> Box<dyn miette::ReportHandler> {
    let mut look = MietteHandlerOpts::new()
        .force_graphical(true)
        .terminal_links(false)
        .context_lines(1);
    if !std::io::stderr().is_terminal() {
        // In a log every message stands on one line, so that it can be searched for.
        look = look
            .unicode(true)
            .color(false)
            .width(WIDTH)
            .wrap_lines(false);
    }
    Box::new(look.build())
}

/// What is wrong with a scenario, to standard error: each mistake for itself.
pub(super) fn scenario_error(error: ScenarioError) {
    match error {
        ScenarioError::Many { faults, .. } => warnings(faults),
        ScenarioError::Text(fault) => warnings(vec![*fault]),
        ScenarioError::File { ref help, .. } => self::error(&error, help.as_deref()),
    }
}

/// A line to standard output. Whoever reads it may have heard enough (`| head`): that is no error.
pub(super) fn line(text: impl std::fmt::Display) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Which files of an earlier run were removed from a folder, in words; none if none were.
pub(super) fn removed(folder: &Path, names: &[String]) -> Option<String> {
    (!names.is_empty()).then(|| {
        format!(
            "removed from {} what an earlier run left there: {}",
            folder.display(),
            names.join(", ")
        )
    })
}

/// What is wrong or odd about a scenario, to standard error.
pub(super) fn warnings(faults: Vec<Fault>) {
    for fault in faults {
        eprintln!("{:?}", Report::new(Shown::from(fault)));
    }
}

/// Any other error: what is wrong and, if known, how to put it right.
pub(super) fn error(problem: impl std::fmt::Display, help: Option<&str>) {
    let mut diagnostic = miette::MietteDiagnostic::new(problem.to_string());
    if let Some(help) = help {
        diagnostic = diagnostic.with_help(help);
    }
    eprintln!("{:?}", Report::new(diagnostic));
}
