//! `rheotaxis reproduce`: repeats the papers' experiments and compares the figures.

use super::args_reproduce::ReproduceArgs;
use super::campaign_plan::count;
use super::exit::Exit;
use super::{cache, say, stop};
use indicatif::{ProgressBar, ProgressStyle};
use rheotaxis::cache::SpinUps;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use studies::campaign::RunRow;
use studies::reproduce::{
    Plan, Reference, ReproduceError, Reproduced, reproduce, table, wanted, write,
};

/// Runs the rows, prints their tables and writes them.
pub(super) fn run(args: &ReproduceArgs) -> Exit {
    stop::listen();
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
    let references = wanted(&args.rows, &args.arms)?;
    // Writes to the folder first, so that an error does not come after hours of work.
    write(&args.out, &[])?;
    if !args.quiet {
        eprintln!("{}", trials(&references, args));
    }
    let kept = cache::opened(&args.cache);
    let mut done = Vec::new();
    for reference in &references {
        let reproduced = one(reference, args, kept.as_ref(), &done);
        cache::tell_fault(kept.as_ref());
        let reproduced = reproduced?;
        say::line(table(&reproduced));
        done.push(reproduced);
    }
    say::line(format_args!(
        "results in {}: REPRODUCTION.md, figures.csv, rows.csv, declarations.csv",
        args.out.display()
    ));
    Ok(())
}

/// A line that says how many trials will be run.
fn trials(references: &[Reference], args: &ReproduceArgs) -> String {
    let most = if args.until_width.is_some() {
        "at most "
    } else {
        ""
    };
    let arms: usize = references.iter().map(|r| r.arms.len()).sum();
    let rows: Vec<String> = (references.iter())
        .map(|r| match r.arms.len() {
            1 => r.row.id.clone(),
            n => format!("{} ({n} arms)", r.row.id),
        })
        .collect();
    let all = (arms as u64).saturating_mul(args.n());
    let (seeds, all) = (count(args.n(), "seed"), count(all, "trial"));
    format!("{}: {most}{seeds} each, {most}{all}", rows.join(", "))
}

fn one(
    reference: &Reference,
    args: &ReproduceArgs,
    kept: Option<&SpinUps>,
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
        key: args.key.get(),
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
    let reproduced = reproduce(reference, plan, kept, stop::listen(), heard, |so_far| {
        let mut all = done.to_vec();
        all.push(so_far.clone());
        write(&args.out, &all)?;
        Ok(())
    });
    bar.finish_and_clear();
    reproduced
}
