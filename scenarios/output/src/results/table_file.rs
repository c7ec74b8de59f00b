//! A table that grows in a file while a run goes on.

use crate::decimal::push_decimal;
use crate::files::ReportError;
use csv::{StringRecord, Writer};
use std::io::Write as _;
use std::path::Path;
use world::files::Output;

/// The file, and the row that is being made. Every row is passed to the system at once, so a kill loses nothing.
#[derive(Debug)]
pub(super) struct TableFile {
    file: Writer<Output>,
    row: StringRecord,
    number: String,
}

impl TableFile {
    /// Makes the file with the names of its columns; the folder must exist.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn create(path: &Path, names: &str) -> Result<Self, ReportError> {
        let mut file = Output::create(path)?;
        (file.write_all(format!("{names}\n").as_bytes())).map_err(|e| file.failed(e))?;
        file.place()?;
        Ok(Self { file: Writer::from_writer(file), row: StringRecord::new(), number: String::new() })
    }

    /// Adds a number with so many decimals to the row. What is not known stays empty.
    pub(super) fn number(&mut self, number: impl Into<Option<f64>>, places: usize) {
        self.number.clear();
        if let Some(v) = number.into() {
            push_decimal(&mut self.number, v, places);
        }
        self.row.push_field(&self.number);
    }

    /// Adds a yes or no.
    pub(super) fn flag(&mut self, yes: bool) {
        self.row.push_field(if yes { "1" } else { "0" });
    }

    /// Adds a text.
    pub(super) fn text(&mut self, text: &str) {
        self.row.push_field(text);
    }

    /// Writes the row.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn end_row(&mut self) -> Result<(), ReportError> {
        let written = self.file.write_record(&self.row);
        self.row.clear();
        let written = written.map_err(std::io::Error::from).and_then(|()| self.file.flush());
        written.map_err(|e| self.file.get_ref().failed(e).into())
    }
}
