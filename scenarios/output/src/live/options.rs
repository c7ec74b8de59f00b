//! Options of live state.

use super::{LiveError, Plane, Ros2};
use rheotaxis::topic::{Topic, chunk};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// zenoh's own port, the default for listening.
pub const DEFAULT_PORT: u16 = 7447;

/// How to publish.
#[derive(Clone, Debug)]
pub struct LiveOptions {
    /// Second chunk of every key, `[a-z0-9_]+`; see [`run_id`].
    pub run_id: String,
    /// zenoh endpoint to listen on; `None` means [`DEFAULT_PORT`] on the loopback interface, or the next free port.
    pub listen: Option<String>,
    /// A zenoh configuration (JSON5), all of which is used: mode, endpoints, scouting, TLS, access control. `None`
    /// means the file that the environment variable `ZENOH_CONFIG` names, if any. With a configuration, only `listen`
    /// from here overrides something in it.
    pub config_file: Option<PathBuf>,
    /// Shortest wall time between two publications of state, and of sidescan pings; values in between are superseded.
    pub state_period: Duration,
    /// Shortest wall time between two publications of the plume, of maps, and of camera pictures.
    pub plume_period: Duration,
    /// What others may ask of the run.
    pub plane: Arc<Plane>,
    /// Whether that may be anybody who comes from another machine. Otherwise a session that is open to them, and tells
    /// nobody apart, is refused if the run may be controlled.
    pub control_from_anywhere: bool,
    /// Publish for ROS 2 as well.
    pub ros2: Option<Ros2>,
}

impl LiveOptions {
    /// The defaults: loopback interface, [`DEFAULT_PORT`] or the next free port, state at most 20 times and plume at
    /// most twice a second.
    pub fn new(run_id: String) -> Self {
        Self {
            run_id,
            listen: None,
            config_file: None,
            state_period: Duration::from_millis(50),
            plume_period: Duration::from_millis(500),
            plane: Arc::new(Plane::new(false, None)),
            control_from_anywhere: false,
            ros2: None,
        }
    }

    /// Whether the run's id can be part of a key.
    ///
    /// # Errors
    /// [`LiveError::RunId`] if not.
    pub fn check(&self) -> Result<(), LiveError> {
        let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if self.run_id.is_empty() || !self.run_id.chars().all(fits) {
            return Err(LiveError::RunId { id: self.run_id.clone() });
        }
        Ok(())
    }
}

/// What is known of a run before it starts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LiveMeta {
    /// The scenario as written (RON).
    pub scenario_text: String,
    /// Its name.
    pub scenario_name: String,
    /// The seed.
    pub seed: u64,
    /// The program's version.
    pub version: String,
    /// The scene as a JSON text; `None` to publish none.
    pub scene: Option<String>,
    /// Everything that the run may publish.
    pub topics: Vec<Topic>,
}

/// What happened to the states that were passed in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LiveCounts {
    /// States passed to [`Live::see`](super::Live::see).
    pub offered: u64,
    /// States sent.
    pub sent: u64,
    /// States replaced by a newer one before they were sent.
    pub superseded: u64,
}

/// The id of a run in keys: `<scenario>_<seed>`, in which everything but `a-z`, `0-9` and `_` becomes `_`.
pub fn run_id(scenario: &str, seed: u64) -> String {
    format!("{}_{seed}", chunk(scenario))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_fit_into_keys_or_are_refused() {
        for (name, seed, id) in [("duck_st", 7, "duck_st_7"), ("Duck ST/é*?$#@", 1, "duck_st________1"), ("", 0, "__0")]
        {
            assert_eq!(run_id(name, seed), id);
            assert_eq!(LiveOptions::new(id.to_owned()).check(), Ok(()));
        }
        for id in ["", "Duck", "a/b", "a*", "@live"] {
            let error = LiveOptions::new(id.to_owned()).check().unwrap_err();
            assert!(error.to_string().contains(&format!("`{id}` must be of a-z, 0-9 and _ only")), "{error}");
        }
    }
}
