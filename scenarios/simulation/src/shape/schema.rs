//! The JSON Schema of the type of a file, and of other kinds of files beside it.
//!
//! Keys of our own are `x-unit` for numbers, `x-legal` for texts, `x-source` and `x-what` for algorithms, and `x-order`
//! for the order of the fields in the type, because JSON objects have no order.

use super::kind::FileKind;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};
use world::registry::Registry;

/// A JSON object.
pub(crate) type Object = Map<String, Value>;

/// Key of the order of the fields.
pub(super) const ORDER: &str = "x-order";
/// Key of the other kinds of files: an object with a property for each.
pub(super) const FILES: &str = "x-files";
/// Key of the words for what a text may be.
pub(super) const LEGAL: &str = "x-legal";
/// Key of the source of an algorithm.
pub(crate) const SOURCE: &str = "x-source";
/// Key of the catalogue's sentence about an algorithm.
pub(crate) const WHAT: &str = "x-what";

/// The schema of a `T`, with other kinds of files beside it.
pub(crate) fn schema<T: JsonSchema>(registry: &Registry, kinds: &[FileKind]) -> Value {
    let settings = SchemaSettings::draft2020_12;
    let mut read = root::<T>(registry, settings().for_deserialize(), kinds);
    // The schema for writing lists every field as required, in the order of the type.
    let written = root::<T>(registry, settings().for_serialize(), kinds);
    put_order(&mut read, &written);
    read
}

/// The schema of a `T`; the types of all kinds are defined in it.
fn root<T: JsonSchema>(registry: &Registry, settings: SchemaSettings, kinds: &[FileKind]) -> Value {
    let schemas: Vec<_> = kinds.iter().map(|kind| kind.schema).collect();
    let (root, others) = registry.schema::<T>(settings, &schemas);
    let mut root = root.to_value();
    if !kinds.is_empty() {
        let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
        let mut files = Map::new();
        for (kind, schema) in kinds.iter().zip(others) {
            let mut file = schema.to_value();
            file["description"] = kind.what.into();
            files.insert(kind.name.into(), file);
        }
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
