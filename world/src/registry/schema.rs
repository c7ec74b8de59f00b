//! What stands in the schema of scenario files where something is chosen by name.

use super::{Choice, Kind, Registry, Set};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value};
use std::borrow::Cow;

impl<K: Kind> JsonSchema for Choice<K> {
    fn schema_name() -> Cow<'static, str> {
        K::NAME.into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let rows = Registry::now().rows::<K>();
        let variants: Vec<Value> = (rows.iter())
            .map(|row| {
                let (name, parameters) = (row.entry.name, (row.schema)(generator));
                json_schema!({
                    "type": "object",
                    "description": row.entry.what,
                    "x-what": row.entry.what,
                    "x-source": row.entry.source,
                    "properties": { name: parameters },
                    "required": [name],
                    "additionalProperties": false,
                })
                .to_value()
            })
            .collect();
        if variants.is_empty() {
            // `oneOf` of nothing is no legal schema; an `enum` of nothing is one that allows nothing.
            return json_schema!({ "description": K::WHAT.trim(), "enum": [] });
        }
        json_schema!({ "description": K::WHAT.trim(), "oneOf": variants })
    }
}

impl<K: Kind> JsonSchema for Set<K> {
    fn schema_name() -> Cow<'static, str> {
        K::NAME.into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let rows = Registry::now().rows::<K>();
        let fields: Map<String, Value> = (rows.iter())
            .map(|row| {
                let parameters = (row.schema)(generator);
                let field = json_schema!({
                    "description": row.entry.what,
                    "x-what": row.entry.what,
                    "x-source": row.entry.source,
                    "anyOf": [parameters, { "type": "null" }],
                    "default": null,
                });
                (row.entry.name.to_string(), field.to_value())
            })
            .collect();
        json_schema!({
            "description": K::WHAT.trim(),
            "type": "object",
            "properties": fields,
            "additionalProperties": false,
        })
    }
}
