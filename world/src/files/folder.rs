//! The folder in which a command leaves its files. A list in the folder names them. The command's next run removes the
//! listed files first, so that the folder never mixes files of two runs. While it writes, no other may write there. What
//! is there and on no such list is somebody else's, and is not replaced.

use super::input::{open, read_text};
use super::lock::{Lock, busy, is_in_use};
use super::output::{Output, OutputError, clear_abandoned};
use std::collections::BTreeSet;
use std::fs;
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Endings of the files that a command leaves. A list that names a file with another ending is not ours.
const ENDINGS: [&str; 8] = ["csv", "html", "json", "mcap", "md", "png", "svg", "tmp"];
/// Longest list read, bytes.
const LONGEST: u64 = 16 << 20;
/// How every list begins.
const HEAD: &str = "# What `rheotaxis ";

/// A folder with its list. Clones share the list.
#[derive(Clone, Debug)]
pub struct Folder {
    dir: PathBuf,
    removed: Arc<[String]>,
    /// Whether files that no list names are replaced, too.
    overwrites: bool,
    list: Arc<Mutex<List>>,
}

#[derive(Debug)]
struct List {
    file: Output,
    names: BTreeSet<String>,
    /// Until all is written.
    lock: Option<Lock>,
}

impl Folder {
    /// Takes an existing folder, removes the files that an earlier run of `command` listed in it, and begins a new list,
    /// `<command>-files.txt`.
    ///
    /// # Errors
    /// If another run is writing there, if the list cannot be read or made, or if a file cannot be removed.
    pub fn begin(dir: &Path, command: &str) -> Result<Self, OutputError> {
        Self::begin_with(dir, command, Some(&|_| false))
    }

    /// As [`Folder::begin`], but refuses the folder if it holds somebody else's file under a name that the command will
    /// write, as `own` tells; without `own`, such files are replaced.
    ///
    /// # Errors
    /// As [`Folder::begin`]; also for such a file. Nothing has been removed then.
    pub fn begin_with(dir: &Path, command: &str, own: Option<&dyn Fn(&str) -> bool>) -> Result<Self, OutputError> {
        let lock = Lock::take(dir).map_err(|e| OutputError::new(dir, e))?;
        let path = list_path(dir, command);
        let listed = untaken(dir, &path, own)?;
        let names: BTreeSet<&str> = listed.iter().map(String::as_str).collect();
        clear_abandoned(dir, |name| names.contains(name) || path.file_name().is_some_and(|list| list == name));
        let removed = remove(dir, listed)?;
        let mut file = Output::create(&path)?;
        let head =
            format!("{HEAD}{command}` left in this folder; the next time it writes here it removes these first.\n");
        (file.write_all(head.as_bytes())).map_err(|e| file.failed(e))?;
        file.place()?;
        let list = List { file, names: BTreeSet::new(), lock: Some(lock) };
        Ok(Self {
            dir: dir.to_owned(),
            removed: removed.into(),
            overwrites: own.is_none(),
            list: Arc::new(Mutex::new(list)),
        })
    }

    /// Whether [`Folder::begin_with`] would take a folder, which need not exist yet. Nothing in it changes.
    ///
    /// # Errors
    /// As [`Folder::begin_with`]; also if a file has the name of the folder, or of one that it is to lie in.
    pub fn could_begin(dir: &Path, command: &str, own: Option<&dyn Fn(&str) -> bool>) -> Result<(), OutputError> {
        // Without a slash at the end, with which a file would not be found.
        let plain: PathBuf = dir.components().collect();
        let there = plain.ancestors().find(|a| fs::metadata(a).is_ok());
        if let Some(file) = there.filter(|there| !there.is_dir()) {
            let problem = "it is a file, not a folder";
            return Err(OutputError::new(file, io::Error::new(ErrorKind::NotADirectory, problem)));
        }
        if !dir.is_dir() {
            return Ok(());
        }
        if is_in_use(dir) {
            return Err(OutputError::new(dir, busy()));
        }
        untaken(dir, &list_path(dir, command), own).map(drop)
    }

    /// Names of the files of an earlier run that were removed.
    pub fn removed(&self) -> &[String] {
        &self.removed
    }

    /// The folder.
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Enters a file into the list before it is written, and returns its path.
    ///
    /// # Errors
    /// If somebody else's file has that name, or if the list cannot be written.
    pub fn file(&self, name: &str) -> Result<PathBuf, OutputError> {
        let path = self.dir.join(name);
        let known = self.list().names.contains(name);
        if !known && !self.overwrites && is_file(&path) {
            return Err(OutputError::foreign(&path, &[]));
        }
        self.enter(name)?;
        Ok(path)
    }

    /// Enters a file that is there by now.
    ///
    /// # Errors
    /// If the list cannot be written.
    pub fn enter(&self, name: &str) -> Result<(), OutputError> {
        let mut list = self.list();
        if list.names.insert(name.to_string()) {
            let line = format!("{name}\n");
            let written = list.file.write_all(line.as_bytes());
            written.map_err(|e| list.file.failed(e))?;
        }
        Ok(())
    }

    /// Lets others write into the folder: all is written. It is not necessary to say so before the last clone goes.
    pub fn leave(&self) {
        self.list().lock = None;
    }

    fn list(&self) -> MutexGuard<'_, List> {
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn list_path(dir: &Path, command: &str) -> PathBuf {
    dir.join(format!("{command}-files.txt"))
}

/// Whether a regular file stands there. Anything else, a link too, is dealt with when a file is to take its place.
fn is_file(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|there| there.is_file())
}

/// The names on the list, if the folder holds no file of others among those that are `own`.
fn untaken(dir: &Path, list: &Path, own: Option<&dyn Fn(&str) -> bool>) -> Result<Vec<String>, OutputError> {
    let listed = listed(list)?;
    let Some(own) = own else {
        return Ok(listed);
    };
    if is_file(list) && !is_list(list) {
        return Err(OutputError::foreign(list, &[]));
    }
    let names: BTreeSet<&str> = listed.iter().map(String::as_str).collect();
    let there = fs::read_dir(dir).into_iter().flatten().flatten();
    let mut others: Vec<String> = there
        .filter(|e| e.file_type().is_ok_and(|kind| kind.is_file()))
        .filter_map(|e| e.file_name().into_string().ok())
        .filter(|name| own(name) && !names.contains(name.as_str()))
        .collect();
    others.sort();
    match &others[..] {
        [] => Ok(listed),
        [first, rest @ ..] => Err(OutputError::foreign(&dir.join(first), rest)),
    }
}

/// Whether a file begins as a list of ours.
fn is_list(path: &Path) -> bool {
    let mut begins = [0; HEAD.len()];
    let read = open(path).and_then(|mut file| file.read_exact(&mut begins));
    read.is_ok() && begins == *HEAD.as_bytes()
}

/// The names on a list that are plain names of files of ours.
fn listed(list: &Path) -> Result<Vec<String>, OutputError> {
    let text = match read_text(list, LONGEST) {
        Ok(text) => text,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => return Err(OutputError::new(list, e)),
    };
    let ours = |name: &&str| {
        let plain = Path::new(name).file_name().is_some_and(|n| n == *name);
        let ending = Path::new(name).extension().unwrap_or_default();
        plain && ENDINGS.iter().any(|e| ending == *e)
    };
    let names = text.lines().filter(|l| !l.starts_with('#')).filter(ours);
    Ok(names.map(str::to_string).collect())
}

/// Removes those that are regular files directly in the folder, and names them.
fn remove(dir: &Path, names: Vec<String>) -> Result<Vec<String>, OutputError> {
    let mut removed = Vec::new();
    for name in names {
        let path = dir.join(&name);
        if is_file(&path) {
            fs::remove_file(&path).map_err(|e| OutputError::new(&path, e))?;
            removed.push(name);
        }
    }
    Ok(removed)
}
