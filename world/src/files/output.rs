//! Writing. A file is written under a temporary name in the same folder and gets its real name when it is complete.
//!
//! Only regular files are replaced. If a folder, a pipe, a socket or a device has the name, or a link to one of them,
//! that is an error. A link to a regular file, or to nothing, is itself replaced; its target stays as it is. The
//! temporary file is made with `O_EXCL`, so that no existing file is opened, followed or overwritten. It is removed if
//! the file is not completed. Its name ends in the process's number, a count and `.tmp`.

use super::input::special;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// A file could not be written: its folder is not writable, the disk is full, or something else has its name.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct OutputError {
    /// The file.
    pub path: PathBuf,
    /// The message of the system, or what has the name instead.
    pub source: io::Error,
}

impl OutputError {
    /// The error of a file, with its cause.
    pub fn new(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        Self { path, source }
    }
}

/// A file that is being written. If it is dropped before it has its name, it is removed.
#[derive(Debug)]
pub struct Output {
    file: File,
    path: PathBuf,
    temporary: PathBuf,
    placed: bool,
    kept: bool,
}

/// Bytes of a file's name that its temporary name keeps; a whole name may have 255.
const NAME: usize = 200;
/// Number of names that are tried. Other processes may make names in the same folder at the same time.
const TRIES: u32 = 10_000;

impl Output {
    /// Begins a file that will become `path`; the folder must exist.
    ///
    /// # Errors
    /// If it cannot be made, or if `path` exists and is not a regular file.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let failed = |source| OutputError::new(path, source);
        replaceable(path).map_err(failed)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let end = name.floor_char_boundary(NAME);
        for _ in 0..TRIES {
            let count = COUNT.fetch_add(1, Ordering::Relaxed);
            let unique = format!("{}.{}-{count}.tmp", &name[..end], std::process::id());
            let temporary = path.with_file_name(unique);
            match File::create_new(&temporary) {
                Ok(file) => {
                    return Ok(Self {
                        file,
                        path: path.to_owned(),
                        temporary,
                        placed: false,
                        kept: false,
                    });
                }
                Err(e) if e.kind() == ErrorKind::AlreadyExists => {}
                Err(e) => return Err(failed(e)),
            }
        }
        let problem = "every temporary name tried is taken";
        Err(failed(io::Error::new(ErrorKind::AlreadyExists, problem)))
    }

    /// As [`Output::create`], but an incomplete file stays under its temporary name.
    ///
    /// # Errors
    /// As [`Output::create`].
    pub fn create_kept(path: &Path) -> Result<Self, OutputError> {
        let mut output = Self::create(path)?;
        output.kept = true;
        Ok(output)
    }

    /// The temporary path, until the file has its name.
    #[must_use]
    pub fn temporary(&self) -> &Path {
        &self.temporary
    }

    /// An error of this file.
    #[must_use]
    pub fn failed(&self, source: io::Error) -> OutputError {
        OutputError::new(&self.path, source)
    }

    /// Gives the file its name now, although more will be written, for a table that others read while it grows.
    ///
    /// # Errors
    /// If something that is not a regular file has appeared at that path, or if the system refuses.
    pub fn place(&mut self) -> Result<(), OutputError> {
        if !self.placed {
            replaceable(&self.path)
                .and_then(|()| fs::rename(&self.temporary, &self.path))
                .map_err(|e| self.failed(e))?;
            self.placed = true;
        }
        Ok(())
    }

    /// Completes the file: gives it its name.
    ///
    /// # Errors
    /// As [`Output::place`].
    pub fn finish(mut self) -> Result<PathBuf, OutputError> {
        self.place()?;
        Ok(self.path.clone())
    }

    /// Completes the file and makes sure that content and name are on the disk, so that they survive a power cut.
    ///
    /// # Errors
    /// As [`Output::place`]; also if it cannot be brought to the disk.
    pub fn finish_on_disk(self) -> Result<PathBuf, OutputError> {
        self.file.sync_all().map_err(|e| self.failed(e))?;
        let path = self.finish()?;
        // Where a folder cannot be synced, the system takes care of it.
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        if let Ok(folder) = File::open(folder) {
            let _ = folder.sync_all();
        }
        Ok(path)
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        if !self.placed && !self.kept {
            // Half a file is of no use, and it takes space on a full disk.
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Output {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// Whether a new file may replace what is there.
fn replaceable(path: &Path) -> io::Result<()> {
    let refuse = |problem: String| Err(io::Error::new(ErrorKind::AlreadyExists, problem));
    if path.file_name().is_none() {
        return refuse("that names a folder, not a file".to_string());
    }
    let there = match fs::symlink_metadata(path) {
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(()),
        there => there?.file_type(),
    };
    let (link, kind) = if there.is_symlink() {
        // `/dev/stdout` and the like must not be replaced, wherever they lead.
        if fs::read_link(path)?.starts_with("/proc") {
            return refuse("it is a link to an open file of a process".to_string());
        }
        match fs::metadata(path) {
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(()),
            there => ("a link to ", there?.file_type()),
        }
    } else {
        ("", there)
    };
    match special(kind) {
        None => Ok(()),
        Some(what) => refuse(format!(
            "it is {link}{what}, and only a regular file is replaced"
        )),
    }
}

/// Writes a file completely or not at all.
///
/// # Errors
/// If it cannot be written; what was there before then stays.
pub fn write(path: &Path, bytes: &[u8]) -> Result<PathBuf, OutputError> {
    written(path, bytes)?.finish()
}

/// As [`write()`], and makes sure that the file is on the disk.
///
/// # Errors
/// As [`write()`].
pub fn write_on_disk(path: &Path, bytes: &[u8]) -> Result<PathBuf, OutputError> {
    written(path, bytes)?.finish_on_disk()
}

fn written(path: &Path, bytes: &[u8]) -> Result<Output, OutputError> {
    let mut output = Output::create(path)?;
    output.write_all(bytes).map_err(|e| output.failed(e))?;
    Ok(output)
}

/// Writes a file completely, or not at all if anything exists at that path, even a link; the error then has the kind
/// `AlreadyExists`. If several processes do this at the same time, the first one's file stays.
///
/// # Errors
/// If it cannot be written, or if something is there.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<PathBuf, OutputError> {
    let failed = |e| OutputError::new(path, e);
    if fs::symlink_metadata(path).is_ok() {
        return Err(failed(ErrorKind::AlreadyExists.into()));
    }
    let output = written(path, bytes)?;
    output.file.sync_all().map_err(failed)?;
    // Unlike a rename, a second name (hard link) fails where a file exists. The output then loses its first name when
    // it is dropped.
    match fs::hard_link(&output.temporary, path) {
        Ok(()) => Ok(path.to_owned()),
        Err(e) if e.kind() == ErrorKind::AlreadyExists => Err(failed(e)),
        // On a file system without links, the last writer's file stays.
        Err(_) => output.finish(),
    }
}

/// Makes a folder and its parents.
///
/// # Errors
/// If one of them cannot be made, or if something else has that name.
pub fn make_folder(path: &Path) -> io::Result<()> {
    fs::create_dir_all(path)
}
