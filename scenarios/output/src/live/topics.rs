//! The published topics. `rheotaxis topics` prints them, and a run publishes the schema of each under
//! `meta/schema/<name>`.

pub use rheotaxis::topic::{Payload, Topic};
use world::registry::Registry;

/// Everything that a run publishes, with the topics of other crates that the registry of this thread carries.
#[must_use]
pub fn topics() -> Vec<Topic> {
    rheotaxis::registry::topics(&Registry::now())
}
