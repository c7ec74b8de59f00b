//! Parses a text into a tree and continues after mistakes of syntax.

use super::token::{Token, Tokens};
use super::tree::{Group, Item, Kind, Node, Tree, is_name, joined};
use crate::scenario::fault::UnplacedFault;
use std::ops::Range;

/// Deepest nesting of brackets.
const DEEPEST: usize = 128;

impl Tree {
    /// Parses a text. `None` if brackets are nested too deep.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let tokens = Tokens::scan(text);
        let plain = Parser::new(text, &tokens, false).whole()?;
        if plain.brackets == 0 && !plain.cut {
            return Some(plain);
        }
        // If the brackets do not match, the indentation shows which one is missing.
        let indented = Parser::new(text, &tokens, true).whole()?;
        let better = !indented.cut && indented.brackets <= plain.brackets.max(1);
        Some(if better { indented } else { plain })
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: &'a Tokens,
    at: usize,
    by_indent: bool,
    open: Vec<char>,
    told_cut: bool,
    tree: Tree,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str, tokens: &'a Tokens, by_indent: bool) -> Self {
        let mut tree = Tree::default();
        for at in &tokens.unclosed {
            let problem = "the text in quotes is not closed on its line";
            let found = UnplacedFault::error("", problem).hint("end it with `\"`");
            tree.faults.push((at.clone(), found));
        }
        Self { text, tokens, at: 0, by_indent, open: Vec::new(), told_cut: false, tree }
    }

    fn whole(mut self) -> Option<Tree> {
        if self.word() == Some("#!") {
            self.at += 1;
            self.value("", 0..0, 0)?;
            self.tree.nodes.clear();
        }
        self.tree.root = self.value("", 0..0, 0)?;
        if let Some(next) = self.peek() {
            let problem = "something follows after the end of the scenario";
            let at = next.at.clone();
            self.fault(at, "", problem, "");
            self.tree.brackets += 1;
        }
        self.tree.cut |= self.tokens.cut;
        if self.tree.cut
            && let Some(last) = self.tokens.all.last()
        {
            // The last token of a text that was cut off may be incomplete.
            for node in &mut self.tree.nodes {
                if node.value.end == last.at.end && matches!(node.kind, Kind::Word) {
                    node.kind = Kind::Missing;
                    node.silent = true;
                }
            }
        }
        Some(self.tree)
    }

    fn peek(&self) -> Option<&'a Token> {
        self.tokens.all.get(self.at)
    }

    fn first(&self, ahead: usize) -> char {
        (self.tokens.all.get(self.at + ahead)).map_or('\0', |t| t.first)
    }

    fn slice(&self, token: &Token) -> &'a str {
        &self.text[token.at.clone()]
    }

    fn word(&self) -> Option<&'a str> {
        self.peek().filter(|t| !is_mark(t.first)).map(|t| self.slice(t))
    }

    fn fault(&mut self, at: Range<usize>, path: &str, problem: &str, hint: &str) {
        let found = UnplacedFault::error(path, problem);
        let found = if hint.is_empty() { found } else { found.hint(hint) };
        self.tree.faults.push((at, found));
    }

    fn push(&mut self, path: &str, key: &Range<usize>, value: Range<usize>, kind: Kind) -> usize {
        let start = if key.is_empty() { value.start } else { key.start };
        self.tree.nodes.push(Node { path: path.to_string(), whole: start..value.end, value, kind, silent: false });
        self.tree.nodes.len() - 1
    }

    fn missing(&mut self, path: &str, key: &Range<usize>) -> usize {
        let end = key.end;
        let id = self.push(path, key, end..end, Kind::Missing);
        self.tree.nodes[id].silent = true;
        id
    }

    /// Parses the value at the current place; there is one.
    fn value(&mut self, path: &str, key: Range<usize>, depth: usize) -> Option<usize> {
        if depth > DEEPEST {
            return None;
        }
        let Some(token) = self.peek() else {
            self.tree.cut = true;
            return Some(self.missing(path, &key));
        };
        let start = token.at.start;
        let name = self.word();
        self.at += 1;
        let bracket = if name.is_some() { self.first(0) } else { token.first };
        let named = name.is_some_and(is_name);
        if name.is_some() && !(named && "([{".contains(bracket)) {
            return Some(self.push(path, &key, token.at.clone(), Kind::Word));
        }
        if name.is_none() && !"([{".contains(bracket) {
            let problem = format!("expected a value, got `{}`", self.slice(token));
            self.fault(token.at.clone(), path, &problem, "");
            return Some(self.missing(path, &key));
        }
        if name.is_some() {
            self.at += 1;
        }
        let opener = self.at - 1;
        self.open.push(bracket);
        let (items, silent) = self.items(path, bracket, opener, named, depth)?;
        self.open.pop();
        let end = (self.tokens.all.get(self.at - 1)).map_or(start, |t| t.at.end);
        let group = Group { name: name.map(str::to_string), bracket, items };
        let id = self.push(path, &key, start..end, Kind::Group(group));
        self.tree.nodes[id].silent = silent;
        Some(id)
    }

    /// Parses what is between brackets. Also returns whether the closing bracket is missing.
    fn items(
        &mut self,
        path: &str,
        bracket: char,
        opener: usize,
        variant: bool,
        depth: usize,
    ) -> Option<(Vec<Item>, bool)> {
        let mut items = Vec::new();
        let mut comma = true;
        loop {
            let Some(token) = self.peek() else {
                self.tree.cut = true;
                if !std::mem::replace(&mut self.told_cut, true) {
                    self.cut(path, bracket, opener);
                }
                return Some((items, true));
            };
            if self.by_indent && self.outdented(opener) {
                let at = self.tokens.all[opener].at.clone();
                let problem = format!("this `{bracket}` is not closed");
                let line = 1 + self.text[..token.at.start].matches('\n').count();
                let hint = format!("a `{}` is missing before line {line}", closing(bracket));
                self.fault(at, path, &problem, &hint);
                self.tree.brackets += 1;
                return Some((items, true));
            }
            match token.first {
                ')' | ']' | '}' => {
                    if token.first != closing(bracket) {
                        self.tree.brackets += 1;
                        let outer = &self.open[..self.open.len() - 1];
                        let mine = outer.iter().rev().any(|b| closing(*b) == token.first);
                        if mine {
                            let problem = format!("expected `{}` before this `{}`", closing(bracket), token.first);
                            let line = 1 + self.text[..self.tokens.all[opener].at.start].matches('\n').count();
                            let hint = format!("the `{bracket}` of line {line} is not closed");
                            self.fault(token.at.clone(), path, &problem, &hint);
                            return Some((items, true));
                        }
                        let open = self.tokens.all[opener].at.start;
                        if depth > 0 && !self.text[open..token.at.start].contains('\n') {
                            let problem = format!("expected `{}`, got `{}`", closing(bracket), token.first);
                            self.fault(token.at.clone(), path, &problem, "");
                            self.at += 1;
                            return Some((items, false));
                        }
                        let problem = format!("this `{}` closes nothing", token.first);
                        self.fault(token.at.clone(), path, &problem, "remove it");
                        self.at += 1;
                        continue;
                    }
                    self.at += 1;
                    if depth == 0 && self.peek().is_some() && self.goes_on() {
                        self.tree.brackets += 1;
                        let problem = format!("this `{}` is one too many", token.first);
                        let hint = "the scenario continues after it: remove it";
                        self.fault(token.at.clone(), path, &problem, hint);
                        continue;
                    }
                    return Some((items, false));
                }
                ',' => {
                    if comma {
                        let problem = "expected a value before this comma";
                        self.fault(token.at.clone(), path, problem, "remove the comma");
                    }
                    comma = true;
                    self.at += 1;
                    continue;
                }
                ':' | '=' | ';' => {
                    let problem = format!("expected a comma, got `{}`", token.first);
                    self.fault(token.at.clone(), path, &problem, "");
                    comma = true;
                    self.at += 1;
                    continue;
                }
                _ => {}
            }
            let key = self.key(bracket);
            let item_path = match &key {
                Some(_) => joined(path, self.word().unwrap_or_default()),
                None if bracket == '[' => format!("{path}[{}]", items.len()),
                None if path.is_empty() || variant && items.is_empty() => path.to_string(),
                None => joined(path, &items.len().to_string()),
            };
            if !comma {
                let at = token.at.start;
                let hint = "fields and elements are separated by `,`";
                self.fault(at..at, &item_path, "expected a comma", hint);
            }
            let item = self.item(key, &item_path, bracket, depth)?;
            items.push(item);
            // A value whose closing bracket is missing may include the comma after it.
            comma = self.tokens.all[self.at - 1].first == ',';
        }
    }

    /// Number of tokens before the value, if the item has a name: 2 with a colon, 1 if the colon is missing.
    fn key(&self, bracket: char) -> Option<usize> {
        let word = self.word().filter(|w| is_name(w))?;
        if matches!(self.first(1), ':' | '=') {
            return Some(2);
        }
        // `width_m 50`: a field's name, and its value on the same line.
        let next = self.tokens.all.get(self.at + 1)?;
        let same_line = !self.text[self.peek()?.at.end..next.at.start].contains('\n');
        let field = word.starts_with(|c: char| c.is_ascii_lowercase() || c == '_')
            && !matches!(word, "true" | "false" | "inf" | "r");
        let begins = !is_mark(next.first) || "([{".contains(next.first);
        (bracket == '(' && same_line && field && begins).then_some(1)
    }

    fn item(&mut self, key: Option<usize>, path: &str, bracket: char, depth: usize) -> Option<Item> {
        let Some(skip) = key else {
            let node = self.value(path, 0..0, depth + 1)?;
            return Some(Item { key: None, key_at: 0..0, node });
        };
        let name = self.peek()?;
        let word = self.slice(name);
        let mark = self.first(1);
        self.at += skip;
        if skip == 1 || mark == '=' {
            let problem = format!("expected `:` after `{word}`");
            self.fault(name.at.clone(), path, &problem, "");
        } else if bracket == '[' {
            let problem = format!("an element of a list has no name, got `{word}:`");
            let hint = "fields stand in parentheses: `[(name: value), ...]`";
            self.fault(name.at.clone(), path, &problem, hint);
        }
        let value_follows = match self.peek() {
            None => true,
            Some(t) if ",)]}:=;".contains(t.first) => false,
            Some(_) => self.key(bracket) != Some(2),
        };
        let node = if value_follows {
            self.value(path, name.at.clone(), depth + 1)?
        } else {
            let problem = format!("expected a value after `{word}:`");
            self.fault(name.at.clone(), path, &problem, "");
            self.missing(path, &name.at)
        };
        Some(Item { key: Some(word.to_string()), key_at: name.at.clone(), node })
    }

    /// Reports that the text ends within these brackets; only the innermost ones are reported.
    fn cut(&mut self, path: &str, bracket: char, opener: usize) {
        let lines = self.text.lines().count();
        let problem = format!("the file ends at line {lines} before this `{bracket}` is closed");
        let hint = "the file may have been cut off, or a closing bracket is missing";
        let found = UnplacedFault::error(path, problem).hint(hint).label("opened here");
        let at = self.tokens.all[opener].at.clone();
        self.tree.faults.push((at, found));
    }

    /// Whether this line is indented no deeper than the line that opened the bracket, but does not close it.
    fn outdented(&self, opener: usize) -> bool {
        let (Some(token), open) = (self.peek(), &self.tokens.all[opener]) else {
            return false;
        };
        // Most tokens are not the first of their line.
        let gap = self.tokens.all[self.at.max(1) - 1].at.end..token.at.start;
        if self.at == 0 || !self.text[gap].contains('\n') {
            return false;
        }
        let line = |at: usize| self.text[..at].rfind('\n').map_or(0, |i| i + 1);
        let (here, there) = (line(token.at.start), line(open.at.start));
        let blank = |from: usize, to: usize| self.text[from..to].trim().is_empty();
        let indent = |from: usize| {
            let rest = &self.text[from..];
            rest.len() - rest.trim_start_matches([' ', '\t']).len()
        };
        let closes = token.first == closing(self.slice(open).chars().next().unwrap_or(' '));
        here > there && blank(here, token.at.start) && indent(here) <= indent(there) && !closes
    }

    /// Whether more fields, and another closing bracket at the end, follow the bracket that closes the whole.
    fn goes_on(&self) -> bool {
        self.first(0) == ',' && self.tokens.all.last().is_some_and(|t| t.first == ')')
    }
}

fn closing(bracket: char) -> char {
    match bracket {
        '(' => ')',
        '[' => ']',
        _ => '}',
    }
}

fn is_mark(first: char) -> bool {
    "()[]{},:=;".contains(first)
}
