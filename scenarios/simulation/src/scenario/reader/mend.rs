//! Reads a value completely: reports what cannot be read and replaces it, until there is nothing more to report.

use super::fail::{Fail, Misfit, What};
use super::hint::{Form, HintedMistake};
use super::outline::Outline;
use super::tree::{Group, Hole, Item, Kind, Node, PlacedMistake, Tree, WantedKind, joined};
use super::value::{Reading, Value};
use crate::scenario::fault::UnplacedFault;
use serde::de::DeserializeOwned;
use std::cell::RefCell;
use std::ops::Range;
use world::registry::read_from;
use world::spelling::{choose, nearest};

/// Most rounds of one reading. Each reports a mistake or gives a stand-in another value.
const ROUNDS: usize = 4000;
/// Most mistakes reported for one text.
const MOST: usize = 200;
/// Most values tried for a stand-in.
const TRIES: usize = 12;
/// Longest value that a message repeats, bytes.
pub(super) const SHORT: usize = 40;

/// A text while it is read.
pub(super) struct Mender<'a> {
    pub(super) reading: Reading<'a>,
    told: Vec<HintedMistake>,
}

impl<'a> Mender<'a> {
    pub(super) fn new(text: &'a str, tree: Tree) -> Self {
        let tree = RefCell::new(tree);
        let reading = Reading { text, tree, filling: 0, first: RefCell::default() };
        Self { reading, told: Vec::new() }
    }

    /// Reads the whole text with one set of stand-ins. `None` if none of their values fits.
    pub(super) fn read<T: DeserializeOwned>(&mut self, filling: usize) -> Option<T> {
        self.reading.filling = filling;
        for node in &mut self.tree().nodes {
            if let Kind::Hole(hole) = &mut node.kind {
                *hole = Hole { absent: filling == 2, ..Hole::default() };
            }
        }
        for _ in 0..ROUNDS {
            let id = self.tree().root;
            let root = Value { reading: &self.reading, id, unwrapped: false };
            self.reading.first.take();
            match read_from::<T, _>(root) {
                Ok(value) if self.settled() => return Some(value),
                Ok(_) => {}
                Err(fail) => {
                    let fail = self.reading.first.take().unwrap_or(fail);
                    if self.told.len() > MOST || !self.mend(fail) {
                        return None;
                    }
                }
            }
        }
        None
    }

    /// All mistakes found so far.
    pub(super) fn mistakes(&mut self) -> Vec<PlacedMistake> {
        let tree = self.reading.tree.get_mut();
        let mut found = std::mem::take(&mut tree.faults);
        found.extend(self.told.iter().map(|told| told.with_hint(tree)));
        found
    }

    /// Whether a path leads to, or into, a value that could not be read, or to what has such a value as its field, or to
    /// what a text that is cut off does not hold.
    pub(super) fn in_hole(&self, path: &str) -> bool {
        let starts = |path: &str, with: &str| {
            let rest = path.strip_prefix(with);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let tree = self.reading.tree.borrow();
        let is_hole = |n: &Node| matches!(n.kind, Kind::Hole(_));
        let is_there = || tree.nodes.iter().any(|n| n.path == path && !is_hole(n));
        if tree.cut && !path.is_empty() && !is_there() {
            return true;
        }
        tree.nodes.iter().any(|n| {
            let owner = n.path.rsplit_once('.').map_or("", |(owner, _)| owner);
            let is_owner = !path.is_empty() && owner == path;
            is_hole(n) && (is_owner || starts(path, &n.path))
        })
    }

    /// The place of a path in the text.
    pub(super) fn place(&self, path: &str) -> Range<usize> {
        let outline = Outline::scan(self.reading.text);
        outline.find(path).map_or(0..0, |n| n.whole.clone())
    }

    pub(super) fn tree(&mut self) -> &mut Tree {
        self.reading.tree.get_mut()
    }

    pub(super) fn node(&mut self, id: usize) -> &mut Node {
        &mut self.tree().nodes[id]
    }

    pub(super) fn group(&mut self, id: usize) -> Option<&mut Group> {
        match &mut self.node(id).kind {
            Kind::Group(group) => Some(group),
            _ => None,
        }
    }

    /// Whether every stand-in for a number has been tried with NaN, so that its type has named the legal range.
    fn settled(&mut self) -> bool {
        let mut settled = true;
        for node in &mut self.tree().nodes {
            if let Kind::Hole(hole) = &mut node.kind
                && hole.wanted == Some(WantedKind::Plain("a number"))
                && hole.refused == 0
                && !hole.absent
            {
                hole.refused = 1;
                settled = false;
            }
        }
        settled
    }

    pub(super) fn tell(&mut self, at: Range<usize>, found: UnplacedFault, form: Form) {
        self.told.push(HintedMistake { at, found, form });
    }

    pub(super) fn dig(&mut self, id: usize) {
        let node = self.node(id);
        node.kind = Kind::Hole(Hole::default());
    }

    /// Reports a failure and puts something readable in its place. `false` if that cannot be done.
    fn mend(&mut self, fail: Fail) -> bool {
        let root = self.tree().root;
        let id = fail.at.unwrap_or(root);
        let node = self.node(id).clone();
        match (&node.kind, fail.what) {
            (Kind::Hole(_), what) => self.refill(id, what),
            (Kind::Group(_), What::Missing(field)) => self.missing(id, &node, field),
            (Kind::Group(group), What::Field(name, legal)) => {
                let known: Vec<&str> = group.items.iter().filter_map(|i| i.key.as_deref()).collect();
                let free: Vec<&str> = (legal.iter().copied()).filter(|l| !known.contains(l)).collect();
                let Some(i) = group.items.iter().position(|i| i.key.as_ref() == Some(&name)) else {
                    return false;
                };
                let found = UnplacedFault::error(&node.path, format!("there is no field `{name}`"))
                    .hint(choose(&name, legal, "fields"));
                let at = group.items[i].key_at.clone();
                let meant = nearest(&name, &free).map(str::to_string);
                let group = self.group(id).expect("it is one");
                match meant {
                    Some(meant) => group.items[i].key = Some(meant),
                    None => drop(group.items.remove(i)),
                }
                self.tell(at, found, Form::Whole);
                true
            }
            (Kind::Group(group), What::Twice(field)) => {
                let Some(i) = group.items.iter().rposition(|i| i.key.as_deref() == Some(field)) else {
                    return false;
                };
                let found = UnplacedFault::error(&node.path, format!("the field `{field}` is given twice"));
                self.group(id).expect("it is one").items.remove(i);
                self.tell(group.items[i].key_at.clone(), found, Form::Whole);
                true
            }
            (_, What::Variant(name, legal)) => {
                let found = UnplacedFault::error(&node.path, format!("there is no choice `{name}`"))
                    .hint(choose(&name, legal, "choices"));
                let at = node.value.start..node.value.start + name.len();
                match (nearest(&name, legal), self.group(id)) {
                    (Some(meant), Some(group)) => group.name = Some(meant.to_string()),
                    _ => self.dig(id),
                }
                self.tell(at, found, Form::Whole);
                true
            }
            (_, What::Unnamed(legal)) => {
                let problem = self.got(&node, &Misfit::Kind(WantedKind::Choice(legal)));
                let found = UnplacedFault::error(&node.path, problem).hint(choose("", legal, "choices"));
                self.tell(node.value.clone(), found, Form::Whole);
                self.dig(id);
                true
            }
            (kind, What::Parentheses(name)) => {
                let (problem, form) = match kind {
                    Kind::Group(g) => (format!("expected `(` after `{name}`, got `{}`", g.bracket), Form::Whole),
                    _ => (format!("`{name}` needs parentheses"), Form::Parentheses(name.clone(), id)),
                };
                self.tell(node.value.clone(), UnplacedFault::error(&node.path, problem), form);
                self.node(id).silent = true;
                match self.group(id) {
                    Some(group) if group.bracket == '{' => group.bracket = '(',
                    Some(_) => self.dig(id),
                    None => {
                        self.node(id).kind = Kind::Group(Group { name: Some(name), bracket: '(', items: Vec::new() })
                    }
                }
                true
            }
            (_, What::Bare(name)) => {
                let found = UnplacedFault::error(&node.path, format!("`{name}` has no parentheses"))
                    .hint(format!("write `{name}`"));
                self.tell(node.value.clone(), found, Form::Whole);
                self.dig(id);
                true
            }
            (Kind::Group(_), What::Nameless { place, legal }) => self.nameless(id, &node, place, legal),
            (_, What::Named(name)) => {
                let groups = |n: &&mut Node| matches!(&n.kind, Kind::Group(g) if g.items.iter().any(|i| i.node == id));
                let around = self.tree().nodes.iter_mut().find(groups);
                let Some(Kind::Group(group)) = around.map(|n| &mut n.kind) else {
                    return false;
                };
                group.items.iter_mut().for_each(|i| i.key = None);
                let found = UnplacedFault::error(&node.path, format!("the values here have no names, got `{name}:`"))
                    .hint("write the values alone");
                self.tell(node.whole.clone(), found, Form::Whole);
                true
            }
            (_, What::Misfit(misfit)) => self.another_kind(id, &node, &misfit),
            (_, What::Refused(refusal)) => {
                let found = UnplacedFault::error(&node.path, refusal.to_string());
                let found = if refusal.is_not_finite() { found.hint("give a finite number") } else { found };
                self.tell(node.value.clone(), found, Form::Whole);
                self.dig(id);
                true
            }
            (Kind::Word, _) => false,
        }
    }

    /// Lets a stand-in learn from a failure: a field that must be in it, or a legal range.
    fn refill(&mut self, id: usize, what: What) -> bool {
        let Kind::Hole(hole) = &mut self.node(id).kind else {
            return false;
        };
        match what {
            What::Missing(field) if !hole.fields.contains(&field) => {
                hole.fields.push(field);
                return true;
            }
            What::Refused(refusal) => hole.learn(refusal.bounds(), refusal.legal),
            What::Misfit(misfit) => hole.learn(misfit.bounds(), misfit.to_string()),
            _ => {}
        }
        hole.refused += 1;
        hole.refused < TRIES
    }

    /// Reports a missing field and puts a stand-in in its place.
    fn missing(&mut self, id: usize, node: &Node, field: &'static str) -> bool {
        let Kind::Group(group) = &node.kind else {
            return false;
        };
        // `0`: the value of a choice.
        let key = (field != "0").then(|| field.to_string());
        if let Some(item) = group.items.iter().find(|i| key.is_some() && i.key == key) {
            // It was left out for its default, but it has none.
            let Kind::Hole(hole) = &mut self.node(item.node).kind else {
                return false;
            };
            return std::mem::take(&mut hole.absent);
        }
        let path = key.as_deref().map_or(node.path.clone(), |k| joined(&node.path, k));
        let hole = self.tree().hole(&path, node.whole.end);
        self.group(id).expect("it is one").items.push(Item { key: key.clone(), key_at: 0..0, node: hole });
        if !node.silent {
            let (problem, at, form) = match key {
                Some(_) => {
                    let form = Form::Missing(field.to_string(), hole);
                    (format!("the field `{field}` is missing"), node.whole.clone(), form)
                }
                None => ("expected a value in the parentheses".to_string(), node.value.clone(), Form::Kind(hole)),
            };
            self.tell(at, UnplacedFault::error(&node.path, problem), form);
        }
        true
    }

    /// What is wrong with a value, and the value itself if it is short.
    pub(super) fn got(&self, node: &Node, misfit: &Misfit) -> String {
        let given = &self.reading.text[node.value.clone()];
        let short = (1..=SHORT).contains(&given.len()) && !given.contains('\n');
        if short { format!("{misfit}, got {given}") } else { misfit.to_string() }
    }
}
