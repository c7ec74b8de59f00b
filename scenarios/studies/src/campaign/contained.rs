//! Work whose panic is an answer: it is kept off the screen and returned to the caller.

use rheotaxis::lanes::caught;
use std::cell::Cell;
use std::panic::{set_hook, take_hook};
use std::sync::Once;

/// The result of `work`, or the message of its panic.
pub(super) fn contained<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    hush();
    let before = QUIET.replace(true);
    let result = caught(work);
    QUIET.set(before);
    result
}

thread_local! {
    /// Whether this thread is doing such work.
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Keeps the panics of such work off the screen; all others are shown as usual.
fn hush() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let shown = take_hook();
        set_hook(Box::new(move |info| {
            if !QUIET.get() {
                shown(info);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_told_and_an_answer_is_passed_on() {
        assert_eq!(contained(|| 3), Ok(3));
        let said = contained(|| -> u8 { panic!("the hull is {} m long", -1) });
        assert_eq!(said, Err("the hull is -1 m long".to_string()));
        assert!(!QUIET.get());
    }
}
