//! How many runs are enough: campaigns that go on until every success share is known well enough.
//!
//! *Source*: [`next_n`](super::stats::next_n), asked for each arm under each condition; the greatest answer counts.
//!
//! *Parameters*: `until.half_width`: greatest half width of the Wilson intervals; `seeds`: the most seeds.
//!
//! *Deviations*: looks are at whole blocks. What is wanted follows from the blocks in the folder alone, so any
//! number of processes, stopped and started at will, comes to the same end.

use super::block::{BlockState, read_block};
use super::manifest::Manifest;
use super::plan::Campaign;
use super::stats::next_n;
use std::path::Path;

/// What a campaign needs, as far as its blocks can say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// The blocks from 0 to this one, exclusive.
    pub blocks: u64,
    /// It will not be more: they are all there and enough, or all there can be.
    pub decided: bool,
}

impl Wanted {
    /// Runs in those blocks.
    #[must_use]
    pub fn runs(&self, manifest: &Manifest) -> u64 {
        (self.blocks * manifest.block).min(manifest.runs)
    }
}

/// The blocks that `dir` must hold before the campaign is done, or before more can be said.
#[must_use]
pub fn wanted(campaign: &Campaign, dir: &Path, manifest: &Manifest) -> Wanted {
    let all = manifest.n_blocks();
    let Some(until) = &campaign.spec.until else {
        return Wanted {
            blocks: all,
            decided: true,
        };
    };
    let cells = campaign.n_cells();
    // Successes of each cell among the blocks read so far.
    let mut found = vec![0; cells as usize];
    let (mut read, mut seeds) = (0, 0);
    loop {
        let next = (found.iter())
            .filter_map(|k| {
                next_n(
                    (*k).min(seeds),
                    seeds,
                    until.half_width,
                    campaign.spec.seeds,
                )
            })
            .max();
        let Some(next) = next else {
            return Wanted {
                blocks: read,
                decided: true,
            };
        };
        let blocks = (next * cells).div_ceil(manifest.block).min(all);
        for block in read..blocks {
            let BlockState::Done(rows) = read_block(dir, manifest, block) else {
                return Wanted {
                    blocks,
                    decided: blocks == all,
                };
            };
            for row in rows.iter().filter(|r| r.success) {
                let place = campaign.place(row.run);
                found[(place.condition * campaign.n_arms()) as usize + place.arm] += 1;
            }
        }
        read = blocks;
        // Seeds that every cell has; the last block may hold one more of some, for which the count is capped.
        seeds = manifest.runs_of(blocks - 1).end / cells;
    }
}
