//! The rows of a campaign's folder.

use super::block::{BlockState, present, read_block};
use super::enough::wanted;
use super::error::CampaignError;
use super::manifest::Manifest;
use super::row::RunRow;
use super::table::{TableWriter, csv_head, csv_line};
use std::io::{BufWriter, Write};
use std::path::Path;
use world::files::Output;

/// All existing rows, in the order of runs; runs that are not done yet are left out.
///
/// # Errors
/// If there is no campaign, or if a block is not whole: `campaign run` computes it again.
pub fn read_rows(dir: &Path) -> Result<Vec<RunRow>, CampaignError> {
    let mut all = Vec::new();
    each_block(dir, |rows| {
        all.extend(rows);
        Ok(())
    })?;
    Ok(all)
}

fn each_block(
    dir: &Path,
    mut take: impl FnMut(Vec<RunRow>) -> Result<(), CampaignError>,
) -> Result<Manifest, CampaignError> {
    let manifest = Manifest::of(dir)?;
    manifest.campaign()?;
    for block in present(dir, &manifest)? {
        match read_block(dir, &manifest, block) {
            BlockState::Done(rows) | BlockState::Part(rows) => take(rows)?,
            BlockState::Missing => {}
            BlockState::Broken(error) => return Err(error),
        }
    }
    Ok(manifest)
}

/// The row of a run; `None` if the run is not done yet.
///
/// # Errors
/// If there is no such run, or its block is not whole.
pub fn read_row(dir: &Path, run: u64) -> Result<Option<RunRow>, CampaignError> {
    let manifest = Manifest::of(dir)?;
    manifest.campaign()?;
    let runs = manifest.runs;
    if run >= runs {
        return Err(CampaignError::NoRun { run, runs });
    }
    match read_block(dir, &manifest, run / manifest.block) {
        BlockState::Done(rows) | BlockState::Part(rows) => {
            Ok(rows.into_iter().find(|r| r.run == run))
        }
        BlockState::Missing => Ok(None),
        BlockState::Broken(error) => Err(error),
    }
}

/// The result of a merge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Merged {
    /// Number of rows in the file.
    pub rows: u64,
    /// Number of runs that the campaign wants, as far as is known.
    pub of: u64,
}

/// Writes all existing rows into one Parquet file and, if asked, one CSV file. It holds one block at a time in memory.
///
/// # Errors
/// If a block is not whole, or if a file cannot be written; what was there before then stays.
pub fn merge(dir: &Path, to: &Path, csv: Option<&Path>) -> Result<Merged, CampaignError> {
    if csv == Some(to) {
        let problem = "the Parquet file and the CSV file would be the same".to_string();
        let path = to.to_owned();
        return Err(CampaignError::Write { path, problem });
    }
    let unwritten = |path: &Path, problem: String| CampaignError::Write {
        path: path.to_owned(),
        problem,
    };
    let create = |path: &Path| Ok::<_, CampaignError>(BufWriter::new(Output::create(path)?));
    let mut table = TableWriter::new(create(to)?, &[]).map_err(|e| unwritten(to, e.to_string()))?;
    let mut lines = csv
        .map(|path| create(path).map(|file| (path, file)))
        .transpose()?;
    if let Some((path, file)) = &mut lines {
        writeln!(file, "{}", csv_head()).map_err(|e| unwritten(path, e.to_string()))?;
    }
    let mut n = 0;
    let manifest = each_block(dir, |rows| {
        n += rows.len() as u64;
        table
            .rows(&rows)
            .map_err(|e| unwritten(to, e.to_string()))?;
        if let Some((path, file)) = &mut lines {
            for row in &rows {
                writeln!(file, "{}", csv_line(row)).map_err(|e| unwritten(path, e.to_string()))?;
            }
        }
        Ok(())
    })?;
    let close = |path: &Path, file: BufWriter<Output>| {
        let file = file
            .into_inner()
            .map_err(|e| unwritten(path, e.error().to_string()))?;
        Ok::<_, CampaignError>(file.finish_on_disk()?)
    };
    let table = table.finish().map_err(|e| unwritten(to, e.to_string()))?;
    // If one file cannot be given its name, the other is not affected.
    let table = close(to, table);
    if let Some((path, file)) = lines {
        close(path, file)?;
    }
    table?;
    Ok(Merged {
        rows: n,
        of: wanted(&manifest.campaign()?, dir, &manifest).runs,
    })
}
