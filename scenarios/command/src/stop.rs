//! Ctrl-C: the first asks the work under way to end, the second ends the process at once.

use super::exit::Exit;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by Ctrl-C or a termination signal.
static STOP: AtomicBool = AtomicBool::new(false);

/// Handles Ctrl-C and termination signals from now on. The first sets the flag, a second one ends the process.
pub(super) fn listen() -> &'static AtomicBool {
    // Fails only if a handler is set already, and that is this one.
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(Exit::Interrupted.code().into());
        }
    });
    &STOP
}
