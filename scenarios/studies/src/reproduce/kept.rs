//! Tables of the runs behind printed rows: kept in a folder, resumed from, added to, and checked by running some again.
//!
//! A row has two files of CSV: `<row>.csv` holds a line for each run (seed, outcome, digest and all that is measured),
//! `<row>-declarations.csv` a line for each declaration. The first line of the former names scenario and hash, and holds
//! a fingerprint of all lines of both. Wall times are left out, so the same runs give the same bytes on any machine.

use super::row::{Reference, ReproduceError};
use super::run::{RowResult, seed_runs};
use crate::campaign::{DeclarationRow, LaneLimits, RunRow, as_csv, difference, from_csv};
use output::files::{ReportError, make_folder, write_whole};
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{BuildHasher, RandomState};
use std::path::{Path, PathBuf};
use world::digest::Fingerprint;
use world::files;
use world::seeds::Seed;

/// Longest file that is read, bytes: some hundred thousand runs.
const LONGEST: u64 = 256 << 20;
/// What the first line begins with.
const HEAD: &str = "# rheotaxis reproduce: scenario ";

/// The kept runs of a row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Hash of the scenario.
    hash: String,
    /// By seed and arm.
    runs: BTreeMap<(u64, String), RunRow>,
}

impl Table {
    /// Reads the table of a row; `None` if the folder has none.
    ///
    /// # Errors
    /// If a file cannot be read, or is not such a table: with file, line and column.
    pub fn read(dir: &Path, reference: &Reference) -> Result<Option<Self>, ReproduceError> {
        let [path, beside] = paths(dir, &reference.row.id);
        if !path.exists() {
            return Ok(None);
        }
        let wrong = |path: &Path, problem: String| ReproduceError::Table { path: path.to_path_buf(), problem };
        let text =
            |path: &Path| files::read_text(path, LONGEST).map_err(|e| wrong(path, format!("cannot be read: {e}")));
        let runs = text(&path)?;
        let (head, lines) = runs.split_once('\n').unwrap_or((&runs, ""));
        let said = (head.strip_prefix(HEAD)).and_then(|rest| rest.split_once(", hash "));
        let Some((hash, rows)) = said.and_then(|(_, rest)| rest.split_once(", rows ")) else {
            let problem = format!("line 1: must be `{HEAD}NAME, hash HASH, rows HASH`, got `{head}`");
            return Err(wrong(&path, problem));
        };
        let declarations = text(&beside)?;
        let is = of_rows(lines, &declarations);
        let changed = (rows.trim() != is).then(|| {
            let problem = format!(
                "the table was changed after it was written: its rows and declarations have hash {is}, line 1 says {}; make its runs anew (--anew)",
                rows.trim()
            );
            wrong(&path, problem)
        });
        let rows: Vec<RunRow> = from_csv(lines, 1).map_err(|e| wrong(&path, e))?;
        let declared: Vec<DeclarationRow> = from_csv(&declarations, 0).map_err(|e| wrong(&beside, e))?;
        if let Some(changed) = changed {
            return Err(changed);
        }
        let mut runs: BTreeMap<_, _> = rows.into_iter().map(|r| ((r.seed, r.arm.clone()), r)).collect();
        for d in declared {
            let Some(run) = runs.get_mut(&(d.seed, d.arm.clone())) else {
                let problem = format!("seed {}, arm `{}`: no such run", d.seed, d.arm);
                return Err(wrong(&beside, problem));
            };
            run.declarations.push(d);
        }
        let hash = hash.to_string();
        Ok(Some(Self { hash, runs }))
    }

    /// Whether it holds no runs.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Takes over the runs of a row; those of equal seed and arm are replaced.
    pub fn merge(&mut self, row: &RowResult) {
        self.hash.clone_from(&row.scenario.1);
        for run in &row.runs {
            let run = RunRow { spin_up_wall_s: 0.0, mission_wall_s: 0.0, own_wall_s: None, ..run.clone() };
            self.runs.insert((run.seed, run.arm.clone()), run);
        }
    }

    /// Writes the table of a row.
    ///
    /// # Errors
    /// If the folder or a file cannot be written.
    pub fn write(&self, dir: &Path, row: &RowResult) -> Result<(), ReportError> {
        make_folder(dir)?;
        let mut runs: Vec<RunRow> = self.runs.values().cloned().collect();
        // Numbers within the table, so that they do not depend on the order in which seeds were added.
        for (n, run) in (0..).zip(&mut runs) {
            run.run = n;
            run.seed_index = 0;
            for d in &mut run.declarations {
                (d.run, d.seed_index) = (n, 0);
            }
        }
        let [rows, declarations] = as_csv(&runs);
        let of_rows = of_rows(&rows, &declarations);
        let (name, hash) = (&row.scenario.0, &self.hash);
        let rows = format!("{HEAD}{name}, hash {hash}, rows {of_rows}\n{rows}");
        let [path, beside] = paths(dir, &row.row.id);
        // Declarations first: runs without theirs would be read as runs that declared nothing.
        write_whole(&beside, declarations.as_bytes())?;
        write_whole(&path, rows.as_bytes())?;
        Ok(())
    }

    /// The runs of consecutive seeds from `first` on for which all arms are there, at most `n` seeds.
    pub fn from_seed(&self, first: u64, n: u64, reference: &Reference) -> Vec<RunRow> {
        let arms = reference.arms.len() as u64;
        let mut all = Vec::new();
        for index in 0..n {
            let seed = first + index;
            let of = |(arm, _): &(String, _)| self.runs.get(&(seed, arm.clone())).cloned();
            let Some(runs) = reference.arms.iter().map(of).collect::<Option<Vec<_>>>() else {
                break;
            };
            for (k, mut run) in (0..).zip(runs) {
                (run.run, run.seed_index) = (index * arms + k, index);
                all.push(run);
            }
        }
        all
    }

    /// All runs of a row's arms.
    pub fn of_arms(&self, reference: &Reference) -> Vec<RunRow> {
        let asked = |arm: &String| reference.arms.iter().any(|(name, _)| name == arm);
        let all = self.runs.iter().filter(|((_, arm), _)| asked(arm));
        all.map(|(_, run)| run.clone()).collect()
    }

    /// What shows that the program no longer gives these runs: another scenario, or another digest or measure when `n`
    /// of the seeds, drawn at random, are run again. `None` if nothing does.
    pub fn stale(&self, reference: &Reference, n: usize) -> Option<String> {
        let (was, is) = (&self.hash, reference.loaded.hash());
        if *was != is {
            return Some(format!("its scenario has hash {is}, that of the table {was}"));
        }
        self.drawn(n).into_iter().find_map(|seed| self.differs(reference, seed))
    }

    /// Different seeds, drawn at random: what is checked must not be known before.
    fn drawn(&self, n: usize) -> Vec<u64> {
        let seeds: BTreeSet<u64> = self.runs.keys().map(|(seed, _)| *seed).collect();
        let random = RandomState::new();
        let mut seeds: Vec<u64> = seeds.into_iter().collect();
        seeds.sort_by_key(|seed| random.hash_one(seed));
        seeds.truncate(n);
        seeds
    }

    fn differs(&self, reference: &Reference, seed: u64) -> Option<String> {
        let was = |arm: &String| self.runs.get(&(seed, arm.clone()));
        let mut found = None;
        seed_runs(reference, |arm| was(arm).is_some(), (0, Seed::from(seed)), None, LaneLimits::NONE, &mut |is| {
            let is = &is;
            let was = was(&is.arm).expect("only arms of the table are run");
            let counts = [is, was].map(|run| run.declarations.len());
            let of_declarations = || is.declarations.iter().zip(&was.declarations);
            let differs = (counts[0] != counts[1])
                .then(|| ("number of declarations", counts.map(|n| n.to_string())))
                .or_else(|| difference(is, was))
                .or_else(|| of_declarations().find_map(|(is, was)| difference(is, was)));
            if let Some((column, [now, before])) = differs {
                let arm = &is.arm;
                found = Some(format!("seed {seed} of arm `{arm}` now has {column} {now}, in the table {before}"));
            }
        });
        found
    }
}

/// Fingerprint of the lines of a table, of those of its runs and those of its declarations.
fn of_rows(rows: &str, declarations: &str) -> String {
    let mut all = Fingerprint::default();
    all.part(rows.as_bytes());
    all.part(declarations.as_bytes());
    Fingerprint::hex(&all.finish())[..32].to_string()
}

fn paths(dir: &Path, id: &str) -> [PathBuf; 2] {
    [dir.join(format!("{id}.csv")), dir.join(format!("{id}-declarations.csv"))]
}

#[cfg(test)]
mod tests {
    use super::super::row::wanted;
    use super::*;
    use crate::reproduce::{Plan, compare, reproduce};
    use std::sync::atomic::AtomicBool;
    use world::registry::Registry;
    use world::seeds::Key;

    /// The file of the row of these tests.
    const FILE: &str = "wp_laminar.csv";

    fn reference(arms: &[String]) -> Reference {
        wanted(&Registry::default(), &["wp_laminar".into()], arms).unwrap().remove(0)
    }

    fn reproduced(reference: &Reference, seeds: std::ops::Range<u64>) -> RowResult {
        let mut row = RowResult::begin(reference);
        for seed in seeds {
            for (arm, _) in &reference.arms {
                row.runs.push(RunRow {
                    arm: arm.clone(),
                    seed,
                    digest: format!("{seed}-{arm}"),
                    error_m: Some(0.1 + seed as f64),
                    mission_wall_s: 7.0,
                    declarations: vec![DeclarationRow {
                        arm: arm.clone(),
                        seed,
                        rule: "says \"here\", twice".to_string(),
                        t_s: 0.1 + 0.2,
                        ..DeclarationRow::default()
                    }],
                    ..RunRow::default()
                });
            }
        }
        row.figures = compare(&reference.row, &row.runs);
        row
    }

    /// A folder with the table of a row.
    fn written(row: &RowResult) -> (tempfile::TempDir, Table) {
        let (dir, mut table) = (tempfile::tempdir().unwrap(), Table::default());
        table.merge(row);
        table.write(dir.path(), row).unwrap();
        (dir, table)
    }

    #[test]
    fn a_table_is_read_as_it_was_written_and_grows() {
        let reference = reference(&[]);
        let arms = reference.arms.len();
        assert_eq!(Table::read(tempfile::tempdir().unwrap().path(), &reference).unwrap(), None);
        let first = reproduced(&reference, 5..8);
        let (dir, _) = written(&first);
        let mut back = Table::read(dir.path(), &reference).unwrap().unwrap();
        assert_eq!(back.from_seed(5, 9, &reference).len(), 3 * arms);
        assert!(back.from_seed(4, 9, &reference).is_empty());
        let one = &back.of_arms(&reference)[0];
        assert_eq!(one.declarations[0].t_s.to_bits(), (0.1_f64 + 0.2).to_bits());
        assert_eq!(one.mission_wall_s, 0.0);
        back.merge(&reproduced(&reference, 3..6));
        back.write(dir.path(), &first).unwrap();
        let again = Table::read(dir.path(), &reference).unwrap().unwrap();
        assert_eq!(again.from_seed(3, 9, &reference).len(), 5 * arms);
    }

    #[test]
    fn a_table_that_the_program_no_longer_gives_is_stale() {
        let reference = reference(&[]);
        let (_dir, mut table) = written(&reproduced(&reference, 1..3));
        assert_eq!(table.stale(&reference, 0), None);
        assert!(table.stale(&reference, 1).unwrap().contains("in the table"));
        table.hash = "another".to_string();
        assert!(table.stale(&reference, 0).unwrap().contains("that of the table another"));
    }

    /// A false figure is not seen by its digest.
    #[test]
    fn every_measure_of_a_run_and_of_its_declarations_is_checked() {
        let reference = reference(&["pomdp".into()]);
        let stop = AtomicBool::new(false);
        let plan = Plan { n: 1, first_seed: 4, key: Key::public(), until_half_width: None, jobs: 1 };
        let begun = RowResult::begin(&reference);
        let row = reproduce(&reference, begun, plan, None, &stop, |_, _| {}, |_| Ok(())).unwrap();
        let (dir, _) = written(&row);
        let table = Table::read(dir.path(), &reference).unwrap().unwrap();
        assert_eq!(table.stale(&reference, 1), None);
        type Change = (&'static str, fn(&mut RunRow));
        let changes: [Change; 3] = [
            ("error_m", |run| run.error_m = Some(0.25)),
            ("outcome", |run| run.outcome = "found!".into()),
            ("number of declarations", |run| run.declarations.push(DeclarationRow::default())),
        ];
        for (column, change) in changes {
            let mut changed = table.clone();
            changed.runs.values_mut().for_each(change);
            let said = changed.stale(&reference, 1).expect(column);
            assert!(said.contains(&format!("now has {column} ")), "{said}");
        }
    }

    #[test]
    fn a_broken_table_names_file_line_and_column() {
        let reference = reference(&[]);
        let (dir, _) = written(&reproduced(&reference, 1..3));
        let path = dir.path().join(FILE);
        let text = std::fs::read_to_string(&path).unwrap();
        for (broken, names) in [
            (text.replacen('#', "", 1), [FILE, "line 1"]),
            (text.replacen(",1.1,", ",x,", 1), ["line 3", "error_m"]),
            (text[..text.len() - 20].to_string(), [FILE, "line"]),
            (text.replacen("seed_index", "seed_number", 1), ["line 2", "seed_index"]),
            (text.replacen(",1.1,", ",1.2,", 1), [FILE, "changed after it was written"]),
        ] {
            std::fs::write(&path, broken).unwrap();
            let said = Table::read(dir.path(), &reference).unwrap_err().to_string();
            assert!(names.iter().all(|name| said.contains(name)), "{names:?}: {said}");
        }
    }
}
