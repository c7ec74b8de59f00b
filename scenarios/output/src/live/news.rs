//! What a listener is asked for, and what it hears of runs.

use rheotaxis::topic::Topic;
use serde_json::Value;
use std::path::PathBuf;

/// What to hear, and where.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ListenOptions {
    /// A key expression below the key of a run, or one that begins with `rheotaxis/`. `None` means all but the schemas.
    pub key: Option<String>,
    /// zenoh endpoint of the run; `None` means those that runs on this machine take by default.
    pub connect: Option<String>,
    /// A zenoh configuration (JSON5), all of which is used. `None` means the file that the environment variable
    /// `ZENOH_CONFIG` names, if any. With a configuration, only `connect` from here overrides something in it.
    pub config_file: Option<PathBuf>,
    /// Everything that runs may publish: a key that asks for none of it is noticed, unless this is empty.
    pub topics: Vec<Topic>,
}

/// What a listener hears.
#[derive(Clone, Debug, PartialEq)]
pub enum News {
    /// A run with this id is there.
    Begun(String),
    /// A message: `key`, and `message` as JSON. Of packed numbers `message` is the header, and `packed` holds their
    /// count, least, greatest and mean; of a picture, `jpeg` holds its size.
    Message(Value),
    /// A run has said all, and that it has ended.
    Ended(String),
    /// A run is gone and did not say that it ended.
    Gone(String),
}
