//! How many runs are enough: campaigns that go on until every success share is known well enough.
//!
//! *Source*: [`next_n`](super::stats::next_n), asked for each arm under each condition; the greatest answer counts.
//!
//! *Parameters*: `until.half_width`: greatest half width of the Wilson intervals; `seeds`: the most seeds.
//!
//! *Deviations*: looks are at whole numbers of seeds, whatever the blocks. What is wanted follows from the rows in the folder
//! alone, so any number of processes, stopped and started at will, comes to the same end.

use super::block::read_block;
use super::manifest::Manifest;
use super::plan::Campaign;
use super::stats::next_n;
use std::collections::BTreeMap;
use std::path::Path;

/// What a campaign needs, as far as its rows can say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// The runs from 0 to this one, exclusive.
    pub runs: u64,
    /// It will not be more: they are all there and enough, or all there can be.
    pub decided: bool,
}

impl Wanted {
    /// The blocks in which those runs lie: from 0 to this one, exclusive.
    #[must_use]
    pub fn blocks(&self, manifest: &Manifest) -> u64 {
        self.runs.div_ceil(manifest.block)
    }
}

/// The runs that `dir` must hold before the campaign is done, or before more can be said.
#[must_use]
pub fn wanted(campaign: &Campaign, dir: &Path, manifest: &Manifest) -> Wanted {
    let Some(until) = &campaign.spec.until else {
        return Wanted {
            runs: manifest.runs,
            decided: true,
        };
    };
    let (cells, most) = (campaign.n_cells(), campaign.spec.seeds.count());
    // Successes among the seeds looked at so far of each cell that has any.
    let mut found: BTreeMap<u64, u64> = BTreeMap::new();
    let mut seeds = 0;
    loop {
        let none = ((found.len() as u64) < cells).then_some(&0);
        let next = (found.values().chain(none))
            .filter_map(|k| next_n(*k, seeds, until.half_width, most))
            .max();
        let Some(next) = next else {
            return Wanted {
                runs: seeds * cells,
                decided: true,
            };
        };
        // Runs go seed by seed: these are the rows of the seeds not looked at yet.
        let new = seeds * cells..next * cells;
        let mut there = 0;
        for block in new.start / manifest.block..new.end.div_ceil(manifest.block) {
            for row in read_block(dir, manifest, block).rows() {
                if new.contains(&row.run) {
                    there += 1;
                    let place = campaign.place(row.run);
                    let cell = place.condition * campaign.n_arms() + place.arm as u64;
                    if row.success {
                        *found.entry(cell).or_insert(0) += 1;
                    }
                }
            }
            if there < (new.end.min((block + 1) * manifest.block)) - new.start {
                return Wanted {
                    runs: new.end,
                    decided: next == most,
                };
            }
        }
        seeds = next;
    }
}
