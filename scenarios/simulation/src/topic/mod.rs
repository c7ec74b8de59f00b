//! Topics: named values that a run publishes, and the tables that describe them.
//!
//! A [`Topic`] is a row of a table: name, key, meaning, rate and fields. From it come the JSON Schema that a run
//! publishes and the text of `rheotaxis topics`. A system publishes a value with [`Topics::publish`]. Live state puts
//! it under `rheotaxis/<run>/<key>`, the recording keeps it as JSON, and the summary shows the last one.
//!
//! Publishing never changes a result: no system of the tick reads what was published.

mod publish;
pub mod run;

pub use publish::{TopicValue, Topics};

use robots::handoff::{Behaviour, GantryBehaviour};
use serde_json::{Map, Value, json};

/// The version of JSON Schema.
const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

/// Type of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldKind {
    /// A number.
    Number,
    /// A whole number, not negative.
    Count,
    /// True or false.
    Flag,
    /// Text.
    Text,
    /// A behaviour's name: one of ours, or one that a strategy of another crate gives its own.
    Behaviour,
    /// A gantry's behaviour.
    GantryBehaviour,
    /// One of these words.
    Word(&'static [&'static str]),
    /// A fixed number of numbers.
    Vector(usize),
    /// Any number of (east, north).
    Points,
    /// Any number of (east, north, up).
    Places,
    /// Any number of numbers.
    Numbers,
    /// Any number of truth values.
    Flags,
    /// Any number of words.
    Words,
    /// An object of its own form.
    Object,
    /// Any number of them.
    Objects,
}

impl FieldKind {
    fn schema(self) -> Map<String, Value> {
        let vector = |n: usize| json!({"type": "array", "items": {"type": "number"}, "minItems": n, "maxItems": n});
        let schema = match self {
            FieldKind::Number => json!({"type": "number"}),
            FieldKind::Count => json!({"type": "integer", "minimum": 0}),
            FieldKind::Flag => json!({"type": "boolean"}),
            FieldKind::Text => json!({"type": "string"}),
            FieldKind::Behaviour => {
                let ours = json!({"type": "string", "enum": Behaviour::ALL.map(Behaviour::name)});
                let others = json!({"type": "string", "pattern": "^[a-z0-9_]+$"});
                json!({"type": "string", "anyOf": [ours, others]})
            }
            FieldKind::GantryBehaviour => {
                json!({"type": "string", "enum": GantryBehaviour::ALL.map(GantryBehaviour::name)})
            }
            FieldKind::Word(words) => json!({"type": "string", "enum": words}),
            FieldKind::Vector(n) => vector(n),
            FieldKind::Points => json!({"type": "array", "items": vector(2)}),
            FieldKind::Places => json!({"type": "array", "items": vector(3)}),
            FieldKind::Numbers => json!({"type": "array", "items": {"type": "number"}}),
            FieldKind::Flags => json!({"type": "array", "items": {"type": "boolean"}}),
            FieldKind::Words => json!({"type": "array", "items": {"type": "string"}}),
            FieldKind::Object => json!({"type": "object"}),
            FieldKind::Objects => json!({"type": "array", "items": {"type": "object"}}),
        };
        match schema {
            Value::Object(fields) => fields,
            _ => Map::new(),
        }
    }
}

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name, with its unit.
    pub name: &'static str,
    /// Type.
    pub kind: FieldKind,
    /// Always present; otherwise the field is omitted if it has no value.
    pub required: bool,
    /// What it means.
    pub what: &'static str,
}

impl Field {
    /// A field that every message has.
    #[must_use]
    pub const fn always(name: &'static str, kind: FieldKind, what: &'static str) -> Self {
        Self { name, kind, required: true, what }
    }

    /// A field that a message has only if there is a value.
    #[must_use]
    pub const fn sometimes(name: &'static str, kind: FieldKind, what: &'static str) -> Self {
        Self { name, kind, required: false, what }
    }
}

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

/// A topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Topic {
    /// Name of its schema.
    pub name: &'static str,
    /// Key below `rheotaxis/<run>/`.
    pub key: &'static str,
    /// What it contains.
    pub what: &'static str,
    /// How often it is published.
    pub rate: &'static str,
    /// Its encoding.
    pub payload: Payload,
    /// Fields of the payload, or of the attachment if the payload is packed.
    pub fields: &'static [Field],
}

impl Topic {
    /// A topic whose messages are JSON objects with these fields. Give every message the time `t_s`, and put the unit
    /// into the name of each field.
    #[must_use]
    pub const fn json(
        name: &'static str,
        key: &'static str,
        rate: &'static str,
        what: &'static str,
        fields: &'static [Field],
    ) -> Self {
        Self { name, key, what, rate, payload: Payload::Json, fields }
    }

    /// JSON Schema (draft 2020-12) of the payload, or of the attachment if the payload is packed.
    #[must_use]
    pub fn schema(&self) -> Value {
        if self.payload == Payload::Schema {
            return json!({
                "$schema": DRAFT, "title": self.name, "description": self.what, "type": "object",
                "required": ["$schema", "title", "description", "type"],
            });
        }
        let properties: Map<String, Value> = self
            .fields
            .iter()
            .map(|field| {
                let mut schema = field.kind.schema();
                schema.insert("description".into(), field.what.into());
                (field.name.to_owned(), Value::Object(schema))
            })
            .collect();
        let required: Vec<&str> = self.fields.iter().filter(|f| f.required).map(|f| f.name).collect();
        let what = match self.payload {
            Payload::PackedF32 | Payload::Jpeg => {
                format!("{} This is the schema of the attachment.", self.what)
            }
            _ => self.what.to_owned(),
        };
        json!({
            "$schema": DRAFT, "title": self.name, "description": what, "type": "object",
            "properties": properties, "required": required, "additionalProperties": false,
        })
    }
}

/// A name as a part of a key: everything but `a-z`, `0-9` and `_` becomes `_`.
#[must_use]
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

/// The fields of two JSON objects in one.
pub(crate) fn merged(a: Value, b: Value) -> Value {
    let fields = |v| match v {
        Value::Object(fields) => fields,
        _ => Map::new(),
    };
    fields(a).into_iter().chain(fields(b)).collect()
}

/// A JSON object with one more number, if there is one.
#[must_use]
pub fn with(object: Value, name: &str, number: Option<f64>) -> Value {
    match number {
        Some(number) => merged(object, json!({ name: number })),
        None => object,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strategies of other crates name behaviours only when they run, so no list holds them all.
    #[test]
    fn behaviours_of_other_crates_are_allowed_by_their_form() {
        let schema = FieldKind::Behaviour.schema();
        let [ours, others] = [0, 1].map(|k| &schema["anyOf"][k]);
        assert_eq!(ours["enum"][0], "idle");
        assert_eq!(others["pattern"], "^[a-z0-9_]+$");
        assert!(schema.get("enum").is_none());
    }

    #[test]
    fn a_schema_lists_its_fields() {
        let clock = run::CLOCK[0].schema();
        assert_eq!(clock["required"], json!(["t_s", "step", "ended", "sent", "superseded"]));
        assert_eq!(clock["properties"]["step"]["type"], "integer");
        assert_eq!(clock["additionalProperties"], false);
    }
}
