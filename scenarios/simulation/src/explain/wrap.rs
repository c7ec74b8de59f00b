//! Breaks prose into lines.

/// The words of a text in lines of at most `width` characters; a longer word has a line of its own.
///
/// No line begins with a word that Markdown takes for the mark of a list, a heading or a quotation.
pub(super) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut words = text.split_whitespace().peekable();
    while let Some(word) = words.next() {
        let mut piece = word.to_string();
        while let Some(mark) = words.next_if(|next| is_mark(next)) {
            piece.push(' ');
            piece.push_str(mark);
        }
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + piece.chars().count() <= width => {
                line.push(' ');
                line.push_str(&piece);
            }
            _ => lines.push(piece),
        }
    }
    lines
}

fn is_mark(word: &str) -> bool {
    let number = word.strip_suffix(['.', ')']);
    matches!(word, "-" | "+" | "*")
        || word.starts_with(['#', '>', '|'])
        || number.is_some_and(|n| !n.is_empty() && n.chars().all(|c| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_as_long_as_they_may_be_and_none_becomes_a_list_by_accident() {
        for (text, width, lines) in [
            ("one two\n three", 7, ["one two", "three"].as_slice()),
            ("one two three", 6, &["one", "two", "three"]),
            ("longer than six", 6, &["longer", "than", "six"]),
            ("unbreakable", 6, &["unbreakable"]),
            (" \n ", 6, &[]),
            ("so many as 3. And", 10, &["so many", "as 3. And"]),
            ("depth - 5 m", 6, &["depth -", "5 m"]),
        ] {
            assert_eq!(wrap(text, width), lines);
        }
    }
}
