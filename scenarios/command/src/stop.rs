//! Ctrl-C: the first ends the work in hand in order, the second ends the process at once.

use super::exit::Exit;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by Ctrl-C or a termination signal.
static STOP: AtomicBool = AtomicBool::new(false);

/// From here on Ctrl-C and termination signals ask to stop, and a second one does not ask.
pub(super) fn listen() -> &'static AtomicBool {
    // Fails only if a handler is there already, and that one is ours.
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(Exit::Interrupted.code().into());
        }
    });
    &STOP
}
