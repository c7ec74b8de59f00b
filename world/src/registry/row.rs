//! A row: one thing of a kind, and how it is read.

use super::read::Parameters;
use super::{Kind, Listed, Takes};
use crate::catalogue::Entry;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;

/// Reads the parameters of a thing.
type Read<K> = for<'de> fn(&mut ron::de::Deserializer<'de>) -> ron::Result<Box<<K as Kind>::Spec>>;

/// One thing of a kind.
pub struct Row<K: Kind> {
    /// Name as written in RON, one sentence, source.
    pub entry: Entry,
    pub(super) read: Read<K>,
    pub(super) schema: fn(&mut SchemaGenerator) -> Schema,
}

impl<K: Kind> Row<K> {
    /// The row of parameters `S`.
    pub fn new<S: Listed + DeserializeOwned + JsonSchema>() -> Self
    where
        K: Takes<S>,
    {
        Self {
            entry: S::ENTRY,
            read: |from| S::deserialize(Parameters(from)).map(K::boxed),
            schema: SchemaGenerator::subschema_for::<S>,
        }
    }
}

impl<K: Kind> Clone for Row<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: Kind> Copy for Row<K> {}

impl<K: Kind> std::fmt::Debug for Row<K> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple(K::NAME).field(&self.entry).finish()
    }
}
