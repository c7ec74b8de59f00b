//! The JSON Schema of a scenario file. Most of it is derived from the types; units, sources and the order of the fields
//! are added.
//!
//! Keys of our own are `x-unit` for numbers, `x-source` and `x-what` for algorithms, and `x-order` for the order of the
//! fields in the type, because JSON objects have no order.

use super::sources;
use super::units;
use crate::scenario::Scenario;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};

/// A JSON object.
pub(super) type Object = Map<String, Value>;

/// Key of the order of the fields.
pub(super) const ORDER: &str = "x-order";
/// Key of the source of an algorithm.
pub(super) const SOURCE: &str = "x-source";
/// Key of the catalogue's sentence about an algorithm.
pub(super) const WHAT: &str = "x-what";

/// The whole schema.
pub(super) fn schema() -> Value {
    let settings = SchemaSettings::draft2020_12;
    let read = settings().for_deserialize().into_generator();
    let mut read = read.into_root_schema_for::<Scenario>().to_value();
    // The schema for writing lists every field as required, in the order of the type.
    let written = settings().for_serialize().into_generator();
    let written = written.into_root_schema_for::<Scenario>().to_value();
    put_order(&mut read, &written);
    if let Some(types) = read.get_mut("$defs").and_then(Value::as_object_mut) {
        for (name, schema) in types {
            if let Some(ordered) = written["$defs"].get(name) {
                put_order(schema, ordered);
            }
            if let Some(schema) = schema.as_object_mut() {
                sources::put(name, schema);
                units::put(name, schema);
            }
        }
    }
    if let Some(whole) = read.as_object_mut() {
        whole.insert("title".into(), "A scenario of rheotaxis".into());
        units::put("Scenario", whole);
    }
    sorted(read)
}

fn put_order(schema: &mut Value, written: &Value) {
    if let (Some(schema), Some(order)) = (schema.as_object_mut(), written.get("required"))
        && schema.contains_key("properties")
    {
        schema.insert(ORDER.into(), order.clone());
    }
}

/// The value with its keys in alphabetical order, whatever features the JSON library was built with.
fn sorted(value: Value) -> Value {
    match value {
        Value::Object(fields) => {
            let mut fields: Vec<_> = fields.into_iter().map(|(k, v)| (k, sorted(v))).collect();
            fields.sort_by(|(a, _), (b, _)| a.cmp(b));
            Value::Object(fields.into_iter().collect())
        }
        Value::Array(items) => Value::Array(items.into_iter().map(sorted).collect()),
        one => one,
    }
}
