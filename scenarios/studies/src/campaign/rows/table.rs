//! Tables as Parquet files.

use super::record::{Column, Record};
use output::columns::ColumnInfo;
use parquet::basic::Compression;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::record::{Field, Row};
use parquet::schema::parser::parse_message_type;
use serde_json::{Value, json};
use std::io::Write;
use std::marker::PhantomData;
use std::sync::Arc;

/// Key of the note that describes the columns: JSON, unit and meaning of each by its name.
const COLUMNS: &str = "columns";

/// A Parquet file of records, written group by group.
pub(in crate::campaign) struct TableWriter<T, W: Write + Send>(SerializedFileWriter<W>, PhantomData<T>);

impl<T: Record, W: Write + Send> TableWriter<T, W> {
    /// Begins a table with these notes in its footer, and one that describes the columns.
    pub(in crate::campaign) fn new(to: W, notes: &[(&str, String)]) -> Result<Self> {
        let mut schema = format!("message {} {{\n", T::TABLE);
        for (ColumnInfo { name, .. }, optional, column) in T::COLUMNS {
            let presence = if *optional { "OPTIONAL" } else { "REQUIRED" };
            let (kind, logical) = match column {
                Column::Number(..) => ("INT64", " (INTEGER(64,false))"),
                Column::Truth(..) => ("BOOLEAN", ""),
                Column::Text(..) => ("BYTE_ARRAY", " (STRING)"),
                Column::Real(..) => ("DOUBLE", ""),
            };
            schema.push_str(&format!("  {presence} {kind} {name}{logical};\n"));
        }
        schema.push('}');
        let said =
            (T::COLUMNS.iter()).map(|(c, ..)| (c.name.to_string(), json!({ "unit": c.unit, "meaning": c.what })));
        let said = Value::Object(said.collect()).to_string();
        let notes = (notes.iter())
            .map(|(key, value)| KeyValue::new((*key).to_string(), value.clone()))
            .chain([KeyValue::new(COLUMNS.to_string(), said)])
            .collect();
        let properties = WriterProperties::builder()
            .set_compression(Compression::LZ4_RAW)
            .set_created_by(format!("rheotaxis {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(notes))
            .build();
        let schema = Arc::new(parse_message_type(&schema)?);
        let file = SerializedFileWriter::new(to, schema, Arc::new(properties))?;
        Ok(Self(file, PhantomData))
    }

    /// Puts bytes before the first column; readers skip them.
    pub(in crate::campaign) fn before_columns(&mut self, bytes: &[u8]) -> Result<()> {
        Ok(self.0.write_all(bytes)?)
    }

    /// Adds records as a group.
    pub(in crate::campaign) fn rows(&mut self, rows: &[T]) -> Result<()> {
        if rows.is_empty() {
            return Ok(());
        }
        let mut group = self.0.next_row_group()?;
        for (_, optional, column) in T::COLUMNS {
            let to = group.next_column()?;
            let to = to.ok_or_else(|| odd("the schema has fewer columns than a row"))?;
            let rows = rows.iter();
            match column {
                Column::Number(get, _) => {
                    let values = rows.map(|r| get(r).map(u64::cast_signed));
                    write_values::<Int64Type>(to, *optional, values)?;
                }
                Column::Truth(get, _) => write_values::<BoolType>(to, *optional, rows.map(|r| Some(get(r))))?,
                Column::Text(get, _) => {
                    let values = rows.map(|r| get(r).map(ByteArray::from));
                    write_values::<ByteArrayType>(to, *optional, values)?;
                }
                Column::Real(get, _) => write_values::<DoubleType>(to, *optional, rows.map(get))?,
            }
        }
        group.close().map(drop)
    }

    /// Writes the footer and returns the file.
    pub(in crate::campaign) fn finish(self) -> Result<W> {
        self.0.into_inner()
    }
}

fn write_values<D: DataType>(
    mut to: SerializedColumnWriter<'_>,
    optional: bool,
    values: impl Iterator<Item = Option<D::T>>,
) -> Result<()> {
    let values: Vec<Option<D::T>> = values.collect();
    let levels: Option<Vec<i16>> = optional.then(|| values.iter().map(|v| i16::from(v.is_some())).collect());
    let there: Vec<D::T> = values.into_iter().flatten().collect();
    (to.typed::<D>()).write_batch(&there, levels.as_deref(), None)?;
    to.close()
}

fn odd(what: &str) -> ParquetError {
    ParquetError::General(what.to_string())
}

/// All rows of a table of at most `most` rows, and the notes in its footer. What footer and pages claim is first
/// compared with the file and with that number, because the library would reserve memory for any claim.
pub(in crate::campaign) fn read<T: Record>(
    from: impl ChunkReader + 'static,
    most: usize,
) -> Result<(Vec<T>, Vec<KeyValue>)> {
    let length = from.len();
    let reader = SerializedFileReader::new(from)?;
    let meta = reader.metadata().file_metadata();
    let names: Vec<&str> = meta.schema().get_fields().iter().map(|f| f.name()).collect();
    if !names.iter().eq(T::COLUMNS.iter().map(|(info, ..)| &info.name)) {
        return Err(odd("its columns are not those of this table"));
    }
    let fits = |n: i64| usize::try_from(n).is_ok_and(|n| n <= most);
    let mut n = 0;
    for (k, group) in reader.metadata().row_groups().iter().enumerate() {
        if !fits(group.num_rows()) {
            return Err(odd("it says to hold more rows than it can"));
        }
        n += group.num_rows();
        if !fits(n) {
            return Err(odd("it says to hold more rows than it can"));
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

fn row_of<T: Record>(fields: &Row) -> Result<T> {
    let mut row = T::default();
    for ((ColumnInfo { name, .. }, _, column), (_, field)) in T::COLUMNS.iter().zip(fields.get_column_iter()) {
        match (column, field) {
            (Column::Number(_, set), Field::ULong(v)) => set(&mut row, *v),
            (Column::Truth(_, set), Field::Bool(v)) => set(&mut row, *v),
            (Column::Text(_, set), Field::Str(v)) => set(&mut row, v.clone()),
            (Column::Real(_, set), Field::Double(v)) => set(&mut row, *v),
            (Column::Number(..) | Column::Text(..) | Column::Real(..), Field::Null) => {}
            _ => return Err(odd(&format!("column {name} has another type"))),
        }
    }
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::super::row::{DeclarationRow, RunRow};
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
            ..RunRow::default()
        };
        let rows = vec![RunRow::default(), full.clone(), RunRow { run: 3, ..full }];
        let mut table = TableWriter::new(Vec::new(), &[("k", "v".to_string())]).unwrap();
        table.rows(&rows[..2]).unwrap();
        table.rows(&rows[2..]).unwrap();
        let bytes = table.finish().unwrap();
        let read_bytes = |bytes: &[u8], most: usize| {
            let mut file = tempfile::tempfile().unwrap();
            file.write_all(bytes).unwrap();
            read::<RunRow>(file, most)
        };
        let (back, notes) = read_bytes(&bytes, 3).unwrap();
        assert_eq!(back, rows);
        let said = read_bytes(&bytes, 2).unwrap_err().to_string();
        assert!(said.contains("more rows than it can"), "{said}");
        assert!(notes.iter().any(|n| n.key == "k" && n.value.as_deref() == Some("v")));
        let said = notes.iter().find(|n| n.key == COLUMNS).unwrap();
        let said: Value = serde_json::from_str(said.value.as_deref().unwrap()).unwrap();
        assert_eq!(said.as_object().unwrap().len(), RunRow::COLUMNS.len());
        let traced = &said["traced_m"];
        let what = "Straight distance from the first detection to the declaration.";
        assert_eq!(traced, &json!({ "unit": "m", "meaning": what }));
        for cut in 0..bytes.len() {
            assert!(read_bytes(&bytes[..cut], 3).is_err(), "cut at {cut}");
        }
    }

    #[test]
    fn declarations_come_back_bit_for_bit_and_an_empty_table_stays_empty() {
        let one = DeclarationRow {
            robot: "auv, 0".to_string(),
            region: Some(3),
            east_m: 0.1 + 0.2,
            error_along_m: Some(-1e-300),
            fix_m: Some(9.5),
            ..DeclarationRow::default()
        };
        for rows in [vec![one.clone(), DeclarationRow::default()], Vec::new()] {
            let mut table = TableWriter::new(tempfile::tempfile().unwrap(), &[]).unwrap();
            table.rows(&rows).unwrap();
            let (back, _) = read::<DeclarationRow>(table.finish().unwrap(), 2).unwrap();
            assert_eq!(back, rows);
        }
        let mut table = TableWriter::new(tempfile::tempfile().unwrap(), &[]).unwrap();
        table.rows(&[one]).unwrap();
        let said = read::<RunRow>(table.finish().unwrap(), 2).unwrap_err();
        assert!(said.to_string().contains("its columns are not"), "{said}");
    }
}
