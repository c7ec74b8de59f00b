//! Errors of writing a run's files, and how to continue when one file could not be written.

use crate::charts::png;
use crate::mcap::RecordError;
use rheotaxis::error::AssembleError;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use world::files::{self, Folder, OutputError};

/// Why a file that a run should leave could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The folder cannot be made.
    #[error("cannot create the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The system's message.
        source: io::Error,
    },
    /// A file cannot be written: the folder is not writable, the disk is full, or something else has its name.
    #[error(transparent)]
    Write(#[from] OutputError),
    /// A figure cannot be drawn.
    #[error("cannot draw {}: {cause}", path.display())]
    Draw {
        /// The file it was for.
        path: PathBuf,
        /// What was wrong.
        cause: String,
    },
    /// The recording failed.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The scene of the run cannot be made: a file that the scenario names is missing or wrong.
    #[error(transparent)]
    Scene(#[from] Box<AssembleError>),
    /// Several errors; everything else was written.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Several(Vec<ReportError>),
}

impl ReportError {
    /// One error for several; `None` if there are none.
    pub fn combine(mut failures: Vec<ReportError>) -> Option<Self> {
        match failures.len() {
            0 | 1 => failures.pop(),
            _ => Some(ReportError::Several(failures)),
        }
    }
}

/// Makes a folder and its parents.
pub fn make_folder(path: &Path) -> Result<(), ReportError> {
    files::make_folder(path).map_err(|source| ReportError::Folder { path: path.to_owned(), source })
}

/// Makes the folder for a command's results, and removes the files that an earlier run of the command left there.
pub fn begin_folder(path: &Path, command: &str) -> Result<Folder, ReportError> {
    make_folder(path)?;
    Ok(Folder::begin(path, command)?)
}

/// As [`begin_folder`] for a run, but refuses a folder with somebody else's file under a name that `own` says is one of
/// the run's. Without `own`, such files are replaced.
pub fn begin_run(path: &Path, own: Option<&dyn Fn(&str) -> bool>) -> Result<Folder, ReportError> {
    make_folder(path)?;
    Ok(Folder::begin_with(path, RUN, own)?)
}

/// Whether [`begin_run`] would take a folder. Nothing is made.
pub fn could_begin_run(path: &Path, own: Option<&dyn Fn(&str) -> bool>) -> Result<(), ReportError> {
    Ok(Folder::could_begin(path, RUN, own)?)
}

/// What the list of a run's files is named after.
const RUN: &str = "run";

/// Refuses to write a single file into a folder that a run is writing its results into.
pub fn beside_no_run(file: &Path) -> Result<(), ReportError> {
    if !files::is_in_use(files::folder_of(file)) {
        return Ok(());
    }
    let problem = "a run is writing its results into that folder: wait for its end, or name another";
    let source = io::Error::new(io::ErrorKind::ResourceBusy, problem);
    Err(OutputError::new(file, source).into())
}

/// Writes a file completely or not at all.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<PathBuf, ReportError> {
    Ok(files::write(path, bytes)?)
}

/// A table as CSV: the names of its columns, separated by commas, and its rows. A field is quoted if it must be
/// (RFC 4180).
pub fn csv_text<R>(columns: &str, rows: impl IntoIterator<Item = R>) -> String
where
    R: IntoIterator,
    R::Item: AsRef<[u8]>,
{
    let mut table = csv::Writer::from_writer(format!("{columns}\n").into_bytes());
    for row in rows {
        (table.write_record(row)).expect("every row has as many fields as the first");
    }
    let bytes = table.into_inner().expect("writing to memory succeeds");
    String::from_utf8(bytes).expect("fields are texts")
}

/// A number as a field of a table; nothing if there is none. It reads back bit for bit.
pub fn csv_number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |v| v.to_string())
}

/// Files being written into a folder; if one fails, the others are not affected.
#[derive(Debug)]
pub struct PendingFiles<'a> {
    folder: &'a Folder,
    files: Vec<PathBuf>,
    failures: Vec<ReportError>,
}

impl<'a> PendingFiles<'a> {
    /// Begins without any file.
    pub fn new(folder: &'a Folder) -> Self {
        Self { folder, files: Vec::new(), failures: Vec::new() }
    }

    /// Writes a file.
    pub fn write(&mut self, name: &str, bytes: &[u8]) {
        let path = self.folder.file(name);
        let written = path.and_then(|path| files::write(&path, bytes));
        self.take(written.map_err(ReportError::from));
    }

    /// Writes a file if it could be drawn, or notes that it could not.
    pub fn draw(&mut self, name: &str, drawn: Result<Vec<u8>, String>) {
        match drawn {
            Ok(bytes) => self.write(name, &bytes),
            Err(cause) => {
                let path = self.folder.dir().join(name);
                self.take(Err(ReportError::Draw { path, cause }));
            }
        }
    }

    /// Writes a figure as `<name>.svg` and `<name>.png`.
    pub fn figure(&mut self, name: &str, svg: &str) {
        self.write(&format!("{name}.svg"), svg.as_bytes());
        self.draw(&format!("{name}.png"), guarded(|| png(svg)).flatten());
    }

    /// Adds the result of writing another file.
    pub fn take(&mut self, written: Result<PathBuf, ReportError>) {
        match written {
            Ok(path) => self.files.push(path),
            Err(error) => self.failures.push(error),
        }
    }

    /// The paths of all files that were written, or all errors.
    pub fn done(self) -> Result<Vec<PathBuf>, ReportError> {
        match ReportError::combine(self.failures) {
            None => Ok(self.files),
            Some(error) => Err(error),
        }
    }
}

/// Draws something; a panic becomes an error of this one figure.
pub fn guarded<T>(draw: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(draw)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or(panic.downcast_ref::<&str>().copied());
        text.unwrap_or("the drawing broke off").to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn fields_are_quoted_where_they_must_be() {
        let rows = [["a,b\n", "plain"], ["no \"bed\"", ""]];
        let text = csv_text("x,y", rows);
        assert_eq!(text, "x,y\n\"a,b\n\",plain\n\"no \"\"bed\"\"\",\n");
        assert_eq!(csv_number(Some(0.1 + 0.2)), "0.30000000000000004");
    }

    #[test]
    fn a_file_in_the_way_of_the_folder_is_named() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("f");
        fs::write(&path, b"").unwrap();
        let said = make_folder(&path.join("out")).unwrap_err().to_string();
        assert!(said.contains("cannot create the folder"), "{said}");
        assert!(said.contains("f/out"), "{said}");
    }

    #[test]
    fn one_file_that_fails_costs_no_other_and_all_that_fail_are_named() {
        let dir = tempfile::tempdir().unwrap();
        for taken in ["b", "d"] {
            fs::create_dir(dir.path().join(taken)).unwrap();
        }
        let folder = Folder::begin(dir.path(), "test").unwrap();
        let mut kept = PendingFiles::new(&folder);
        for name in ["a", "b", "c", "d", "e"] {
            kept.write(name, b"x");
        }
        let said = kept.done().unwrap_err().to_string();
        assert_eq!(said.lines().count(), 2, "{said}");
        assert!(said.contains("/b: it is a folder") && said.contains("/d: it is"), "{said}");
        for written in ["a", "c", "e"] {
            assert_eq!(fs::read(dir.path().join(written)).unwrap(), b"x");
        }
    }
}
