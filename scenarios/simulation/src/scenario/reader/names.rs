//! One field of the outermost structure that texts of another version call by another name.

use super::hint::Form;
use super::mend::Mender;
use super::tree::Item;
use crate::scenario::fault::UnplacedFault;
use crate::scenario::outline::Outline;

/// A field with two names: the type reads both (serde's `alias`), and a text may use one of them.
#[derive(Clone, Debug)]
pub(in crate::scenario) struct Renamed {
    /// The type's own name of it.
    pub field: &'static str,
    /// Its name in this text.
    pub here: &'static str,
    /// Its name in texts of the other version.
    pub elsewhere: &'static str,
    /// What is wrong with that name here.
    pub problem: String,
    /// How to put it right.
    pub hint: String,
}

impl Renamed {
    /// Whether a text has the name that it must not use.
    pub(super) fn misused(&self, text: &str) -> bool {
        let outline = Outline::scan(text);
        (outline.nodes.iter()).any(|n| n.path == self.elsewhere && n.whole != n.value)
    }
}

impl Mender<'_> {
    /// Gives the field its own name in the tree, and tells of the other version's name.
    pub(super) fn rename(&mut self) {
        let Some(renamed) = self.renamed.clone() else {
            return;
        };
        let root = self.tree().root;
        let Some(group) = self.group(root) else {
            return;
        };
        let is = |item: &Item, name: &str| item.key.as_deref() == Some(name);
        let right = group.items.iter().any(|i| is(i, renamed.here));
        let wrong = group.items.iter().position(|i| is(i, renamed.elsewhere));
        let wrong_at = wrong.map(|i| {
            let at = group.items[i].key_at.clone();
            if right {
                group.items.remove(i);
            } else {
                group.items[i].key = Some(renamed.field.to_string());
            }
            at
        });
        for item in group.items.iter_mut().filter(|i| is(i, renamed.here)) {
            item.key = Some(renamed.field.to_string());
        }
        if let Some(at) = wrong_at {
            let found = UnplacedFault::error(renamed.elsewhere, renamed.problem).hint(renamed.hint);
            self.tell(at, found, Form::Whole);
        }
    }

    fn renamed_at(&self, id: usize) -> Option<&Renamed> {
        let root = self.reading.tree.borrow().root;
        self.renamed.as_ref().filter(|_| id == root)
    }

    /// The names that a group's fields may have in this text.
    pub(super) fn legal(&self, id: usize, legal: &'static [&'static str]) -> Vec<&'static str> {
        let elsewhere = self.renamed_at(id).map(|r| r.elsewhere);
        let legal = legal.iter().copied();
        legal.filter(|l| Some(*l) != elsewhere).collect()
    }

    /// What this text calls a field of a group.
    pub(super) fn shown<'n>(&self, id: usize, field: &'n str) -> &'n str {
        match self.renamed_at(id) {
            Some(renamed) if renamed.field == field => renamed.here,
            _ => field,
        }
    }

    /// What the type calls a field that the text names.
    pub(super) fn own<'n>(&self, id: usize, name: &'n str) -> &'n str {
        match self.renamed_at(id) {
            Some(renamed) if renamed.here == name => renamed.field,
            _ => name,
        }
    }
}
