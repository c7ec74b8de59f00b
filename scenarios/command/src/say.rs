//! How results, errors and other messages are printed. A stream that cannot be written ends no run; that results could
//! not be printed is said at the end.

use super::exit::Exit;
use console::{Term, colors_enabled_stderr};
use output::shown::{self, Look, PLAIN, printable};
use rheotaxis::scenario::{Loaded, ScenarioError, load_with};
use std::io::{self, ErrorKind, Write};
use std::panic::{set_hook, take_hook};
use std::path::Path;
use std::sync::{Once, OnceLock};
use world::frames::NOT_FINITE;
use world::registry::Registry;

/// Why a line could not be printed to standard output, the first time.
static UNPRINTED: OnceLock<String> = OnceLock::new();

/// How messages are drawn on standard error.
fn look() -> Look {
    let terminal = Term::stderr();
    if !terminal.is_term() {
        return PLAIN;
    }
    Look { color: colors_enabled_stderr(), width: Some(terminal.size().1.into()) }
}

/// Prints each mistake of a scenario to standard error.
pub(super) fn scenario_error(error: &ScenarioError) {
    for drawn in shown::all(error, look()) {
        to_stderr(&drawn);
    }
}

/// Width of what standard output goes to, characters: that of the terminal, or of `COLUMNS`; a file or a pipe has none.
pub(super) fn columns() -> Option<usize> {
    let terminal = Term::stdout();
    let told = || std::env::var("COLUMNS").ok()?.trim().parse().ok();
    let columns = if terminal.is_term() { terminal.size_checked().map(|(_, wide)| wide.into()) } else { told() };
    columns.filter(|n| *n > 0)
}

/// Keeps panics about a state that is no number off the screen. Lanes hand them on, and they are told as errors: where
/// in the program they were noticed says nothing of the vehicle at fault.
pub(super) fn hush_lost_states() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let shown = take_hook();
        set_hook(Box::new(move |panic| {
            let said = panic.payload_as_str();
            if !said.is_some_and(|said| said.contains(NOT_FINITE)) {
                shown(panic);
            }
        }));
    });
}

/// Prints a line to standard output.
pub(super) fn line(text: impl std::fmt::Display) {
    let text = text.to_string();
    keep(writeln!(io::stdout(), "{}", printable(&text)));
}

/// Prints a line about the work to standard error.
pub(super) fn note(text: impl std::fmt::Display) {
    to_stderr(&printable(&text.to_string()));
}

/// Standard error may be a full disk or a closed pipe, and there is no other place to say so.
fn to_stderr(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Keeps an error of standard output. A reader that closes the pipe early (`| head`) is none.
fn keep(printed: io::Result<()>) {
    if let Err(error) = printed
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _first = UNPRINTED.set(error.to_string());
    }
}

/// How a command ends, if all that it had to print was printed.
pub(super) fn end(exit: Exit) -> Exit {
    keep(io::stdout().flush());
    match UNPRINTED.get() {
        None => exit,
        Some(problem) => {
            error(format!("cannot write to standard output: {problem}"), None);
            exit.worse(Exit::Error)
        }
    }
}

/// Prints what clap says instead of a command: help, which was asked for, or how a usage is wrong.
pub(super) fn usage(said: &clap::Error) -> u8 {
    let printed = said.print();
    if said.use_stderr() {
        return u8::try_from(said.exit_code()).unwrap_or(2);
    }
    keep(printed);
    end(Exit::Success).code()
}

/// So many things.
pub(super) fn count(n: u64, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// Names the files of an earlier run that were removed from a folder, if there were any.
pub(super) fn removed(folder: &Path, names: &[String]) -> Option<String> {
    (!names.is_empty())
        .then(|| format!("removed from {} what an earlier run left: {}", folder.display(), names.join(", ")))
}

/// Reads and checks a scenario, and prints the warnings about it to standard error.
///
/// # Errors
/// Its mistakes.
pub(super) fn checked(registry: &Registry, file: &Path) -> Result<Loaded, ScenarioError> {
    let loaded = load_with(registry, file)?;
    warnings(&loaded)?;
    Ok(loaded)
}

/// Checks a scenario, and prints the warnings about it to standard error.
///
/// # Errors
/// Its mistakes.
pub(super) fn warnings(loaded: &Loaded) -> Result<(), ScenarioError> {
    for fault in loaded.check()? {
        to_stderr(&shown::fault(&fault, look()));
    }
    Ok(())
}

/// Prints any other error: what is wrong and, if known, how to correct it.
pub(super) fn error(problem: impl std::fmt::Display, help: Option<&str>) {
    to_stderr(&shown::error(&problem.to_string(), help, look()));
}
