//! The message of the crate ron, for the rare text that ron refuses and our reader of mistakes accepts.

use super::fault::UnplacedFault;
use super::reader::outline::Outline;
use ron::error::{Position, SpannedError};
use std::ops::Range;

/// Its place and the finding.
pub(super) fn unread(text: &str, error: &SpannedError) -> (Range<usize>, UnplacedFault) {
    let span = offset(text, error.span.start)..offset(text, error.span.end);
    let outline = Outline::scan(text);
    let path = outline.innermost(span.start).map_or("", |n| n.path.as_str());
    let message = lower(&error.code.to_string());
    (trimmed(text, span), UnplacedFault::error(path, message))
}

/// Byte offset of a line and column (in characters).
fn offset(text: &str, at: Position) -> usize {
    let start: usize = text.split_inclusive('\n').take(at.line - 1).map(str::len).sum();
    text[start..].char_indices().nth(at.col - 1).map_or(text.len(), |(i, _)| start + i)
}

/// The range without blanks at its ends, if something is left.
fn trimmed(text: &str, span: Range<usize>) -> Range<usize> {
    let part = &text[span.clone()];
    let start = span.start + (part.len() - part.trim_start().len());
    let end = span.start + part.trim_end().len();
    if start < end { start..end } else { span }
}

fn lower(s: &str) -> String {
    let mut chars = s.chars();
    chars.next().map_or_else(String::new, |c| c.to_lowercase().collect::<String>() + chars.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters() {
        let text = "ab\né€x";
        assert_eq!(&text[offset(text, Position { line: 2, col: 3 })..], "x");
        assert_eq!(offset(text, Position { line: 2, col: 9 }), text.len());
    }
}
