//! Runs a campaign's blocks: those of this process's share that are not done yet.
#![allow(
    clippy::disallowed_methods,
    reason = "the limit of wall time decides when to stop, never what a run does"
)]

use super::block::{BlockState, read_block, write_block};
use super::enough::wanted;
use super::error::CampaignError;
use super::manifest::Manifest;
use super::one_run::{RunName, sharing_run};
use super::plan::Campaign;
use super::row::RunRow;
use super::shard::Shard;
use crate::scenario::Loaded;
use crate::spun_up::SpunUp;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Runs in a block, if nothing else is asked for.
pub const BLOCK: u64 = 256;

/// How to run a campaign; none of it changes a row.
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// The share of the blocks.
    pub shard: Shard,
    /// Runs at a time; 0 for one a core.
    pub jobs: usize,
    /// Runs in a block, made a multiple of the number of arms; without it the folder's, or [`BLOCK`].
    pub block: Option<u64>,
    /// Wall time after which to stop.
    pub max_wall: Option<Duration>,
    /// Go on in a folder of another campaign, keeping the blocks it has.
    pub force: bool,
}

/// What is told while a campaign runs, from any thread.
#[derive(Debug)]
pub enum Event<'a> {
    /// Before the first run: runs of this share, and how many of them are done.
    Begun {
        /// Of this share.
        runs: u64,
        /// Done before.
        done: u64,
    },
    /// A block was found that is not whole; it is done again.
    Broken(&'a CampaignError),
    /// A run has ended.
    Ran(&'a RunRow),
    /// A block was written.
    Wrote(u64),
}

/// How it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnded {
    /// Every block of the share is there.
    Complete,
    /// Stopped from outside or by the limit of wall time.
    Stopped {
        /// Blocks written since the start.
        written: u64,
        /// Blocks of the share still to do.
        left: u64,
    },
    /// The share is done as far as is known; whether more runs are needed hangs on blocks of others.
    Waiting {
        /// Blocks of other shares that are not there.
        missing: u64,
    },
}

/// Runs what is left of a share of a campaign into `dir`. Once `stop` is set the runs in hand are
/// finished and no block is written that is not whole.
///
/// # Errors
/// If the folder holds another campaign or cannot be written; blocks written before stay as they are.
pub fn run(
    campaign: &Campaign,
    dir: &Path,
    options: &RunOptions,
    stop: &AtomicBool,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<RunEnded, CampaignError> {
    let begun = Instant::now();
    let manifest = settle(campaign, dir, options)?;
    let share = Share {
        campaign,
        dir,
        manifest: &manifest,
        options,
        begun,
        stop,
        tell,
    };
    let mut written = 0;
    let mut reached = None;
    loop {
        let wanted = wanted(campaign, dir, &manifest);
        if reached == Some(wanted) {
            let there = |b: &u64| matches!(read_block(dir, &manifest, *b), BlockState::Done(_));
            let missing = (0..wanted.blocks).filter(|b| !there(b)).count() as u64;
            return Ok(RunEnded::Waiting { missing });
        }
        let ended = share.run_to(wanted.blocks, &mut written)?;
        if wanted.decided || ended != RunEnded::Complete {
            return Ok(ended);
        }
        reached = Some(wanted);
    }
}

/// A share of a campaign being run.
struct Share<'a> {
    campaign: &'a Campaign,
    dir: &'a Path,
    manifest: &'a Manifest,
    options: &'a RunOptions,
    begun: Instant,
    stop: &'a AtomicBool,
    tell: &'a (dyn Fn(Event<'_>) + Sync),
}

impl Share<'_> {
    /// Does what is not done of the share's blocks below `end`; counts in `written` those it writes.
    fn run_to(&self, end: u64, written: &mut u64) -> Result<RunEnded, CampaignError> {
        let Self {
            campaign,
            dir,
            manifest,
            options,
            begun,
            stop,
            tell,
        } = *self;
        let mut to_do = Vec::new();
        let (mut runs, mut done) = (0, 0);
        for block in (0..end).filter(|b| options.shard.has(*b)) {
            let n = manifest.runs_of(block).count() as u64;
            runs += n;
            match read_block(dir, manifest, block) {
                BlockState::Done(_) => done += n,
                BlockState::Missing => to_do.push(block),
                BlockState::Broken(error) => {
                    tell(Event::Broken(&error));
                    to_do.push(block);
                }
            }
        }
        tell(Event::Begun { runs, done });
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(options.jobs)
            .build()
            .map_err(|e| CampaignError::Shard(format!("cannot start threads: {e}")))?;
        let first = Instant::now();
        for (k, &block) in to_do.iter().enumerate() {
            let stopped = |written: &u64| RunEnded::Stopped {
                written: *written,
                left: (to_do.len() - k) as u64,
            };
            // A block that would be cut off is not begun.
            let expected = first.elapsed().checked_div(k as u32).unwrap_or_default();
            if (options.max_wall).is_some_and(|max| begun.elapsed() + expected > max) {
                return Ok(stopped(written));
            }
            let going = || {
                !stop.load(Ordering::Relaxed)
                    && options.max_wall.is_none_or(|max| begun.elapsed() <= max)
            };
            let rows = pool.install(|| block_rows(campaign, manifest, block, &going, tell))?;
            let Some(rows) = rows else {
                return Ok(stopped(written));
            };
            write_block(dir, block, &rows)?;
            *written += 1;
            tell(Event::Wrote(block));
        }
        Ok(RunEnded::Complete)
    }
}

/// Makes the folder the campaign's, or makes sure that it is.
fn settle(
    campaign: &Campaign,
    dir: &Path,
    options: &RunOptions,
) -> Result<Manifest, CampaignError> {
    let found = Manifest::find(dir)?;
    let block = (options.block)
        .or(found.as_ref().map(|m| m.block))
        .unwrap_or(BLOCK)
        .max(1)
        .next_multiple_of(campaign.n_arms());
    let ours = Manifest::new(campaign, block);
    if let Some(there) = &found {
        let what = there.differences(&ours);
        if what.is_empty() {
            return Ok(there.clone());
        }
        if !options.force {
            let dir = dir.to_owned();
            return Err(CampaignError::Differs { dir, what });
        }
    }
    campaign.check()?;
    std::fs::create_dir_all(dir).map_err(|e| CampaignError::Write {
        path: dir.to_owned(),
        problem: e.to_string(),
    })?;
    ours.write(dir)?;
    Ok(ours)
}

/// The rows of a block, in the order of runs; `None` if it was stopped before it was whole.
fn block_rows(
    campaign: &Campaign,
    manifest: &Manifest,
    block: u64,
    going: &(dyn Fn() -> bool + Sync),
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<Option<Vec<RunRow>>, CampaignError> {
    let runs = manifest.runs_of(block);
    let mut scenarios: BTreeMap<u64, Vec<Loaded>> = BTreeMap::new();
    for run in runs.clone() {
        let condition = campaign.place(run).condition;
        if let Entry::Vacant(place) = scenarios.entry(condition) {
            let arms = (0..campaign.spec.arms.len()).map(|arm| campaign.loaded(condition, arm));
            place.insert(arms.collect::<Result<_, _>>()?);
        }
    }
    let n_arms = campaign.n_arms();
    let groups: Option<Vec<Vec<RunRow>>> = (runs.start / n_arms..runs.end.div_ceil(n_arms))
        .into_par_iter()
        .map(|group| {
            // The arms of a seed, one after the other, so that they can share a spun-up state.
            let mut spun: Vec<SpunUp> = Vec::new();
            let mut rows = Vec::new();
            for run in group * n_arms..(group + 1) * n_arms {
                if !going() {
                    return None;
                }
                let place = campaign.place(run);
                let name = RunName {
                    run,
                    arm: campaign.arm(place.arm).name.clone(),
                    condition: campaign.condition_name(place.condition),
                    seed_index: place.seed_index,
                    seed: place.seed,
                };
                let row = sharing_run(&scenarios[&place.condition][place.arm], &name, &mut spun);
                tell(Event::Ran(&row));
                rows.push(row);
            }
            Some(rows)
        })
        .collect();
    Ok(groups.map(|groups| groups.into_iter().flatten().collect()))
}
