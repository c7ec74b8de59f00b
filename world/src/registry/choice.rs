//! What stands in a scenario where something is chosen by name.

use super::{Kind, Registry, Row, Spec, Standard, Takes, names};
use serde::de::{DeserializeSeed, EnumAccess, Error, VariantAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::ops::{Deref, DerefMut};

/// One thing of a kind with its parameters. In files it is an enum: the name, and the parameters in parentheses.
pub struct Choice<K: Kind>(Box<K::Spec>);

impl<K: Kind> Choice<K> {
    /// The thing with these parameters.
    #[must_use]
    pub fn new<S>(spec: S) -> Self
    where
        K: Takes<S>,
    {
        Self(K::boxed(spec))
    }

    /// Its name, as in RON.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.0.entry().name
    }

    /// Its parameters without the name, to be written.
    pub(super) fn parameters(&self) -> Parameters<'_, K::Spec> {
        Parameters(&self.0)
    }

    /// Its parameters, if they are `S`.
    #[must_use]
    pub fn get<S: 'static>(&self) -> Option<&S> {
        self.0.as_any().downcast_ref()
    }

    /// The same, to change them.
    #[must_use]
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
        let rows = Registry::now().rows::<K>();
        let legal: Vec<&'static str> = rows.iter().map(|r| r.entry.name).collect();
        let legal = names::kept(&legal);
        from.deserialize_enum(K::NAME, legal, OneOf { rows, legal })
    }
}

/// Reads one of a kind's things.
struct OneOf<K: Kind> {
    rows: Vec<Row<K>>,
    legal: &'static [&'static str],
}

impl<'de, K: Kind> Visitor<'de> for OneOf<K> {
    type Value = Choice<K>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "one of {}", self.legal.join(", "))
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<Choice<K>, A::Error> {
        let (row, parameters) = data.variant_seed(Name(&self))?;
        parameters.newtype_variant_seed(row)
    }
}

/// Reads a name.
struct Name<'r, K: Kind>(&'r OneOf<K>);

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

    fn visit_str<E: Error>(self, name: &str) -> Result<Row<K>, E> {
        let row = self.0.rows.iter().find(|r| r.entry.name == name);
        row.copied()
            .ok_or_else(|| E::unknown_variant(name, self.0.legal))
    }

    fn visit_bytes<E: Error>(self, name: &[u8]) -> Result<Row<K>, E> {
        self.visit_str(&String::from_utf8_lossy(name))
    }
}

impl<'de, K: Kind> DeserializeSeed<'de> for Row<K> {
    type Value = Choice<K>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Choice<K>, D::Error> {
        let mut from = <dyn erased_serde::Deserializer>::erase(from);
        (self.read)(&mut from).map(Choice).map_err(Error::custom)
    }
}
