//! Fields, tuples and lists that are used in place of each other: reported, and read as what was meant.

use super::fail::Misfit;
use super::hint::Form;
use super::mend::{Mender, SHORT};
use super::tree::{Group, Item, Kind, Node, WantedKind};
use crate::scenario::fault::UnplacedFault;
use world::spelling::choose;

impl Mender<'_> {
    /// Values without names where fields belong.
    pub(super) fn nameless(&mut self, id: usize, node: &Node, place: usize, legal: &[&'static str]) -> bool {
        let Kind::Group(group) = &node.kind else {
            return false;
        };
        let inner = self.node(group.items[place].node).clone();
        let written = self.reading.text[inner.value.clone()].to_string();
        let at = inner.value.clone();
        if let (1, Kind::Group(Group { name: None, bracket: '(', items })) = (group.items.len(), &inner.kind) {
            let found = UnplacedFault::error(&node.path, "one pair of parentheses too many")
                .hint("write the fields in a single pair");
            self.tell(at, found, Form::Whole);
            self.group(id).expect("it is one").items = items.clone();
            self.node(id).silent |= inner.silent;
            return true;
        }
        if group.items.iter().all(|i| i.key.is_none()) && group.items.len() <= legal.len() {
            let text = self.reading.text;
            let tree = self.tree();
            let named = legal
                .iter()
                .zip(&group.items)
                .map(|(name, i)| format!("{name}: {}", &text[tree.nodes[i.node].value.clone()]));
            let hint = format!("write `({})`", named.collect::<Vec<_>>().join(", "));
            let hint = if hint.contains('\n') || hint.len() > 2 * SHORT { choose("", legal, "fields") } else { hint };
            let found = UnplacedFault::error(&node.path, "the fields here have names").hint(hint);
            self.tell(at, found, Form::Whole);
            let items = &mut self.group(id).expect("it is one").items;
            for (item, name) in items.iter_mut().zip(legal) {
                item.key = Some((*name).to_string());
            }
            return true;
        }
        let items = &mut self.group(id).expect("it is one").items;
        if let Some(name) = legal.iter().find(|l| **l == written) {
            items[place].key = Some(written);
            let hole = items[place].node;
            self.dig(hole);
            let found = UnplacedFault::error(&node.path, format!("the field `{name}` has no value"));
            self.tell(at, found, Form::Missing((*name).to_string(), hole));
        } else {
            items.remove(place);
            let problem = self.got(&inner, &Misfit::Kind(WantedKind::Plain("`name: value`")));
            let found = UnplacedFault::error(&node.path, problem).hint(choose("", legal, "fields"));
            self.tell(at, found, Form::Whole);
        }
        true
    }

    /// A value of another kind than the one that belongs there.
    pub(super) fn another_kind(&mut self, id: usize, node: &Node, misfit: &Misfit) -> bool {
        let mut form = if misfit.says_range() { Form::Whole } else { Form::Kind(id) };
        let mut found = UnplacedFault::error(&node.path, self.got(node, misfit));
        match (&node.kind, misfit) {
            (Kind::Group(group), Misfit::Kind(WantedKind::List)) if group.bracket == '(' => {
                found = found.hint("write `[ ]` around it");
                form = Form::Whole;
                let tree = self.tree();
                tree.nodes.push(Node { path: format!("{}[0]", node.path), whole: node.value.clone(), ..node.clone() });
                let inner = Item { key: None, key_at: 0..0, node: tree.nodes.len() - 1 };
                tree.nodes[id].kind = Kind::Group(Group { name: None, bracket: '[', items: vec![inner] });
            }
            (Kind::Group(group), Misfit::Kind(WantedKind::Tuple(_)))
                if group.bracket == '[' && group.name.is_none() =>
            {
                found = found.hint("write `( )` in place of `[ ]`");
                form = Form::Whole;
                self.group(id).expect("it is one").bracket = '(';
            }
            _ => self.dig(id),
        }
        self.tell(node.value.clone(), found, form);
        true
    }
}
