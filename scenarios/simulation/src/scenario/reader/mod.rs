//! All mistakes of a RON text in one round.
//!
//! A text that ron reads is read by ron. One that it refuses is made a tree of values with their places (`tree`),
//! from which the same types are read again (`value`). Whatever a type refuses is told and replaced by a stand-in
//! (`mend`), until the whole can be read: so every type that serde reads is checked to its end, without a list of
//! its fields. What the values mean is then checked under several sets of stand-ins; a mistake that not all of
//! them bring comes from a stand-in, not from the file.

mod access;
mod confuse;
mod deserialize;
mod fail;
mod hint;
mod mend;
mod names;
mod parse;
mod scalar;
mod token;
mod tree;
mod value;

use super::fault::Severity;
use super::fault::{Fault, Found, ScenarioError};
use super::unread::unread;
pub(crate) use hint::distance;
use mend::Mender;
pub(super) use names::Renamed;
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;
use tree::{Placed, Tree};

/// Sets of stand-ins: two of values, one of defaults.
const FILLINGS: usize = 3;

/// Reads a text; errors call it `name`. `meaning` is asked only where the text has mistakes, and adds those that do
/// not hang on them.
///
/// # Errors
/// All mistakes, in the text's order.
pub fn read<T: DeserializeOwned>(
    name: &str,
    text: &str,
    meaning: &dyn Fn(&T) -> Vec<Found>,
) -> Result<T, ScenarioError> {
    read_renamed(name, text, None, meaning)
}

/// The same for a type of which one field has another name in some texts.
pub(super) fn read_renamed<T: DeserializeOwned>(
    name: &str,
    text: &str,
    renamed: Option<Renamed>,
    meaning: &dyn Fn(&T) -> Vec<Found>,
) -> Result<T, ScenarioError> {
    let reader = ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES);
    let error = match reader.from_str(text) {
        // The type reads both names; that the text has the right one remains to be seen.
        Ok(_) if renamed.as_ref().is_some_and(|r| r.misused(text)) => None,
        Ok(value) => return Ok(value),
        Err(error) => Some(error),
    };
    let mut found = mistakes(text, renamed, meaning);
    if let (true, Some(error)) = (found.is_empty(), error) {
        found.push(unread(text, &error));
    }
    let faults = found.into_iter();
    let faults = faults.map(|(at, found)| Fault::new(name, text, at, found));
    Err(ScenarioError::of(name, faults.collect()))
}

fn mistakes<T: DeserializeOwned>(
    text: &str,
    renamed: Option<Renamed>,
    meaning: &dyn Fn(&T) -> Vec<Found>,
) -> Vec<Placed> {
    let Some(tree) = Tree::of(text) else {
        let problem = "brackets are nested more than 128 deep";
        return vec![(0..0, Found::error("", problem))];
    };
    let mut mender = Mender::new(text, tree, renamed);
    mender.rename();
    let first = mender.read(0);
    // What later readings would tell of comes from their stand-ins.
    let mut found = mender.told();
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
