//! Reads a RON text, or reports all its mistakes at once.
//!
//! If ron can read the text, its result is used. If not, the text is parsed into a tree of values with their places
//! (`tree`), which continues after mistakes of syntax, and the tree is checked against the [shape](crate::shape) of the
//! type (`check`). A mistake suspends what is in it, and nothing else. If the check finds nothing, a rule that only the
//! type knows is broken, and its own message is reported.

mod check;
mod hint;
pub(super) mod outline;
mod parse;
mod scalar;
mod token;
mod tree;

use super::fault::{Fault, ScenarioError, UnplacedFault};
use crate::shape::{Reference, schema};
use check::check;
use outline::Outline;
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use std::any::TypeId;
use std::sync::{Arc, Mutex, PoisonError};
use tree::{PlacedMistake, Tree};
use world::registry::{ReadError, Registry};

/// Most mistakes reported for one text.
const MOST: usize = 200;

/// Reads a text with what a registry adds; errors call it `name`. `meaning` finds the mistakes of a value whose form is
/// right.
///
/// # Errors
/// All mistakes of form or, if there are none, all of meaning, in the order of the text.
pub fn read<T: DeserializeOwned + JsonSchema + 'static>(
    registry: &Registry,
    name: &str,
    text: &str,
    meaning: impl FnOnce(&T) -> Vec<UnplacedFault>,
) -> Result<T, ScenarioError> {
    let error = match registry.read(text) {
        Ok(value) => {
            let found = meaning(&value);
            if found.is_empty() {
                return Ok(value);
            }
            let outline = Outline::scan(text);
            let faults = found.into_iter().map(|found| outline.located(name, text, found));
            return Err(ScenarioError::from_faults(name, faults.collect()));
        }
        Err(error) => error,
    };
    let mut found = mistakes(text, || legal::<T>(registry));
    if found.is_empty() {
        found.push(unread(text, error));
    }
    let faults = found.into_iter().map(|(at, found)| Fault::new(name, text, at, found));
    Err(ScenarioError::from_faults(name, faults.collect()))
}

/// What may stand in a file that is read as a `T`. Making it takes some ten times as long as checking a text, and
/// whoever mends a file, or reads many, asks for the same one again.
fn legal<T: JsonSchema + 'static>(registry: &Registry) -> Arc<Reference> {
    static LAST: Mutex<Option<(TypeId, Registry, Arc<Reference>)>> = Mutex::new(None);
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    match &*last {
        Some((of, with, made)) if *of == TypeId::of::<T>() && with == registry => Arc::clone(made),
        _ => {
            let made = Arc::new(Reference::from_schema(&schema::<T>(registry, &[])));
            *last = Some((TypeId::of::<T>(), registry.clone(), Arc::clone(&made)));
            made
        }
    }
}

fn mistakes(text: &str, legal: impl FnOnce() -> Arc<Reference>) -> Vec<PlacedMistake> {
    let Some(mut tree) = Tree::parse(text) else {
        let problem = "brackets are nested more than 128 deep";
        return vec![(0..0, UnplacedFault::error("", problem))];
    };
    let mut found = std::mem::take(&mut tree.faults);
    found.extend(check(text, &tree, &legal()));
    found.sort_by_key(|(at, _)| at.start);
    found.dedup();
    found.truncate(MOST);
    found
}

/// The message of ron, for the rare text in which the check finds nothing.
fn unread(text: &str, error: ReadError) -> PlacedMistake {
    let ReadError { at, message } = error;
    let outline = Outline::scan(text);
    let path = outline.innermost(at.start).map_or("", |n| n.path.as_str());
    let part = &text[at.clone()];
    let start = at.start + (part.len() - part.trim_start().len());
    let end = at.start + part.trim_end().len();
    let mut letters = message.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_lowercase).collect();
    let found = UnplacedFault::error(path, first + letters.as_str());
    (if start < end { start..end } else { at }, found)
}

#[cfg(test)]
mod tests;
