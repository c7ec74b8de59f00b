//! Kinds of things that are chosen by name, their rows, and what all things of all kinds can do.

use super::read::Parameters;
use crate::catalogue::Entry;
use dyn_clone::DynClone;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserializer;
use serde::de::{DeserializeOwned, DeserializeSeed, Visitor};
use std::any::Any;
use std::fmt::{self, Debug};

/// A place in a scenario where one of several things stands by its name. Made by [`kind!`](crate::kind).
pub trait Kind: Sized + 'static {
    /// What each of its things can do: a trait object.
    type Spec: ?Sized + Spec;
    /// Its name to readers and writers of files.
    const NAME: &'static str;
    /// Its heading in lists.
    const HEADING: &'static str;
    /// What it is for, in one or two sentences.
    const WHAT: &'static str;

    /// The rows that come with the program, in the order of lists.
    fn built_in() -> Vec<Row<Self>>;
}

/// A kind that takes parameters `S`. [`kind!`](crate::kind) says it of all that implement the kind's trait.
pub trait Takes<S>: Kind {
    /// The parameters as what the kind's things can do.
    fn boxed(spec: S) -> Box<Self::Spec>;
}

/// Parameters that a scenario can ask for by name.
pub trait Listed {
    /// Name as written in RON, one sentence, source.
    const ENTRY: Entry;
}

/// What the parameters of anything that is chosen by name can do; the trait of each kind builds on it. It comes by itself with
/// the derives of a plain struct and [`Listed`].
pub trait Spec: Debug + Send + Sync + DynClone + erased_serde::Serialize {
    /// Name as written in RON, one sentence, source.
    fn entry(&self) -> Entry;
    /// The parameters, for those who know their type.
    fn as_any(&self) -> &dyn Any;
    /// The same, to change them.
    fn as_any_mut(&mut self) -> &mut dyn Any;
    /// Whether these are the same parameters.
    fn same(&self, other: &dyn Any) -> bool;
}

impl<S> Spec for S
where
    S: Listed + Debug + Clone + PartialEq + serde::Serialize + Send + Sync + 'static,
{
    fn entry(&self) -> Entry {
        S::ENTRY
    }

    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn same(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<S>() == Some(self)
    }
}

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

impl<K: Kind> Debug for Row<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple(K::NAME).field(&self.entry).finish()
    }
}

/// Reads a name, and finds its row.
pub(super) struct Name<'r, K: Kind>(pub(super) &'r [Row<K>]);

impl<'de, K: Kind> DeserializeSeed<'de> for Name<'_, K> {
    type Value = Row<K>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Row<K>, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl<K: Kind> Visitor<'_> for Name<'_, K> {
    type Value = Row<K>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a name")
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Row<K>, E> {
        let known = || self.0.iter().map(|row| row.entry.name).collect::<Vec<_>>().join(", ");
        let row = self.0.iter().find(|row| row.entry.name == name);
        row.copied().ok_or_else(|| E::custom(format!("there is no `{name}`; there are: {}", known())))
    }
}
