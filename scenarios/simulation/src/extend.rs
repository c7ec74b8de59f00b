//! What a crate adds to every run of the program: systems with their resources, and topics.
//!
//! Both are carried by the [`Registry`], like rows. A scenario that is read under a registry
//! ([`load_with`](crate::scenario::load_with)) keeps it, so [`Trial::assemble`](crate::trial::Trial::assemble),
//! campaigns and the whole command (`command::main_with`) take up what it carries.
//!
//! ```
//! use bevy_ecs::prelude::{Query, ResMut, Resource};
//! use rheotaxis::extend::{Extend, Systems};
//! use robots::handoff::Readings;
//! use world::registry::Registry;
//! use world::stage::Stage;
//!
//! #[derive(Resource, Default)]
//! struct Smells(u64);
//!
//! fn count(readings: Query<&Readings>, mut smells: ResMut<Smells>) {
//!     smells.0 += readings.iter().filter(|r| r.chemical.is_some_and(|c| c.detected)).count() as u64;
//! }
//!
//! let registry = Registry::default().with_systems(|systems: &mut Systems| {
//!     systems.insert(Smells::default()).add_blind(Stage::Decide, count);
//! });
//! ```

pub use crate::machines::Systems;

use crate::registry::topics;
use crate::topic::Topic;
use world::error::WorldError;
use world::registry::Registry;

/// A function that adds systems and resources to a run.
pub(crate) struct Addition(pub(crate) Box<dyn Fn(&mut Systems) + Send + Sync>);

/// What a registry carries beside its rows.
pub trait Extend: Sized {
    /// Adds systems to the tick of every run, and resources to its world. They run after the systems of the program
    /// in their stage, and in every run they start anew. See [`Systems`] for the order, and [`crate::machines`] for
    /// what they may know.
    #[must_use]
    fn with_systems(self, add: impl Fn(&mut Systems) + Send + Sync + 'static) -> Self;

    /// Declares a topic that a system publishes.
    ///
    /// # Errors
    /// If there is a topic of that name or key, or if the key cannot be one.
    fn with_topic(self, topic: Topic) -> Result<Self, WorldError>;
}

impl Extend for Registry {
    fn with_systems(self, add: impl Fn(&mut Systems) + Send + Sync + 'static) -> Self {
        self.carrying(Addition(Box::new(add)))
    }

    fn with_topic(self, topic: Topic) -> Result<Self, WorldError> {
        let wrong = |problem: String| WorldError::Invalid { field: format!("topic `{}`", topic.name), problem };
        let fits = |part: &str| {
            let legal = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            part == "<id>" || (!part.is_empty() && part.chars().all(legal))
        };
        if !topic.key.split('/').all(fits) {
            return Err(wrong(format!(
                "the key must be parts of a-z, 0-9 and _ (or `<id>`) with / between them, got `{}`",
                topic.key
            )));
        }
        let all = topics(&self);
        if let Some(other) = (all.iter()).find(|t| t.name == topic.name || t.key == topic.key) {
            return Err(wrong(format!(
                "there is a topic `{}` with the key `{}` already; give yours another name and key",
                other.name, other.key
            )));
        }
        Ok(self.carrying(topic))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topic::run::ClockMessage;

    fn topic(name: &'static str, key: &'static str) -> Topic {
        Topic::of::<ClockMessage>(name, key, "always")
    }

    #[test]
    fn a_topic_has_a_name_and_a_key_of_its_own() {
        let own = topic("own", "own/<id>/depth");
        let registry = Registry::default().with_topic(own).expect("new");
        assert_eq!(topics(&registry).last(), Some(&own));
        for (name, key) in [
            ("own", "own/other"),
            ("other", "own/<id>/depth"),
            ("clock", "own/clock"),
            ("other", "auv/<id>/truth"),
            ("other", "own/Depth"),
            ("other", "own//depth"),
            ("other", ""),
        ] {
            let refused = registry.clone().with_topic(topic(name, key));
            assert!(refused.is_err(), "{name} {key}");
        }
    }
}
