//! The JSON Schema of a scenario file, and of other kinds of files beside it. Most of it is derived from the types;
//! units, sources and the order of the fields are added.
//!
//! Keys of our own are `x-unit` for numbers, `x-source` and `x-what` for algorithms, and `x-order` for the order of the
//! fields in the type, because JSON objects have no order.

use super::kind::FileKind;
use super::sources;
use super::units;
use crate::scenario::Scenario;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};

/// A JSON object.
pub(super) type Object = Map<String, Value>;

/// Key of the order of the fields.
pub(super) const ORDER: &str = "x-order";
/// Key of the other kinds of files: an object with a property for each.
pub(super) const FILES: &str = "x-files";
/// Key of the source of an algorithm.
pub(super) const SOURCE: &str = "x-source";
/// Key of the catalogue's sentence about an algorithm.
pub(super) const WHAT: &str = "x-what";

/// The whole schema, with other kinds of files beside the scenario.
pub(super) fn schema(kinds: &[FileKind]) -> Value {
    let settings = SchemaSettings::draft2020_12;
    let mut read = root(settings().for_deserialize(), kinds);
    // The schema for writing lists every field as required, in the order of the type.
    let written = root(settings().for_serialize(), kinds);
    put_order(&mut read, &written);
    if let Some(types) = read.get_mut("$defs").and_then(Value::as_object_mut) {
        for (name, schema) in types {
            if let Some(schema) = schema.as_object_mut() {
                sources::add_sources(name, schema);
                units::add_units(name, schema);
            }
        }
    }
    if let Some(whole) = read.as_object_mut() {
        whole.insert("title".into(), "A scenario of rheotaxis".into());
        units::add_units("Scenario", whole);
    }
    sorted(read)
}

/// The schema of a scenario; the types of all kinds are defined in it.
fn root(settings: SchemaSettings, kinds: &[FileKind]) -> Value {
    let mut types = settings.into_generator();
    let mut files = Map::new();
    for kind in kinds {
        let mut file = (kind.schema)(&mut types).to_value();
        file["description"] = kind.what.into();
        files.insert(kind.name.into(), file);
    }
    let mut root = types.into_root_schema_for::<Scenario>().to_value();
    if !kinds.is_empty() {
        let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
        root[FILES] = json!({ "properties": files, ORDER: names });
    }
    root
}

/// Puts the order of the fields into a schema and those in it.
fn put_order(schema: &mut Value, written: &Value) {
    match (schema, written) {
        (Value::Object(schema), Value::Object(written)) => {
            for (key, inner) in schema.iter_mut() {
                if let Some(written) = written.get(key) {
                    put_order(inner, written);
                }
            }
            let several = schema.get("properties").and_then(Value::as_object);
            if several.is_some_and(|fields| fields.len() > 1)
                && let Some(order) = written.get("required")
            {
                schema.insert(ORDER.into(), order.clone());
            }
        }
        (Value::Array(schemas), Value::Array(written)) => {
            for (schema, written) in schemas.iter_mut().zip(written) {
                put_order(schema, written);
            }
        }
        _ => {}
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
