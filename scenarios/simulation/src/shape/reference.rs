//! The parsed form of a JSON Schema: fields, choices and numbers.
//!
//! It knows only the forms of JSON Schema, not how the types are written. A choice is a `oneOf` of names (`const`,
//! `enum`) and of objects with one property, which is the variant's name.

use super::schema::{FILES, LEGAL, ORDER, Object, SOURCE, WHAT};
use serde_json::Value;
use std::collections::BTreeMap;
use world::limits::UNIT;

/// The whole reference.
#[derive(Clone, Debug)]
pub(crate) struct Reference {
    /// The scenario itself.
    pub(crate) root: Shape,
    /// What the scenario itself is.
    pub(crate) what: String,
    /// The other kinds of files, as fields with their names.
    pub(crate) files: Vec<Field>,
    /// The types they are made of, by name.
    pub(crate) types: BTreeMap<String, NamedType>,
}

/// A type that fields refer to.
#[derive(Clone, Debug)]
pub(crate) struct NamedType {
    /// What it is.
    pub(crate) what: String,
    /// What it is made of.
    pub(crate) shape: Shape,
}

/// What may stand in a place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A type of that name.
    Named(String),
    /// A number.
    Number(Number),
    /// Words in quotes.
    Text(Text),
    /// `true` or `false`.
    Truth,
    /// Any number of them.
    List(Box<Shape>),
    /// Values in this order.
    Tuple(Vec<Shape>),
    /// Names with values.
    Fields(Vec<Field>),
    /// One of several.
    Choice(Vec<Variant>),
}

/// A number and its legal range.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Number {
    /// Without a fraction: the least and the greatest.
    pub(crate) whole: Option<(i128, i128)>,
    /// Least.
    pub(crate) low: Option<f64>,
    /// The number that it must exceed.
    pub(crate) above: Option<f64>,
    /// Greatest.
    pub(crate) high: Option<f64>,
    /// The number that it must not reach.
    pub(crate) below: Option<f64>,
    /// Unit; empty for a pure number.
    pub(crate) unit: String,
}

/// A text.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Text {
    /// The pattern that it must match.
    pub(crate) pattern: Option<String>,
    /// What it may be, in words.
    pub(crate) legal: Option<String>,
    /// Most characters.
    pub(crate) longest: Option<u64>,
}

/// A field.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Field {
    /// Its name as written in RON.
    pub(crate) name: String,
    /// What it means.
    pub(crate) what: String,
    /// The publication that it follows.
    pub(crate) source: Option<String>,
    /// What may stand there.
    pub(crate) shape: Shape,
    /// The value if it is left out; `null` for none.
    pub(crate) default: Option<Value>,
    /// It cannot be left out.
    pub(crate) required: bool,
    /// It may be `None`.
    pub(crate) optional: bool,
}

/// One of a choice.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variant {
    /// As written in RON.
    pub(crate) name: String,
    /// What it means.
    pub(crate) what: String,
    /// Where it comes from.
    pub(crate) source: Option<String>,
    /// What stands in its parentheses.
    pub(crate) holds: Option<Shape>,
}

impl Reference {
    /// From a schema.
    pub(crate) fn from_schema(schema: &Value) -> Self {
        let named = |schema: &Value| NamedType { what: what(schema), shape: shape(schema) };
        let types = schema["$defs"].as_object().into_iter().flatten();
        let NamedType { what, shape: root } = named(schema);
        Self {
            root,
            what,
            files: fields(&schema[FILES]),
            types: types.map(|(name, s)| (name.clone(), named(s))).collect(),
        }
    }

    /// The shape itself, if it is the name of one.
    pub(crate) fn resolved<'a>(&'a self, shape: &'a Shape) -> &'a Shape {
        match shape {
            Shape::Named(name) => self.resolved(&self.types[name].shape),
            other => other,
        }
    }
}

/// Name of a variant, if the schema is that of one with a single name.
pub(crate) fn variant_name(variant: &Object) -> Option<String> {
    if let Some(Value::String(name)) = variant.get("const") {
        return Some(name.clone());
    }
    let fields = variant.get("properties")?.as_object()?;
    (fields.len() == 1).then(|| fields.keys().next().cloned()).flatten()
}

fn shape(schema: &Value) -> Shape {
    if let Some(Value::String(path)) = schema.get("$ref") {
        let name = path.rsplit('/').next().unwrap_or(path);
        return Shape::Named(name.to_string());
    }
    if let Some(Value::Array(all)) = schema.get("anyOf") {
        // One of them is `null`, because the field may be left out.
        let given = all.iter().find(|s| s["type"] != "null");
        return given.map_or(Shape::Truth, shape);
    }
    if let Some(Value::Array(variants)) = schema.get("oneOf") {
        return Shape::Choice(variants.iter().flat_map(variant).collect());
    }
    if let Some(Value::Array(names)) = schema.get("enum") {
        return Shape::Choice(names.iter().filter_map(bare).collect());
    }
    let kind = match &schema["type"] {
        Value::Array(kinds) => kinds.iter().find(|k| *k != "null"),
        kind => Some(kind),
    };
    match kind.and_then(Value::as_str) {
        Some("object") => Shape::Fields(fields(schema)),
        Some("array") => array(schema),
        Some("string") => Shape::Text(Text {
            pattern: text(schema, "pattern"),
            legal: text(schema, LEGAL),
            longest: schema["maxLength"].as_u64(),
        }),
        Some("boolean") => Shape::Truth,
        kind => Shape::Number(number(schema, kind == Some("integer"))),
    }
}

fn variant(schema: &Value) -> Vec<Variant> {
    if schema["type"] == "integer" {
        // A choice that may also be a bare number.
        return vec![Variant {
            name: "number".to_string(),
            what: what(schema),
            source: None,
            holds: Some(shape(schema)),
        }];
    }
    if let Some(Value::Array(names)) = schema.get("enum") {
        return names.iter().filter_map(bare).collect();
    }
    let Some(name) = schema.as_object().and_then(variant_name) else {
        return Vec::new();
    };
    vec![Variant {
        what: what(schema),
        source: text(schema, SOURCE),
        holds: schema.get("properties").map(|p| shape(&p[&name])),
        name,
    }]
}

fn bare(name: &Value) -> Option<Variant> {
    name.as_str().map(|name| Variant { name: name.to_string(), what: String::new(), source: None, holds: None })
}

fn fields(schema: &Value) -> Vec<Field> {
    let required = names(schema, "required");
    let mut order = names(schema, ORDER);
    let all = schema["properties"].as_object();
    // Fields without a place in the order come last.
    for name in all.into_iter().flat_map(|all| all.keys()) {
        if !order.contains(&name.as_str()) {
            order.push(name);
        }
    }
    let field = |name: &str| {
        let own = all?.get(name)?;
        Some(Field {
            name: name.to_string(),
            what: what(own),
            source: text(own, SOURCE),
            shape: shape(own),
            default: own.get("default").cloned(),
            required: required.contains(&name),
            optional: is_optional(own),
        })
    };
    order.into_iter().filter_map(field).collect()
}

fn is_optional(schema: &Value) -> bool {
    let kinds = schema["type"].as_array().into_iter().flatten();
    let some = schema["anyOf"].as_array().into_iter().flatten().map(|s| &s["type"]);
    kinds.chain(some).any(|kind| kind == "null")
}

fn names<'a>(schema: &'a Value, key: &str) -> Vec<&'a str> {
    let names = schema[key].as_array().into_iter().flatten();
    names.filter_map(Value::as_str).collect()
}

fn array(schema: &Value) -> Shape {
    if let Some(Value::Array(parts)) = schema.get("prefixItems") {
        return Shape::Tuple(parts.iter().map(shape).collect());
    }
    let item = shape(&schema["items"]);
    match (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
        (Some(least), Some(most)) if least == most => Shape::Tuple((0..most).map(|_| item.clone()).collect()),
        _ => Shape::List(Box::new(item)),
    }
}

fn number(schema: &Value, whole: bool) -> Number {
    let only = schema["const"].as_f64();
    Number {
        whole: whole.then(|| whole_range(schema)),
        low: only.or(schema["minimum"].as_f64()),
        above: schema["exclusiveMinimum"].as_f64(),
        high: only.or(schema["maximum"].as_f64()),
        below: schema["exclusiveMaximum"].as_f64(),
        unit: text(schema, UNIT).unwrap_or_default(),
    }
}

/// The range that the type of a whole number can hold, within the bounds that the schema states.
fn whole_range(schema: &Value) -> (i128, i128) {
    let (least, most) = match schema["format"].as_str() {
        Some("uint8") => (0, u8::MAX.into()),
        Some("uint16") => (0, u16::MAX.into()),
        Some("uint32") => (0, u32::MAX.into()),
        Some("int8") => (i8::MIN.into(), i8::MAX.into()),
        Some("int16") => (i16::MIN.into(), i16::MAX.into()),
        Some("int32") => (i32::MIN.into(), i32::MAX.into()),
        Some("int64" | "int") => (i64::MIN.into(), i64::MAX.into()),
        _ => (0, u64::MAX.into()),
    };
    let stated = |key: &str| schema[key].as_i64().map(i128::from);
    (stated("minimum").map_or(least, |v| v.max(least)), stated("maximum").map_or(most, |v| v.min(most)))
}

fn text(schema: &Value, key: &str) -> Option<String> {
    schema[key].as_str().map(str::to_string)
}

/// The meaning: the type's own words, and the catalogue's if they say more.
fn what(schema: &Value) -> String {
    let own = schema["description"].as_str().map(plain);
    let listed = schema[WHAT].as_str().map(sentence);
    match (own, listed) {
        (Some(own), Some(listed)) => {
            // For an algorithm the catalogue's sentence is enough; for a field of a part it is added.
            let variant = schema["properties"].is_object() || schema["const"].is_string();
            let again = listed.starts_with(own.trim_end_matches('.'));
            if variant || again { listed } else { format!("{own} {listed}") }
        }
        (Some(one), None) | (None, Some(one)) => one,
        (None, None) => String::new(),
    }
}

/// The text as a sentence, with a capital letter and a full stop.
fn sentence(s: &str) -> String {
    let mut letters = s.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    let end = if s.ends_with('.') { "" } else { "." };
    first + letters.as_str() + end
}

/// A doc comment as one line of plain text, without the brackets of links.
fn plain(doc: &str) -> String {
    let words: Vec<&str> = doc.split_whitespace().collect();
    words.join(" ").replace("[`", "`").replace("`]", "`")
}
