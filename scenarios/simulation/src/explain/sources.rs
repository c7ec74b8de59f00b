//! Puts the sources of algorithms, from the rows of the catalogues, beside the fields and variants that name them.

use crate::shape::{Object, SOURCE, WHAT, variant_name};
use serde_json::Value;
use world::catalogue::Entry;

/// Catalogues of things that a scenario names as a variant. Kinds of the registry put their sources themselves.
const VARIANTS: &[&[Entry]] = &[robots::estimate::CATALOGUE, robots::vehicles::CATALOGUE];

/// Catalogues of things that a scenario names as a field, with the type that has the field.
const FIELDS: &[(&str, &[Entry])] = &[
    ("WaterSpec", plumes::flow::OPTIONS),
    ("GantryBlock", robots::sense::PARTS),
    ("RobotSpec", robots::actuate::CATALOGUE),
    ("CrabSpec", robots::track::UNITS),
    ("ColourSpec", eyes::vision::CATALOGUE),
    ("VerifierSpec", eyes::vision::CATALOGUE),
];

/// Puts the sources of a type's fields or variants into its schema.
pub(super) fn add_sources(name: &str, schema: &mut Object) {
    if let Some(Value::Array(variants)) = schema.get_mut("oneOf") {
        for variant in variants.iter_mut().filter_map(Value::as_object_mut) {
            let Some(name) = variant_name(variant) else {
                continue;
            };
            if let Some(row) = row(VARIANTS, &name) {
                say(variant, row);
            }
        }
    }
    let rows = FIELDS.iter().find(|(of, _)| *of == name);
    if let (Some((_, rows)), Some(Value::Object(fields))) = (rows, schema.get_mut("properties")) {
        for (name, field) in fields {
            if let (Some(row), Some(field)) = (row(&[rows], name), field.as_object_mut()) {
                say(field, row);
            }
        }
    }
}

/// Adds source and sentence, unless the type has its own.
fn say(schema: &mut Object, row: &Entry) {
    for (key, text) in [(SOURCE, row.source), (WHAT, row.what)] {
        schema.entry(key).or_insert_with(|| text.into());
    }
}

/// The row of a name; a row may name several fields.
fn row<'a>(catalogues: &[&'a [Entry]], name: &str) -> Option<&'a Entry> {
    let rows = catalogues.iter().flat_map(|rows| rows.iter());
    let mut rows = rows.filter(|row| row.name.split(", ").any(|n| n == name));
    rows.next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_stands_in_two_catalogues() {
        let rows = || VARIANTS.iter().flat_map(|rows| rows.iter());
        for row in rows() {
            let same = rows().filter(|other| other.name == row.name);
            assert_eq!(same.count(), 1, "{}", row.name);
        }
    }
}
