//! Progress of a campaign.

use super::block::{BlockState, present, read_block};
use super::enough::{Demand, wanted};
use super::error::CampaignError;
use super::manifest::Manifest;
use super::rows::row::RunRow;
use super::seeds::Seeds;
use std::path::Path;
use world::registry::Registry;

/// Progress of an arm, over all conditions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ArmStatus {
    /// Its name.
    pub name: String,
    /// Number of runs done.
    pub runs: u64,
    /// Number of successes among them.
    pub successes: u64,
    /// Number of runs among them that failed with an error.
    pub failed: u64,
}

/// Progress of a campaign.
#[derive(Debug)]
pub struct Status {
    /// What it needs, as far as its blocks tell.
    pub wanted: Demand,
    /// What the folder was made from.
    pub manifest: Manifest,
    /// Number of blocks that contain everything wanted of them.
    pub blocks_done: u64,
    /// Blocks whose file is not whole.
    pub broken: Vec<CampaignError>,
    /// Number of runs that have a row.
    pub runs_done: u64,
    /// Number of wanted runs that have no row.
    pub missing: u64,
    /// The first run that failed, with its error.
    pub first_error: Option<(u64, String)>,
    /// The runs' seeds.
    pub seeds: Seeds,
    /// Each arm.
    pub arms: Vec<ArmStatus>,
}

impl Status {
    /// Examines a folder.
    ///
    /// # Errors
    /// If there is no campaign in it.
    pub fn examine(registry: &Registry, dir: &Path) -> Result<Self, CampaignError> {
        let manifest = Manifest::open(dir)?;
        let campaign = manifest.campaign(registry)?;
        let named = |name: &String| ArmStatus { name: name.clone(), ..ArmStatus::default() };
        let wanted = wanted(&campaign, dir, &manifest);
        let mut status = Self {
            arms: campaign.spec.arms.iter().map(|a| named(&a.name)).collect(),
            blocks_done: 0,
            broken: Vec::new(),
            runs_done: 0,
            missing: wanted.runs,
            first_error: None,
            seeds: campaign.spec.seeds,
            wanted,
            manifest,
        };
        for block in present(dir, &status.manifest)? {
            match read_block(dir, &status.manifest, block) {
                BlockState::Missing => {}
                BlockState::Broken(error) => status.broken.push(error),
                BlockState::Done(rows) | BlockState::Part(rows) => status.add(block, rows),
            }
        }
        Ok(status)
    }

    fn add(&mut self, block: u64, rows: Vec<RunRow>) {
        let asked = self.manifest.runs_of(block);
        let asked = asked.start..asked.end.min(self.wanted.runs);
        let there = rows.iter().filter(|r| asked.contains(&r.run)).count() as u64;
        let enough = !asked.is_empty() && there == asked.end - asked.start;
        self.blocks_done += u64::from(enough);
        self.missing -= there;
        self.runs_done += rows.len() as u64;
        for row in rows {
            if let Some(arm) = self.arms.iter_mut().find(|a| a.name == row.arm) {
                arm.runs += 1;
                arm.successes += u64::from(row.success);
                arm.failed += u64::from(row.error.is_some());
            }
            if let Some(error) = row.error {
                self.first_error.get_or_insert((row.run, error));
            }
        }
    }

    /// Whether every run that is wanted has its row.
    pub fn complete(&self) -> bool {
        self.wanted.decided && self.missing == 0
    }
}
