//! Checks the values of a tree against the shape of the type that reads them: all mistakes of form and range.
//!
//! A value that does not fit is reported, and what is in it is left alone, unless it is plain what was meant: a field or
//! a choice whose name is misspelled, fields without their names, a list in parentheses.

use super::hint;
use super::scalar;
use super::tree::{Group, Item, Kind, Node, PlacedMistake, Tree, is_name};
use crate::scenario::fault::UnplacedFault;
use crate::shape::{Field, Number, Reference, Shape, Text, Variant};
use std::collections::BTreeSet;
use std::ops::Range;
use world::spelling::{choose, nearest};

/// Longest value that a message repeats, bytes.
const SHORT: usize = 40;

/// All mistakes of a text's tree; not more than are reported.
pub(super) fn check(text: &str, tree: &Tree, legal: &Reference) -> Vec<PlacedMistake> {
    let mut checker = Checker { text, tree, legal, found: Vec::new() };
    checker.value(tree.root, &legal.root);
    checker.found
}

struct Checker<'a> {
    text: &'a str,
    tree: &'a Tree,
    legal: &'a Reference,
    found: Vec<PlacedMistake>,
}

impl<'a> Checker<'a> {
    fn node(&self, id: usize) -> &'a Node {
        &self.tree.nodes[id]
    }

    fn written(&self, node: &Node) -> &'a str {
        &self.text[node.value.clone()]
    }

    fn tell(&mut self, at: Range<usize>, path: &str, problem: String, hint: Option<String>) {
        let found = UnplacedFault::error(path, problem);
        self.found.push((
            at,
            match hint {
                Some(hint) => found.hint(hint),
                None => found,
            },
        ));
    }

    /// Reports a value: what is wrong with it, and the value itself if it is short.
    fn refuse(&mut self, node: &Node, problem: &str, hint: Option<String>) {
        let given = self.written(node);
        let short = (1..=SHORT).contains(&given.len()) && !given.contains('\n');
        let problem = if short { format!("{problem}, got {given}") } else { problem.to_string() };
        self.tell(node.value.clone(), &node.path, problem, hint);
    }

    /// Something of another kind belongs in this place.
    fn misfit(&mut self, node: &Node, shape: &Shape) {
        let problem = format!("expected {}", hint::kind(self.legal, shape));
        self.refuse(node, &problem, hint::instead(self.legal, shape));
    }

    fn value(&mut self, id: usize, shape: &Shape) {
        let node = self.node(id);
        if self.found.len() >= super::MOST {
            return;
        }
        match (self.legal.resolved(shape), &node.kind) {
            (_, Kind::Missing) => {}
            (Shape::Choice(variants), _) => self.choice(node, variants),
            (Shape::Number(n), Kind::Word) => self.number(node, n),
            (Shape::Text(t), Kind::Word) => self.words(node, t),
            (Shape::Truth, Kind::Word) if matches!(self.written(node), "true" | "false") => {}
            (Shape::List(of), Kind::Group(group)) if group.name.is_none() => self.list(node, group, of),
            (Shape::Tuple(parts), Kind::Group(group)) if group.name.is_none() => {
                self.tuple(node, group.bracket, &group.items, parts)
            }
            (Shape::Fields(fields), Kind::Group(group)) if group.bracket == '(' => {
                let of = |of: &Shape| matches!(of, Shape::Named(of) if group.name.as_ref() == Some(of));
                if let Some(name) = group.name.as_ref().filter(|_| !of(shape)) {
                    let problem = format!("expected fields in parentheses without the name `{name}`");
                    self.refuse(node, &problem, hint::instead(self.legal, shape));
                }
                self.fields(node, group, fields);
            }
            (shape, _) => self.misfit(node, shape),
        }
    }

    fn number(&mut self, node: &Node, n: &Number) {
        let word = self.written(node);
        let refused = match n.whole {
            Some((least, most)) => match (scalar::whole(word), scalar::number(word)) {
                (Some(v), _) if (least..=most).contains(&v) => None,
                (Some(_), _) => Some((format!("must be {}", hint::whole(least, most)), None)),
                (None, Some(_)) => Some(("must be a whole number".to_string(), hint::range(n, 0.0))),
                (None, None) => Some(("expected a whole number".to_string(), hint::range(n, 0.0))),
            },
            None => match scalar::number(word) {
                None => Some(("expected a number".to_string(), hint::range(n, 0.0))),
                Some(v) if fits(n, v) => None,
                Some(v) if v.is_finite() => hint::range(n, v).map(|range| (range, None)),
                Some(v) => {
                    let range = hint::range(n, if v.is_nan() { 0.0 } else { v })
                        .unwrap_or_else(|| "must be a finite number".to_string());
                    Some((range, Some("give a finite number".to_string())))
                }
            },
        };
        if let Some((problem, hint)) = refused {
            self.refuse(node, &problem, hint);
        }
    }

    fn words(&mut self, node: &Node, t: &Text) {
        match scalar::text(self.written(node)) {
            Some(Ok(text)) => {
                if let Some(problem) = hint::refused(t, &text) {
                    self.refuse(node, &problem, None);
                }
            }
            Some(Err(escape)) => self.refuse(node, &format!("the text has the unknown escape `\\{escape}`"), None),
            None => self.misfit(node, &Shape::Text(t.clone())),
        }
    }

    fn list(&mut self, node: &Node, group: &Group, of: &Shape) {
        if group.bracket != '[' {
            let alone =
                group.items.iter().any(|i| i.key.is_some()) || matches!(self.legal.resolved(of), Shape::Tuple(_));
            let hint = if alone { "write `[ ]` around it" } else { "write `[ ]` in place of `( )`" };
            self.refuse(node, "expected a list in square brackets", Some(hint.to_string()));
            if let (true, Shape::Fields(fields)) = (alone, self.legal.resolved(of)) {
                return self.fields(node, group, fields);
            }
        }
        // The parser has reported names in a list.
        for item in &group.items {
            self.value(item.node, of);
        }
    }

    fn tuple(&mut self, node: &Node, bracket: char, items: &[Item], parts: &[Shape]) {
        let problem = format!("expected {} values in parentheses", parts.len());
        let (n, form) = (items.len(), format!("({})", vec!["..."; parts.len()].join(", ")));
        if bracket == '[' {
            self.refuse(node, &problem, Some("write `( )` in place of `[ ]`".to_string()));
        } else if n != parts.len() {
            return self.refuse(node, &format!("{problem}, not {n}"), Some(format!("write `{form}`")));
        } else if let Some(item) = items.iter().find(|i| i.key.is_some()) {
            let named = self.node(item.node);
            let problem = format!("the values here have no names, got `{}:`", item.key.as_deref().unwrap_or_default());
            self.tell(named.whole.clone(), &named.path, problem, Some("write the values alone".to_string()));
        }
        for (item, part) in items.iter().zip(parts) {
            self.value(item.node, part);
        }
    }

    fn fields(&mut self, node: &Node, group: &Group, legal: &[Field]) {
        let names = hint::fields(legal);
        let mut given = vec![false; legal.len()];
        let nameless = group.items.iter().filter(|i| i.key.is_none()).count();
        if let (1, [item]) = (nameless, group.items.as_slice())
            && let Node { kind: Kind::Group(inner @ Group { name: None, bracket: '(', .. }), .. } = self.node(item.node)
        {
            let problem = "one pair of parentheses too many".to_string();
            let hint = "write the fields in a single pair".to_string();
            let within = self.node(item.node);
            self.tell(within.value.clone(), &node.path, problem, Some(hint));
            return self.fields(within, inner, legal);
        }
        if nameless > 0 && nameless == group.items.len() && nameless <= legal.len() {
            let first = self.node(group.items[0].node);
            if !names.contains(&self.written(first)) {
                return self.unnamed(node, group, legal);
            }
        }
        let keys: BTreeSet<&str> = group.items.iter().filter_map(|i| i.key.as_deref()).collect();
        for item in &group.items {
            let value = self.node(item.node);
            let Some(key) = &item.key else {
                let named = names.iter().position(|name| *name == self.written(value));
                if let Some(i) = named {
                    given[i] = true;
                    let hint = self.missing(&legal[i]);
                    let problem = format!("the field `{}` has no value", names[i]);
                    self.tell(value.value.clone(), &node.path, problem, Some(hint));
                } else {
                    let hint = choose("", &names, "fields");
                    let at = Node { path: node.path.clone(), ..value.clone() };
                    self.refuse(&at, "expected `name: value`", Some(hint));
                }
                continue;
            };
            let meant = match names.iter().position(|name| name == key) {
                Some(i) if given[i] => {
                    let problem = format!("the field `{key}` is given twice");
                    self.tell(item.key_at.clone(), &node.path, problem, None);
                    continue;
                }
                Some(i) => Some(i),
                None => {
                    let hint = choose(key, &names, "fields");
                    self.tell(item.key_at.clone(), &node.path, format!("there is no field `{key}`"), Some(hint));
                    let free: Vec<&str> = names.iter().copied().filter(|name| !keys.contains(name)).collect();
                    nearest(key, &free).and_then(|near| names.iter().position(|name| *name == near))
                }
            };
            if let Some(i) = meant {
                given[i] = true;
                self.field(item.node, &legal[i]);
            }
            if self.found.len() >= super::MOST {
                return;
            }
        }
        for (field, _) in legal.iter().zip(&given).filter(|(field, given)| field.required && !**given && !node.silent) {
            let hint = self.missing(field);
            self.tell(node.whole.clone(), &node.path, format!("the field `{}` is missing", field.name), Some(hint));
        }
    }

    /// What to write for a field that is missing.
    fn missing(&self, field: &Field) -> String {
        let values = hint::values(self.legal, &field.shape).map_or(String::new(), |values| format!(": {values}"));
        format!("add `{}: {}`{values}", field.name, hint::form(self.legal, &field.shape))
    }

    /// Values without names where fields belong: they are taken in the order of the fields.
    fn unnamed(&mut self, node: &Node, group: &Group, legal: &[Field]) {
        let pairs = || legal.iter().zip(&group.items);
        let named = pairs().map(|(field, item)| format!("{}: {}", field.name, self.written(self.node(item.node))));
        let hint = format!("write `({})`", named.collect::<Vec<_>>().join(", "));
        let long = hint.contains('\n') || hint.len() > 2 * SHORT;
        let hint = if long { choose("", &hint::fields(legal), "fields") } else { hint };
        let at = self.node(group.items[0].node).value.clone();
        self.tell(at, &node.path, "the fields here have names".to_string(), Some(hint));
        for (field, item) in pairs() {
            self.field(item.node, field);
        }
    }

    fn field(&mut self, id: usize, field: &Field) {
        let node = self.node(id);
        match &node.kind {
            Kind::Word if field.optional && self.written(node) == "None" => {}
            Kind::Group(group) if field.optional && group.name.as_deref() == Some("Some") => {
                self.held(node, group, &field.shape);
            }
            _ => self.value(id, &field.shape),
        }
    }

    fn choice(&mut self, node: &Node, variants: &[Variant]) {
        let names = hint::names(variants);
        let (name, group) = match &node.kind {
            Kind::Group(group) => (group.name.as_deref(), Some(group)),
            _ => (Some(self.written(node)), None),
        };
        let number = variants.iter().find(|v| v.name == "number").and_then(|v| v.holds.as_ref());
        if let (Some(Shape::Number(n)), None) = (number, group)
            && scalar::number(self.written(node)).is_some()
        {
            return self.number(node, n);
        }
        let Some(name) = name.filter(|name| is_name(name)) else {
            let or = if number.is_some() { " or a number" } else { "" };
            let problem = format!("expected the name of a choice{or}");
            return self.refuse(node, &problem, Some(choose("", &names, "choices")));
        };
        let known = variants.iter().find(|v| v.name == name);
        let near = nearest(name, &names).and_then(|near| variants.iter().find(|v| v.name == near));
        if known.is_none() {
            let at = node.value.start..node.value.start + name.len();
            let hint = choose(name, &names, "choices");
            self.tell(at, &node.path, format!("there is no choice `{name}`"), Some(hint));
        }
        match (known.or(near).map(|v| &v.holds), group) {
            (Some(Some(shape)), Some(group)) => {
                if group.bracket != '(' {
                    let problem = format!("expected `(` after `{name}`, got `{}`", group.bracket);
                    self.tell(node.value.clone(), &node.path, problem, None);
                }
                self.held(node, group, shape);
            }
            (Some(Some(shape)), None) if known.is_some() => {
                let form = match hint::form(self.legal, shape) {
                    form if form.starts_with('(') => form,
                    form => format!("({form})"),
                };
                let problem = format!("`{name}` needs parentheses");
                self.tell(node.value.clone(), &node.path, problem, Some(format!("write `{name}{form}`")));
            }
            (Some(None), Some(_)) if known.is_some() => {
                let problem = format!("`{name}` has no parentheses");
                self.tell(node.value.clone(), &node.path, problem, Some(format!("write `{name}`")));
            }
            _ => {}
        }
    }

    /// What stands in the parentheses of a choice: fields or values without parentheses of their own, or one value.
    fn held(&mut self, node: &Node, group: &Group, shape: &Shape) {
        match (self.legal.resolved(shape), group.items.as_slice()) {
            (Shape::Fields(fields), _) => self.fields(node, group, fields),
            (Shape::Tuple(parts), _) => self.tuple(node, '(', &group.items, parts),
            (shape, []) if !node.silent => {
                let hint = hint::instead(self.legal, shape);
                let problem = "expected a value in the parentheses".to_string();
                self.tell(node.value.clone(), &node.path, problem, hint);
            }
            (shape, [item]) if item.key.is_none() => self.value(item.node, shape),
            (_, []) => {}
            _ => self.refuse(node, "expected one value in the parentheses", None),
        }
    }
}

/// Whether a number lies in its range. What is not finite lies in none, unless there is none.
fn fits(n: &Number, v: f64) -> bool {
    let ends = [n.low, n.above, n.high, n.below];
    let within = n.low.is_none_or(|low| v >= low)
        && n.above.is_none_or(|low| v > low)
        && n.high.is_none_or(|high| v <= high)
        && n.below.is_none_or(|high| v < high);
    within || ends.iter().all(Option::is_none)
}
