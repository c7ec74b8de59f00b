//! `rheotaxis reproduce`: repeats the papers' experiments and compares the figures.

use super::cache;
use crate::args::reproduce::ReproduceArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::progress;
use crate::say;
use crate::say::count;
use crate::stop;
use indicatif::ProgressBar;
use output::shown::printable;
use rheotaxis::cache::SpinUps;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use studies::campaign::RunRow;
use studies::reproduce::{
    Plan, Reference, ReproduceError, RowResult, Table, TimeLeft, compare, reproduce, table, wanted, write,
};
use world::registry::Registry;

/// Runs the rows, prints their tables and writes them.
pub(crate) fn run(registry: &Registry, args: &ReproduceArgs) -> Result<Exit, Failure> {
    stop::listen();
    let references = wanted(registry, &args.rows, &args.arms)?;
    // Writes to the folder first, so that an error does not come after hours of work.
    write(&args.out, &[], &command())?;
    if !args.quiet && !args.no_runs {
        say::note(trials(&references, args));
    }
    let planned = |r: &Reference| (r.arms.len() as u64).saturating_mul(args.n(&r.row));
    let mut work = Work {
        args,
        kept: cache::opened(&args.cache),
        left: TimeLeft::new(references.iter().map(planned), args.jobs),
        rows: references.iter().map(RowResult::begin).collect(),
        tables: Vec::new(),
        references,
    };
    if let Some(dir) = &args.keep {
        work.take_kept(dir)?;
    }
    if args.no_runs {
        work.show_kept()?;
        return Ok(Exit::Success);
    }
    let rows = 0..work.rows.len();
    if rows.len() > 1 && args.until_width.is_none() {
        // Rows differ in cost, so some of each tell how long the rest takes.
        for k in rows.clone() {
            work.advance(k, Some(work.left.threads()))?;
        }
    }
    for k in rows {
        work.advance(k, None)?;
        say::line(table(&work.rows[k], say::columns()));
    }
    say::line(format_args!(
        "results in {}: REPRODUCTION.md, figures.csv, rows.csv, declarations.csv",
        args.out.display()
    ));
    Ok(Exit::Success)
}

/// The command as it was typed.
pub(super) fn command() -> String {
    let typed = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    std::iter::once("rheotaxis".to_owned()).chain(typed).collect::<Vec<_>>().join(" ")
}

/// A line that says how many trials will be run.
fn trials(references: &[Reference], args: &ReproduceArgs) -> String {
    let most = if args.until_width.is_some() { "at most " } else { "" };
    let seeds: Vec<u64> = references.iter().map(|r| args.n(&r.row)).collect();
    let alike = seeds.iter().all(|n| *n == seeds[0]);
    let row = |(r, n): (&Reference, &u64)| {
        let arms = (r.arms.len() > 1).then(|| count(r.arms.len() as u64, "arm"));
        let own = (!alike).then(|| count(*n, "seed"));
        let said: Vec<String> = arms.into_iter().chain(own).collect();
        match said.is_empty() {
            true => r.row.id.clone(),
            false => format!("{} ({})", r.row.id, said.join(", ")),
        }
    };
    let rows: Vec<String> = references.iter().zip(&seeds).map(row).collect();
    let each = if alike { format!("{most}{} each, ", count(seeds[0], "seed")) } else { String::new() };
    let of_row = |(r, n): (&Reference, &u64)| (r.arms.len() as u64).saturating_mul(*n);
    let all = (references.iter().zip(&seeds).map(of_row)).fold(0, u64::saturating_add);
    format!("{}: {each}{most}{}", rows.join(", "), count(all, "trial"))
}

/// An experiment on its way.
struct Work<'a> {
    args: &'a ReproduceArgs,
    /// The cache of spin-ups.
    kept: Option<SpinUps>,
    references: Vec<Reference>,
    /// The rows as far as they have come.
    rows: Vec<RowResult>,
    /// With --keep: their tables.
    tables: Vec<Table>,
    left: TimeLeft,
}

impl Work<'_> {
    /// Reads the tables of kept runs, checks some of them, and takes over those that are planned.
    fn take_kept(&mut self, dir: &Path) -> Result<(), ReproduceError> {
        let args = self.args;
        for (reference, row) in self.references.iter().zip(&mut self.rows) {
            let mut table = match Table::read(dir, reference) {
                Err(_) if args.anew => Table::default(),
                read => read?.unwrap_or_default(),
            };
            if !table.is_empty() {
                if args.check > 0 && !args.quiet {
                    say::note(format_args!("{}: runs {} again", row.row.id, count(args.check as u64, "kept seed")));
                }
                match table.stale(reference, args.check) {
                    Some(_) if args.anew => table = Table::default(),
                    Some(problem) => {
                        let row = row.row.id.clone();
                        return Err(ReproduceError::OutOfDate { row, problem });
                    }
                    None => {}
                }
            }
            row.runs = match args.no_runs {
                true => table.of_arms(reference),
                false => table.from_seed(args.first_seed, args.n(&reference.row), reference),
            };
            row.figures = compare(&reference.row, &row.runs);
            self.tables.push(table);
        }
        Ok(())
    }

    /// Prints and writes the figures of the kept runs.
    fn show_kept(&self) -> Result<(), ReproduceError> {
        for row in &self.rows {
            match row.runs.is_empty() {
                true => say::line(format_args!("{}: no runs are kept", row.row.id)),
                false => say::line(table(row, say::columns())),
            }
        }
        let some = self.rows.iter().filter(|r| !r.runs.is_empty());
        write(&self.args.out, &some.cloned().collect::<Vec<_>>(), &command())?;
        Ok(())
    }

    /// Runs row `k` until it has `seeds`, or all that it is to have.
    fn advance(&mut self, k: usize, seeds: Option<u64>) -> Result<(), ReproduceError> {
        let Self { args, kept, references, rows, tables, left } = self;
        let (kept, stop) = (kept.as_ref(), stop::listen());
        let (reference, row) = (&references[k], rows[k].clone());
        let n = args.n(&reference.row);
        let all = n.saturating_mul(reference.arms.len() as u64);
        let n = seeds.map_or(n, |seeds| seeds.min(n));
        let bar = bar(reference, args.quiet, all, row.runs.len() as u64);
        let found = AtomicU64::new(row.runs.iter().filter(|r| r.success).count() as u64);
        let plan = Plan {
            n,
            first_seed: args.first_seed,
            key: args.key.get(),
            until_half_width: args.until_width,
            jobs: args.jobs,
        };
        let heard = |run: &RunRow, planned| {
            let planned = seeds.map_or(planned, |_| all);
            left.heard(k, run, planned);
            bar.set_length(planned);
            bar.inc(1);
            let new = u64::from(run.success);
            let found = found.fetch_add(new, Ordering::Relaxed) + new;
            bar.set_message(match left.describe() {
                Some(left) => format!("found {found} | about {left} left in all"),
                None => format!("found {found}"),
            });
        };
        let done = reproduce(reference, row, plan, kept, stop, heard, |so_far| {
            rows[k] = so_far.clone();
            // Without a terminal there is no bar.
            if bar.is_hidden() && !args.quiet {
                let (id, runs) = (&reference.row.id, count(so_far.runs.len() as u64, "trial"));
                match left.describe() {
                    Some(left) => say::note(format_args!("{id}: {runs} done, about {left} left in all")),
                    None => say::note(format_args!("{id}: {runs} done")),
                }
            }
            if let (Some(dir), Some(table)) = (&args.keep, tables.get_mut(k)) {
                table.merge(so_far);
                table.write(dir, so_far)?;
            }
            let begun = rows.iter().filter(|r| !r.runs.is_empty());
            write(&args.out, &begun.cloned().collect::<Vec<_>>(), &command())?;
            Ok(())
        });
        bar.finish_and_clear();
        cache::tell_fault(kept);
        rows[k] = done?;
        Ok(())
    }
}

fn bar(reference: &Reference, quiet: bool, length: u64, done: u64) -> ProgressBar {
    let bar = progress::bar(quiet, length, "{prefix} [{bar:30}] {pos} of {len} runs | {msg}");
    bar.set_prefix(printable(&reference.row.id).into_owned());
    bar.set_position(done);
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}
