//! A block of runs and its file. The file grows by replacement: each version is whole and has more rows.

use super::contained::contained;
use super::error::CampaignError;
use super::manifest::Manifest;
use super::plan::hash;
use super::row::RunRow;
use super::seal::{self, Seal};
use super::table::{TableWriter, csv_line, read};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{ErrorKind, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};
use world::files::{self, write_on_disk};

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
    #[must_use]
    pub fn rows(self) -> Vec<RunRow> {
        match self {
            BlockState::Part(rows) | BlockState::Done(rows) => rows,
            BlockState::Missing | BlockState::Broken(_) => Vec::new(),
        }
    }
}

/// The file of a block.
#[must_use]
pub fn block_path(dir: &Path, block: u64) -> PathBuf {
    dir.join(format!("part-{block:06}.parquet"))
}

/// The blocks that have a file, in order. Readers go by the files that exist, not by the plan.
pub(super) fn present(dir: &Path, manifest: &Manifest) -> Result<Vec<u64>, CampaignError> {
    let unread = |e: std::io::Error| CampaignError::Read {
        path: dir.to_owned(),
        problem: e.to_string(),
    };
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

/// Writes the rows of a block, all or some: to a temporary file, to the disk, and then under its name.
pub(super) fn write_block(dir: &Path, block: u64, rows: &[RunRow]) -> Result<(), CampaignError> {
    let path = block_path(dir, block);
    let notes = [
        ("block", block.to_string()),
        ("rows", rows.len().to_string()),
        ("rows_hash", rows_hash(rows)),
    ];
    let sealed = TableWriter::new(Vec::new(), &notes).and_then(|mut table| {
        table.before_columns(&seal::room())?;
        table.rows(rows)?;
        table.finish()
    });
    let mut bytes = sealed.map_err(|e| CampaignError::Write {
        path: path.clone(),
        problem: e.to_string(),
    })?;
    seal::close(&mut bytes);
    write_on_disk(&path, &bytes)?;
    Ok(())
}

/// Adds rows to those in a block's file, whoever wrote them; a damaged file is replaced.
pub(super) fn add_to_block(
    dir: &Path,
    manifest: &Manifest,
    block: u64,
    rows: &[RunRow],
) -> Result<(), CampaignError> {
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

/// Reads a block and verifies it: seal, footer, indices of its runs, hash of its rows. Whatever its bytes are, the
/// answer is one of the four states.
#[must_use]
pub fn read_block(dir: &Path, manifest: &Manifest, block: u64) -> BlockState {
    let path = block_path(dir, block);
    let file = match files::open(&path) {
        Ok(file) => file,
        Err(e) if e.kind() == ErrorKind::NotFound => return BlockState::Missing,
        Err(e) if e.kind() == ErrorKind::InvalidInput => {
            let problem = e.to_string();
            return BlockState::Broken(CampaignError::Broken { path, problem });
        }
        Err(e) => {
            let problem = e.to_string();
            return BlockState::Broken(CampaignError::Read { path, problem });
        }
    };
    let runs = manifest.runs_of(block);
    let n = runs.clone().count();
    match sound(file, runs, manifest.sealed) {
        Ok(rows) if rows.len() == n => BlockState::Done(rows),
        Ok(rows) => BlockState::Part(rows),
        Err(problem) => BlockState::Broken(CampaignError::Broken { path, problem }),
    }
}

fn sound(mut file: File, runs: Range<u64>, sealed: bool) -> Result<Vec<RunRow>, String> {
    match seal::look(&mut file).map_err(|e| e.to_string())? {
        Seal::Whole => {}
        // Older programs wrote blocks without seals.
        Seal::Missing if !sealed => {}
        Seal::Missing => return Err("it does not begin as a block does".to_string()),
        Seal::Wrong => {
            return Err("its bytes are not those that were written (wrong hash)".to_string());
        }
    }
    file.seek(SeekFrom::Start(0)).map_err(|e| e.to_string())?;
    let most = runs.clone().count();
    let (rows, notes) = contained(|| read(file, most))
        .map_err(|said| format!("the library that reads it gave up: {said}"))?
        .map_err(|e| e.to_string())?;
    let note = |key: &str| {
        let found = notes.iter().find(|n| n.key == key);
        found.and_then(|n| n.value.clone()).unwrap_or_default()
    };
    let in_order = rows.windows(2).all(|pair| pair[0].run < pair[1].run);
    if rows.is_empty() || !in_order || !rows.iter().all(|r| runs.contains(&r.run)) {
        let (first, last) = (runs.start, runs.end - 1);
        return Err(format!(
            "it does not hold runs from {first} to {last}, each once"
        ));
    }
    if note("rows_hash") != rows_hash(&rows) {
        return Err("its rows are not those that were written (wrong hash)".to_string());
    }
    Ok(rows)
}

fn rows_hash(rows: &[RunRow]) -> String {
    let lines: Vec<String> = rows.iter().map(csv_line).collect();
    hash(&lines.join("\n"))
}

#[cfg(test)]
mod tests;
