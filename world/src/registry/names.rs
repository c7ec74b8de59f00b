//! The names under which the rows of a kind stand in files, and the reader of one name.

use super::{Kind, Registry, Row};
use serde::Deserializer;
use serde::de::{DeserializeSeed, Error, Visitor};
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// Every list that was asked for, once: as many as there are kinds and registries.
static LISTS: Mutex<Vec<&'static [&'static str]>> = Mutex::new(Vec::new());

/// The same names for as long as the program runs: readers of files ask for that.
fn kept(names: &[&'static str]) -> &'static [&'static str] {
    let mut lists = LISTS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(list) = lists.iter().find(|l| **l == names) {
        return list;
    }
    let list: &'static [&'static str] = Vec::leak(names.to_vec());
    lists.push(list);
    list
}

/// The rows of a kind with their names.
pub(super) struct NamedRows<K: Kind> {
    pub(super) rows: Vec<Row<K>>,
    pub(super) legal: &'static [&'static str],
}

impl<K: Kind> NamedRows<K> {
    /// Those of the registry in use.
    pub(super) fn now() -> Self {
        let rows = Registry::now().rows::<K>();
        let legal: Vec<&'static str> = rows.iter().map(|r| r.entry.name).collect();
        Self { legal: kept(&legal), rows }
    }

    /// The reader of a name that stands there.
    pub(super) fn name(&self, place: NamePlace) -> Name<'_, K> {
        Name { known: self, place }
    }
}

/// Where a name stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum NamePlace {
    /// It is chosen among others.
    Variant,
    /// It names the field of a struct.
    Field,
}

/// Reads a name, and finds its row.
pub(super) struct Name<'r, K: Kind> {
    known: &'r NamedRows<K>,
    place: NamePlace,
}

impl<'de, K: Kind> DeserializeSeed<'de> for Name<'_, K> {
    type Value = Row<K>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Row<K>, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl<K: Kind> Visitor<'_> for Name<'_, K> {
    type Value = Row<K>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self.place {
            NamePlace::Variant => "a name",
            NamePlace::Field => "field identifier",
        })
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Row<K>, E> {
        let row = self.known.rows.iter().find(|r| r.entry.name == name);
        row.copied().ok_or_else(|| match self.place {
            NamePlace::Variant => E::unknown_variant(name, self.known.legal),
            NamePlace::Field => E::unknown_field(name, self.known.legal),
        })
    }

    fn visit_bytes<E: Error>(self, name: &[u8]) -> Result<Row<K>, E> {
        self.visit_str(&String::from_utf8_lossy(name))
    }
}
