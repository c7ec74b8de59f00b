//! Writing. A file is written under a temporary name in the same folder and gets its real name when it is complete.
//!
//! Only regular files are replaced. If a folder, a pipe, a socket or a device has the name, or a link to one of them,
//! that is an error. A link to a regular file, or to nothing, is itself replaced; its target stays as it is. The
//! temporary file is made with `O_EXCL`, so that no existing file is opened, followed or overwritten. It is removed if
//! the file is not completed. Its name ends in the process's number, a count and `.tmp`. It is locked while it is
//! written, so that others know whether it was left by a process that was killed.

use super::input::special;
use super::lock::{is_held, is_removed};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

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

    /// The error of somebody else's file that stands in the place; `also` names others like it.
    pub(super) fn foreign(path: &Path, also: &[String]) -> Self {
        let also = match also {
            [] => String::new(),
            also => format!(" (so it is with {})", also.join(", ")),
        };
        Self::new(path, io::Error::other(Foreign(also)))
    }

    /// Whether somebody else's file stands in the place.
    pub fn is_foreign(&self) -> bool {
        self.source.get_ref().is_some_and(|e| e.is::<Foreign>())
    }

    /// Whether another run is writing there.
    pub fn is_busy(&self) -> bool {
        self.source.kind() == ErrorKind::ResourceBusy
    }
}

/// What holds of a file that no list of results names.
#[derive(Debug, thiserror::Error)]
#[error("it is there, and no earlier run left it: move it away, or name another folder{0}")]
struct Foreign(String);

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
/// What the temporary names end in.
const ENDING: &str = ".tmp";
/// The temporary names of this process's files under way, but for those that are kept.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes this process's files under way, for a process that ends at once.
pub fn drop_unfinished() {
    for path in std::mem::take(&mut *unfinished()) {
        let _ = fs::remove_file(path);
    }
}

/// Removes the temporary files that killed processes have left in a folder, of files whose names are `of` those meant.
/// One that somebody is writing, or that cannot be locked, stays.
pub fn clear_abandoned(dir: &Path, of: impl Fn(&str) -> bool) {
    let there = fs::read_dir(dir).into_iter().flatten().flatten();
    for entry in there.filter(|e| e.file_type().is_ok_and(|kind| kind.is_file())) {
        let name = entry.file_name();
        if !name.to_str().and_then(whole_name).is_some_and(&of) {
            continue;
        }
        // A lock over a network may need the right to write.
        let file = File::options().write(true).open(entry.path());
        if file.is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// The name that a file with a temporary name will have.
fn whole_name(temporary: &str) -> Option<&str> {
    let (name, numbers) = temporary.strip_suffix(ENDING)?.rsplit_once('.')?;
    let (process, count) = numbers.split_once('-')?;
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    (digits(process) && digits(count)).then_some(name)
}

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
            let unique = format!("{}.{}-{count}{ENDING}", &name[..end], std::process::id());
            let temporary = path.with_file_name(unique);
            match File::create_new(&temporary) {
                // Somebody who clears away took it in the moment before it was locked.
                Ok(file) if is_held(&file) || is_removed(&file) => {}
                Ok(file) => {
                    unfinished().insert(temporary.clone());
                    return Ok(Self { file, path: path.to_owned(), temporary, placed: false, kept: false });
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
        unfinished().remove(&output.temporary);
        Ok(output)
    }

    /// The temporary path, until the file has its name.
    pub fn temporary(&self) -> &Path {
        &self.temporary
    }

    /// An error of this file.
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
            unfinished().remove(&self.temporary);
            // Others may read it while it grows, also where a lock would keep them from that.
            let _ = self.file.unlock();
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
        if let Ok(folder) = File::open(folder_of(&path)) {
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
            unfinished().remove(&self.temporary);
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

/// The folder that a file is in, or is to be in.
pub fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
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
        Some(what) => refuse(format!("it is {link}{what}, and only a regular file is replaced")),
    }
}

/// Writes a file completely or not at all. What killed processes have left of it goes.
///
/// # Errors
/// If it cannot be written; what was there before then stays.
pub fn write(path: &Path, bytes: &[u8]) -> Result<PathBuf, OutputError> {
    clear_abandoned(folder_of(path), |name| path.file_name().is_some_and(|whole| whole == name));
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
