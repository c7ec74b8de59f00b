//! Runs the remaining work of this process's share of a campaign.
#![allow(clippy::disallowed_methods, reason = "wall time decides when rows are written, never what a run does")]

use super::block::{add_to_block, is_of_campaign, present, read_block};
use super::cost::block_of;
use super::enough::wanted;
use super::error::CampaignError;
use super::manifest::Manifest;
use super::outside::Outside;
use super::plan::Campaign;
use super::rows::row::RunRow;
use super::shard::Shard;
use super::share::Share;
use super::work::{Event, Limits, Work};
use rheotaxis::cache::SpinUps;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, OnceLock};
use std::thread::available_parallelism;
use std::time::{Duration, Instant};
use world::files::{OutputError, clear_abandoned, make_folder};

/// Interval of wall time at which finished rows of incomplete blocks are written; a kill loses at most this.
const SAVE: Duration = Duration::from_secs(30);

/// How to run a campaign; nothing here changes a row.
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// The share of the blocks.
    pub shard: Shard,
    /// Number of runs at a time; 0 means one for each core.
    pub jobs: usize,
    /// Runs in a block, made a multiple of the number of arms. Without it, that of the folder, or what
    /// [`block_of`](super::block_of) derives from the cost of the first run.
    pub block: Option<u64>,
    /// Wall time after which to stop.
    pub max_wall: Option<Duration>,
    /// Continue in a folder of another campaign and keep its blocks.
    pub force: bool,
    /// Where spin-ups are kept; without it, each is made.
    pub kept: Option<Arc<SpinUps>>,
    /// Who decides for robots and gantries whose strategy is `External`; without it, such an arm is refused.
    pub outside: Option<Arc<dyn Outside>>,
    /// Whether [`Campaign::check_with`] was called before, so that a new folder is begun without it.
    pub checked: bool,
}

/// How the campaign ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnded {
    /// Every run of the share has its row.
    Complete,
    /// Stopped from outside, or by the limit of wall time.
    Stopped {
        /// Number of runs done since the start; their rows are written.
        done: u64,
        /// Number of runs of the share still to do.
        left: u64,
    },
    /// The share is done as far as is known. Whether more runs are needed depends on blocks of other shares.
    Waiting {
        /// Number of missing blocks of other shares.
        missing: u64,
    },
}

/// Runs the remaining work of a share of a campaign into `dir`. Once `stop` is set, no run begins. Finished rows are
/// written at once, and those of the current runs when they end.
///
/// # Errors
/// If the folder holds another campaign or cannot be written. Rows written before stay as they are.
pub fn run(
    campaign: &Campaign,
    dir: &Path,
    options: &RunOptions,
    stop: &AtomicBool,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<RunEnded, CampaignError> {
    let limits = Limits::new(options.max_wall, stop);
    let threads = match options.jobs {
        0 => available_parallelism().map_or(1, usize::from),
        jobs => jobs,
    };
    let work = Work {
        campaign,
        limits: &limits,
        kept: options.kept.as_deref(),
        outside: options.outside.as_deref(),
        threads: threads.min(usize::try_from(campaign.n_runs()).unwrap_or(threads)),
        tell,
        scenarios: Mutex::new(BTreeMap::new()),
    };
    let manifest = OnceLock::new();
    if let Some(settled) = settle(campaign, dir, options)? {
        let _ = manifest.set(settled);
    } else if options.shard.count > 1 {
        // The runs of this share depend on the length of blocks, so one run is made to determine it.
        let row = work.one(0)?;
        let first = new_manifest(campaign, options, &row).write_first(dir, false)?;
        if options.shard.has(0) {
            add_to_block(dir, &first, 0, &[row])?;
        }
        let _ = manifest.set(first);
    }
    clear_abandoned(dir, is_of_campaign);
    let by_cost = |row: &RunRow| new_manifest(campaign, options, row).write_first(dir, false);
    let mut reached = None;
    loop {
        // A new folder has no rows, whatever the length of blocks is.
        let stand_in = Manifest::new(campaign, campaign.n_arms());
        let wanted = wanted(campaign, dir, manifest.get().unwrap_or(&stand_in));
        if reached == Some(wanted) {
            let known = manifest.get().unwrap_or(&stand_in);
            let missing = missing_blocks(dir, known, wanted.runs)?;
            return Ok(RunEnded::Waiting { missing });
        }
        let place = (options.shard, campaign.n_arms(), wanted.runs);
        let share = Share::look(dir, &manifest, &by_cost, place, tell)?;
        tell(Event::Begun { runs: share.runs, done: share.done });
        let mut saved = Instant::now();
        let mut stopping = false;
        let ended = work.go(&|| share.next(), &|row| share.keep(row), &mut |over| {
            // At once when a stop is requested, because a second request may be a kill.
            if (over && !stopping) || saved.elapsed() > SAVE {
                stopping = over;
                saved = Instant::now();
                return share.write_out();
            }
            Ok(())
        });
        // Whatever went wrong, everything that can be kept is kept.
        ended.and(share.write_out())?;
        let left = share.runs - share.done - share.kept();
        if left > 0 {
            return Ok(RunEnded::Stopped { done: share.kept(), left });
        }
        // Somebody may have removed rows meanwhile. They are made again.
        if share.kept() > 0 {
            let after = Share::look(dir, &manifest, &by_cost, place, tell)?;
            if after.done < after.runs {
                continue;
            }
        }
        if wanted.decided {
            return Ok(RunEnded::Complete);
        }
        reached = Some(wanted);
    }
}

/// Blocks up to a run that lack rows.
fn missing_blocks(dir: &Path, manifest: &Manifest, end: u64) -> Result<u64, CampaignError> {
    let whole = |block: &u64| {
        let runs = manifest.runs_of(*block);
        let asked = runs.start..runs.end.min(end);
        let rows = read_block(dir, manifest, *block).rows();
        let there = rows.iter().filter(|r| asked.contains(&r.run)).count() as u64;
        !asked.is_empty() && there == asked.end - asked.start
    };
    let there = present(dir, manifest)?.iter().filter(|b| whole(b)).count() as u64;
    Ok(end.div_ceil(manifest.block) - there)
}

fn new_manifest(campaign: &Campaign, options: &RunOptions, first: &RunRow) -> Manifest {
    let (spin_up_s, mission_s) = (first.spin_up_wall_s, first.mission_wall_s);
    let block = block_of(campaign, spin_up_s, mission_s, options.shard.count);
    Manifest::new(campaign, block)
}

/// Makes the folder the campaign's own, or checks that it is. `None` if it is new: then the first run determines the
/// length of blocks.
fn settle(campaign: &Campaign, dir: &Path, options: &RunOptions) -> Result<Option<Manifest>, CampaignError> {
    let found = Manifest::find(dir)?;
    let asked = (options.block)
        .map(|block| block.max(1).next_multiple_of(campaign.n_arms()))
        .or(found.as_ref().map(|m| m.block));
    let ours = Manifest::new(campaign, asked.unwrap_or(campaign.n_arms()));
    if let Some(there) = &found {
        let what = there.differences(&ours);
        if what.is_empty() {
            there.check()?;
            return Ok(Some(there.clone()));
        }
        if !options.force {
            let dir = dir.to_owned();
            return Err(CampaignError::Differs { dir, what });
        }
    }
    if !options.checked {
        campaign.check_with(options.outside.is_some())?;
    }
    make_folder(dir).map_err(|e| OutputError::new(dir, e))?;
    if found.is_none() {
        if !present(dir, &ours)?.is_empty() {
            return Err(CampaignError::NoCampaign {
                dir: dir.to_owned(),
                problem: "there are blocks in it, but nothing says of what".to_string(),
            });
        }
        return asked.map(|_| ours.write_first(dir, true)).transpose();
    }
    let ours = Manifest { block: ours.block.next_multiple_of(campaign.n_arms()), ..ours };
    ours.write(dir)?;
    Ok(Some(ours))
}
