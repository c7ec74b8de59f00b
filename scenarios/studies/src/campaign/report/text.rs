//! Plain tables.

use std::fmt::Write as _;

/// Widest column, characters; longer cells are not aligned.
const WIDEST: usize = 200;

const TEXT: &str = "writing to a String succeeds";

/// A table whose columns are aligned by spaces. The first column holds words and is as wide as necessary.
pub(crate) fn align<const N: usize>(head: &[&str; N], rows: &[[String; N]]) -> String {
    let width = |k: usize| {
        (rows.iter().map(|r| r[k].chars().count()))
            .chain([head[k].chars().count()])
            .max()
            .unwrap_or(0)
            .min(WIDEST)
    };
    let widths: [usize; N] = std::array::from_fn(width);
    let mut out = String::new();
    let mut line = |cells: [&str; N]| {
        let mut text = String::new();
        for (cell, width) in cells.iter().zip(widths) {
            write!(text, "{cell:<width$}  ").expect(TEXT);
        }
        out.push_str(text.trim_end());
        out.push('\n');
    };
    line(*head);
    let rules = widths.map(|w| "-".repeat(w));
    line(std::array::from_fn(|k| rules[k].as_str()));
    for row in rows {
        line(std::array::from_fn(|k| row[k].as_str()));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The formatter's widest field has 65 535 characters; a row file may contain a longer name.
    #[test]
    fn a_cell_of_any_length_is_written_out() {
        let long = "a".repeat(70_000);
        let rows = [[long.clone(), "12".to_string()]];
        assert!(align(&["x", "value"], &rows).contains(&format!("{long}  12\n")));
    }

    #[test]
    fn columns_stand_under_each_other() {
        let rows = [
            ["a".to_string(), "12".to_string()],
            ["bcd".to_string(), "3".to_string()],
        ];
        assert_eq!(
            align(&["x", "value"], &rows),
            "x    value\n---  -----\na    12\nbcd  3\n"
        );
    }
}
