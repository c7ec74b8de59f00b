//! A folder of what can be made again: each content under a key, checked when it is read, all together bounded in size.
//!
//! A file holds a head (what it is, the key, the length), the content, and a hash of both. A file that is cut short,
//! changed, of another key or of another program is found to be so, and removed. Several processes may use the folder:
//! a file appears whole, by renaming; a file that another process removes meanwhile is one that is not there; and each
//! process brings the folder back below its bound after every file that it adds, the least recently used files first.
//! Files with other names are never touched.
#![allow(clippy::disallowed_methods, reason = "times of use decide which file goes first, and nothing else")]

use super::input::open;
use super::output::{Output, make_folder};
use crate::digest::Fingerprint;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime};

const MAGIC: [u8; 16] = *b"rheotaxis kept 1";
const HEAD: usize = MAGIC.len() + 32 + 8;
const SEAL: usize = 32;
const ENDING: &str = ".kept";
/// A file that has had only its temporary name for this long belongs to a process that was killed.
const ABANDONED: Duration = Duration::from_secs(3600);
/// The part of the bound that one process fills, after its first file: a process that makes thousands of contents would
/// otherwise drive out all that others use, and in the end its own first ones.
const SHARE: u64 = 4;

/// The folder.
#[derive(Debug)]
pub struct Shelf {
    dir: PathBuf,
    most: u64,
    /// Bytes that this process has added.
    added: AtomicU64,
}

/// What stands under a key.
#[derive(Debug, PartialEq, Eq)]
pub enum ShelfEntry {
    /// Nothing.
    Nothing,
    /// Something that was not written there, or not whole. It has been removed.
    Broken,
    /// The content.
    Whole(Vec<u8>),
}

/// Number and size of files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stock {
    /// Number of whole files, as far as their names tell.
    pub files: u64,
    /// Bytes of all files, also of those under way.
    pub bytes: u64,
    /// When one was last added or read.
    pub used: Option<SystemTime>,
}

/// The folder or a file in it cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}: {source}", path.display())]
pub struct ShelfError {
    /// The folder or the file.
    pub path: PathBuf,
    /// The message of the system.
    pub source: io::Error,
}

/// A file of the folder.
struct Entry {
    path: PathBuf,
    bytes: u64,
    used: SystemTime,
    whole: bool,
}

impl Shelf {
    /// A folder, which need not exist yet, and the most bytes that it may hold.
    pub fn new(dir: PathBuf, most: u64) -> Self {
        let added = AtomicU64::new(0);
        Self { dir, most, added }
    }

    /// The folder.
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// The most bytes that it may hold.
    pub fn most(&self) -> u64 {
        self.most
    }

    fn path(&self, key: &[u8; 32]) -> PathBuf {
        self.dir.join(Fingerprint::hex(key) + ENDING)
    }

    /// Reads what stands under a key, and notes that it was used.
    ///
    /// # Errors
    /// If something is there that cannot be read, such as a folder or another user's file.
    pub fn get(&self, key: &[u8; 32]) -> Result<ShelfEntry, ShelfError> {
        let path = self.path(key);
        match read(&path, key) {
            Ok(Some(content)) => {
                // In a folder without rights the order of use is not kept.
                let file = File::options().write(true).open(&path);
                let _ = file.and_then(|f| f.set_modified(SystemTime::now()));
                Ok(ShelfEntry::Whole(content))
            }
            Ok(None) => {
                let _ = fs::remove_file(&path);
                Ok(ShelfEntry::Broken)
            }
            Err(e) if e.kind() == ErrorKind::NotFound => Ok(ShelfEntry::Nothing),
            Err(source) => Err(ShelfError { path, source }),
        }
    }

    /// Writes a content under a key, in place of what is there. Returns whether it did: a content larger than the
    /// bound, or one beyond this process's share, is not written.
    ///
    /// # Errors
    /// If the folder cannot be made or written, or if the disk is full.
    pub fn store(&self, key: &[u8; 32], content: &[u8]) -> Result<bool, ShelfError> {
        let bytes = (HEAD + content.len() + SEAL) as u64;
        let before = self.added.fetch_add(bytes, Ordering::Relaxed);
        if bytes > self.most || (before > 0 && before + bytes > self.most / SHARE) {
            self.added.fetch_sub(bytes, Ordering::Relaxed);
            return Ok(false);
        }
        make_folder(&self.dir).map_err(|e| self.failed(e))?;
        let path = self.path(key);
        let failed = |source| ShelfError { path: path.clone(), source };
        let mut output = Output::create(&path).map_err(|e| failed(e.source))?;
        let head = head(key, content.len());
        let seal = seal(&head, content);
        [head.as_slice(), content, seal.as_slice()]
            .into_iter()
            .try_for_each(|part| output.write_all(part))
            .map_err(failed)?;
        output.finish().map_err(|e| failed(e.source))?;
        self.make_room(&path)?;
        Ok(true)
    }

    /// Removes the least recently used files until all fit, but not the one that was just added.
    fn make_room(&self, newest: &Path) -> Result<(), ShelfError> {
        let mut entries = self.entries()?;
        let abandoned = |e: &Entry| !e.whole && e.used.elapsed().is_ok_and(|age| age > ABANDONED);
        entries.retain(|e| !(abandoned(e) && fs::remove_file(&e.path).is_ok()));
        let mut bytes: u64 = entries.iter().map(|e| e.bytes).sum();
        // By name where the times are equal, so that two processes choose the same ones.
        entries.sort_by(|a, b| (a.used, &a.path).cmp(&(b.used, &b.path)));
        for entry in entries.iter().filter(|e| e.whole && e.path != newest) {
            if bytes <= self.most {
                break;
            }
            match fs::remove_file(&entry.path) {
                Ok(()) => bytes -= entry.bytes,
                // Another process was faster.
                Err(e) if e.kind() == ErrorKind::NotFound => bytes -= entry.bytes,
                Err(source) => {
                    let path = entry.path.clone();
                    return Err(ShelfError { path, source });
                }
            }
        }
        Ok(())
    }

    /// What it holds now.
    ///
    /// # Errors
    /// If the folder is there and cannot be read.
    pub fn stock(&self) -> Result<Stock, ShelfError> {
        let entries = self.entries()?;
        Ok(Stock {
            files: entries.iter().filter(|e| e.whole).count() as u64,
            bytes: entries.iter().map(|e| e.bytes).sum(),
            used: entries.iter().map(|e| e.used).max(),
        })
    }

    /// Removes all its files, and tells how many they were. Files with other names stay.
    ///
    /// # Errors
    /// If the folder is there and cannot be read, or if a file cannot be removed; those before it are.
    pub fn clear(&self) -> Result<Stock, ShelfError> {
        let stock = self.stock()?;
        for Entry { path, .. } in self.entries()? {
            match fs::remove_file(&path) {
                Err(source) if source.kind() != ErrorKind::NotFound => {
                    return Err(ShelfError { path, source });
                }
                _ => {}
            }
        }
        Ok(stock)
    }

    fn entries(&self) -> Result<Vec<Entry>, ShelfError> {
        let listed = match fs::read_dir(&self.dir) {
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
            listed => listed.map_err(|e| self.failed(e))?,
        };
        // A file that vanishes meanwhile is not there.
        Ok(listed.flatten().filter_map(|e| entry(&e)).collect())
    }

    fn failed(&self, source: io::Error) -> ShelfError {
        let path = self.dir.clone();
        ShelfError { path, source }
    }
}

/// A file whose name is one that a shelf gives, or the temporary name of such a file.
fn entry(listed: &fs::DirEntry) -> Option<Entry> {
    let name = listed.file_name();
    let (key, rest) = name.to_str()?.split_at_checked(64)?;
    let hex = |b: u8| b.is_ascii_digit() || (b'a'..=b'f').contains(&b);
    let rest = rest.strip_prefix(ENDING)?;
    let there = listed.metadata().ok()?;
    let ours = key.bytes().all(hex) && (rest.is_empty() || rest.ends_with(".tmp"));
    (ours && there.is_file()).then(|| Entry {
        path: listed.path(),
        bytes: there.len(),
        used: there.modified().unwrap_or(SystemTime::UNIX_EPOCH),
        whole: rest.is_empty(),
    })
}

fn head(key: &[u8; 32], length: usize) -> Vec<u8> {
    [&MAGIC[..], key, &(length as u64).to_le_bytes()].concat()
}

fn seal(head: &[u8], content: &[u8]) -> [u8; SEAL] {
    let mut seal = Fingerprint::default();
    seal.bytes(head);
    seal.bytes(content);
    seal.finish()
}

/// The content of a file; `None` if it is not the one that was written under this key, or not whole.
fn read(path: &Path, key: &[u8; 32]) -> io::Result<Option<Vec<u8>>> {
    let mut file = open(path)?;
    let whole = file.metadata()?.len();
    let length = usize::try_from(whole).ok().and_then(|whole| whole.checked_sub(HEAD + SEAL));
    let Some(length) = length else {
        return Ok(None);
    };
    let mut begins = [0; HEAD];
    file.read_exact(&mut begins)?;
    // Before memory is taken for a file that is something else.
    if begins != *head(key, length) {
        return Ok(None);
    }
    let mut content = Vec::new();
    if content.try_reserve_exact(length + SEAL + 1).is_err() {
        return Ok(None);
    }
    file.take((length + SEAL + 1) as u64).read_to_end(&mut content)?;
    if content.len() != length + SEAL {
        return Ok(None);
    }
    let sealed = content.split_off(length);
    Ok((sealed == seal(&begins, &content)).then_some(content))
}
