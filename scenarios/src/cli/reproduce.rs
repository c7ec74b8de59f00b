//! `rheotaxis reproduce`: our figures beside the papers'.

use super::args_reproduce::ReproduceArgs;
use super::exit::Exit;
use super::say;
use crate::campaign::RunRow;
use crate::reproduce::{
    Plan, Reference, ReproduceError, Reproduced, reproduce, table, wanted, write,
};
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// Set by Ctrl-C or a termination signal: the runs in hand end, no more begin.
static STOP: AtomicBool = AtomicBool::new(false);

/// Runs the rows and shows and writes their tables.
pub(super) fn run(args: &ReproduceArgs) -> Exit {
    // Fails only if a handler is there already, and that one is ours.
    let _ = ctrlc::set_handler(|| STOP.store(true, Ordering::Relaxed));
    match all(args) {
        Ok(()) => Exit::Success,
        Err(ReproduceError::Interrupted) => {
            say::error(ReproduceError::Interrupted, None);
            Exit::Interrupted
        }
        Err(ReproduceError::Scenario(error)) => {
            say::scenario_error(error);
            Exit::Error
        }
        Err(error) => {
            say::error(error, None);
            Exit::Error
        }
    }
}

fn all(args: &ReproduceArgs) -> Result<(), ReproduceError> {
    let references = wanted(&args.rows)?;
    // The folder is tried before hours are spent.
    write(&args.out, &[])?;
    let mut done = Vec::new();
    for reference in &references {
        let reproduced = one(reference, args, &done)?;
        say::line(table(&reproduced));
        done.push(reproduced);
    }
    say::line(format_args!(
        "results in {}: REPRODUCTION.md, figures.csv, rows.csv",
        args.out.display()
    ));
    Ok(())
}

fn one(
    reference: &Reference,
    args: &ReproduceArgs,
    done: &[Reproduced],
) -> Result<Reproduced, ReproduceError> {
    let n = args.n();
    let bar = if args.quiet {
        ProgressBar::hidden()
    } else {
        ProgressBar::new(n)
    };
    bar.set_style(
        ProgressStyle::with_template(
            "{prefix} [{bar:30}] {pos} of {len} runs, {per_sec}, {eta} left | {msg}",
        )
        .expect("the template is well formed")
        .progress_chars("=> "),
    );
    bar.set_prefix(reference.row.id.clone());
    bar.enable_steady_tick(Duration::from_millis(500));
    let found = AtomicU64::new(0);
    let plan = Plan {
        n,
        first_seed: args.first_seed,
        until_half_width: args.until_width,
        jobs: args.jobs,
    };
    let heard = |row: &RunRow, planned| {
        bar.set_length(planned);
        bar.inc(1);
        let found =
            found.fetch_add(u64::from(row.success), Ordering::Relaxed) + u64::from(row.success);
        bar.set_message(format!("found {found}"));
    };
    let reproduced = reproduce(reference, plan, &STOP, heard, |so_far| {
        let mut all = done.to_vec();
        all.push(so_far.clone());
        write(&args.out, &all)?;
        Ok(())
    });
    bar.finish_and_clear();
    reproduced
}
