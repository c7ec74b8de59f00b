//! What systems publish during a run.

use super::{Payload, Topic, message_json};
use bevy_ecs::prelude::Resource;
use serde::Serialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// A value of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct TopicValue {
    /// The topic.
    pub topic: Topic,
    /// The key below `rheotaxis/<run>/`: that of the topic with an id in the place of `<id>`.
    pub key: String,
    /// Simulated time, s.
    pub t_s: f64,
    /// A JSON object.
    pub value: Value,
}

/// The newest value of every key. A system that publishes takes it as `ResMut<Topics>`.
///
/// Nothing of a run's state can be read from it: only what systems have published themselves.
#[derive(Resource, Clone, Debug, Default)]
pub struct Topics {
    declared: Vec<Topic>,
    newest: BTreeMap<String, TopicValue>,
    /// Keys of the values that are in no frame yet.
    fresh: BTreeSet<String>,
}

impl Topics {
    /// For a run that has declared these topics.
    pub fn new(declared: Vec<Topic>) -> Self {
        Self { declared, ..Self::default() }
    }

    /// Publishes a value of a topic at a simulated time. `id` takes the place of `<id>` in the topic's key; it is
    /// empty for a key without one. Of several values between two frames the last one counts.
    ///
    /// # Panics
    /// If the topic is not declared, if the value is not a JSON object, or if the id does not fit into the key.
    pub fn publish(&mut self, topic: &Topic, id: &str, t_s: f64, value: &impl Serialize) {
        let name = topic.name;
        assert!(
            self.declared.contains(topic),
            "the topic `{name}` is not declared: add it to the registry with `with_topic`"
        );
        assert!(
            topic.key.contains("<id>") != id.is_empty() && !id.contains('/'),
            "the topic `{name}` has the key `{}`, for which \"{id}\" is no id",
            topic.key
        );
        let value = message_json(value).unwrap_or_else(|e| panic!("a value of the topic `{name}` is not JSON: {e}"));
        assert!(
            topic.payload == Payload::Json && value.is_object(),
            "a value of the topic `{name}` must be a JSON object: publish a struct with named fields"
        );
        let key = topic.key.replace("<id>", id);
        self.fresh.insert(key.clone());
        let published = TopicValue { topic: *topic, key: key.clone(), t_s, value };
        self.newest.insert(key, published);
    }

    /// The newest value of every key, sorted by key.
    pub fn newest(&self) -> impl Iterator<Item = &TopicValue> {
        self.newest.values()
    }

    /// The values that were published since it was last called.
    pub(crate) fn take_fresh(&mut self) -> Vec<TopicValue> {
        let fresh = std::mem::take(&mut self.fresh);
        let of = |key: String| self.newest[&key].clone();
        fresh.into_iter().map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use schemars::JsonSchema;
    use serde_json::json;

    /// A depth.
    #[derive(Serialize, JsonSchema)]
    struct Depth {
        /// Depth, m.
        m: u32,
    }

    const DEPTH: Topic = Topic::of::<Depth>("depth", "own/<id>/depth", "always");

    #[test]
    fn the_last_value_of_each_key_counts_and_is_taken_once() {
        let mut topics = Topics::new(vec![DEPTH]);
        for (id, m) in [("b", 1), ("a", 2), ("b", 3)] {
            topics.publish(&DEPTH, id, f64::from(m), &Depth { m });
        }
        let taken: Vec<_> = (topics.take_fresh().into_iter()).map(|p| (p.key, p.t_s, p.value["m"].clone())).collect();
        let [a, b] = ["own/a/depth", "own/b/depth"].map(str::to_string);
        assert_eq!(taken, [(a, 2.0, json!(2)), (b, 3.0, json!(3))]);
        assert_eq!(topics.take_fresh(), []);
        assert_eq!(topics.newest().count(), 2);
    }

    #[test]
    #[should_panic(expected = "add it to the registry with `with_topic`")]
    fn a_topic_that_is_not_declared_is_refused() {
        Topics::default().publish(&DEPTH, "a", 0.0, &Depth { m: 1 });
    }

    #[test]
    #[should_panic(expected = "must be a JSON object")]
    fn a_bare_number_is_refused() {
        Topics::new(vec![DEPTH]).publish(&DEPTH, "a", 0.0, &1.0);
    }
}
