//! A share of a campaign: the runs still to do, and the blocks that their rows fill.

use super::shard::Shard;
use super::work::Event;
use crate::campaign::block::{
    BlockState, add_to_block, block_path, declarations_path, present, read_block, write_block,
};
use crate::campaign::error::CampaignError;
use crate::campaign::manifest::Manifest;
use crate::campaign::rows::row::RunRow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use world::files::is_special;

/// The remaining runs of a share up to a limit, and its incomplete blocks.
pub(super) struct Share<'a> {
    dir: &'a Path,
    /// Known before the first run, except in a new folder that one process fills alone: there the first run determines
    /// the length of blocks.
    manifest: &'a OnceLock<Manifest>,
    /// Writes the manifest of a new folder, from its first row.
    settle: &'a (dyn Fn(&RunRow) -> Result<Manifest, CampaignError> + Sync),
    shard: Shard,
    arms: u64,
    /// Runs from 0 to this one, exclusive, are wanted.
    end: u64,
    line: Mutex<Line>,
    /// Locked while a block is written, so that a smaller version never replaces a larger one.
    writing: Mutex<()>,
    tell: &'a (dyn Fn(Event<'_>) + Sync),
    /// Number of runs of the share, and how many of them existed before.
    pub(super) runs: u64,
    pub(super) done: u64,
}

#[derive(Default)]
struct Line {
    /// The next run to look at: the first arm of a seed.
    next: u64,
    /// Blocks that are complete.
    whole: BTreeSet<u64>,
    /// Finished runs of incomplete blocks.
    there: BTreeMap<u64, BTreeSet<u64>>,
    /// New rows of incomplete blocks.
    open: BTreeMap<u64, Open>,
    kept: u64,
}

#[derive(Default)]
struct Open {
    rows: Vec<RunRow>,
    /// Number of rows that are on the disk.
    written: usize,
}

fn lock<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'a> Share<'a> {
    /// Examines the folder: what is done, and what is damaged.
    pub(super) fn look(
        dir: &'a Path,
        manifest: &'a OnceLock<Manifest>,
        settle: &'a (dyn Fn(&RunRow) -> Result<Manifest, CampaignError> + Sync),
        (shard, arms, end): (Shard, u64, u64),
        tell: &'a (dyn Fn(Event<'_>) + Sync),
    ) -> Result<Self, CampaignError> {
        let mut share = Self {
            dir,
            manifest,
            settle,
            shard,
            arms,
            end,
            line: Mutex::default(),
            writing: Mutex::new(()),
            tell,
            runs: end,
            done: 0,
        };
        let Some(manifest) = manifest.get() else {
            return Ok(share);
        };
        let whole_blocks = end / manifest.block;
        let of_share = match whole_blocks.checked_sub(shard.index + 1) {
            Some(after_first) => after_first / shard.count + 1,
            None => 0,
        };
        share.runs = of_share * manifest.block;
        if !end.is_multiple_of(manifest.block) && shard.has(whole_blocks) {
            share.runs += end % manifest.block;
        }
        let mut line = Line::default();
        for block in present(dir, manifest)? {
            let asked = share.asked(manifest, block);
            if !shard.has(block) || asked.is_empty() {
                continue;
            }
            let rows = match read_block(dir, manifest, block) {
                BlockState::Broken(error)
                    if is_special(&block_path(dir, block)) || is_special(&declarations_path(dir, block)) =>
                {
                    return Err(error);
                }
                BlockState::Broken(error) => {
                    tell(Event::Broken(&error));
                    continue;
                }
                state => state.rows(),
            };
            let there: BTreeSet<u64> = (rows.iter().map(|r| r.run)).filter(|run| asked.contains(run)).collect();
            share.done += there.len() as u64;
            if there.len() as u64 == asked.end - asked.start {
                line.whole.insert(block);
            } else {
                line.there.insert(block, there);
            }
        }
        share.line = Mutex::new(line);
        Ok(share)
    }

    /// The wanted runs of a block.
    fn asked(&self, manifest: &Manifest, block: u64) -> std::ops::Range<u64> {
        let runs = manifest.runs_of(block);
        runs.start..runs.end.min(self.end)
    }

    /// The next runs to do: those of one seed and condition.
    pub(super) fn next(&self) -> Option<Vec<u64>> {
        let mut line = lock(&self.line);
        while line.next < self.end {
            let first = line.next;
            let mut done = None;
            if let Some(manifest) = self.manifest.get() {
                let block = first / manifest.block;
                if !self.shard.has(block) || line.whole.contains(&block) {
                    line.next = (block + 1) * manifest.block;
                    continue;
                }
                done = line.there.get(&block);
            }
            let runs = first..(first + self.arms).min(self.end);
            let left: Vec<u64> = runs.filter(|r| done.is_none_or(|d| !d.contains(r))).collect();
            line.next = first + self.arms;
            if !left.is_empty() {
                return Some(left);
            }
        }
        None
    }

    /// Keeps a row. If it completes its block, the block is written.
    pub(super) fn keep(&self, row: RunRow) -> Result<(), CampaignError> {
        let manifest = match self.manifest.get() {
            Some(manifest) => manifest,
            None => {
                // One thread settles it; the others wait for it here.
                let _one = lock(&self.writing);
                match self.manifest.get() {
                    Some(manifest) => manifest,
                    None => {
                        let settled = (self.settle)(&row)?;
                        self.manifest.get_or_init(|| settled)
                    }
                }
            }
        };
        let block = row.run / manifest.block;
        let asked = self.asked(manifest, block);
        let full = {
            let mut line = lock(&self.line);
            line.kept += 1;
            let before = line.there.get(&block).map_or(0, BTreeSet::len);
            let open = line.open.entry(block).or_default();
            open.rows.push(row);
            if (before + open.rows.len()) as u64 == asked.end - asked.start {
                line.open.remove(&block).map(|open| (before, open))
            } else {
                None
            }
        };
        if let Some((before, mut open)) = full {
            open.rows.sort_by_key(|r| r.run);
            let _one = lock(&self.writing);
            if before == 0 {
                write_block(self.dir, block, &open.rows)?;
            } else {
                add_to_block(self.dir, manifest, block, &open.rows)?;
            }
            (self.tell)(Event::Wrote(block));
        }
        Ok(())
    }

    /// Writes the finished rows of incomplete blocks.
    pub(super) fn write_out(&self) -> Result<(), CampaignError> {
        let Some(manifest) = self.manifest.get() else {
            return Ok(());
        };
        let _one = lock(&self.writing);
        let open: Vec<(u64, Vec<RunRow>)> = (lock(&self.line).open.iter_mut())
            .filter(|(_, open)| open.written < open.rows.len())
            .map(|(block, open)| {
                open.written = open.rows.len();
                (*block, open.rows.clone())
            })
            .collect();
        for (block, rows) in open {
            add_to_block(self.dir, manifest, block, &rows)?;
        }
        Ok(())
    }

    /// Rows kept since the folder was examined.
    pub(super) fn kept(&self) -> u64 {
        lock(&self.line).kept
    }
}
