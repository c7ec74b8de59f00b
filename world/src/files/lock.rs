//! Locks that tell of another process. The system lets go of them whenever and however their holder ends. On a file
//! system without locks nothing tells of the other process.

use super::input::special;
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The file that is locked while a process writes its results into a folder.
const NAME: &str = ".rheotaxis-lock";
/// Number of times that the file is made, should others remove it each time.
const TRIES: u32 = 100;

/// A folder that one process writes its results into. The file vanishes with it, unless the process is killed.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes an existing folder.
    ///
    /// # Errors
    /// If another process, or another run of this one, has it; or if the file cannot be made.
    pub(super) fn take(dir: &Path) -> io::Result<Self> {
        let path = dir.join(NAME);
        for _ in 0..TRIES {
            let there = fs::symlink_metadata(&path).ok();
            if let Some(what) = there.and_then(|m| special(m.file_type())) {
                let problem = format!("{NAME} in it is {what}, not a file");
                return Err(io::Error::new(ErrorKind::AlreadyExists, problem));
            }
            let mut options = File::options();
            let file = (options.write(true).create(true).truncate(false)).open(&path)?;
            if is_held(&file) {
                return Err(busy());
            }
            // Whoever had it may have removed it since it was opened.
            if !is_removed(&file) {
                return Ok(Self { path, _file: file });
            }
        }
        let problem = format!("others remove its {NAME} again and again");
        Err(io::Error::new(ErrorKind::ResourceBusy, problem))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Before it is let go: a file that another process has locked must stay.
        if cfg!(unix) {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// What is said of a folder that another run has.
pub(super) fn busy() -> io::Error {
    io::Error::new(
        ErrorKind::ResourceBusy,
        "another run is writing its results there: wait for its end, or name another folder",
    )
}

/// Whether a run is writing its results into a folder now, so that what others write there could mix with them.
pub fn is_in_use(dir: &Path) -> bool {
    // Reading is enough for a look; as nothing is made, a folder without a run stays as it is.
    let path = dir.join(NAME);
    fs::symlink_metadata(&path).is_ok_and(|m| m.is_file()) && File::open(path).is_ok_and(|file| is_held(&file))
}

/// Locks a file until it is closed, and tells whether somebody else has locked it before.
pub(super) fn is_held(file: &File) -> bool {
    matches!(file.try_lock(), Err(TryLockError::WouldBlock))
}

/// Whether an open file has lost its name.
pub(super) fn is_removed(file: &File) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        file.metadata().is_ok_and(|m| m.nlink() == 0)
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_has_a_folder_and_a_file_that_was_left_there_is_no_hindrance() {
        let dir = tempfile::tempdir().unwrap();
        assert!(!is_in_use(dir.path()));
        // As after a kill.
        fs::write(dir.path().join(NAME), "").unwrap();
        assert!(!is_in_use(dir.path()));
        let held = Lock::take(dir.path()).unwrap();
        assert!(is_in_use(dir.path()));
        let error = Lock::take(dir.path()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::ResourceBusy);
        assert!(error.to_string().contains("another run"), "{error}");
        drop(held);
        assert!(!is_in_use(dir.path()));
        drop(Lock::take(dir.path()).unwrap());
        let left = fs::read_dir(dir.path()).unwrap().count();
        assert_eq!(left, usize::from(!cfg!(unix)));
    }
}
