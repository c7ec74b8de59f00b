//! Errors of setting up live state. Once it runs, it cannot make a run fail.

use std::path::PathBuf;

/// Why live state could not be set up.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LiveError {
    /// The port belongs to another process.
    #[error(
        "zenoh cannot listen on {endpoint}: port {port} is already in use; \
         choose another with --zenoh-listen, or run with --no-zenoh"
    )]
    BusyPort {
        /// The endpoint asked for.
        endpoint: String,
        /// Its port.
        port: u16,
    },
    /// Whoever comes from another machine could control the run.
    #[error(
        "anybody on the network could control this, without a user, a client certificate or access control: {ways}. \
         Close that (docs/interfaces.md has configurations that tell who may), or allow it with \
         --control-from-anywhere"
    )]
    Exposed {
        /// By which ways.
        ways: String,
    },
    /// The endpoint to listen on does not have zenoh's form.
    #[error("`{endpoint}` is not a zenoh endpoint; write one like tcp/127.0.0.1:7447")]
    Endpoint {
        /// As given.
        endpoint: String,
    },
    /// The configuration file cannot be used.
    #[error("zenoh configuration {}: {why}", path.display())]
    Config {
        /// The file.
        path: PathBuf,
        /// zenoh's message.
        why: String,
    },
    /// The run's id cannot be part of a key.
    #[error("run id `{id}` must be of a-z, 0-9 and _ only, and not empty")]
    RunId {
        /// As given.
        id: String,
    },
    /// What to listen to is no key expression.
    #[error(
        "`{key}` is no key expression: {why}; write one like clock, auv/*/chemical, auv/auv0/** or \
         rheotaxis/duck_st_1/plume"
    )]
    Key {
        /// As given.
        key: String,
        /// zenoh's message.
        why: String,
    },
    /// A listener whose configuration needs a run finds none, or is not let in.
    #[error("zenoh finds no run: {why}")]
    NoSession {
        /// zenoh's message.
        why: String,
    },
    /// zenoh did not start.
    #[error("zenoh did not start: {why}")]
    Open {
        /// zenoh's message.
        why: String,
    },
}
