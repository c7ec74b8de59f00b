//! The tables of a campaign: a line for each run, and a line for each declaration. Each has one column for each field
//! of its record, with the field's name.

use super::row::{DeclarationRow, RunRow};
use output::files::{csv_number, csv_text};

/// How a column is read from a record and written to it. A value that is missing is not written: it stays as in a new
/// record.
pub(crate) enum Column<T> {
    Number(fn(&T) -> Option<u64>, fn(&mut T, u64)),
    Truth(fn(&T) -> bool, fn(&mut T, bool)),
    Text(fn(&T) -> Option<&str>, fn(&mut T, String)),
    Real(fn(&T) -> Option<f64>, fn(&mut T, f64)),
}

/// A line of a table.
pub(crate) trait Record: Default + 'static {
    /// Name of the table.
    const TABLE: &'static str;
    /// Of each column: name, whether it may be empty, and access.
    const COLUMNS: &'static [(&'static str, bool, Column<Self>)];
}

/// A column with a field's name: whether it may be empty, its kind, how it is read and written.
macro_rules! column {
    ($f:ident, $empty:literal, $kind:ident, $read:expr, $write:expr) => {
        (stringify!($f), $empty, Column::$kind($read, $write))
    };
}
macro_rules! number {
    ($f:ident) => {
        column!($f, false, Number, |r| Some(r.$f), |r, v| r.$f = v)
    };
}
macro_rules! maybe_number {
    ($f:ident) => {
        column!($f, true, Number, |r| r.$f, |r, v| r.$f = Some(v))
    };
}
macro_rules! text {
    ($f:ident) => {
        column!($f, false, Text, |r| Some(&r.$f), |r, v| r.$f = v)
    };
}
macro_rules! real {
    ($f:ident) => {
        column!($f, false, Real, |r| Some(r.$f), |r, v| r.$f = v)
    };
}
macro_rules! maybe {
    ($f:ident) => {
        column!($f, true, Real, |r| r.$f, |r, v| r.$f = Some(v))
    };
}

impl Record for RunRow {
    const TABLE: &'static str = "runs";
    const COLUMNS: &'static [(&'static str, bool, Column<Self>)] = &[
        number!(run),
        text!(arm),
        text!(condition),
        number!(seed_index),
        number!(seed),
        text!(outcome),
        column!(success, false, Truth, |r| r.success, |r, v| r.success = v),
        column!(error, true, Text, |r| r.error.as_deref(), |r, v| r.error =
            Some(v)),
        text!(digest),
        real!(mission_s),
        maybe!(first_detection_s),
        maybe!(declared_s),
        maybe!(declared_east_m),
        maybe!(declared_north_m),
        maybe!(error_m),
        maybe!(error_along_m),
        maybe!(error_across_m),
        maybe!(zone_points),
        maybe!(zone_since_s),
        maybe!(traced_m),
        number!(sources_declared),
        real!(travelled_m),
        number!(detections),
        maybe!(sweep_s),
        maybe!(speed_m_s),
        maybe!(ngdr),
        maybe!(far_speed_m_s),
        maybe!(near_speed_m_s),
        maybe!(far_offset_m),
        maybe!(near_offset_m),
        maybe!(correct_cell_s),
        maybe!(map_cell_p),
        maybe!(map_near_p),
        maybe_number!(map_cell_true),
        maybe_number!(map_near_true),
        maybe_number!(map_declared),
        real!(spin_up_wall_s),
        real!(mission_wall_s),
    ];
}

impl Record for DeclarationRow {
    const TABLE: &'static str = "declarations";
    const COLUMNS: &'static [(&'static str, bool, Column<Self>)] = &[
        number!(run),
        text!(arm),
        text!(condition),
        number!(seed_index),
        number!(seed),
        text!(robot),
        number!(number),
        maybe_number!(region),
        text!(rule),
        text!(verdict),
        real!(t_s),
        real!(east_m),
        real!(north_m),
        maybe!(error_m),
        maybe!(error_along_m),
        maybe!(error_across_m),
        maybe!(traced_m),
        maybe!(fix_m),
    ];
}

/// The fields of a line of CSV; a missing value is empty. Numbers read back bit for bit.
pub(super) fn csv_fields<T: Record>(record: &T) -> impl Iterator<Item = String> {
    T::COLUMNS.iter().map(move |(.., column)| match column {
        Column::Number(get, _) => get(record).map_or_else(String::new, |v| v.to_string()),
        Column::Truth(get, _) => get(record).to_string(),
        Column::Text(get, _) => get(record).unwrap_or_default().to_string(),
        Column::Real(get, _) => csv_number(get(record)),
    })
}

fn csv<'a, T: Record>(records: impl IntoIterator<Item = &'a T>) -> String {
    let names: Vec<&str> = T::COLUMNS.iter().map(|(name, ..)| *name).collect();
    csv_text(&names.join(","), records.into_iter().map(csv_fields))
}

/// Reads records from a table of CSV with the names of all columns in its first line. What is wrong is told with line
/// and column; `before` is the number of lines before the table.
pub(crate) fn from_csv<T: Record>(text: &str, before: u64) -> Result<Vec<T>, String> {
    let mut table = csv::ReaderBuilder::new();
    let mut table = table.has_headers(false).from_reader(text.as_bytes());
    let mut records = Vec::new();
    for (n, line) in table.records().enumerate() {
        let line = line.map_err(|e| format!("after line {}: {e}", before + n as u64))?;
        let at = before + line.position().map_or(0, csv::Position::line);
        for ((name, ..), field) in T::COLUMNS.iter().zip(&line) {
            if n == 0 && *name != field {
                return Err(format!(
                    "line {at}: a column must be called {name}, not `{field}`"
                ));
            }
        }
        if line.len() != T::COLUMNS.len() {
            let (want, got) = (T::COLUMNS.len(), line.len());
            return Err(format!("line {at}: must have {want} fields, has {got}"));
        }
        if n > 0 {
            records.push(record(&line).map_err(|e| format!("line {at}, {e}"))?);
        }
    }
    match text.is_empty() {
        true => Err("it is empty".to_string()),
        false => Ok(records),
    }
}

fn record<T: Record>(line: &csv::StringRecord) -> Result<T, String> {
    let mut record = T::default();
    for ((name, optional, column), field) in T::COLUMNS.iter().zip(line) {
        if *optional && field.is_empty() {
            continue;
        }
        let wrong = |what: &str| format!("column {name}: must be {what}, got `{field}`");
        match column {
            Column::Number(_, set) => {
                let v = field.parse().map_err(|_| wrong("a whole number"))?;
                set(&mut record, v);
            }
            Column::Truth(_, set) => {
                let v = field.parse().map_err(|_| wrong("true or false"))?;
                set(&mut record, v);
            }
            Column::Text(_, set) => set(&mut record, field.to_string()),
            Column::Real(_, set) => set(&mut record, field.parse().map_err(|_| wrong("a number"))?),
        }
    }
    Ok(record)
}

/// Rows of runs and their declarations as two tables of CSV.
pub(crate) fn as_csv(rows: &[RunRow]) -> [String; 2] {
    let declarations = rows.iter().flat_map(|row| &row.declarations);
    [csv(rows), csv(declarations)]
}

#[cfg(test)]
mod tests {
    use super::super::report::sample::row;
    use super::*;

    #[test]
    fn every_run_and_every_declaration_is_a_line_under_the_names() {
        let declared = DeclarationRow {
            rule: "stop, at last".to_string(),
            ..DeclarationRow::default()
        };
        let twice = RunRow {
            declarations: vec![declared; 2],
            ..row(0, Some((1.0, 2.0)))
        };
        let [runs, declarations] = as_csv(&[twice, row(1, None)]);
        let commas: Vec<usize> = runs.lines().map(|l| l.matches(',').count()).collect();
        assert_eq!(commas, [RunRow::COLUMNS.len() - 1; 3]);
        assert!(runs.starts_with("run,") && !runs.contains("NaN"));
        assert_eq!(declarations.lines().count(), 3);
        assert!(
            declarations.contains(",\"stop, at last\","),
            "{declarations}"
        );
    }
}
