//! The tables of a campaign: a line for each run, and a line for each declaration. Each has one column for each field
//! of its record, with the field's name.

use super::record::{Column, Record};
use super::row::{DeclarationRow, RunRow};
use output::columns::{ColumnInfo, TableInfo};
use output::files::{csv_number, csv_text};

/// The tables of a campaign.
pub fn tables() -> Vec<TableInfo> {
    fn columns<T: Record>() -> Vec<ColumnInfo> {
        T::COLUMNS.iter().map(|(info, ..)| *info).collect()
    }
    vec![
        TableInfo {
            file: "part-<block>.parquet",
            what: "The runs of a campaign: a row for each. The file that `campaign merge` writes has the same columns.",
            columns: columns::<RunRow>(),
        },
        TableInfo {
            file: "declarations-<block>.parquet",
            what: "The declarations of a campaign's runs: a row for each. `campaign merge` writes such a file, too.",
            columns: columns::<DeclarationRow>(),
        },
    ]
}

/// The fields of a line of CSV; a missing value is empty. Numbers read back bit for bit.
pub(in crate::campaign) fn csv_fields<T: Record>(record: &T) -> impl Iterator<Item = String> {
    T::COLUMNS.iter().map(move |(.., column)| match column {
        Column::Number(get, _) => get(record).map_or_else(String::new, |v| v.to_string()),
        Column::Truth(get, _) => get(record).to_string(),
        Column::Text(get, _) => get(record).unwrap_or_default().to_string(),
        Column::Real(get, _) => csv_number(get(record)),
    })
}

/// Columns that say where in a table a run stands, and how long it took.
const OF_THE_TABLE: [&str; 5] = ["run", "seed_index", "spin_up_wall_s", "mission_wall_s", "own_wall_s"];

/// The first column in which two records of the same run differ, with both values.
pub(crate) fn difference<T: Record>(a: &T, b: &T) -> Option<(&'static str, [String; 2])> {
    let names = T::COLUMNS.iter().map(|(info, ..)| info.name);
    let values = csv_fields(a).zip(csv_fields(b));
    names.zip(values).find_map(|(name, (a, b))| {
        let differs = a != b && !OF_THE_TABLE.contains(&name);
        differs.then_some((name, [a, b]))
    })
}

fn csv<'a, T: Record>(records: impl IntoIterator<Item = &'a T>) -> String {
    let names: Vec<&str> = T::COLUMNS.iter().map(|(info, ..)| info.name).collect();
    csv_text(&names.join(","), records.into_iter().map(csv_fields))
}

/// Reads records from a table of CSV with the names of all columns in its first line; of an older table the last ones may
/// be missing, if they may be empty. What is wrong is told with line and column; `before` is the number of lines before
/// the table.
pub(crate) fn from_csv<T: Record>(text: &str, before: u64) -> Result<Vec<T>, String> {
    let mut table = csv::ReaderBuilder::new();
    let mut table = table.has_headers(false).from_reader(text.as_bytes());
    let mut records = Vec::new();
    for (n, line) in table.records().enumerate() {
        let line = line.map_err(|e| format!("after line {}: {e}", before + n as u64))?;
        let at = before + line.position().map_or(0, csv::Position::line);
        for ((ColumnInfo { name, .. }, ..), field) in T::COLUMNS.iter().zip(&line) {
            if n == 0 && *name != field {
                return Err(format!("line {at}: a column must be called {name}, not `{field}`"));
            }
        }
        let missing = T::COLUMNS.iter().skip(line.len());
        if line.len() > T::COLUMNS.len() || missing.into_iter().any(|(_, optional, _)| !optional) {
            let (want, got) = (T::COLUMNS.len(), line.len());
            return Err(format!("line {at}: must have {want} fields, has {got}"));
        }
        if n > 0 {
            records.push(read_line(&line).map_err(|e| format!("line {at}, {e}"))?);
        }
    }
    match text.is_empty() {
        true => Err("it is empty".to_string()),
        false => Ok(records),
    }
}

fn read_line<T: Record>(line: &csv::StringRecord) -> Result<T, String> {
    let mut record = T::default();
    for ((ColumnInfo { name, .. }, optional, column), field) in T::COLUMNS.iter().zip(line) {
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
    use super::*;
    use crate::campaign::report::sample::row;

    #[test]
    fn every_run_and_every_declaration_is_a_line_under_the_names() {
        let declared = DeclarationRow { rule: "stop, at last".to_string(), ..DeclarationRow::default() };
        let twice = RunRow { declarations: vec![declared; 2], ..row(0, Some((1.0, 2.0))) };
        let [runs, declarations] = as_csv(&[twice, row(1, None)]);
        let commas: Vec<usize> = runs.lines().map(|l| l.matches(',').count()).collect();
        assert_eq!(commas, [RunRow::COLUMNS.len() - 1; 3]);
        assert!(runs.starts_with("run,") && !runs.contains("NaN"));
        assert_eq!(declarations.lines().count(), 3);
        assert!(declarations.contains(",\"stop, at last\","), "{declarations}");
    }
}
