//! ron's messages in this house's words: the field's path, what was given, what is legal.

use super::fault::{Fault, Found, ScenarioError};
use super::outline::Outline;
use ron::error::{Error, Position, SpannedError};
use std::ops::Range;

/// Longest value repeated in a message, bytes.
const SHORT: usize = 40;

/// Turns an error of the reader into one that points at its place.
pub(crate) fn explain(name: &str, text: &str, error: &SpannedError) -> ScenarioError {
    let outline = Outline::of(text);
    let span = offset(text, error.span.start)..offset(text, error.span.end);
    // At the end: nothing but the piece of a token follows the place.
    let rest = text[span.end..].trim_end();
    let at_end = !rest.contains(|c: char| c.is_whitespace() || "()[]{},:".contains(c))
        || matches!(
            error.code,
            Error::Eof | Error::ExpectedStringEnd | Error::UnclosedBlockComment
        );
    if at_end && let Some(&(bracket, open)) = outline.open.last() {
        return truncated(name, text, &outline, bracket, open);
    }
    let place = if matches!(error.code, Error::MissingStructField { .. }) {
        span.end
    } else {
        span.start
    };
    let node = outline.at(place);
    let path = node.map_or("", |n| n.path.as_str());
    let around = path.rfind(['.', '[']).map_or("", |i| &path[..i]);
    let (span, found) = match &error.code {
        Error::NoSuchStructField {
            expected, found, ..
        } => (
            span,
            Found::error(around, format!("there is no field `{found}`"))
                .hint(choose(found, expected, "fields")),
        ),
        Error::NoSuchEnumVariant {
            expected, found, ..
        } => (
            span,
            Found::error(path, format!("there is no choice `{found}`"))
                .hint(choose(found, expected, "choices")),
        ),
        Error::MissingStructField { field, .. } => (
            node.map_or(span, |n| n.whole.clone()),
            Found::error(path, format!("the field `{field}` is missing"))
                .hint(format!("add `{field}: ...`")),
        ),
        Error::DuplicateStructField { field, .. } => (
            span,
            Found::error(around, format!("the field `{field}` is given twice")),
        ),
        Error::ExpectedComma => (
            span,
            Found::error(path, "expected a comma").hint("fields and elements are separated by `,`"),
        ),
        Error::TrailingCharacters => (
            span,
            Found::error("", "something follows after the end of the scenario"),
        ),
        Error::Message(message) => {
            let found = Found::error(path, message.clone());
            let odd = ["NaN", "inf"].iter().any(|w| message.contains(w));
            let found = if odd {
                found.hint("give a finite number")
            } else {
                found
            };
            (node.map_or(span, |n| n.value.clone()), found)
        }
        other => return unexpected(name, text, &outline, span, other),
    };
    Box::new(Fault::new(name, text, trimmed(text, span), found)).into()
}

/// Something of another kind than what belongs here.
fn unexpected(
    name: &str,
    text: &str,
    outline: &Outline,
    span: Range<usize>,
    error: &Error,
) -> ScenarioError {
    let wanted = match error {
        Error::ExpectedFloat => "expected a number".to_string(),
        Error::ExpectedString => "expected a text in quotes".to_string(),
        Error::InvalidValueForType { expected, .. } if expected.contains("nonzero") => {
            "must be at least 1".to_string()
        }
        other => lower(&other.to_string()),
    };
    // After the last token of a value the reader stands just behind it.
    let before = text[..span.start].trim_end().len().saturating_sub(1);
    let node = [span.start, before]
        .into_iter()
        .filter_map(|at| outline.at(at))
        .find(|n| !n.path.is_empty());
    let (path, span, got) = node.map_or(("", span, ""), |n| {
        (n.path.as_str(), n.value.clone(), &text[n.value.clone()])
    });
    let message = if (1..=SHORT).contains(&got.len()) && !got.contains('\n') {
        format!("{wanted}, got {got}")
    } else {
        wanted
    };
    Box::new(Fault::new(name, text, span, Found::error(path, message))).into()
}

/// A text that stops before its brackets are closed.
fn truncated(
    name: &str,
    text: &str,
    outline: &Outline,
    bracket: char,
    open: usize,
) -> ScenarioError {
    let lines = text.lines().count();
    let path = outline.at(open).map_or("", |n| n.path.as_str());
    let found = Found::error(
        path,
        format!("the file ends at line {lines} before this `{bracket}` is closed"),
    )
    .hint("the file may have been cut off, or a closing bracket is missing")
    .label("opened here");
    Box::new(Fault::new(name, text, open..open + 1, found)).into()
}

/// "did you mean" with what there is to choose from.
fn choose(given: &str, legal: &[&str], what: &str) -> String {
    let nearest = legal
        .iter()
        .map(|l| (distance(given, l), l))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, l)| *d <= 1 + l.len() / 3);
    let all = legal.join(", ");
    match nearest {
        _ if legal.is_empty() => format!("there are no {what} here"),
        Some((_, l)) => format!("did you mean `{l}`? {what} here: {all}"),
        None => format!("{what} here: {all}"),
    }
}

/// Edits (insert, delete, replace) between two words, case ignored.
fn distance(a: &str, b: &str) -> usize {
    let (a, b) = (a.to_ascii_lowercase(), b.to_ascii_lowercase());
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.chars().enumerate() {
            let replaced = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[row.len() - 1]
}

/// Byte offset of a line and column (in characters).
fn offset(text: &str, at: Position) -> usize {
    let start: usize = text
        .split_inclusive('\n')
        .take(at.line - 1)
        .map(str::len)
        .sum();
    text[start..]
        .char_indices()
        .nth(at.col - 1)
        .map_or(text.len(), |(i, _)| start + i)
}

/// Without blanks at either side, but within the text.
fn trimmed(text: &str, span: Range<usize>) -> Range<usize> {
    let part = &text[span.clone()];
    let start = span.start + (part.len() - part.trim_start().len());
    let end = span.start + part.trim_end().len();
    if start < end { start..end } else { span }
}

fn lower(s: &str) -> String {
    let mut chars = s.chars();
    chars.next().map_or_else(String::new, |c| {
        c.to_lowercase().collect::<String>() + chars.as_str()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distance_counts_edits() {
        assert_eq!(distance("lenght_m", "length_m"), 2);
        assert_eq!(distance("Zigzag", "ZigZag"), 0);
        assert_eq!(distance("", "abc"), 3);
    }

    #[test]
    fn only_a_near_name_is_proposed() {
        assert!(
            choose("lenght_m", &["length_m", "width_m"], "fields")
                .starts_with("did you mean `length_m`?")
        );
        assert_eq!(
            choose("colour", &["length_m"], "fields"),
            "fields here: length_m"
        );
    }

    #[test]
    fn positions_count_characters() {
        let text = "ab\né€x";
        assert_eq!(&text[offset(text, Position { line: 2, col: 3 })..], "x");
        assert_eq!(offset(text, Position { line: 2, col: 9 }), text.len());
    }
}
