//! A kind of file that a user writes beside a scenario, by the type that reads it.

use robots::vehicles::VehicleFile;
use schemars::{JsonSchema, Schema, SchemaGenerator};

/// A kind of file whose fields can be explained.
#[derive(Clone, Copy, Debug)]
pub struct FileKind {
    /// First word of its paths. No block of a scenario has this name.
    pub(super) name: &'static str,
    /// What it is, in one sentence.
    pub(super) what: &'static str,
    /// The schema of the type that reads it.
    pub(super) schema: fn(&mut SchemaGenerator) -> Schema,
}

impl FileKind {
    /// The kind of file that is read as a `T`: its paths begin with `name`.
    pub const fn new<T: JsonSchema>(name: &'static str, what: &'static str) -> Self {
        Self { name, what, schema: SchemaGenerator::subschema_for::<T> }
    }
}

/// The file of a vehicle's folder.
pub(crate) const VEHICLE: FileKind =
    FileKind::new::<VehicleFile>("vehicle", "The `vehicle.ron` in the folder of a vehicle of your own.");
