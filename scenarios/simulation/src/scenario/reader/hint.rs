//! Hints how to correct a mistake: the nearest name, what to write, or the legal range.

use super::tree::{Hole, Kind, PlacedMistake, Tree, WantedKind};
use crate::scenario::fault::UnplacedFault;
use std::ops::Range;

/// A mistake. Its hint is known only after the whole text has been read.
pub(super) struct HintedMistake {
    pub at: Range<usize>,
    pub found: UnplacedFault,
    pub form: Form,
}

/// What the hint is made from.
pub(super) enum Form {
    /// The hint is complete, or none is needed.
    Whole,
    /// A missing field and the stand-in in its place.
    Missing(String, usize),
    /// The stand-in in place of a value of another kind.
    Kind(usize),
    /// A choice without parentheses, and the group that stands in for them.
    Parentheses(String, usize),
}

impl HintedMistake {
    pub(super) fn with_hint(&self, tree: &Tree) -> PlacedMistake {
        let hint = match &self.form {
            Form::Whole => None,
            Form::Missing(field, id) => {
                let hole = hole(tree, *id);
                let legal = hole.and_then(legal).map_or(String::new(), |l| format!(": {l}"));
                Some(format!("add `{field}: {}`{legal}", shape(tree, *id)))
            }
            Form::Kind(id) => match hole(tree, *id) {
                Some(Hole { wanted: Some(WantedKind::Fields | WantedKind::Tuple(_)), .. }) => {
                    Some(format!("write `{}`", shape(tree, *id)))
                }
                Some(Hole { wanted: Some(WantedKind::Whole(..)), .. }) => hole(tree, *id).and_then(legal),
                Some(Hole { range: Some(range), .. }) if range != FINITE => Some(range.clone()),
                _ => None,
            },
            Form::Parentheses(name, id) => Some(format!("write `{name}{}`", shape(tree, *id))),
        };
        let found = self.found.clone();
        (
            self.at.clone(),
            match hint {
                Some(hint) => found.hint(hint),
                None => found,
            },
        )
    }
}

/// The words of a number without a narrower range.
const FINITE: &str = "must be a finite number";

fn hole(tree: &Tree, id: usize) -> Option<&Hole> {
    match &tree.nodes[id].kind {
        Kind::Hole(hole) => Some(hole),
        _ => None,
    }
}

/// What to write in a place: parentheses and the required fields.
fn shape(tree: &Tree, id: usize) -> String {
    let field = |name: &str, id: usize| format!("{name}: {}", shape(tree, id));
    match &tree.nodes[id].kind {
        Kind::Group(group) => {
            let fields = group.items.iter().map(|i| match &i.key {
                Some(name) => field(name, i.node),
                None => shape(tree, i.node),
            });
            format!("({})", fields.collect::<Vec<_>>().join(", "))
        }
        Kind::Hole(Hole { wanted: Some(WantedKind::Fields), kids, fields, .. }) => {
            let fields = fields.iter().map(|f| kids.get(*f).map_or(format!("{f}: ..."), |id| field(f, *id)));
            format!("({})", fields.collect::<Vec<_>>().join(", "))
        }
        Kind::Hole(Hole { wanted: Some(WantedKind::Tuple(n)), .. }) => format!("({})", vec!["..."; *n].join(", ")),
        _ => "...".to_string(),
    }
}

/// The legal values of a place in words.
fn legal(hole: &Hole) -> Option<String> {
    let range = hole.range.as_ref().filter(|r| *r != FINITE);
    let kind = match hole.wanted.as_ref()? {
        WantedKind::Plain(words) => (*words).to_string(),
        WantedKind::Whole(0, most) if *most == u64::MAX.into() => "a whole number, 0 or greater".to_string(),
        WantedKind::Whole(least, most) => format!("a whole number from {least} to {most}"),
        WantedKind::List => "a list in square brackets".to_string(),
        WantedKind::Choice(choices) => format!("one of {}", choices.join(", ")),
        WantedKind::Fields | WantedKind::Tuple(_) => return None,
    };
    Some(range.map_or(kind.clone(), |range| format!("{kind}, {range}")))
}
