//! Work whose panic is an answer.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// The result of `work`, or the message of its panic. The hook of the process still shows the panic.
///
/// # Errors
/// If `work` panics.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        (panic.downcast_ref::<&str>().map(|s| (*s).to_string()))
            .or_else(|| panic.downcast_ref::<String>().cloned())
            .unwrap_or_else(|| "of unknown cause".to_string())
    })
}
