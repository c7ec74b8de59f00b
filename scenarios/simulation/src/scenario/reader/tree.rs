//! A tree of the values of a RON text with their places.

use crate::scenario::fault::UnplacedFault;
use std::ops::Range;

/// A mistake and its place.
pub(super) type PlacedMistake = (Range<usize>, UnplacedFault);

/// A value.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Its path, such as `robots[1].start`.
    pub path: String,
    /// Its place with its name, in bytes.
    pub whole: Range<usize>,
    /// Its place without its name.
    pub value: Range<usize>,
    /// Its kind.
    pub kind: Kind,
    /// What is missing in it follows from a mistake that is reported already.
    pub silent: bool,
}

/// The kind of a value.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// A word, a number or a text in quotes.
    Word,
    /// Brackets with items.
    Group(Group),
    /// A value that is missing or cut off; it is reported already.
    Missing,
}

/// Brackets with items.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The word before them.
    pub name: Option<String>,
    /// `(`, `[` or `{`.
    pub bracket: char,
    /// The items between them.
    pub items: Vec<Item>,
}

/// An element of a group.
#[derive(Clone, Debug)]
pub(super) struct Item {
    /// Its name.
    pub key: Option<String>,
    /// Its name's place.
    pub key_at: Range<usize>,
    /// Its value.
    pub node: usize,
}

/// The tree of a text.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    /// All values.
    pub nodes: Vec<Node>,
    /// The outermost value.
    pub root: usize,
    /// Mistakes of syntax.
    pub faults: Vec<PlacedMistake>,
    /// The text ends before its brackets are closed.
    pub cut: bool,
    /// Number of brackets that do not match.
    pub brackets: usize,
}

/// Whether a word can be the name of a field or of a choice.
pub(super) fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_') && word.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// The path of a part of what is at a path.
pub(super) fn joined(path: &str, part: &str) -> String {
    if path.is_empty() { part.to_string() } else { format!("{path}.{part}") }
}
