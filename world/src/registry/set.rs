//! What stands in a scenario where several things of a kind are named, each once: a struct with a field for each.

use super::kind::Name;
use super::{Choice, Kind, Registry, Row, Takes};
use serde::de::{Error, MapAccess, Visitor};
use serde::ser::SerializeStruct;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// Things of a kind, each at most once, in the order of the kind's rows. In files it is a struct; a field that is left out, or
/// `None`, is a thing that is not there.
pub struct Set<K: Kind>(Vec<Choice<K>>);

impl<K: Kind> Set<K> {
    /// This thing among the others, in the place of one of its name. What another crate adds comes last.
    #[must_use]
    pub fn with<S>(mut self, spec: S) -> Self
    where
        K: Takes<S>,
    {
        let new = Choice::<K>::new(spec);
        self = self.without(new.name());
        self.0.push(new);
        self.sorted(&K::built_in())
    }

    /// The others without the one of that name.
    #[must_use]
    pub fn without(mut self, name: &str) -> Self {
        self.0.retain(|c| c.name() != name);
        self
    }

    /// Whether there is one of that name.
    pub fn has(&self, name: &str) -> bool {
        self.0.iter().any(|c| c.name() == name)
    }

    /// The one with parameters `S`.
    pub fn get<S: 'static>(&self) -> Option<&S> {
        self.0.iter().find_map(Choice::get)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Choice<K>> {
        self.0.iter()
    }

    fn sorted(mut self, rows: &[Row<K>]) -> Self {
        let place = |c: &Choice<K>| rows.iter().position(|r| r.entry.name == c.name());
        self.0.sort_by_key(|c| place(c).unwrap_or(rows.len()));
        self
    }
}

impl<K: Kind> Default for Set<K> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<K: Kind> Clone for Set<K> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<K: Kind> PartialEq for Set<K> {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<K: Kind> fmt::Debug for Set<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple(K::NAME).field(&self.0).finish()
    }
}

impl<K: Kind> Serialize for Set<K> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut all = to.serialize_struct(K::NAME, self.0.len())?;
        for one in &self.0 {
            all.serialize_field(one.name(), &one.parameters())?;
        }
        all.end()
    }
}

impl<'de, K: Kind> Deserialize<'de> for Set<K> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_struct(K::NAME, &[], Fields(Registry::now().rows()))
    }
}

/// Reads the fields.
struct Fields<K: Kind>(Vec<Row<K>>);

impl<'de, K: Kind> Visitor<'de> for Fields<K> {
    type Value = Set<K>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "struct {}", K::NAME)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Set<K>, A::Error> {
        let mut seen: Vec<&'static str> = Vec::new();
        let mut set = Set::default();
        while let Some(row) = map.next_key_seed(Name(&self.0))? {
            let name = row.entry.name;
            if seen.contains(&name) {
                return Err(Error::duplicate_field(name));
            }
            seen.push(name);
            set.0.extend(map.next_value_seed(row)?);
        }
        Ok(set.sorted(&self.0))
    }
}
