//! A block of runs and its two files: one of rows, one of their declarations. They grow by replacement: each version
//! is whole and has more rows.
//!
//! The declarations are written first, then the rows. If a kill comes between the two, there are declarations of runs
//! that have no row yet. Readers leave these out, so no row that was written is lost.

use super::contained::contained;
use super::error::CampaignError;
use super::manifest::{FILE, Manifest};
use super::plan::hash;
use super::rows::columns::as_csv;
use super::rows::record::Record;
use super::rows::row::{DeclarationRow, RunRow};
use super::rows::table::{TableWriter, read};
use parquet::file::metadata::KeyValue;
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use world::files::{self, OutputError, write_on_disk};

/// The state of a block.
#[derive(Debug)]
pub enum BlockState {
    /// No file yet.
    Missing,
    /// Some of its rows: those that were done when it was cut off.
    Part(Vec<RunRow>),
    /// All of its rows.
    Done(Vec<RunRow>),
    /// There is a file, but not a sound one.
    Broken(CampaignError),
}

impl BlockState {
    /// The rows that exist; none of a damaged block.
    pub fn rows(self) -> Vec<RunRow> {
        match self {
            BlockState::Part(rows) | BlockState::Done(rows) => rows,
            BlockState::Missing | BlockState::Broken(_) => Vec::new(),
        }
    }
}

/// The file of a block's rows.
pub fn block_path(dir: &Path, block: u64) -> PathBuf {
    dir.join(format!("part-{block:06}.parquet"))
}

/// The file of its declarations.
pub fn declarations_path(dir: &Path, block: u64) -> PathBuf {
    dir.join(format!("declarations-{block:06}.parquet"))
}

/// Whether a file of this name belongs to a campaign's folder.
pub(super) fn is_of_campaign(name: &str) -> bool {
    let of_block = |begin: &str| {
        let number = name.strip_prefix(begin).and_then(|n| n.strip_suffix(".parquet"));
        number.is_some_and(|n| n.bytes().all(|b| b.is_ascii_digit()))
    };
    name == FILE || of_block("part-") || of_block("declarations-")
}

/// The blocks that have a file, in order. Readers go by the files that exist, not by the plan.
pub(super) fn present(dir: &Path, manifest: &Manifest) -> Result<Vec<u64>, CampaignError> {
    let unread = |e: io::Error| CampaignError::Read { path: dir.to_owned(), problem: e.to_string() };
    let files = match fs::read_dir(dir) {
        Ok(files) => files,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => return Err(unread(e)),
    };
    let mut blocks = Vec::new();
    for file in files {
        let name = file.map_err(unread)?.file_name();
        let number = (name.to_str())
            .and_then(|n| n.strip_prefix("part-")?.strip_suffix(".parquet"))
            .and_then(|n| n.parse().ok())
            .filter(|n| block_path(dir, *n).file_name() == Some(&name));
        blocks.extend(number.filter(|n| *n < manifest.n_blocks()));
    }
    blocks.sort_unstable();
    Ok(blocks)
}

/// Writes the rows of a block, all or some, and their declarations: each to a temporary file, to the disk, and then
/// under its name.
pub(super) fn write_block(dir: &Path, block: u64, rows: &[RunRow]) -> Result<(), CampaignError> {
    let number = ("block", block.to_string());
    let declarations: Vec<DeclarationRow> = (rows.iter().flat_map(|r| &r.declarations)).cloned().collect();
    let notes = [number.clone()];
    write_table(&declarations_path(dir, block), &declarations, &notes)?;
    let notes = [number, ("rows", rows.len().to_string()), ("rows_hash", rows_hash(rows))];
    write_table(&block_path(dir, block), rows, &notes)
}

fn write_table<T: Record>(path: &Path, rows: &[T], notes: &[(&str, String)]) -> Result<(), CampaignError> {
    let sealed = TableWriter::new(Vec::new(), notes).and_then(|mut table| {
        table.before_columns(&seal::room())?;
        table.rows(rows)?;
        table.finish()
    });
    let mut bytes = sealed.map_err(|e| OutputError::new(path, io::Error::other(e)))?;
    seal::close(&mut bytes);
    write_on_disk(path, &bytes)?;
    Ok(())
}

/// Adds rows to those in a block's file, whoever wrote them; a damaged file is replaced.
pub(super) fn add_to_block(dir: &Path, manifest: &Manifest, block: u64, rows: &[RunRow]) -> Result<(), CampaignError> {
    let mut all: BTreeMap<u64, RunRow> = BTreeMap::new();
    let there = read_block(dir, manifest, block).rows();
    let before = there.len();
    for row in there.into_iter().chain(rows.iter().cloned()) {
        all.entry(row.run).or_insert(row);
    }
    if all.len() == before {
        return Ok(());
    }
    let all: Vec<RunRow> = all.into_values().collect();
    write_block(dir, block, &all)
}

/// Reads a block and verifies it: seals, footers, indices of its runs, hash of its rows and their declarations.
/// Whatever the bytes are, the answer is one of the four states.
pub fn read_block(dir: &Path, manifest: &Manifest, block: u64) -> BlockState {
    let wanted = manifest.runs_of(block).count();
    match sound(dir, manifest, block) {
        Ok(None) => BlockState::Missing,
        Ok(Some(rows)) if rows.len() == wanted => BlockState::Done(rows),
        Ok(Some(rows)) => BlockState::Part(rows),
        Err(error) => BlockState::Broken(error),
    }
}

/// The rows of a block with their declarations; `None` if there are no rows.
fn sound(dir: &Path, manifest: &Manifest, block: u64) -> Result<Option<Vec<RunRow>>, CampaignError> {
    let (path, beside) = (block_path(dir, block), declarations_path(dir, block));
    let broken = |path: &Path, problem: String| CampaignError::Broken { path: path.to_owned(), problem };
    let runs = manifest.runs_of(block);
    let Some((mut rows, notes)) = read_table::<RunRow>(&path, Some(runs.clone().count()))? else {
        return Ok(None);
    };
    let in_order = rows.windows(2).all(|pair| pair[0].run < pair[1].run);
    if rows.is_empty() || !in_order || !rows.iter().all(|r| runs.contains(&r.run)) {
        let (first, last) = (runs.start, runs.end - 1);
        let problem = format!("it does not hold runs from {first} to {last}, each once");
        return Err(broken(&path, problem));
    }
    let Some((declarations, _)) = read_table::<DeclarationRow>(&beside, None)? else {
        return Err(broken(&beside, "it does not exist".to_string()));
    };
    for declaration in declarations {
        if let Ok(k) = rows.binary_search_by_key(&declaration.run, |r| r.run) {
            rows[k].declarations.push(declaration);
        }
    }
    let note = notes.into_iter().find(|n| n.key == "rows_hash");
    if note.and_then(|n| n.value) != Some(rows_hash(&rows)) {
        let problem = "its rows and declarations are not those that were written (wrong hash)";
        return Err(broken(&path, problem.to_string()));
    }
    Ok(Some(rows))
}

/// The lines of a table, and the notes in its footer.
type TableContent<T> = (Vec<T>, Vec<KeyValue>);

/// The lines of a table and the notes in its footer; `None` if there is no file. If it is not known how many lines
/// there may be, there are at most as many as the file has bytes.
fn read_table<T: Record>(path: &Path, most: Option<usize>) -> Result<Option<TableContent<T>>, CampaignError> {
    let path = || path.to_owned();
    let unread = |e: io::Error| {
        let (path, problem) = (path(), e.to_string());
        match e.kind() {
            ErrorKind::InvalidInput => CampaignError::Broken { path, problem },
            _ => CampaignError::Read { path, problem },
        }
    };
    let broken = |problem: String| {
        let path = path();
        CampaignError::Broken { path, problem }
    };
    let mut file = match files::open(&path()) {
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
        file => file.map_err(unread)?,
    };
    seal::look(&mut file).map_err(unread)?.map_err(broken)?;
    let end = file.seek(SeekFrom::End(0)).map_err(unread)?;
    let most = most.unwrap_or(usize::try_from(end).unwrap_or(usize::MAX));
    contained(|| read(file, most))
        .map_err(|said| broken(format!("the library that reads it gave up: {said}")))?
        .map_err(|e| broken(e.to_string()))
        .map(Some)
}

fn rows_hash(rows: &[RunRow]) -> String {
    hash(&as_csv(rows).concat())
}

mod seal;
#[cfg(test)]
mod tests;
