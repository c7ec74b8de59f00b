//! Files of a run: written whole or not at all, with errors that name file and cause.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use world::record::{RecordError, temporary_name};

/// Why something a run should leave behind could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The folder cannot be made.
    #[error("cannot create the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file cannot be written: folder not writable, disk full.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
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
}

/// Makes a folder and those above it.
pub(crate) fn make_folder(path: &Path) -> Result<(), ReportError> {
    fs::create_dir_all(path).map_err(|source| ReportError::Folder {
        path: path.to_owned(),
        source,
    })
}

/// Writes a file through a temporary name, so that whoever sees it sees it whole.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<PathBuf, ReportError> {
    let temporary = temporary_name(path);
    let failed = |at: &Path| {
        let path = at.to_owned();
        move |source| ReportError::Write { path, source }
    };
    fs::write(&temporary, bytes).map_err(failed(&temporary))?;
    fs::rename(&temporary, path).map_err(failed(path))?;
    Ok(path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_file_leaves_no_temporary() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.json");
        assert_eq!(write_whole(&path, b"{}").unwrap(), path);
        assert_eq!(fs::read(&path).unwrap(), b"{}");
        assert!(!temporary_name(&path).exists());
    }

    #[test]
    fn a_file_in_the_way_of_the_folder_is_named() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("f");
        fs::write(&path, b"").unwrap();
        let said = make_folder(&path.join("out")).unwrap_err().to_string();
        assert!(said.starts_with("cannot create the folder"), "{said}");
        assert!(said.contains("f/out"), "{said}");
        let said = write_whole(&path.join("a"), b"").unwrap_err().to_string();
        assert!(said.starts_with("cannot write"), "{said}");
    }
}
