//! What may stand in a file: fields, choices, numbers and their ranges, from the types that read it.
//!
//! `schema` makes the JSON Schema of a type, and [`Reference`] is its parsed form. The reader of files checks a text
//! against it, and `explain` writes it for people.

mod kind;
mod reference;
mod schema;

pub use kind::FileKind;
pub(crate) use kind::VEHICLE;
pub(crate) use reference::{Field, NamedType, Number, Reference, Shape, Text, Variant, variant_name};
pub(crate) use schema::{Object, SOURCE, WHAT, schema};
