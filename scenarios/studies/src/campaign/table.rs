//! Rows as Parquet and as CSV: one column for each field of [`RunRow`], with the field's name.

use super::row::{DeclaredAt, RunRow};
use parquet::basic::Compression;
use parquet::basic::ZstdLevel;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::{Field, Row};
use parquet::schema::parser::parse_message_type;
use std::io::Write;
use std::sync::Arc;

/// How a column is read from a row and written to it.
enum Column {
    Number(fn(&RunRow) -> u64, fn(&mut RunRow, u64)),
    Truth(fn(&RunRow) -> bool, fn(&mut RunRow, bool)),
    Text(fn(&RunRow) -> Option<&str>, fn(&mut RunRow, Option<String>)),
    Real(fn(&RunRow) -> Option<f64>, fn(&mut RunRow, Option<f64>)),
    Declarations,
}

macro_rules! number {
    ($f:ident) => {
        (
            stringify!($f),
            false,
            Column::Number(|r| r.$f, |r, v| r.$f = v),
        )
    };
}
macro_rules! text {
    ($f:ident) => {
        (
            stringify!($f),
            false,
            Column::Text(|r| Some(&r.$f), |r, v| r.$f = v.unwrap_or_default()),
        )
    };
}
macro_rules! real {
    ($f:ident) => {
        (
            stringify!($f),
            false,
            Column::Real(|r| Some(r.$f), |r, v| r.$f = v.unwrap_or_default()),
        )
    };
}
macro_rules! maybe {
    ($f:ident) => {
        (
            stringify!($f),
            true,
            Column::Real(|r| r.$f, |r, v| r.$f = v),
        )
    };
}

/// Name, whether it may be empty, and access.
const COLUMNS: [(&str, bool, Column); 34] = [
    number!(run),
    text!(arm),
    text!(condition),
    number!(seed_index),
    number!(seed),
    text!(outcome),
    (
        "success",
        false,
        Column::Truth(|r| r.success, |r, v| r.success = v),
    ),
    (
        "error",
        true,
        Column::Text(|r| r.error.as_deref(), |r, v| r.error = v),
    ),
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
    ("declarations", false, Column::Declarations),
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
    real!(spin_up_wall_s),
    real!(mission_wall_s),
];

/// A Parquet file of rows, written group by group.
pub(super) struct TableWriter<W: Write + Send>(SerializedFileWriter<W>);

impl<W: Write + Send> TableWriter<W> {
    /// Begins a table with these notes in its footer.
    pub(super) fn new(to: W, notes: &[(&str, String)]) -> Result<Self> {
        let mut schema = String::from("message runs {\n");
        for (name, optional, column) in &COLUMNS {
            let presence = if *optional { "OPTIONAL" } else { "REQUIRED" };
            let (kind, logical) = match column {
                Column::Number(..) => ("INT64", " (INTEGER(64,false))"),
                Column::Truth(..) => ("BOOLEAN", ""),
                Column::Text(..) | Column::Declarations => ("BYTE_ARRAY", " (STRING)"),
                Column::Real(..) => ("DOUBLE", ""),
            };
            schema.push_str(&format!("  {presence} {kind} {name}{logical};\n"));
        }
        schema.push('}');
        let notes = (notes.iter())
            .map(|(key, value)| KeyValue::new((*key).to_string(), value.clone()))
            .collect();
        let properties = WriterProperties::builder()
            .set_compression(Compression::ZSTD(ZstdLevel::default()))
            .set_created_by(format!("rheotaxis {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(notes))
            .build();
        let schema = Arc::new(parse_message_type(&schema)?);
        Ok(Self(SerializedFileWriter::new(
            to,
            schema,
            Arc::new(properties),
        )?))
    }

    /// Puts bytes before the first column; readers skip them.
    pub(super) fn before_columns(&mut self, bytes: &[u8]) -> Result<()> {
        Ok(self.0.write_all(bytes)?)
    }

    /// Adds rows as a group.
    pub(super) fn rows(&mut self, rows: &[RunRow]) -> Result<()> {
        let mut group = self.0.next_row_group()?;
        for (_, optional, column) in &COLUMNS {
            write_column(&mut group, rows, *optional, column)?;
        }
        group.close().map(drop)
    }

    /// Writes the footer and returns the file.
    pub(super) fn finish(self) -> Result<W> {
        self.0.into_inner()
    }
}

fn write_column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    rows: &[RunRow],
    optional: bool,
    column: &Column,
) -> Result<()> {
    let missing = || ParquetError::General("the schema has fewer columns than a row".to_string());
    let mut writer = group.next_column()?.ok_or_else(missing)?;
    let levels = |there: Vec<bool>| -> Option<Vec<i16>> {
        optional.then(|| there.into_iter().map(i16::from).collect())
    };
    match column {
        Column::Number(get, _) => {
            let values: Vec<i64> = rows.iter().map(|r| get(r).cast_signed()).collect();
            writer
                .typed::<Int64Type>()
                .write_batch(&values, None, None)?;
        }
        Column::Truth(get, _) => {
            let values: Vec<bool> = rows.iter().map(get).collect();
            writer
                .typed::<BoolType>()
                .write_batch(&values, None, None)?;
        }
        Column::Text(get, _) => {
            let values: Vec<ByteArray> = rows
                .iter()
                .filter_map(|r| get(r).map(ByteArray::from))
                .collect();
            let levels = levels(rows.iter().map(|r| get(r).is_some()).collect());
            writer
                .typed::<ByteArrayType>()
                .write_batch(&values, levels.as_deref(), None)?;
        }
        Column::Declarations => {
            let words = |r: &RunRow| ByteArray::from(DeclaredAt::words(&r.declarations).as_str());
            let values: Vec<ByteArray> = rows.iter().map(words).collect();
            writer
                .typed::<ByteArrayType>()
                .write_batch(&values, None, None)?;
        }
        Column::Real(get, _) => {
            let values: Vec<f64> = rows.iter().filter_map(get).collect();
            let levels = levels(rows.iter().map(|r| get(r).is_some()).collect());
            writer
                .typed::<DoubleType>()
                .write_batch(&values, levels.as_deref(), None)?;
        }
    }
    writer.close()
}

/// All rows of a table of at most `most` rows, and the notes in its footer. What footer and pages claim is first
/// compared with the file and with that number, because the library would reserve memory for any claim.
pub(super) fn read<R: ChunkReader + 'static>(
    from: R,
    most: usize,
) -> Result<(Vec<RunRow>, Vec<KeyValue>)> {
    let odd = |what: &str| ParquetError::General(what.to_string());
    let length = from.len();
    let reader = SerializedFileReader::new(from)?;
    let meta = reader.metadata().file_metadata();
    let names: Vec<&str> = meta
        .schema()
        .get_fields()
        .iter()
        .map(|f| f.name())
        .collect();
    if !names.iter().eq(COLUMNS.iter().map(|(name, ..)| name)) {
        return Err(odd("its columns are not those of a campaign"));
    }
    let fits = |n: i64| usize::try_from(n).is_ok_and(|n| n <= most);
    let mut n = 0;
    for (k, group) in reader.metadata().row_groups().iter().enumerate() {
        if !fits(group.num_rows()) {
            return Err(odd("it says to hold more rows than a block has"));
        }
        n += group.num_rows();
        if !fits(n) {
            return Err(odd("it says to hold more rows than a block has"));
        }
        let pages = reader.get_row_group(k)?;
        for (c, column) in group.columns().iter().enumerate() {
            // Numbers below 0 make the library panic; the caller handles that.
            let (at, size) = column.byte_range();
            if at.checked_add(size).is_none_or(|end| end > length) || !fits(column.num_values()) {
                return Err(odd("a column lies outside the file"));
            }
            for page in pages.get_column_page_reader(c)? {
                if !fits(i64::from(page?.num_values())) {
                    return Err(odd("a page says to hold more values than there are rows"));
                }
            }
        }
    }
    let notes = meta.key_value_metadata().cloned().unwrap_or_default();
    let rows = reader.get_row_iter(None)?;
    let rows = rows.map(|row| row_of(&row?)).collect::<Result<Vec<_>>>()?;
    Ok((rows, notes))
}

fn row_of(fields: &Row) -> Result<RunRow> {
    let mut row = RunRow::default();
    for ((name, _, column), (_, field)) in COLUMNS.iter().zip(fields.get_column_iter()) {
        match (column, field) {
            (Column::Number(_, set), Field::ULong(v)) => set(&mut row, *v),
            (Column::Truth(_, set), Field::Bool(v)) => set(&mut row, *v),
            (Column::Text(_, set), Field::Str(v)) => set(&mut row, Some(v.clone())),
            (Column::Real(_, set), Field::Double(v)) => set(&mut row, Some(*v)),
            (Column::Declarations, Field::Str(v)) => {
                let read = DeclaredAt::read(v);
                row.declarations = read.ok_or_else(|| {
                    ParquetError::General(format!("{v:?} is no list of declarations"))
                })?;
            }
            (Column::Text(..) | Column::Real(..), Field::Null) => {}
            _ => {
                return Err(ParquetError::General(format!(
                    "column {name} has another type"
                )));
            }
        }
    }
    Ok(row)
}

/// The names of the columns as a line of CSV.
pub(super) fn csv_head() -> String {
    let names: Vec<&str> = COLUMNS.iter().map(|(name, ..)| *name).collect();
    names.join(",")
}

/// A row as a line of CSV; a missing value is empty. Numbers read back bit for bit.
pub(super) fn csv_line(row: &RunRow) -> String {
    let cells: Vec<String> = (COLUMNS.iter())
        .map(|(_, _, column)| match column {
            Column::Number(get, _) => get(row).to_string(),
            Column::Truth(get, _) => get(row).to_string(),
            Column::Text(get, _) => get(row).map(quoted).unwrap_or_default(),
            Column::Real(get, _) => get(row).map(|v| v.to_string()).unwrap_or_default(),
            Column::Declarations => quoted(&DeclaredAt::words(&row.declarations)),
        })
        .collect();
    cells.join(",")
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back_bit_for_bit() {
        let full = RunRow {
            run: 1 << 40,
            arm: "a, \"b\"".to_string(),
            seed: u64::MAX,
            success: true,
            error: Some("panicked: ü\nline".to_string()),
            mission_s: 0.1 + 0.2,
            declared_s: Some(f64::MIN_POSITIVE),
            error_along_m: Some(-0.0),
            detections: 7,
            declarations: vec![
                DeclaredAt {
                    rule: "up_flow_edge".to_string(),
                    verdict: "unchecked".to_string(),
                    region: Some(3),
                    east_m: 0.1 + 0.2,
                    error_along_m: Some(-1e-300),
                    fix_m: Some(9.5),
                    ..DeclaredAt::default()
                };
                2
            ],
            ..RunRow::default()
        };
        let rows = vec![RunRow::default(), full.clone(), RunRow { run: 3, ..full }];
        let mut table = TableWriter::new(Vec::new(), &[("k", "v".to_string())]).unwrap();
        table.rows(&rows[..2]).unwrap();
        table.rows(&rows[2..]).unwrap();
        let bytes = table.finish().unwrap();
        let read_bytes = |bytes: &[u8]| {
            let mut file = tempfile::tempfile().unwrap();
            file.write_all(bytes).unwrap();
            read(file, 3)
        };
        let (back, notes) = read_bytes(&bytes).unwrap();
        assert_eq!(back, rows);
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        let said = read(file, 2).unwrap_err().to_string();
        assert!(said.contains("more rows than a block has"), "{said}");
        assert!(
            notes
                .iter()
                .any(|n| n.key == "k" && n.value.as_deref() == Some("v"))
        );
        for cut in 0..bytes.len() {
            assert!(read_bytes(&bytes[..cut]).is_err(), "cut at {cut}");
        }
        let line = csv_line(&rows[1]);
        assert!(
            line.contains("\"a, \"\"b\"\"\"") && line.contains("0.30000000000000004"),
            "{line}"
        );
        assert_eq!(csv_head().split(',').count(), COLUMNS.len());
    }
}
