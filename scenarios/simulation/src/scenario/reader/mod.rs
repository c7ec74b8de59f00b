//! Reads a RON text, or reports all its mistakes at once.
//!
//! If ron can read the text, its result is used. If not, the text is parsed into a tree of values with their places
//! (`tree`), and the same types are read from the tree (`value`). A value that a type refuses is reported and replaced
//! by a stand-in (`mend`), until the whole text can be read. So every type that serde reads is checked completely,
//! without a list of its fields. Then the meaning is checked with several sets of stand-ins. A mistake that does not
//! appear with all of them comes from a stand-in, not from the file.

mod access;
mod confuse;
mod deserialize;
mod fail;
mod hint;
mod mend;
pub(super) mod outline;
mod parse;
mod scalar;
mod token;
mod tree;
mod value;

use super::fault::Severity;
use super::fault::{Fault, ScenarioError, UnplacedFault};
use super::unread::unread;
use mend::Mender;
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};
use tree::{PlacedMistake, Tree};
use world::registry::read_from;

/// A value of which every part is read by the one reader for all formats.
struct Whole<T>(T);

impl<'de, T: DeserializeOwned> Deserialize<'de> for Whole<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        read_from(from).map(Self)
    }
}

/// Number of sets of stand-ins: two of values, one of defaults.
const FILLINGS: usize = 3;

/// Reads a text; errors call it `name`. `meaning` is called only if the text has mistakes. It adds mistakes of meaning
/// that do not depend on them.
///
/// # Errors
/// All mistakes, in the order of the text.
pub fn read<T: DeserializeOwned>(
    name: &str,
    text: &str,
    meaning: &dyn Fn(&T) -> Vec<UnplacedFault>,
) -> Result<T, ScenarioError> {
    let reader =
        ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES);
    let error = match reader.from_str(text).map(|Whole(value)| value) {
        Ok(value) => return Ok(value),
        Err(error) => error,
    };
    let mut found = mistakes(text, meaning);
    if found.is_empty() {
        found.push(unread(text, &error));
    }
    let faults = found.into_iter();
    let faults = faults.map(|(at, found)| Fault::new(name, text, at, found));
    Err(ScenarioError::from_faults(name, faults.collect()))
}

fn mistakes<T: DeserializeOwned>(text: &str, meaning: &dyn Fn(&T) -> Vec<UnplacedFault>) -> Vec<PlacedMistake> {
    let Some(tree) = Tree::parse(text) else {
        let problem = "brackets are nested more than 128 deep";
        return vec![(0..0, UnplacedFault::error("", problem))];
    };
    let mut mender = Mender::new(text, tree);
    let first = mender.read(0);
    // Mistakes that only later readings find come from their stand-ins.
    let mut found = mender.mistakes();
    let others = (1..FILLINGS).filter_map(|filling| mender.read(filling));
    let values: Vec<T> = first.into_iter().chain(others).collect();
    let mut said = values.iter().map(meaning);
    let mut meant = said.next().unwrap_or_default();
    meant.retain(|f| f.severity == Severity::Error && !mender.in_hole(&f.path));
    for again in said {
        meant.retain(|f| again.contains(f));
    }
    found.extend(meant.into_iter().map(|f| (mender.place(&f.path), f)));
    found.sort_by_key(|(at, _)| at.start);
    found.dedup();
    found
}

#[cfg(test)]
mod tests;
