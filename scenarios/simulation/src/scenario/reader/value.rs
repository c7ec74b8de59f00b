//! A value of the tree, from which serde reads. Each failure knows the value that it is about.

use super::access::{Elements, Fields};
use super::fail::{Fail, Misfit, What};
use super::scalar;
use super::tree::{Group, Item, Kind, Node, Tree, WantedKind};
use serde::de::Visitor;
use std::cell::RefCell;

/// A text that is read, and the set of stand-ins in use.
pub(super) struct Reading<'a> {
    /// The text.
    pub text: &'a str,
    /// Its values. Stand-ins learn what the types want of them.
    pub tree: RefCell<Tree>,
    /// Number of the set of stand-ins.
    pub filling: usize,
    /// The first failure whose value is known. It ends the reading. serde may lose the value on the way out, through
    /// types that are chosen by name.
    pub first: RefCell<Option<Fail>>,
}

impl Reading<'_> {
    /// A failure about this value, if it is not about one within it.
    pub(super) fn about(&self, id: usize, fail: Fail) -> Fail {
        let fail = fail.about(id);
        self.first.borrow_mut().get_or_insert_with(|| fail.clone());
        fail
    }
}

/// A value that is read.
#[derive(Clone, Copy)]
pub(super) struct Value<'a, 'b> {
    /// All of them.
    pub reading: &'b Reading<'a>,
    /// Its index.
    pub id: usize,
    /// It is the value in the parentheses of a choice whose name has been read.
    pub unwrapped: bool,
}

impl<'a, 'b> Value<'a, 'b> {
    pub(super) fn node(&self) -> Node {
        self.reading.tree.borrow().nodes[self.id].clone()
    }

    pub(super) fn kid(&self, id: usize) -> Self {
        Self { reading: self.reading, id, unwrapped: false }
    }

    pub(super) fn fail<T>(&self, what: What) -> Result<T, Fail> {
        Err(self.about(Fail { at: None, what }))
    }

    /// A failure about this value, if it is not about one within it.
    pub(super) fn about(&self, fail: Fail) -> Fail {
        self.reading.about(self.id, fail)
    }

    pub(super) fn misfit<T>(&self, misfit: Misfit) -> Result<T, Fail> {
        self.fail(What::Misfit(misfit))
    }

    /// Something of this kind belongs here.
    pub(super) fn wanted<T>(&self, kind: WantedKind) -> Result<T, Fail> {
        self.misfit(Misfit::Kind(kind))
    }

    pub(super) fn word(&self) -> Option<&'a str> {
        let tree = self.reading.tree.borrow();
        let node = &tree.nodes[self.id];
        matches!(node.kind, Kind::Word).then(|| &self.reading.text[node.value.clone()])
    }

    pub(super) fn group(&self) -> Option<Group> {
        match self.node().kind {
            Kind::Group(group) => Some(group),
            _ => None,
        }
    }

    /// Whether this is a stand-in. If it is, it learns what belongs here.
    pub(super) fn asks(&self, wanted: WantedKind) -> bool {
        match &mut self.reading.tree.borrow_mut().nodes[self.id].kind {
            Kind::Hole(hole) => {
                hole.wanted.get_or_insert(wanted);
                hole.absent = false;
                true
            }
            _ => false,
        }
    }

    /// Number of values of a stand-in that were refused so far.
    pub(super) fn refused(&self) -> usize {
        match &self.reading.tree.borrow().nodes[self.id].kind {
            Kind::Hole(hole) => hole.refused,
            _ => 0,
        }
    }

    /// A stand-in within a stand-in.
    pub(super) fn hole_kid(&self, name: &str) -> Self {
        self.kid(self.reading.tree.borrow_mut().hole_kid(self.id, name))
    }

    /// The one value in the parentheses of a choice, if there is exactly one. Any other value is returned itself.
    pub(super) fn only(&self) -> Option<Self> {
        match self.group().filter(|_| self.unwrapped) {
            None => Some(*self),
            Some(group) => match group.items.as_slice() {
                [Item { key: None, node, .. }] => Some(self.kid(*node)),
                _ => None,
            },
        }
    }

    /// The same; a failure if there is none.
    pub(super) fn inner(&self) -> Result<Self, Fail> {
        match (self.only(), self.group()) {
            (Some(value), _) => Ok(value),
            (None, Some(group)) if group.items.is_empty() => self.fail(What::Missing("0")),
            _ => self.wanted(WantedKind::Plain("one value in the parentheses")),
        }
    }

    /// The elements between parentheses or brackets; a failure if one has a name.
    pub(super) fn elements(&self, group: &Group) -> Result<Vec<usize>, Fail> {
        if let Some(item) = group.items.iter().find(|i| i.key.is_some()) {
            let name = item.key.clone().unwrap_or_default();
            return self.kid(item.node).fail(What::Named(name));
        }
        Ok(group.items.iter().map(|i| i.node).collect())
    }

    pub(super) fn visit_fields<V: Visitor<'static>>(
        self,
        group: &Group,
        legal: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fail> {
        if let Some(place) = group.items.iter().position(|i| i.key.is_none()) {
            return self.fail(What::Nameless { place, legal });
        }
        let tree = self.reading.tree.borrow();
        let there = |i: &&Item| !matches!(&tree.nodes[i.node].kind, Kind::Hole(h) if h.absent);
        let items: Vec<Item> = group.items.iter().filter(there).cloned().collect();
        drop(tree);
        visitor.visit_map(Fields { of: self, items: items.into_iter(), value: None }).map_err(|e| self.about(e))
    }

    pub(super) fn visit_elements<V: Visitor<'static>>(
        self,
        elements: Vec<usize>,
        visitor: V,
    ) -> Result<V::Value, Fail> {
        visitor.visit_seq(Elements { of: self, elements: elements.into_iter() }).map_err(|e| self.about(e))
    }

    pub(super) fn fields<V: Visitor<'static>>(
        self,
        name: &str,
        legal: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fail> {
        if self.asks(WantedKind::Fields) {
            let Kind::Hole(hole) = self.node().kind else { unreachable!("it was one just now") };
            let item = |f: &&str| Item { key: Some((*f).to_string()), key_at: 0..0, node: self.hole_kid(f).id };
            let items: Vec<Item> = hole.fields.iter().map(item).collect();
            return visitor
                .visit_map(Fields { of: self, items: items.into_iter(), value: None })
                .map_err(|e| self.about(e));
        }
        let Some(group) = self.group().filter(|g| g.bracket == '(') else {
            return self.wanted(WantedKind::Fields);
        };
        match &group.name {
            Some(given) if !self.unwrapped && given != name => self.misfit(Misfit::Name(given.clone())),
            _ => self.visit_fields(&group, legal, visitor),
        }
    }

    pub(super) fn tuple<V: Visitor<'static>>(self, len: usize, visitor: V) -> Result<V::Value, Fail> {
        if self.asks(WantedKind::Tuple(len)) {
            let kids = (0..len).map(|i| self.hole_kid(&i.to_string()).id).collect();
            return self.visit_elements(kids, visitor);
        }
        let Some(group) = self.group().filter(|g| g.bracket == '(' && (self.unwrapped || g.name.is_none())) else {
            return self.wanted(WantedKind::Tuple(len));
        };
        let elements = self.elements(&group)?;
        if elements.len() != len {
            return self.misfit(Misfit::Count { wanted: len, got: elements.len() });
        }
        self.visit_elements(elements, visitor)
    }

    pub(super) fn float(self) -> Result<f64, Fail> {
        if self.asks(WantedKind::Plain("a number")) {
            let bounds = match &self.reading.tree.borrow().nodes[self.id].kind {
                Kind::Hole(hole) => hole.bounds,
                _ => None,
            };
            let number = scalar::stand_in(self.reading.filling, self.refused(), bounds);
            // In one set no two of them are the same, so that no two parts are by their stand-ins alone.
            let apart = if self.reading.filling == 2 { 1.0 - 1e-3 * (self.id % 97) as f64 } else { 1.0 };
            return Ok(number * apart);
        }
        match self.word().and_then(scalar::number) {
            Some(v) => Ok(v),
            None => self.wanted(WantedKind::Plain("a number")),
        }
    }

    pub(super) fn whole(self, least: i128, most: i128) -> Result<i128, Fail> {
        if self.asks(WantedKind::Whole(least, most)) {
            return Ok(scalar::stand_in_whole(self.reading.filling, self.refused()).clamp(least, most));
        }
        match self.word().map(|w| (scalar::whole(w), scalar::number(w))) {
            Some((Some(v), _)) if (least..=most).contains(&v) => Ok(v),
            Some((Some(_), _)) => self.wanted(WantedKind::Whole(least, most)),
            Some((None, Some(_))) => self.misfit(Misfit::Fraction),
            _ => self.wanted(WantedKind::Plain("a whole number")),
        }
    }
}
