//! The JSON Schema of a scenario file, and of other kinds of files beside it. Most of it is derived from the types;
//! units and sources are added.

use super::sources;
use super::units;
use crate::scenario::Scenario;
use crate::shape::{self, FileKind};
use serde_json::Value;
use world::registry::Registry;

/// The whole schema, with other kinds of files beside the scenario.
pub(super) fn schema(registry: &Registry, kinds: &[FileKind]) -> Value {
    let mut read = shape::schema::<Scenario>(registry, kinds);
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
