//! What a report says in tables and words, and the same as plain text for a terminal.

use super::text::{Table, wrapped};
use std::fmt::Write as _;

const TEXT: &str = "writing to a String succeeds";

/// The tables and words of a report.
#[derive(Clone, Debug, Default)]
pub(super) struct Content {
    pub(super) title: String,
    /// Which campaign it is, and what counts as a success.
    pub(super) about: Vec<String>,
    /// What each arm sets.
    pub(super) sets: Table,
    pub(super) limit_s: f64,
    pub(super) success: Table,
    /// A table for each measure.
    pub(super) measured: Vec<(String, Table)>,
    pub(super) restricted: Table,
    /// A table for each quantity by which arms are compared; none for one arm.
    pub(super) pairs: Vec<(String, Table)>,
    pub(super) warnings: Vec<String>,
    /// How sure the maps are, and what stands below that; none without maps.
    pub(super) reliable: Option<(Table, String)>,
    pub(super) walls: String,
    pub(super) first_error: Option<String>,
}

impl Content {
    /// As plain text, in at most `columns` characters where there is such a limit.
    pub(super) fn text(&self, columns: Option<usize>) -> String {
        let mut out = String::new();
        let mut line = |words: &str| {
            let words = wrapped(words, columns);
            out.push_str(words.trim_end());
            out.push('\n');
        };
        line(&self.title);
        for words in &self.about {
            line(words);
        }
        for row in &self.sets.rows {
            line(&format!("  arm {}: {}", row[0], row[1]));
        }
        let limit = format!("The limit is {:.0} s", self.limit_s);
        let restricted = (limit, self.restricted.clone());
        let mut tables = vec![(String::new(), self.success.clone())];
        tables.extend(self.measured.iter().cloned());
        tables.push(restricted);
        for (title, table) in &tables {
            section(&mut out, title, table, columns);
        }
        for (title, table) in &self.pairs {
            section(&mut out, &format!("{title}, arm against arm"), table, columns);
        }
        for warning in &self.warnings {
            paragraph(&mut out, &format!("Warning: {warning}"), columns);
        }
        if let Some((table, notes)) = &self.reliable {
            section(&mut out, "How sure the maps are", table, columns);
            paragraph(&mut out, notes, columns);
        }
        paragraph(&mut out, &self.walls, columns);
        if let Some(error) = &self.first_error {
            paragraph(&mut out, error, columns);
        }
        out
    }
}

fn section(out: &mut String, title: &str, table: &Table, columns: Option<usize>) {
    out.push('\n');
    if !title.is_empty() {
        writeln!(out, "{title}").expect(TEXT);
    }
    out.push_str(&table.text(columns));
}

fn paragraph(out: &mut String, words: &str, columns: Option<usize>) {
    out.push('\n');
    out.push_str(wrapped(words, columns).trim_end());
    out.push('\n');
}
