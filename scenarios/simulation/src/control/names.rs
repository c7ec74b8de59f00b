//! Names that come from outside and last as long as the program: behaviours and rules of declarations.

use robots::handoff::Behaviour;
use std::collections::BTreeSet;
use std::sync::Mutex;

/// So many names are kept, so that nobody outside can fill the memory with them.
const MOST: usize = 1000;
/// Longest name, bytes.
const LONGEST: usize = 40;

static NAMES: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());

/// A name that lasts.
///
/// # Errors
/// If it is empty, too long or not made of a-z, 0-9 and _, or if there are too many different ones.
pub(super) fn lasting(name: &str) -> Result<&'static str, String> {
    let legal = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_';
    if name.is_empty() || name.len() > LONGEST || !name.bytes().all(legal) {
        return Err(format!("a name must have 1 to {LONGEST} of the characters a-z, 0-9 and _, got {name:?}"));
    }
    let mut names = NAMES.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some(known) = names.get(name) {
        return Ok(known);
    }
    if names.len() >= MOST {
        return Err(format!("there are {MOST} different names already: {name:?} is one too many"));
    }
    let kept: &'static str = Box::leak(name.to_string().into_boxed_str());
    names.insert(kept);
    Ok(kept)
}

/// A behaviour of this program, or one of the searcher's own.
///
/// # Errors
/// As [`lasting`].
pub(super) fn behaviour(name: &str) -> Result<Behaviour, String> {
    let ours = Behaviour::ALL.into_iter().find(|b| b.name() == name);
    ours.map_or_else(|| lasting(name).map(Behaviour::Other), Ok)
}
