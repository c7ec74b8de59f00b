//! The rows of a campaign's folder.

use super::block::{BlockState, present, read_block};
use super::enough::wanted;
use super::error::CampaignError;
use super::manifest::Manifest;
use super::rows::columns::csv_fields;
use super::rows::record::Record;
use super::rows::row::RunRow;
use super::rows::table::TableWriter;
use std::error::Error;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use world::files::{Output, OutputError, clear_abandoned, folder_of};
use world::registry::Registry;

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
    let manifest = Manifest::open(dir)?;
    manifest.check()?;
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
    let manifest = Manifest::open(dir)?;
    manifest.check()?;
    let runs = manifest.runs;
    if run >= runs {
        return Err(CampaignError::NoRun { run, runs });
    }
    match read_block(dir, &manifest, run / manifest.block) {
        BlockState::Done(rows) | BlockState::Part(rows) => Ok(rows.into_iter().find(|r| r.run == run)),
        BlockState::Missing => Ok(None),
        BlockState::Broken(error) => Err(error),
    }
}

/// The result of a merge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MergeResult {
    /// Number of rows in the file.
    pub rows: u64,
    /// Number of runs that the campaign wants, as far as is known.
    pub of: u64,
    /// Number of declarations.
    pub declarations: u64,
    /// The Parquet file of declarations.
    pub declarations_path: PathBuf,
}

/// Where the declarations go if the rows go into this file.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push("-declarations");
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

/// Writes all existing rows into one Parquet file, their declarations into one beside it (`all.parquet` and
/// `all-declarations.parquet`), and if asked, both as CSV files, too. It holds one block at a time in memory.
///
/// # Errors
/// If a block is not whole, or if a file cannot be written; what was there before then stays.
pub fn merge(registry: &Registry, dir: &Path, to: &Path, csv: Option<&Path>) -> Result<MergeResult, CampaignError> {
    if csv == Some(to) {
        return Err(unwritten(to)("the Parquet file and the CSV file would be the same"));
    }
    let declarations_path = beside(to);
    let csv_beside = csv.map(beside);
    let files = [Some(to), Some(&declarations_path), csv, csv_beside.as_deref()];
    for file in files.into_iter().flatten() {
        clear_abandoned(folder_of(file), |name| file.file_name().is_some_and(|f| f == name));
    }
    let mut runs = Table::create(to, csv)?;
    let mut declared = Table::create(&declarations_path, csv_beside.as_deref())?;
    let manifest = each_block(dir, |rows| {
        runs.add(&rows)?;
        let declarations: Vec<_> = rows.into_iter().flat_map(|r| r.declarations).collect();
        declared.add(&declarations)
    })?;
    let (rows, declarations) = (runs.lines, declared.lines);
    // If one file cannot be given its name, the others are not affected.
    runs.close().and(declared.close())?;
    Ok(MergeResult {
        rows,
        of: wanted(&manifest.campaign(registry)?, dir, &manifest).runs,
        declarations,
        declarations_path,
    })
}

/// A table that grows block by block.
struct Table<'a, T> {
    path: &'a Path,
    parquet: TableWriter<T, BufWriter<Output>>,
    csv: Option<(&'a Path, csv::Writer<Output>)>,
    lines: u64,
}

fn unwritten<E: Into<Box<dyn Error + Send + Sync>>>(path: &Path) -> impl Fn(E) -> CampaignError + use<'_, E> {
    move |e| OutputError::new(path, io::Error::other(e)).into()
}

impl<'a, T: Record> Table<'a, T> {
    fn create(path: &'a Path, csv: Option<&'a Path>) -> Result<Self, CampaignError> {
        let file = BufWriter::new(Output::create(path)?);
        let parquet = TableWriter::new(file, &[]).map_err(unwritten(path))?;
        let csv = match csv {
            None => None,
            Some(path) => {
                let mut to = csv::Writer::from_writer(Output::create(path)?);
                let head = T::COLUMNS.iter().map(|(info, ..)| info.name);
                to.write_record(head).map_err(unwritten(path))?;
                Some((path, to))
            }
        };
        Ok(Self { path, parquet, csv, lines: 0 })
    }

    fn add(&mut self, records: &[T]) -> Result<(), CampaignError> {
        self.lines += records.len() as u64;
        self.parquet.rows(records).map_err(unwritten(self.path))?;
        if let Some((path, to)) = &mut self.csv {
            for record in records {
                to.write_record(csv_fields(record)).map_err(unwritten(path))?;
            }
        }
        Ok(())
    }

    /// Gives the files their names, each if it can be.
    fn close(self) -> Result<(), CampaignError> {
        let parquet = self.parquet.finish().map_err(unwritten(self.path));
        let parquet = parquet.and_then(|file| {
            let file = file.into_inner();
            let file = file.map_err(|e| unwritten(self.path)(e.into_error()))?;
            Ok(file.finish_on_disk()?)
        });
        let csv = self.csv.map_or(Ok(()), |(path, to)| {
            let file = to.into_inner();
            let file = file.map_err(|e| unwritten(path)(e.into_error()))?;
            Ok(file.finish_on_disk().map(drop)?)
        });
        parquet.and(csv)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_go_beside_the_rows() {
        let of = |path: &str| beside(Path::new(path));
        assert_eq!(of("a/all.parquet"), Path::new("a/all-declarations.parquet"));
        assert_eq!(of("b.1.csv"), Path::new("b.1-declarations.csv"));
        assert_eq!(of("all"), Path::new("all-declarations"));
    }
}
