//! What a listener is asked for, and what it hears of runs.

use serde::Serialize;
use serde_json::Value;
use std::path::PathBuf;

/// What to hear, and where.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ListenOptions {
    /// A topic's name, a key below that of a run, or a key expression that begins with `rheotaxis/`. `None` means all
    /// that runs publish.
    pub key: Option<String>,
    /// Id of the one run to hear, as [`run_id`](super::run_id) makes it; `None` means all that are there.
    pub run: Option<String>,
    /// zenoh endpoint of the run; `None` means those that runs on this machine take by default.
    pub connect: Option<String>,
    /// A zenoh configuration (JSON5), all of which is used. `None` means the file that the environment variable
    /// `ZENOH_CONFIG` names, if any. With a configuration, only `connect` from here overrides something in it.
    pub config_file: Option<PathBuf>,
}

/// What a listener hears.
#[derive(Clone, Debug, PartialEq)]
pub enum News {
    /// A run with this id is there.
    Begun(String),
    /// A message of a run. What was published before the listener came is among them, the newest of each key.
    Said(Said),
    /// A run has published its last message.
    Ended(String),
    /// A run is gone and did not say that it ended.
    Gone(String),
}

/// A message of a run, in a form to be read.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Said {
    /// Its key.
    pub key: String,
    /// Name of its topic; absent where this program does not know it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub topic: Option<&'static str>,
    /// Simulated time, s, of what has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t_s: Option<f64>,
    /// The message. Packed numbers and pictures are summarised, beside their header.
    pub message: Value,
}
