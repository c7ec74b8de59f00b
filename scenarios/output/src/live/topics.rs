//! The published topics: a table with a row for each, and the JSON Schema of each row.
//!
//! `rheotaxis topics` prints the table, and a run publishes each schema under `meta/schema/<name>`.

use super::table::TOPICS;
use robots::handoff::{Behaviour, GantryBehaviour};
use serde_json::{Map, Value, json};

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
        let required: Vec<&str> = self
            .fields
            .iter()
            .filter(|f| f.required)
            .map(|f| f.name)
            .collect();
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

/// Everything a run publishes.
#[must_use]
pub fn topics() -> &'static [Topic] {
    TOPICS
}

const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_keys_are_unique_and_every_field_is_explained() {
        for (i, topic) in TOPICS.iter().enumerate() {
            assert!(
                TOPICS[..i]
                    .iter()
                    .all(|t| t.name != topic.name && t.key != topic.key)
            );
            for (j, field) in topic.fields.iter().enumerate() {
                assert!(
                    topic.fields[..j].iter().all(|f| f.name != field.name),
                    "{}",
                    field.name
                );
                assert!(field.what.ends_with('.'), "{}: {}", topic.name, field.name);
            }
        }
    }

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
        let clock = TOPICS[0].schema();
        assert_eq!(
            clock["required"],
            json!(["t_s", "step", "ended", "sent", "superseded"])
        );
        assert_eq!(clock["properties"]["step"]["type"], "integer");
        assert_eq!(clock["additionalProperties"], false);
    }
}
