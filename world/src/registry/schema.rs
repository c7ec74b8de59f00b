//! What stands in the schema of scenario files where something is chosen by name.

use super::{Choice, Kind, Registry};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::Value;
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
                    "x-source": row.entry.source,
                    "properties": { name: parameters },
                    "required": [name],
                    "additionalProperties": false,
                })
                .to_value()
            })
            .collect();
        json_schema!({ "description": K::HEADING, "oneOf": variants })
    }
}
