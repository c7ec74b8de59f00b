//! The rows that are known: those that come with the program and those that another crate adds.

use super::read::{self, ReadError};
use super::{Kind, Listed, Row, Takes};
use crate::catalogue::Entry;
use crate::error::WorldError;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;
use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::sync::Arc;

/// A row of any kind.
#[derive(Clone, Debug)]
struct RegistryRow {
    kind: TypeId,
    row: Arc<dyn Any + Send + Sync>,
}

/// What a crate adds to the program: rows of kinds, and things of any other type that a run takes up (such as systems of
/// the tick). By default nothing.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    added: Vec<RegistryRow>,
    carried: Vec<Arc<dyn Any + Send + Sync>>,
}

/// The same rows and things: those of one registry and its copies.
impl PartialEq for Registry {
    fn eq(&self, other: &Self) -> bool {
        let places = |r: &Self| -> Vec<*const ()> {
            let rows = r.added.iter().map(|a| &a.row);
            rows.chain(&r.carried).map(|thing| Arc::as_ptr(thing).cast()).collect()
        };
        places(self) == places(other)
    }
}

thread_local! {
    /// What files are read under on this thread.
    static NOW: RefCell<Registry> = RefCell::default();
}

impl Registry {
    /// These and parameters `S` as a thing of a kind.
    ///
    /// # Errors
    /// [`WorldError::Invalid`] when the kind has a thing of that name.
    pub fn with<K, S>(mut self) -> Result<Self, WorldError>
    where
        K: Takes<S>,
        S: Listed + DeserializeOwned + JsonSchema,
    {
        let name = S::ENTRY.name;
        if self.rows::<K>().iter().any(|r| r.entry.name == name) {
            return Err(WorldError::Invalid {
                field: K::NAME.to_string(),
                problem: format!("there is a `{name}` already; give yours another name"),
            });
        }
        self.added.push(RegistryRow { kind: TypeId::of::<K>(), row: Arc::new(Row::<K>::new::<S>()) });
        Ok(self)
    }

    /// Adds a thing that is not a row. Whoever knows its type finds it with [`Registry::carried`].
    #[must_use]
    pub fn carrying<T: Send + Sync + 'static>(mut self, thing: T) -> Self {
        self.carried.push(Arc::new(thing));
        self
    }

    /// The things of a type, in the order in which they were added.
    pub fn carried<T: Send + Sync + 'static>(&self) -> impl Iterator<Item = &T> {
        self.carried.iter().filter_map(|c| c.downcast_ref())
    }

    /// All things of a kind: those that come with the program first.
    pub fn rows<K: Kind>(&self) -> Vec<Row<K>> {
        let mine = self.added.iter().filter(|a| a.kind == TypeId::of::<K>());
        let mine = mine.filter_map(|a| a.row.downcast_ref::<Row<K>>().copied());
        K::built_in().into_iter().chain(mine).collect()
    }

    /// The same for lists.
    pub fn entries<K: Kind>(&self) -> Vec<Entry> {
        self.rows::<K>().iter().map(|r| r.entry).collect()
    }

    /// Reads a RON text.
    ///
    /// # Errors
    /// The first mistake.
    pub fn read<T: DeserializeOwned>(&self, text: &str) -> Result<T, ReadError> {
        self.scope(|| read::whole(text))
    }

    /// The JSON Schema of a file that is read as a `T`. The schemas of `more` types refer to the same definitions.
    pub fn schema<T: JsonSchema>(
        &self,
        settings: SchemaSettings,
        more: &[fn(&mut SchemaGenerator) -> Schema],
    ) -> (Schema, Vec<Schema>) {
        self.scope(|| {
            let mut types = settings.into_generator();
            let more = more.iter().map(|schema| schema(&mut types)).collect();
            (types.into_root_schema_for::<T>(), more)
        })
    }

    /// Does something on this thread with these rows known. The traits that read a value and make the schema of a type take
    /// no argument, so they look here.
    fn scope<R>(&self, work: impl FnOnce() -> R) -> R {
        /// Puts back what was known before, also if the work panics.
        struct RestoreOnDrop(Registry);
        impl Drop for RestoreOnDrop {
            fn drop(&mut self) {
                NOW.set(std::mem::take(&mut self.0));
            }
        }
        let _before = RestoreOnDrop(NOW.replace(self.clone()));
        work()
    }

    /// The rows known on this thread now.
    pub(super) fn now() -> Self {
        NOW.with_borrow(Clone::clone)
    }
}
