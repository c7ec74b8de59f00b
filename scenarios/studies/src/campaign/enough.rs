//! How many runs are enough, for campaigns that continue until every success share is known precisely.
//!
//! *Source*: [`next_n`](super::stats::next_n), evaluated for each arm under each condition; the greatest answer counts.
//!
//! *Parameters*: `until.half_width`: greatest half width of the Wilson intervals; `seeds`: the most seeds.
//!
//! *Deviations*: the share is examined at whole numbers of seeds, whatever the blocks are. What is wanted follows only
//! from the rows in the folder, so any number of processes, stopped and started at will, arrives at the same end.

use super::block::read_block;
use super::manifest::Manifest;
use super::plan::Campaign;
use super::stats::next_n;
use std::collections::BTreeMap;
use std::path::Path;

/// What a campaign needs, as far as its rows tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Demand {
    /// Runs from 0 to this one, exclusive.
    pub runs: u64,
    /// The number will not grow: all runs exist and suffice, or no more are allowed.
    pub decided: bool,
}

impl Demand {
    /// The blocks that contain those runs: from 0 to this one, exclusive.
    pub fn blocks(&self, manifest: &Manifest) -> u64 {
        self.runs.div_ceil(manifest.block)
    }
}

/// The runs that `dir` must hold before the campaign is done, or before more can be decided.
pub fn wanted(campaign: &Campaign, dir: &Path, manifest: &Manifest) -> Demand {
    let Some(until) = &campaign.spec.until else {
        return Demand { runs: manifest.runs, decided: true };
    };
    let (cells, most) = (campaign.n_cells(), campaign.spec.seeds.count());
    // Successes of each cell that has any, among the seeds examined so far.
    let mut found: BTreeMap<u64, u64> = BTreeMap::new();
    let mut seeds = 0;
    loop {
        let none = ((found.len() as u64) < cells).then_some(&0);
        let next = (found.values().chain(none)).filter_map(|k| next_n(*k, seeds, until.half_width, most)).max();
        let Some(next) = next else {
            return Demand { runs: seeds * cells, decided: true };
        };
        // Runs go seed by seed, so these are the rows of the seeds that have not been examined.
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
                return Demand { runs: new.end, decided: next == most };
            }
        }
        seeds = next;
    }
}
