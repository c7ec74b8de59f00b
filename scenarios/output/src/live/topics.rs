//! The published topics. `rheotaxis topics` prints them, and a run publishes the schema of each under
//! `meta/schema/<name>`.

pub use rheotaxis::registry::topics;
pub use rheotaxis::topic::{Payload, Topic};
