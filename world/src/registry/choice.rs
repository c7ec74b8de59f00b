//! What stands in a scenario where something is chosen by name.

use super::kind::Name;
use super::read::{IsNone, from_text};
use super::{Kind, Registry, Row, Spec, Takes};
use serde::de::DeserializeSeed;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::ops::{Deref, DerefMut};

/// One thing of a kind with its parameters. In files it is an enum: the name, and the parameters in parentheses.
pub struct Choice<K: Kind>(Box<K::Spec>);

/// A kind with a thing for those who do not choose.
pub trait Standard: Kind {
    /// That thing with its standard parameters.
    fn standard() -> Choice<Self>;
}

impl<K: Kind> Choice<K> {
    /// The thing with these parameters.
    pub fn new<S>(spec: S) -> Self
    where
        K: Takes<S>,
    {
        Self(K::boxed(spec))
    }

    /// Its name, as in RON.
    pub fn name(&self) -> &'static str {
        self.0.entry().name
    }

    /// Whether it comes from another crate than the program's.
    pub fn is_own(&self) -> bool {
        K::built_in().iter().all(|row| row.entry.name != self.name())
    }

    /// Its parameters without the name, to be written.
    pub(super) fn parameters(&self) -> Parameters<'_, K::Spec> {
        Parameters(&self.0)
    }

    /// Its parameters, if they are `S`.
    pub fn get<S: 'static>(&self) -> Option<&S> {
        self.0.as_any().downcast_ref()
    }

    /// The same, to change them.
    pub fn get_mut<S: 'static>(&mut self) -> Option<&mut S> {
        self.0.as_any_mut().downcast_mut()
    }
}

impl<K: Kind> Deref for Choice<K> {
    type Target = K::Spec;
    fn deref(&self) -> &K::Spec {
        &self.0
    }
}

impl<K: Kind> DerefMut for Choice<K> {
    fn deref_mut(&mut self) -> &mut K::Spec {
        &mut self.0
    }
}

impl<K: Standard> Default for Choice<K> {
    fn default() -> Self {
        K::standard()
    }
}

impl<K: Kind> Clone for Choice<K> {
    fn clone(&self) -> Self {
        Self(dyn_clone::clone_box(&*self.0))
    }
}

impl<K: Kind> PartialEq for Choice<K> {
    fn eq(&self, other: &Self) -> bool {
        self.0.same(other.0.as_any())
    }
}

impl<K: Kind> fmt::Debug for Choice<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple(self.name()).field(&&self.0).finish()
    }
}

/// The parameters without the name.
pub(super) struct Parameters<'s, T: ?Sized>(&'s T);

impl<T: ?Sized + Spec> Serialize for Parameters<'_, T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        erased_serde::serialize(self.0, to)
    }
}

impl<K: Kind> Serialize for Choice<K> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        // Names alone are read again: the number says nothing.
        to.serialize_newtype_variant(K::NAME, 0, self.name(), &self.parameters())
    }
}

impl<'de, K: Kind> Deserialize<'de> for Choice<K> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from_text(from, |from| {
            let row = Name(&Registry::now().rows::<K>()).deserialize(&mut *from)?;
            (row.read)(from).map(Choice)
        })
    }
}

/// Reads a field of a struct whose fields are the things of a kind.
impl<'de, K: Kind> DeserializeSeed<'de> for Row<K> {
    type Value = Option<Choice<K>>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Self::Value, D::Error> {
        from_text(from, |from| match from.deserialize_identifier(IsNone) {
            Ok(true) => Ok(None),
            // `Some` before the parentheses, or nothing.
            _ => (self.read)(from).map(|spec| Some(Choice(spec))),
        })
    }
}
