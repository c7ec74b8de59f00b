//! The runs behind a row: seeds 1 to n, on all cores, until there are enough.

use super::compare::{Compared, compare};
use super::row::{Reference, ReproduceError, Row};
use crate::campaign::stats::next_n;
use crate::campaign::{RunName, RunRow, one_run};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// How many runs, on how many threads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Runs; with `until_half_width` at most.
    pub n: u64,
    /// Stop when the half width of the success interval is this or less.
    pub until_half_width: Option<f64>,
    /// Threads; 0 for one a core.
    pub jobs: usize,
}

/// A row with what our runs came to.
#[derive(Clone, Debug)]
pub struct Reproduced {
    /// The row.
    pub row: Row,
    /// Name and hash of its scenario.
    pub scenario: (String, String),
    /// The runs, by seed.
    pub runs: Vec<RunRow>,
    /// The figures.
    pub figures: Vec<Compared>,
}

/// Runs one row. `heard` is told of every run that ends (from the threads), with the number now planned.
///
/// # Errors
/// If the threads cannot be started, or `stop` was set: the runs in hand end, no more are begun.
pub fn reproduce(
    reference: &Reference,
    plan: Plan,
    stop: &AtomicBool,
    heard: impl Fn(&RunRow, u64) + Sync,
) -> Result<Reproduced, ReproduceError> {
    let pool = ThreadPoolBuilder::new()
        .num_threads(plan.jobs)
        .build()
        .map_err(|e| ReproduceError::Threads {
            jobs: plan.jobs,
            problem: e.to_string(),
        })?;
    let mut runs: Vec<RunRow> = Vec::new();
    while let Some(n) = next(&runs, plan) {
        let from = runs.len() as u64;
        let batch: Vec<Option<RunRow>> = pool.install(|| {
            (from..n)
                .into_par_iter()
                .map(|index| {
                    if stop.load(Ordering::Relaxed) {
                        return None;
                    }
                    let row = one_run(&reference.loaded, &name(&reference.row, index));
                    heard(&row, n);
                    Some(row)
                })
                .collect()
        });
        let batch: Option<Vec<RunRow>> = batch.into_iter().collect();
        runs.extend(batch.ok_or(ReproduceError::Interrupted)?);
    }
    Ok(Reproduced {
        figures: compare(&reference.row, &runs),
        row: reference.row.clone(),
        scenario: (reference.loaded.name.clone(), reference.loaded.hash.clone()),
        runs,
    })
}

/// How many runs there shall be next; `None` when there are enough.
fn next(runs: &[RunRow], plan: Plan) -> Option<u64> {
    let n = runs.len() as u64;
    match plan.until_half_width {
        Some(half_width) => {
            let found = runs.iter().filter(|r| r.success).count() as u64;
            next_n(found, n, half_width, plan.n)
        }
        None => (n < plan.n).then_some(plan.n),
    }
}

fn name(row: &Row, index: u64) -> RunName {
    RunName {
        run: index,
        arm: row.id.clone(),
        condition: String::new(),
        seed_index: index,
        seed: index + 1,
    }
}
