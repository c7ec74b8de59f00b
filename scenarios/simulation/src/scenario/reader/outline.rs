//! The places of all fields in a RON text: from paths such as `robots[1].start` to places, and back.
//!
//! ron knows places only while it reads. Later checks (a start inside an obstacle) know only a path. Of a broken text
//! the outline has as much as can be understood.

use super::tree::Tree;
use crate::scenario::fault::{Fault, UnplacedFault};
use std::ops::Range;

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
    /// Whether the text is one value with matching brackets.
    pub whole: bool,
}

impl Outline {
    /// Scans a text.
    pub fn scan(text: &str) -> Self {
        let Some(tree) = Tree::parse(text) else {
            // Nested too deep: the reader says so.
            let all = 0..text.len();
            return Self { nodes: vec![Node { path: String::new(), whole: all.clone(), value: all }], whole: false };
        };
        let whole = !tree.cut && tree.brackets == 0;
        let written = tree.nodes.into_iter().filter(|n| !n.value.is_empty());
        let nodes = written.map(|n| Node { path: n.path, whole: n.whole, value: n.value }).collect();
        Self { nodes, whole }
    }

    /// A mistake at the place of its path; errors call the text `name`.
    pub fn located(&self, name: &str, text: &str, found: UnplacedFault) -> Fault {
        let span = self.find(&found.path).map_or(0..0, |n| n.whole.clone());
        Fault::new(name, text, span, found)
    }

    /// The node of a path, or of the nearest enclosing path that the text has.
    pub(in crate::scenario) fn find(&self, path: &str) -> Option<&Node> {
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
    pub(in crate::scenario) fn innermost(&self, place: usize) -> Option<&Node> {
        self.nodes.iter().filter(|n| n.whole.start <= place && place < n.whole.end).min_by_key(|n| n.whole.len())
    }
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
    fn paths_lead_to_their_values_or_to_what_is_around_them() {
        for (path, is) in [
            ("title", r#""a ( \" b""#),
            ("robots[0].id", "\"a\""),
            ("robots[1].start.east_m", "1"),
            ("robots[1].start.v", "Depth(2.0)"),
            ("raw", r##"r#"x " ) y"#"##),
            ("size.2", "3"),
            ("robots[0].start.depth_m", "(id: \"a\")"),
        ] {
            assert_eq!(value(path), is);
        }
        assert!(Outline::scan(TEXT).find("").is_some());
    }

    #[test]
    fn places_lead_to_their_paths() {
        let o = Outline::scan(TEXT);
        let at = |needle: &str| o.innermost(TEXT.find(needle).unwrap()).unwrap().path.clone();
        assert_eq!(at("east_m"), "robots[1].start.east_m");
        assert_eq!(at("2.0"), "robots[1].start.v");
        assert_eq!(at("robots"), "robots");
        assert!(o.whole);
    }

    #[test]
    fn a_cut_text_says_so_at_any_cut() {
        for cut in (1..TEXT.len()).filter(|&i| TEXT.is_char_boundary(i)) {
            assert!(!Outline::scan(&TEXT[..cut]).whole, "cut at {cut}");
        }
        assert!(Outline::scan("").nodes.is_empty());
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
