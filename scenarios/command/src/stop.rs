//! Ctrl-C ends a command with a code of its own. Of commands that leave their work in order, the first asks the work
//! under way to end, and the second ends the process at once.

use super::exit::Exit;
use std::sync::atomic::{AtomicBool, Ordering};
use world::files::drop_unfinished;

/// Set by Ctrl-C or a termination signal.
static STOP: AtomicBool = AtomicBool::new(false);
/// Whether somebody looks at the flag.
static LISTENED: AtomicBool = AtomicBool::new(false);

/// Handles Ctrl-C and termination signals from now on: unless somebody listens, they end the process. Files under way
/// leave nothing behind.
pub(super) fn begin() {
    // Fails if there is a handler already, this one or another of the program, or if the system gives no thread for it.
    let _ = ctrlc::set_handler(|| {
        if !LISTENED.load(Ordering::Relaxed) || STOP.swap(true, Ordering::Relaxed) {
            drop_unfinished();
            std::process::exit(Exit::Interrupted.code().into());
        }
    });
}

/// From now on the first such signal sets this flag, and a second one ends the process.
pub(super) fn listen() -> &'static AtomicBool {
    LISTENED.store(true, Ordering::Relaxed);
    &STOP
}
