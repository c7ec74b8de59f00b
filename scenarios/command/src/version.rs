//! What `rheotaxis --version` prints: all that tells two builds apart, for reports of errors.

use plumes::filaments;
use rheotaxis::scenario::VERSION;
use std::sync::LazyLock;

/// Version, features, processor path, target and profile, on a line each. `-V` prints the version alone.
pub(super) fn long() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(text);
    &TEXT
}

fn text() -> String {
    let features = match cfg!(feature = "live") {
        true => "live (state over zenoh, TLS included)",
        false => "none (without live: no state over zenoh)",
    };
    format!(
        "{}\nscenarios: version {VERSION}\nfeatures:  {features}\nprocessor: {} ({} for filaments)\n\
         target:    {}\nprofile:   {}",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::ARCH,
        filaments::instructions(),
        env!("RHEOTAXIS_TARGET"),
        env!("RHEOTAXIS_PROFILE"),
    )
}
