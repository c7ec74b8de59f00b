//! A RON text as a tree of values with their places.

use crate::scenario::fault::Found;
use crate::scenario::outline::joined;
use std::collections::BTreeMap;
use std::ops::Range;

/// A mistake and its place.
pub(super) type Placed = (Range<usize>, Found);

/// A value.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Its path, such as `robots[1].start`.
    pub path: String,
    /// With its name, in bytes.
    pub whole: Range<usize>,
    /// Without it.
    pub value: Range<usize>,
    /// What it is.
    pub kind: Kind,
    /// What is lacking in it follows from a mistake that is told already.
    pub silent: bool,
}

/// What a value is.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// A word, a number, a text in quotes.
    Word,
    /// Brackets and what is in them.
    Group(Group),
    /// A value that could not be read or is missing; stands for any.
    Hole(Hole),
}

/// Brackets and what is in them.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The word before them.
    pub name: Option<String>,
    /// `(`, `[` or `{`.
    pub bracket: char,
    /// What is between them.
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

/// A value that could not be read: what it is asked for, and what it answered so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Hole {
    /// Answers that were refused.
    pub refused: usize,
    /// Left out, for a default to take its place.
    pub absent: bool,
    /// Values in it.
    pub kids: BTreeMap<String, usize>,
    /// Fields that must be in it.
    pub fields: Vec<&'static str>,
    /// What would be right, as far as the reader said.
    pub wanted: Option<Wanted>,
    /// The legal range, as the type says it.
    pub range: Option<String>,
    /// The same in numbers, once the type has said them.
    pub bounds: Option<(f64, f64)>,
}

/// What kind of value belongs in a place.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wanted {
    /// A number, a text, true or false: in words.
    Plain(&'static str),
    /// A whole number between bounds.
    Whole(i128, i128),
    /// Fields in parentheses.
    Fields,
    /// So many values in parentheses.
    Tuple(usize),
    /// A list.
    List,
    /// One of these.
    Choice(&'static [&'static str]),
}

/// A text as a tree.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    /// All values.
    pub nodes: Vec<Node>,
    /// The outermost.
    pub root: usize,
    /// Mistakes of syntax.
    pub faults: Vec<Placed>,
    /// The text ends before its brackets are closed.
    pub cut: bool,
    /// Brackets that do not match.
    pub brackets: usize,
}

impl Tree {
    /// A new stand-in.
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

    /// A stand-in within a stand-in.
    pub(super) fn hole_kid(&mut self, id: usize, name: &str) -> usize {
        let Node {
            path,
            whole,
            kind: Kind::Hole(hole),
            ..
        } = &self.nodes[id]
        else {
            return id;
        };
        if let Some(kid) = hole.kids.get(name) {
            return *kid;
        }
        // A choice (`Depth(5)`) is a value, not a field.
        let path = if name.starts_with(|c: char| c.is_ascii_uppercase()) {
            path.clone()
        } else {
            joined(path, name)
        };
        let kid = self.hole(&path, whole.end);
        if let Kind::Hole(hole) = &mut self.nodes[id].kind {
            hole.kids.insert(name.to_string(), kid);
        }
        kid
    }
}

/// Whether a word can be the name of a field or of a choice.
pub(super) fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && word.chars().all(|c| c.is_alphanumeric() || c == '_')
}
