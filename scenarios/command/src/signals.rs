//! Signals that would end the process without a word.

/// Lets a write beyond the limit on the size of files (`ulimit -f`) fail with an error that is told, as on a full disk.
/// Otherwise the signal SIGXFSZ ends the process.
#[cfg(unix)]
pub(super) fn ignore_limits() {
    #[allow(unsafe_code, reason = "no safe function ignores a signal; to ignore one runs no code of ours in a handler")]
    // SAFETY: SIG_IGN is a disposition that any signal but SIGKILL and SIGSTOP may have.
    unsafe {
        libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
    }
}

#[cfg(not(unix))]
pub(super) fn ignore_limits() {}
