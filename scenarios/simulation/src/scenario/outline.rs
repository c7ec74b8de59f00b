//! The places of all fields in a RON text: from paths such as `robots[1].start` to places, and back.
//!
//! ron knows places only while it reads. Later checks (a start inside an obstacle) know only a path. This scan follows
//! brackets and field names and nothing else. It never fails: of a broken text it returns as much as it has seen.

use std::ops::Range;

/// Deepest nesting of brackets.
pub(super) const DEEPEST: usize = 128;

/// A field, an element of a list, or a positional value.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its path; empty for the whole.
    pub path: String,
    /// From its name, if it has one, to the end of its value, in bytes.
    pub whole: Range<usize>,
    /// Its value.
    pub value: Range<usize>,
}

/// All places of a text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Every value; inner values come before the ones around them.
    pub nodes: Vec<Node>,
    /// Brackets that are open at the end of the text, outermost first.
    pub open: Vec<(char, usize)>,
}

/// An open bracket and the item being read within it.
struct Frame {
    path: String,
    bracket: Option<(char, usize)>,
    variant: bool,
    count: usize,
    key: Option<Range<usize>>,
    start: Option<usize>,
    end: usize,
    /// The newest token, and the end of the one before it.
    last: Range<usize>,
    before: usize,
}

impl Frame {
    fn new(path: String, bracket: Option<(char, usize)>, variant: bool) -> Self {
        Self { path, bracket, variant, count: 0, key: None, start: None, end: 0, last: 0..0, before: 0 }
    }

    fn item_path(&self, text: &str) -> String {
        let Some((bracket, _)) = self.bracket else {
            return String::new();
        };
        match &self.key {
            Some(k) => joined(&self.path, &text[k.clone()]),
            None if bracket == '[' => format!("{}[{}]", self.path, self.count),
            // `Altitude(2.0)`: the value of the variant is the value of the field.
            None if self.path.is_empty() || self.variant && self.count == 0 => self.path.clone(),
            None => joined(&self.path, &self.count.to_string()),
        }
    }

    fn finish(&mut self, text: &str, nodes: &mut Vec<Node>) {
        let path = self.item_path(text);
        let key = self.key.take();
        if let Some(start) = self.start.take() {
            nodes.push(Node { path, whole: key.map_or(start, |k| k.start)..self.end, value: start..self.end });
            self.count += 1;
        }
    }

    fn take(&mut self, token: Range<usize>) {
        self.start.get_or_insert(token.start);
        self.before = self.end;
        self.end = token.end;
        self.last = token;
    }

    /// Handles a colon: the newest token is a name, and what comes before it lacks its comma.
    fn name(&mut self, text: &str, nodes: &mut Vec<Node>) {
        let Some(start) = self.start else {
            return;
        };
        if start < self.last.start {
            self.end = self.before;
            self.finish(text, nodes);
        }
        self.start = None;
        self.key = Some(self.last.clone());
    }
}

impl Outline {
    /// Scans a text.
    pub fn scan(text: &str) -> Self {
        // Deeper values are dropped: their paths, each longer than the one around it, would fill the memory.
        let (mut nodes, mut deeper) = (Vec::new(), Vec::new());
        let mut stack = vec![Frame::new(String::new(), None, false)];
        let mut at = 0;
        while at < text.len() {
            let rest = &text[at..];
            let token = at..at + token_len(rest);
            let deep = stack.len() > DEEPEST;
            let nodes = if deep { &mut deeper } else { &mut nodes };
            let top = stack.last_mut().expect("the root frame is never popped");
            match rest.as_bytes()[0] {
                open @ (b'(' | b'[' | b'{') => {
                    let variant = top.start.is_some();
                    top.take(token.clone());
                    let path = if deep { String::new() } else { top.item_path(text) };
                    stack.push(Frame::new(path, Some((open as char, at)), variant));
                }
                b')' | b']' | b'}' => {
                    top.finish(text, nodes);
                    if stack.len() > 1 {
                        stack.pop();
                        stack.last_mut().expect("checked").end = token.end;
                    }
                }
                b',' => top.finish(text, nodes),
                b':' => top.name(text, nodes),
                _ if is_blank(rest) => {}
                _ => top.take(token.clone()),
            }
            at = token.end;
        }
        let open = stack.iter().filter_map(|f| f.bracket).collect();
        for (n, frame) in stack.iter_mut().enumerate().rev() {
            frame.end = text.trim_end().len().max(frame.end);
            let nodes = if n < DEEPEST { &mut nodes } else { &mut deeper };
            frame.finish(text, nodes);
        }
        Self { nodes, open }
    }

    /// The node of a path, or of the nearest enclosing path that the text has.
    pub(super) fn find(&self, path: &str) -> Option<&Node> {
        let mut path = path;
        loop {
            // The outermost node of that path: `Altitude(2.0)`, not `2.0`.
            if let Some(node) = self.nodes.iter().rev().find(|n| n.path == path) {
                return Some(node);
            }
            path = &path[..path.rfind(['.', '['])?];
        }
    }

    /// The innermost node over a place.
    pub(super) fn innermost(&self, place: usize) -> Option<&Node> {
        self.nodes.iter().filter(|n| n.whole.start <= place && place < n.whole.end).min_by_key(|n| n.whole.len())
    }
}

pub(super) fn joined(path: &str, part: &str) -> String {
    if path.is_empty() { part.to_string() } else { format!("{path}.{part}") }
}

pub(super) fn is_blank(rest: &str) -> bool {
    rest.starts_with(char::is_whitespace) || rest.starts_with("//") || rest.starts_with("/*")
}

/// Length of the token, comment or blank a text begins with; at least one character.
pub(super) fn token_len(rest: &str) -> usize {
    let whole = rest.len();
    if rest.starts_with("//") {
        return rest.find('\n').unwrap_or(whole);
    }
    if rest.starts_with("/*") {
        return block_comment(rest);
    }
    if let Some(body) = rest.strip_prefix('"') {
        let mut escaped = false;
        for (i, c) in body.char_indices() {
            match c {
                '"' if !escaped => return i + 2,
                _ => escaped = c == '\\' && !escaped,
            }
        }
        return whole;
    }
    let raw = rest.strip_prefix('r').unwrap_or("");
    let hashes = raw.len() - raw.trim_start_matches('#').len();
    if raw[hashes..].starts_with('"') {
        let closing = format!("\"{}", "#".repeat(hashes));
        let from = hashes + 2;
        return rest[from..].find(&closing).map_or(whole, |i| from + i + closing.len());
    }
    let first = rest.chars().next().map_or(1, char::len_utf8);
    if "()[]{},:=;".contains(&rest[..first]) || rest.starts_with(char::is_whitespace) {
        return first;
    }
    rest.find(|c: char| c.is_whitespace() || "()[]{},:=;\"/".contains(c)).unwrap_or(whole).max(first)
}

fn block_comment(rest: &str) -> usize {
    let (mut depth, mut at) = (0, 0);
    while at < rest.len() {
        let step = if rest[at..].starts_with("/*") {
            depth += 1;
            2
        } else if rest[at..].starts_with("*/") {
            depth -= 1;
            2
        } else {
            rest[at..].chars().next().map_or(1, char::len_utf8)
        };
        at += step;
        if depth == 0 {
            break;
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r##"( // (a comment
        title: "a ( \" b", /* nested /* ) */ */
        robots: [(id: "a"), Some(( start: (east_m: 1, v: Depth(2.0)), )), ],
        raw: r#"x " ) y"#, size: (1, 2, 3),
    )"##;

    fn value(path: &str) -> &'static str {
        let o = Outline::scan(TEXT);
        TEXT.get(o.find(path).unwrap().value.clone()).unwrap()
    }

    #[test]
    fn paths_lead_to_their_values() {
        assert_eq!(value("title"), r#""a ( \" b""#);
        assert_eq!(value("robots[0].id"), "\"a\"");
        assert_eq!(value("robots[1].start.east_m"), "1");
        assert_eq!(value("robots[1].start.v"), "Depth(2.0)");
        assert_eq!(value("raw"), r##"r#"x " ) y"#"##);
        assert_eq!(value("size.2"), "3");
    }

    #[test]
    fn a_path_the_text_lacks_leads_to_what_is_around_it() {
        assert_eq!(value("robots[0].start.depth_m"), "(id: \"a\")");
        assert!(Outline::scan(TEXT).find("").is_some());
    }

    #[test]
    fn places_lead_to_their_paths() {
        let o = Outline::scan(TEXT);
        let at = |needle: &str| o.innermost(TEXT.find(needle).unwrap()).unwrap().path.clone();
        assert_eq!(at("east_m"), "robots[1].start.east_m");
        assert_eq!(at("2.0"), "robots[1].start.v");
        assert_eq!(at("robots"), "robots");
        assert!(o.open.is_empty());
    }

    #[test]
    fn a_cut_text_says_what_is_open_at_any_cut() {
        for cut in (0..TEXT.len()).filter(|&i| TEXT.is_char_boundary(i)) {
            let o = Outline::scan(&TEXT[..cut]);
            assert_eq!(o.open.is_empty(), cut == 0, "cut at {cut}");
        }
        let cut = TEXT.find("east_m").unwrap();
        let open: String = Outline::scan(&TEXT[..cut]).open.iter().map(|o| o.0).collect();
        assert_eq!(open, "([(((".to_string());
    }

    #[test]
    fn paths_of_brackets_without_end_stay_short() {
        let n = 100_000;
        let text = format!("({}1{})", "a: (".repeat(n), ")".repeat(n));
        for text in [&text, &text[..text.len() - n]] {
            let all: usize = Outline::scan(text).nodes.iter().map(|n| n.path.len()).sum();
            assert!(all < 1 << 16, "{all} bytes");
        }
    }
}
