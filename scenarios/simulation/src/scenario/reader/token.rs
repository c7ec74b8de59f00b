//! The tokens of a RON text: brackets, separators, words and texts in quotes. Blanks and comments are skipped.

use std::ops::Range;

/// A token.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    /// Its place, in bytes.
    pub at: Range<usize>,
    /// Its first character, which tells what it is.
    pub first: char,
}

/// The tokens of a text, and where a text in quotes is not closed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tokens {
    /// The tokens in the order of the text.
    pub all: Vec<Token>,
    /// Texts in quotes that are not closed on their line, although the file continues.
    pub unclosed: Vec<Range<usize>>,
    /// The file ends within a text in quotes.
    pub cut: bool,
}

impl Tokens {
    /// Scans a text. A missing quote would exchange inside and outside of all later texts; then each text in quotes is
    /// taken to end with its line.
    pub(super) fn scan(text: &str) -> Self {
        let whole = scan(text, false);
        if !whole.cut {
            return whole;
        }
        let lines = scan(text, true);
        if lines.unclosed.is_empty() { whole } else { lines }
    }
}

fn scan(text: &str, by_line: bool) -> Tokens {
    let end = text.trim_end().len();
    let mut tokens = Tokens::default();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let mut len = token_len(rest);
        let first = rest.chars().next().unwrap_or(' ');
        if first == '"' {
            let closed = len > 1 && rest[..len].ends_with('"') && ends_its_text(&rest[..len]);
            let line = rest.find('\n').unwrap_or(rest.len());
            if by_line && (!closed || len > line) {
                len = rest[..line].trim_end().len();
                if at + len < end {
                    len = meant(&rest[..len]);
                    tokens.unclosed.push(at..at + len);
                } else {
                    tokens.cut = true;
                }
            } else if !closed {
                tokens.cut = true;
            }
        }
        if !is_blank(rest) {
            let at = at..at + len;
            tokens.all.push(Token { at, first });
        }
        at += len;
    }
    tokens
}

fn is_blank(rest: &str) -> bool {
    rest.starts_with(char::is_whitespace) || rest.starts_with("//") || rest.starts_with("/*")
}

/// Length of the token, comment or blank a text begins with; at least one character.
fn token_len(rest: &str) -> usize {
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

/// The likely end of a text that is not closed on its line: before the next field, or before the brackets and the comma
/// at the end of the line.
fn meant(line: &str) -> usize {
    let next_field = line.match_indices(',').find(|(i, _)| {
        let rest = line[i + 1..].trim_start();
        let name = rest.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_');
        name.len() < rest.len() && name.starts_with(':')
    });
    let end = line.trim_end_matches([')', ']', '}', ',', ' ']).len();
    next_field.map_or(end, |(i, _)| i).max(1)
}

/// Whether its last quote is not escaped.
fn ends_its_text(token: &str) -> bool {
    let body = &token[1..token.len() - 1];
    (body.len() - body.trim_end_matches('\\').len()).is_multiple_of(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_quote_too_few_ends_with_its_line() {
        let text = "(a: \"one,\n b: \"two\", c: 3)";
        let tokens = Tokens::scan(text);
        let unclosed: Vec<&str> = (tokens.unclosed.iter()).map(|r| &text[r.clone()]).collect();
        assert_eq!(unclosed, ["\"one"]);
        assert_eq!(meant("\"eel, n: 1)"), 4);
        assert_eq!(meant("\"one, two)],"), 9);
        assert!(!tokens.cut);
        let cut = Tokens::scan("(a: \"one\", b: \"tw");
        assert!(cut.cut && cut.unclosed.is_empty());
        assert!(!Tokens::scan("(a: \"one\ntwo\", b: \"\\\\\")").cut);
    }
}
