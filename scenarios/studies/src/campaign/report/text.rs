//! Tables, and how they are shown as plain text in a terminal of some width.

use output::files::csv_text;
use std::fmt::Write as _;

/// Widest column, characters; longer cells are not aligned.
const WIDEST: usize = 200;

const TEXT: &str = "writing to a String succeeds";

/// A table: what its columns are, and its rows. The first column names the row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Table {
    pub(crate) head: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

/// What a column is, and its cell of a row.
pub(crate) type TableColumn<'a, R> = (&'a str, &'a dyn Fn(&R) -> String);

impl Table {
    /// From heads and rows of the same length.
    pub(crate) fn new<const N: usize>(
        head: [impl Into<String>; N],
        rows: impl IntoIterator<Item = [String; N]>,
    ) -> Self {
        Self { head: head.map(Into::into).into(), rows: rows.into_iter().map(Into::into).collect() }
    }

    /// From rows, and columns: what each is, and its cell of a row.
    pub(crate) fn of<R>(rows: impl IntoIterator<Item = R>, columns: &[TableColumn<'_, R>]) -> Self {
        let cells = |row: R| columns.iter().map(|(_, cell)| cell(&row)).collect();
        Self {
            head: columns.iter().map(|(head, _)| (*head).to_string()).collect(),
            rows: rows.into_iter().map(cells).collect(),
        }
    }

    /// The table as CSV.
    pub(crate) fn csv(&self) -> String {
        csv_text(&self.head.join(","), &self.rows)
    }

    /// The table in Markdown.
    pub(crate) fn markdown(&self) -> String {
        let mut out = String::new();
        let mut line = |cells: &[String]| {
            let safe: Vec<String> = cells.iter().map(|s| s.replace('|', "\\|")).collect();
            writeln!(out, "| {} |", safe.join(" | ")).expect(TEXT);
        };
        line(&self.head);
        line(&vec!["---".to_string(); self.head.len()]);
        self.rows.iter().for_each(|row| line(row));
        out
    }

    /// The table in at most `columns` characters: as it is, or turned, or each row as lines of its own.
    pub(crate) fn text(&self, columns: Option<usize>) -> String {
        let fits = |text: &String| columns.is_none_or(|most| text.lines().all(|l| l.chars().count() <= most));
        (Some(self.aligned()).filter(fits))
            .or_else(|| Some(self.turned().aligned()).filter(fits))
            .unwrap_or_else(|| wrapped(&self.listed(), columns))
    }

    /// Columns aligned by spaces.
    fn aligned(&self) -> String {
        let width = |k: usize| {
            let cells = self.rows.iter().map(|r| &r[k]).chain([&self.head[k]]);
            let longest = cells.map(|c| c.chars().count()).max();
            longest.unwrap_or(0).min(WIDEST)
        };
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let mut out = String::new();
        let mut line = |cells: &[String]| {
            let mut text = String::new();
            for (cell, width) in cells.iter().zip(&widths) {
                write!(text, "{cell:<width$}  ").expect(TEXT);
            }
            out.push_str(text.trim_end());
            out.push('\n');
        };
        line(&self.head);
        let rules: Vec<String> = widths.iter().map(|w| "-".repeat(*w)).collect();
        line(&rules);
        for row in &self.rows {
            line(row);
        }
        out
    }

    /// Rows as columns.
    fn turned(&self) -> Self {
        let column = |k: usize| {
            let cells = self.rows.iter().map(|r| r[k].clone());
            std::iter::once(self.head[k].clone()).chain(cells).collect()
        };
        let mut all = (0..self.head.len()).map(column);
        Self { head: all.next().unwrap_or_default(), rows: all.collect() }
    }

    /// Each row by itself: its first cell, then a line for each other one.
    fn listed(&self) -> String {
        let mut out = String::new();
        for row in &self.rows {
            writeln!(out, "{} {}", self.head[0], row[0]).expect(TEXT);
            for (head, cell) in self.head.iter().zip(row).skip(1) {
                writeln!(out, "  {head}: {cell}").expect(TEXT);
            }
        }
        out
    }
}

/// Lines broken between words, so that they have at most `columns` characters; what follows is set in.
pub(crate) fn wrapped(text: &str, columns: Option<usize>) -> String {
    let Some(most) = columns else {
        return text.to_string();
    };
    let mut out = String::new();
    for line in text.lines() {
        let bare = line.trim_start();
        let mut now = " ".repeat(line.len() - bare.len());
        let inset = format!("{now}  ");
        let mut begun = false;
        for word in bare.split(' ') {
            if begun && now.chars().count() + 1 + word.chars().count() > most {
                writeln!(out, "{now}").expect(TEXT);
                now.clone_from(&inset);
                begun = false;
            }
            if begun {
                now.push(' ');
            }
            now.push_str(word);
            begun = true;
        }
        writeln!(out, "{}", now.trim_end()).expect(TEXT);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let row = |cells: [&str; 3]| cells.map(String::from);
        Table::new(["arm", "median, s", "rests on"], [row(["a", "12", "all 40 pairs"]), row(["bcd", "3", "no pair"])])
    }

    /// The formatter's widest field has 65 535 characters; a row file may contain a longer name.
    #[test]
    fn a_cell_of_any_length_is_written_out() {
        let long = "a".repeat(70_000);
        let rows = [[long.clone(), "12".to_string()]];
        let text = Table::new(["x", "value"], rows).text(None);
        assert!(text.contains(&format!("{long}  12\n")));
    }

    #[test]
    fn columns_stand_under_each_other() {
        let wide = "arm  median, s  rests on\n---  ---------  ------------\na    12         all 40 pairs\n\
            bcd  3          no pair\n";
        assert_eq!(table().text(None), wide);
        assert_eq!(table().text(Some(28)), wide);
    }

    #[test]
    fn a_table_that_is_too_wide_is_turned_and_then_listed() {
        let mut one = table();
        one.rows.truncate(1);
        assert_eq!(
            one.text(Some(24)),
            "arm        a\n---------  ------------\nmedian, s  12\nrests on   all 40 pairs\n"
        );
        assert_eq!(
            table().text(Some(19)),
            "arm a\n  median, s: 12\n  rests on: all 40\n    pairs\narm bcd\n  median, s: 3\n  rests on: no pair\n"
        );
    }

    #[test]
    fn long_lines_are_broken_between_words() {
        assert_eq!(wrapped("one two three\n  four five\n\nx", Some(9)), "one two\n  three\n  four\n    five\n\nx\n");
        let long = "a".repeat(30);
        assert_eq!(wrapped(&long, Some(9)), format!("{long}\n"));
        assert_eq!(wrapped("as it is", None), "as it is");
    }
}
