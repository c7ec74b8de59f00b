//! Topics: named values that a run publishes, and the types that describe them.
//!
//! A [`Topic`] is a row of a table: name, key and rate, with the type of its messages. Messages are structs with
//! `Serialize` and `JsonSchema`; the comments on the struct and on its fields say what they mean. From the type come
//! the JSON, the JSON Schema that a run publishes and the text of `rheotaxis topics`. A field that is an `Option` is
//! left out of a message if it has no value.
//!
//! A system publishes a value with [`Topics::publish`]. Live state puts it under `rheotaxis/<run>/<key>`, the recording
//! keeps it as JSON, and the summary shows the last one. Publishing never changes a result: no system of the tick reads
//! what was published.

mod publish;
pub mod run;

pub use publish::{TopicValue, Topics};

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde_json::{Map, Value};

/// Encoding of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Payload {
    /// The payload is a JSON object.
    Json,
    /// The payload is little-endian f32; the attachment is a JSON object.
    PackedF32,
    /// The payload is a picture (JPEG); the attachment is a JSON object.
    Jpeg,
    /// The payload is a JSON Schema.
    Schema,
}

/// A topic. Its name tells it from others.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// Name of its schema.
    pub name: &'static str,
    /// Key below `rheotaxis/<run>/`.
    pub key: &'static str,
    /// How often it is published.
    pub rate: &'static str,
    /// Its encoding.
    pub payload: Payload,
    /// Describes the type of its messages.
    describe: fn(SchemaSettings) -> Value,
}

impl PartialEq for Topic {
    fn eq(&self, other: &Self) -> bool {
        (self.name, self.key) == (other.name, other.key)
    }
}

impl Eq for Topic {}

impl Topic {
    /// A topic whose messages are JSON objects of a type. Give every message the time `t_s`, and put the unit into the
    /// name of each field.
    pub const fn of<M: JsonSchema>(name: &'static str, key: &'static str, rate: &'static str) -> Self {
        Self { name, key, rate, payload: Payload::Json, describe: described::<M> }
    }

    /// The same with an attachment of that type, and another payload.
    #[must_use]
    pub const fn packed(self, payload: Payload) -> Self {
        Self { payload, ..self }
    }

    /// JSON Schema (draft 2020-12) of the payload, or of the attachment if the payload is packed.
    pub fn schema(&self) -> Value {
        // Of the two forms that schemars knows, the one for reading lets fields be absent.
        let mut schema = (self.describe)(SchemaSettings::draft2020_12().for_deserialize());
        schema["title"] = self.name.into();
        let what = schema["description"].as_str().unwrap_or_default().to_owned();
        match self.payload {
            Payload::Json => {}
            Payload::PackedF32 | Payload::Jpeg => {
                schema["description"] = format!("{what} This is the schema of the attachment.").into();
            }
            Payload::Schema => return schema,
        }
        schema["additionalProperties"] = false.into();
        let fields = schema.get_mut("properties").and_then(Value::as_object_mut);
        for field in fields.into_iter().flat_map(Map::values_mut) {
            // A field without a value is absent, never null.
            if let Some([own, _null]) = field.get("type").and_then(Value::as_array).map(Vec::as_slice) {
                field["type"] = own.clone();
            }
        }
        schema
    }

    /// What it contains.
    pub fn what(&self) -> String {
        let schema = (self.describe)(SchemaSettings::draft2020_12());
        schema["description"].as_str().unwrap_or_default().to_owned()
    }

    /// The names of its fields, in the order of the type.
    pub fn fields(&self) -> Vec<String> {
        // The form for writing asks for every field.
        let schema = (self.describe)(SchemaSettings::draft2020_12().for_serialize());
        serde_json::from_value(schema["required"].clone()).unwrap_or_default()
    }
}

/// The schema of a type: with the schemas of its parts in their places, without the widths of numbers in memory.
fn described<M: JsonSchema>(settings: SchemaSettings) -> Value {
    let plain = RecursiveTransform(|schema: &mut Schema| {
        if !schema.get("type").is_some_and(|kind| kind == "string") {
            schema.remove("format");
        }
        if let Some(Value::String(what)) = schema.get_mut("description") {
            *what = what.replace('\n', " ");
        }
    });
    let settings = settings.with(|s| s.inline_subschemas = true).with_transform(plain);
    settings.into_generator().into_root_schema_for::<M>().to_value()
}

/// A message as JSON; fields without a value are left out.
///
/// # Errors
/// If it is not JSON.
pub fn message_json(message: &impl Serialize) -> Result<Value, serde_json::Error> {
    let mut value = serde_json::to_value(message)?;
    if let Value::Object(fields) = &mut value {
        fields.retain(|_, value| !value.is_null());
    }
    Ok(value)
}

/// Messages with their keys.
pub(crate) struct Said {
    below: String,
    all: Vec<(String, Value)>,
}

impl Said {
    /// None yet; their keys are below this one.
    pub(crate) fn below(key: String) -> Self {
        Self { below: key, all: Vec::with_capacity(8) }
    }

    /// Adds a message.
    pub(crate) fn add(&mut self, key: &str, message: &impl Serialize) {
        let value = message_json(message).expect("numbers, words and lists are JSON");
        self.all.push((format!("{}/{key}", self.below), value));
    }
}

impl IntoIterator for Said {
    type Item = (String, Value);
    type IntoIter = std::vec::IntoIter<Self::Item>;

    fn into_iter(self) -> Self::IntoIter {
        self.all.into_iter()
    }
}

/// A name as a part of a key: everything but `a-z`, `0-9` and `_` becomes `_`.
pub fn chunk(name: &str) -> String {
    if name.is_empty() {
        return "_".to_owned();
    }
    name.chars()
        .map(|c| match c.to_ascii_lowercase() {
            c @ ('a'..='z' | '0'..='9' | '_') => c,
            _ => '_',
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// Where a
    /// buoy is.
    #[derive(Serialize, JsonSchema)]
    struct Buoy {
        /// East and north, m.
        at_m: [f64; 2],
        /// Its depth, m.
        #[schemars(extend("enum" = [1, 2]))]
        depth_m: Option<f64>,
        /// Its number.
        k: u32,
    }

    const BUOY: Topic = Topic::of::<Buoy>("buoy", "buoy/<id>", "always");

    #[test]
    fn a_schema_says_what_the_type_and_its_comments_say() {
        let number = json!({"type": "number"});
        let schema = json!({
            "$schema": "https://json-schema.org/draft/2020-12/schema", "title": "buoy",
            "description": "Where a buoy is.", "type": "object", "additionalProperties": false,
            "required": ["at_m", "k"],
            "properties": {
                "at_m": {
                    "description": "East and north, m.", "type": "array", "items": number, "minItems": 2, "maxItems": 2,
                },
                "depth_m": {"description": "Its depth, m.", "type": "number", "enum": [1, 2]},
                "k": {"description": "Its number.", "type": "integer", "minimum": 0},
            },
        });
        assert_eq!(BUOY.schema(), schema);
        assert_eq!(
            (BUOY.what().as_str(), BUOY.fields()),
            ("Where a buoy is.", vec!["at_m", "depth_m", "k"].into_iter().map(str::to_owned).collect())
        );
        let of_attachment = BUOY.packed(Payload::Jpeg).schema();
        assert_eq!(of_attachment["description"], "Where a buoy is. This is the schema of the attachment.");
    }

    #[test]
    fn a_field_without_a_value_is_left_out() {
        let buoy = |depth_m| message_json(&Buoy { at_m: [1.0, 2.0], depth_m, k: 3 }).unwrap();
        assert_eq!(buoy(None), json!({"at_m": [1.0, 2.0], "k": 3}));
        assert_eq!(buoy(Some(1.0)), json!({"at_m": [1.0, 2.0], "depth_m": 1.0, "k": 3}));
    }
}
