//! A tree of the values of a RON text with their places.

use crate::scenario::fault::UnplacedFault;
use std::collections::BTreeMap;
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
    /// Fields missing in it follow from a mistake that is reported already.
    pub silent: bool,
}

/// The kind of a value.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// A word, a number or a text in quotes.
    Word,
    /// Brackets with items.
    Group(Group),
    /// A stand-in for a value that could not be read or is missing.
    Hole(Hole),
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

/// A stand-in: what the types want in its place, and which values were tried.
#[derive(Clone, Debug, Default)]
pub(super) struct Hole {
    /// Values that were refused.
    pub refused: usize,
    /// It is left out, so that the default takes its place.
    pub absent: bool,
    /// Stand-ins inside it.
    pub kids: BTreeMap<String, usize>,
    /// Fields that must be in it.
    pub fields: Vec<&'static str>,
    /// The kind of value that belongs there, if it is known.
    pub wanted: Option<WantedKind>,
    /// The legal range in the type's words.
    pub range: Option<String>,
    /// The legal range in numbers, if the type has named it.
    pub bounds: Option<(f64, f64)>,
}

impl Hole {
    /// Keeps what a type says is legal. Bounds replace words.
    pub(super) fn learn(&mut self, bounds: Option<(f64, f64)>, legal: String) {
        if bounds.is_some() {
            self.bounds = bounds;
            self.range = Some(legal);
        } else {
            self.range.get_or_insert(legal);
        }
    }
}

/// What kind of value belongs in a place.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum WantedKind {
    /// A value named in words: a number, a text, true or false.
    Plain(&'static str),
    /// A whole number between bounds.
    Whole(i128, i128),
    /// Fields in parentheses.
    Fields,
    /// A number of values in parentheses.
    Tuple(usize),
    /// A list.
    List,
    /// One of these.
    Choice(&'static [&'static str]),
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

impl Tree {
    /// Adds a stand-in.
    pub(super) fn hole(&mut self, path: &str, at: usize) -> usize {
        self.nodes.push(Node {
            path: path.to_string(),
            whole: at..at,
            value: at..at,
            kind: Kind::Hole(Hole::default()),
            silent: true,
        });
        self.nodes.len() - 1
    }

    /// Adds a stand-in inside a stand-in, or returns the one that is there.
    pub(super) fn hole_kid(&mut self, id: usize, name: &str) -> usize {
        let Node { path, whole, kind: Kind::Hole(hole), .. } = &self.nodes[id] else {
            return id;
        };
        if let Some(kid) = hole.kids.get(name) {
            return *kid;
        }
        // The name of a choice (`Depth(5)`) is no part of a path.
        let path = if name.starts_with(|c: char| c.is_ascii_uppercase()) { path.clone() } else { joined(path, name) };
        let kid = self.hole(&path, whole.end);
        if let Kind::Hole(hole) = &mut self.nodes[id].kind {
            hole.kids.insert(name.to_string(), kid);
        }
        kid
    }
}

/// Whether a word can be the name of a field or of a choice.
pub(super) fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_') && word.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// The path of a part of what is at a path.
pub(super) fn joined(path: &str, part: &str) -> String {
    if path.is_empty() { part.to_string() } else { format!("{path}.{part}") }
}
