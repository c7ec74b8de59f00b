//! A recording as its readers see it: topics with their schemas, message paths, clouds, frames.

use mcap::MessageStream;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What is in a recording.
pub(super) struct Recording {
    /// Type, schema and messages of each topic.
    topics: BTreeMap<String, Topic>,
}

struct Topic {
    schema: String,
    messages: Vec<Vec<u8>>,
}

impl Recording {
    /// Reads all of it.
    pub(super) fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).expect("the run has left it");
        let mut topics: BTreeMap<String, Topic> = BTreeMap::new();
        for message in MessageStream::new(&bytes).expect("a recording") {
            let message = message.expect("a message");
            let schema = message.channel.schema.as_ref().expect("a schema");
            let topic = topics.entry(message.channel.topic.clone());
            let topic = topic.or_insert_with(|| Topic {
                schema: String::from_utf8(schema.data.to_vec()).expect("text"),
                messages: Vec::new(),
            });
            topic.messages.push(message.data.into_owned());
        }
        Self { topics }
    }

    /// Names of the topics.
    pub(super) fn topics(&self) -> Vec<&str> {
        self.topics.keys().map(String::as_str).collect()
    }

    /// How many messages a topic has.
    pub(super) fn messages(&self, topic: &str) -> usize {
        self.topics.get(topic).map_or(0, |t| t.messages.len())
    }

    /// Names of the fields of a cloud: they stand in the message as CDR strings.
    pub(super) fn cloud_fields(&self, topic: &str) -> Vec<String> {
        let message = self.topics[topic].messages.last().expect("a message");
        let mut at = 4 + 8;
        let frame = string(message, &mut at);
        assert_eq!(frame, "world/area");
        // Height and width.
        number(message, &mut at);
        number(message, &mut at);
        let count = number(message, &mut at);
        let mut names = Vec::new();
        for _ in 0..count {
            names.push(string(message, &mut at));
            // Offset, type and count.
            number(message, &mut at);
            at += 1;
            number(message, &mut at);
        }
        names
    }

    /// Whether a message path, such as `/auv0/truth.pose.pose.position.z`, ends at a number or a text.
    pub(super) fn resolves(&self, path: &str) -> Result<(), String> {
        let (topic, fields) = path.split_once('.').ok_or("no field")?;
        let Some(found) = self.topics.get(topic) else {
            return Err(format!("no topic {topic} among {:#?}", self.topics()));
        };
        let parts = parts(&found.schema);
        let mut of = "";
        let mut kind = String::new();
        for field in fields.split('.') {
            let name = field.split('[').next().unwrap_or(field);
            let own = parts.get(of).ok_or(format!("{of} is not defined"))?;
            let line = (own.iter()).find(|(_, field)| *field == name);
            let (found, _) = line.ok_or(format!("{of} has no field {name}: {own:?}"))?;
            let list = found.contains('[');
            if list != field.contains('[') {
                return Err(format!("{name} is a {found}"));
            }
            kind = found.split('[').next().unwrap_or(found).to_owned();
            let ending = format!("/{kind}");
            let named = |k: &&&str| **k == kind || k.ends_with(&ending);
            of = parts.keys().find(named).copied().unwrap_or("");
        }
        let plain = ["float64", "string", "int32", "uint32"].contains(&kind.as_str());
        plain.then_some(()).ok_or(format!("it ends at a {kind}"))
    }

    /// All frames of `/tf` and `/tf_static`, which must be one tree.
    pub(super) fn frames(&self) -> BTreeSet<String> {
        let mut parents: BTreeMap<String, String> = BTreeMap::new();
        for topic in ["/tf", "/tf_static"] {
            for message in &self.topics[topic].messages {
                let mut at = 4;
                for _ in 0..number(message, &mut at) {
                    at = at.next_multiple_of(4) + 8;
                    let parent = string(message, &mut at);
                    let child = string(message, &mut at);
                    // Seven numbers of 8 bytes, which begin at a multiple of 8 behind the header of 4.
                    at = 4 + (at - 4).next_multiple_of(8) + 7 * 8;
                    let before = parents.insert(child.clone(), parent.clone());
                    assert!(
                        before.as_ref().is_none_or(|p| *p == parent),
                        "{child} hangs at {before:?} and at {parent}"
                    );
                }
            }
        }
        let tops: BTreeSet<&String> = (parents.values()).filter(|p| !parents.contains_key(*p)).collect();
        assert_eq!(Vec::from_iter(tops), ["world"]);
        parents.into_iter().flat_map(|(a, b)| [a, b]).collect()
    }
}

/// Fields (type, name) of the message and of each type in a schema; the message itself is "".
fn parts(schema: &str) -> BTreeMap<&str, Vec<(&str, &str)>> {
    let mut parts: BTreeMap<&str, Vec<(&str, &str)>> = BTreeMap::new();
    let mut of = "";
    for line in schema.lines() {
        if let Some(name) = line.strip_prefix("MSG: ") {
            of = name;
        } else if let Some((kind, rest)) = line.split_once(' ')
            && !rest.contains('=')
        {
            let name = rest.split(' ').next().unwrap_or(rest);
            parts.entry(of).or_default().push((kind, name));
        }
    }
    parts
}

/// An aligned number of 4 bytes; `at` counts from the message's first byte, alignment from the fifth.
fn number(message: &[u8], at: &mut usize) -> u32 {
    *at = at.next_multiple_of(4);
    let bytes = message[*at..*at + 4].try_into().expect("four bytes");
    *at += 4;
    u32::from_le_bytes(bytes)
}

fn string(message: &[u8], at: &mut usize) -> String {
    let length = number(message, at) as usize;
    let text = &message[*at..*at + length - 1];
    *at += length;
    String::from_utf8(text.to_vec()).expect("text")
}
