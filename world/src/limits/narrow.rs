//! A limit: what it refuses, and what it is in the schema of a field: narrower bounds and the unit, on every number that
//! the field holds.

use crate::ranges::shown;
use schemars::Schema;
use serde_json::{Map, Value};

/// Under this key a schema says the unit of its numbers.
pub const UNIT: &str = "x-unit";

/// A legal range, ends included, with its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range(pub f64, pub f64, pub &'static str);

impl Range {
    /// Why a number is outside.
    pub(super) fn refuses(&self, v: f64) -> Option<String> {
        let Range(low, high, unit) = self;
        // Not `v < low || v > high`, which would accept NaN.
        if v >= *low && v <= *high {
            return None;
        }
        let space = if unit.is_empty() { "" } else { " " };
        Some(format!("must be from {} to {}{space}{unit}, got {}", shown(*low), shown(*high), shown(v)))
    }

    /// Puts the range on every number of a field: itself, or those of a pair, a triple or a list, given or not.
    pub fn narrow(&self, field: &mut Schema) {
        if let Some(field) = field.as_object_mut() {
            self.within(field);
        }
    }

    fn within(&self, field: &mut Map<String, Value>) {
        if is_number(field) {
            self.bound(field);
        }
        for inner in ["items", "prefixItems", "anyOf"] {
            match field.get_mut(inner) {
                Some(Value::Array(parts)) => {
                    let parts = parts.iter_mut().filter_map(Value::as_object_mut);
                    parts.for_each(|part| self.within(part));
                }
                Some(Value::Object(part)) => self.within(part),
                _ => {}
            }
        }
    }

    fn bound(&self, number: &mut Map<String, Value>) {
        let Range(low, high, unit) = *self;
        let said = |number: &Map<String, Value>, key: &str| number.get(key).and_then(Value::as_f64);
        // The type's own bound may be the narrower one: above zero, where the limit begins at zero.
        if said(number, "exclusiveMinimum").is_none_or(|least| low > least) {
            number.remove("exclusiveMinimum");
            let least = said(number, "minimum").map_or(low, |least| least.max(low));
            number.insert("minimum".into(), least.into());
        }
        let most = said(number, "maximum").map_or(high, |most| most.min(high));
        number.insert("maximum".into(), most.into());
        if !unit.is_empty() {
            number.insert(UNIT.into(), unit.into());
        }
    }
}

fn is_number(schema: &Map<String, Value>) -> bool {
    match schema.get("type") {
        Some(Value::String(one)) => one == "number",
        Some(Value::Array(several)) => several.iter().any(|one| one == "number"),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{component_m_s, depth_m, peakedness, solid_m, stream_m_s};
    use crate::ranges::{Finite, NonNegative, Positive};
    use schemars::{JsonSchema, SchemaGenerator};
    use serde_json::json;

    fn narrowed<L: JsonSchema>() -> serde_json::Value {
        SchemaGenerator::default().subschema_for::<L>().to_value()
    }

    #[test]
    fn a_limit_narrows_what_the_type_allows_and_says_the_unit() {
        assert_eq!(
            narrowed::<solid_m<Positive>>(),
            json!({"type": "number", "minimum": 1e-3, "maximum": 1e6, "x-unit": "m"})
        );
        assert_eq!(
            narrowed::<stream_m_s<Positive>>(),
            json!({"type": "number", "exclusiveMinimum": 0.0, "maximum": 15.0, "x-unit": "m/s"})
        );
        assert_eq!(
            narrowed::<component_m_s<NonNegative>>(),
            json!({"type": "number", "minimum": 0.0, "maximum": 15.0, "x-unit": "m/s"})
        );
        assert_eq!(narrowed::<peakedness<Finite>>(), json!({"type": "number", "minimum": 0.1, "maximum": 20.0}));
    }

    #[test]
    fn it_reaches_every_number_of_a_triple_and_one_that_may_be_left_out() {
        let triple = narrowed::<solid_m<(Positive, Positive, Positive)>>();
        assert_eq!(triple["prefixItems"][2]["maximum"], json!(1e6));
        let maybe = narrowed::<depth_m<Option<Positive>>>();
        assert_eq!(maybe["maximum"], json!(12_000.0));
        assert_eq!(maybe["type"], json!(["number", "null"]));
    }
}
