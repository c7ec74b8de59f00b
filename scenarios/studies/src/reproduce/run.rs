//! The runs of a row: consecutive seeds, on all cores, until there are enough.

use super::compare::{FigureComparison, compare};
use super::row::{Reference, ReproduceError, Row};
use crate::campaign::stats::next_n;
use crate::campaign::{LaneLimits, PlannedRun, RunName, RunRow, in_lanes, pool};
use crate::draw::drawn;
use rayon::prelude::*;
use rheotaxis::cache::SpinUps;
use rheotaxis::scenario::Loaded;
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering};
use world::seeds::{Key, Seed};

/// Seeds after which the current results are written, so that little is lost if the program is killed.
const BATCH: u64 = 50;

/// How many runs, on how many threads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Number of seeds; with `until_half_width`, the greatest number.
    pub n: u64,
    /// The first seed; the others follow it.
    pub first_seed: u64,
    /// The key of the runs.
    pub key: Key,
    /// Stop when the half width of the success interval is at most this.
    pub until_half_width: Option<f64>,
    /// Number of threads; 0 means one for each core.
    pub jobs: usize,
}

/// A row with our results.
#[derive(Clone, Debug)]
pub struct RowResult {
    /// The row.
    pub row: Row,
    /// Name and hash of its scenario.
    pub scenario: (String, String),
    /// The runs, by seed and arm.
    pub runs: Vec<RunRow>,
    /// The figures.
    pub figures: Vec<FigureComparison>,
}

impl RowResult {
    /// A row without runs.
    pub fn begin(reference: &Reference) -> Self {
        Self {
            row: reference.row.clone(),
            scenario: (reference.loaded.name.clone(), reference.loaded.hash()),
            runs: Vec::new(),
            figures: Vec::new(),
        }
    }
}

/// Runs what a row still lacks of the plan. `heard` is called for every run that ends (from the threads), with the
/// number now planned. `so_far` gets the row as far as it has come, every 50 seeds and at the end. Spin-ups are taken from
/// `kept`, and added to it.
///
/// # Errors
/// If the threads cannot be started, if `so_far` fails, or if `stop` was set: the runs under way end at once.
pub fn reproduce(
    reference: &Reference,
    mut row: RowResult,
    plan: Plan,
    kept: Option<&SpinUps>,
    stop: &AtomicBool,
    heard: impl Fn(&RunRow, u64) + Sync,
    mut so_far: impl FnMut(&RowResult) -> Result<(), ReproduceError>,
) -> Result<RowResult, ReproduceError> {
    let pool = pool(plan.jobs)?;
    let n_arms = reference.arms.len() as u64;
    while let Some(planned) = next(&row.runs, reference, plan) {
        let from = row.runs.len() as u64 / n_arms;
        let n = planned.min(from + BATCH);
        let of_seed = |index: u64| {
            let going = || !stop.load(Ordering::Relaxed);
            let heed = LaneLimits { begin: &going, go_on: &going, ..LaneLimits::NONE };
            let seed = plan.key.seed(plan.first_seed + index);
            let mut rows = Vec::new();
            seed_runs(reference, |_| true, (index, seed), kept, heed, &mut |row| {
                heard(&row, planned * n_arms);
                rows.push(row);
            });
            rows.sort_by_key(|row| row.run);
            (rows.len() as u64 == n_arms).then_some(rows)
        };
        let batch: Option<Vec<Vec<RunRow>>> = pool.install(|| (from..n).into_par_iter().map(of_seed).collect());
        let batch = batch.ok_or(ReproduceError::Interrupted)?;
        row.runs.extend(batch.into_iter().flatten());
        row.figures = compare(&reference.row, &row.runs);
        so_far(&row)?;
    }
    Ok(row)
}

/// Makes the runs of a seed and its index, in those arms of a row that are `asked` for.
pub(super) fn seed_runs(
    reference: &Reference,
    asked: impl Fn(&String) -> bool,
    (index, seed): (u64, Seed),
    kept: Option<&SpinUps>,
    heed: LaneLimits<'_>,
    keep: &mut dyn FnMut(RunRow),
) {
    let n_arms = reference.arms.len() as u64;
    let arms = (0..).zip(&reference.arms).filter(|(_, (arm, _))| asked(arm));
    let made = arms.map(|(k, (arm, loaded))| {
        let run = index * n_arms + k;
        let name = RunName { run, arm: arm.clone(), seed_index: index, seed, ..RunName::default() };
        let made = drawn(&reference.row.draw, arm, loaded, seed);
        (name, made.expect("ends and values of every draw were checked"))
    });
    let made: Vec<(RunName, Cow<'_, Loaded>)> = made.collect();
    let runs: Vec<PlannedRun<'_>> = made.iter().map(|(name, loaded)| (name.clone(), &**loaded)).collect();
    in_lanes(&runs, kept, heed, keep);
}

/// The next number of seeds; `None` if there are enough for every arm.
fn next(runs: &[RunRow], reference: &Reference, plan: Plan) -> Option<u64> {
    let n = (runs.len() / reference.arms.len()) as u64;
    let Some(half_width) = plan.until_half_width else {
        return (n < plan.n).then_some(plan.n);
    };
    let of_arm = |(arm, _): &(String, Loaded)| {
        let found = runs.iter().filter(|r| r.arm == *arm && r.success).count() as u64;
        next_n(found, n, half_width, plan.n)
    };
    reference.arms.iter().filter_map(of_arm).max()
}
