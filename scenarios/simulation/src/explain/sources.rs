//! Where algorithms come from: the rows of the catalogues, put beside the fields and variants that name them.

use super::schema::{Object, SOURCE, WHAT};
use serde_json::Value;
use world::catalogue::Entry;

/// Catalogues of what a scenario names as a variant; kinds of the registry say it themselves.
const VARIANTS: &[&[Entry]] = &[robots::estimate::CATALOGUE, robots::vehicles::CATALOGUE];

/// Catalogues of what it names as a field, and the type that has the field.
const FIELDS: &[(&str, &[Entry])] = &[
    ("WaterSpec", plumes::flow::OPTIONS),
    ("GantryBlock", robots::sense::PARTS),
    ("RobotSpec", robots::actuate::CATALOGUE),
    ("CrabSpec", robots::track::UNITS),
    ("ColourSpec", robots::vision::CATALOGUE),
    ("VerifierSpec", robots::vision::CATALOGUE),
];

/// Puts what is known of the fields or variants of a type into its schema.
pub(super) fn put(name: &str, schema: &mut Object) {
    if let Some(Value::Array(variants)) = schema.get_mut("oneOf") {
        for variant in variants.iter_mut().filter_map(Value::as_object_mut) {
            let Some(name) = super::read::variant_name(variant) else {
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

/// What a type says of itself stays.
fn say(schema: &mut Object, row: &Entry) {
    for (key, text) in [(SOURCE, row.source), (WHAT, row.what)] {
        schema.entry(key).or_insert_with(|| text.into());
    }
}

/// A row may name several fields.
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
