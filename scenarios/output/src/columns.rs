//! Tables and their columns: name, unit and meaning of each. Writers take the names from these descriptions, so that no
//! column is without one.

use std::fmt::Write as _;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColumnInfo {
    /// Its name in the table. `<probe>` stands for the name of each probe.
    pub name: &'static str,
    /// Its unit; empty for texts, numbers of things, shares and yes or no.
    pub unit: &'static str,
    /// What it means, in one sentence.
    pub what: &'static str,
}

impl ColumnInfo {
    /// A column.
    ///
    /// # Panics
    /// If the meaning does not end as a sentence.
    pub const fn new(name: &'static str, unit: &'static str, what: &'static str) -> Self {
        let what = what.trim_ascii();
        assert!(matches!(what.as_bytes(), [.., b'.']), "a sentence");
        Self { name, unit, what }
    }
}

/// An array of columns: name, unit and meaning of each.
macro_rules! columns {
    ($($name:literal, $unit:literal, $what:literal;)*) => {
        [$($crate::columns::ColumnInfo::new($name, $unit, $what)),*]
    };
}
pub(crate) use columns;

/// A table and its columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableInfo {
    /// Name of the file, with `<gantry>` or `<robot>` in place of an id.
    pub file: &'static str,
    /// What a row is.
    pub what: &'static str,
    /// Its columns, in order.
    pub columns: Vec<ColumnInfo>,
}

impl TableInfo {
    /// Whether a file of this name holds such a table.
    pub fn is_in(&self, file: &str) -> bool {
        match (self.file.split_once('<'), self.file.rsplit_once('>')) {
            (Some((start, _)), Some((_, end))) => file.starts_with(start) && file.ends_with(end),
            _ => self.file == file,
        }
    }

    /// The table and its columns as text for a terminal.
    pub fn text(&self) -> String {
        let mut out = format!("{}\n  {}\n", self.file, self.what);
        for ColumnInfo { name, unit, what } in &self.columns {
            let unit = if unit.is_empty() { "" } else { &format!(", {unit}") };
            let _ = write!(out, "\n  {name}{unit}\n      {what}\n");
        }
        out
    }
}

/// The names of columns, separated by commas.
pub(crate) fn header(columns: &[ColumnInfo]) -> String {
    let names: Vec<&str> = columns.iter().map(|column| column.name).collect();
    names.join(",")
}

const HEAD: &str = "\
# Every column of every table

`RHEOTAXIS_BLESS=1 cargo test --release --test it -- explained` writes this page from the code that writes
the tables; do not edit it. In a terminal, `rheotaxis explain track.csv` shows the same for one table. Parquet files
carry it with them: the key `columns` of their metadata holds unit and meaning of each column as JSON.

A value that does not exist is empty. East and north are metres from the datum; up is 0 at the still surface. Headings
are clockwise from north.
";

/// The page of all tables, for `docs/columns.md`.
pub fn markdown(tables: &[TableInfo]) -> String {
    let mut out = String::from(HEAD);
    for table in tables {
        let _ = write!(
            out,
            "\n## {}\n\n{}\n\n| column | unit | meaning |\n| --- | --- | --- |\n",
            table.file.replace('<', "\\<"),
            table.what
        );
        for ColumnInfo { name, unit, what } in &table.columns {
            let unit = if unit.is_empty() { "–" } else { unit };
            let _ = writeln!(out, "| `{name}` | {unit} | {what} |");
        }
    }
    out
}
