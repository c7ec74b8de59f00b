//! A block of runs and its file. A file that exists under its name is done.

use super::error::CampaignError;
use super::manifest::{Manifest, put_in_place};
use super::plan::hash;
use super::row::RunRow;
use super::table::{TableWriter, csv_line, read};
use std::fs::File;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// How a block stands.
#[derive(Debug)]
pub enum BlockState {
    /// No file yet.
    Missing,
    /// Whole, with its rows.
    Done(Vec<RunRow>),
    /// There is a file, but not a whole one.
    Broken(CampaignError),
}

/// The file of a block.
#[must_use]
pub fn block_path(dir: &Path, block: u64) -> PathBuf {
    dir.join(format!("part-{block:06}.parquet"))
}

/// Writes a block's rows: to a temporary file, to the disk, and under its name.
pub(super) fn write_block(dir: &Path, block: u64, rows: &[RunRow]) -> Result<(), CampaignError> {
    let path = block_path(dir, block);
    let notes = [
        ("block", block.to_string()),
        ("rows", rows.len().to_string()),
        ("rows_hash", rows_hash(rows)),
    ];
    let bytes = TableWriter::new(Vec::new(), &notes)
        .and_then(|mut table| {
            table.rows(rows)?;
            table.finish()
        })
        .map_err(|e| CampaignError::Write {
            path: path.clone(),
            problem: e.to_string(),
        })?;
    put_in_place(&path.with_extension("parquet.tmp"), &path, &bytes)
}

/// Reads a block and makes sure of it: footer, number and indices of its runs, hash of its rows.
#[must_use]
pub fn read_block(dir: &Path, manifest: &Manifest, block: u64) -> BlockState {
    let path = block_path(dir, block);
    let file = match File::open(&path) {
        Ok(file) => file,
        Err(e) if e.kind() == ErrorKind::NotFound => return BlockState::Missing,
        Err(e) => {
            let problem = e.to_string();
            return BlockState::Broken(CampaignError::Read { path, problem });
        }
    };
    match whole(file, manifest.runs_of(block)) {
        Ok(rows) => BlockState::Done(rows),
        Err(problem) => BlockState::Broken(CampaignError::Broken { path, problem }),
    }
}

fn whole(file: File, runs: Range<u64>) -> Result<Vec<RunRow>, String> {
    let (rows, notes) = read(file).map_err(|e| e.to_string())?;
    let note = |key: &str| {
        let found = notes.iter().find(|n| n.key == key);
        found.and_then(|n| n.value.clone()).unwrap_or_default()
    };
    if !rows.iter().map(|r| r.run).eq(runs.clone()) {
        let (first, last) = (runs.start, runs.end - 1);
        return Err(format!(
            "it does not hold the runs {first} to {last}, each once"
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
