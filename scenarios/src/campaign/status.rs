//! How far a campaign has come.

use super::block::{BlockState, read_block};
use super::enough::{Wanted, wanted};
use super::error::CampaignError;
use super::manifest::Manifest;
use std::path::Path;

/// How an arm stands, over all conditions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ArmStatus {
    /// Its name.
    pub name: String,
    /// Runs done.
    pub runs: u64,
    /// Of them, successes.
    pub successes: u64,
    /// Of them, failed with an error.
    pub failed: u64,
}

/// How a campaign stands.
#[derive(Debug)]
pub struct Status {
    /// What it needs, as far as its blocks say.
    pub wanted: Wanted,
    /// What the folder was made from.
    pub manifest: Manifest,
    /// Blocks that are done.
    pub blocks_done: u64,
    /// Blocks whose file is not whole.
    pub broken: Vec<CampaignError>,
    /// Runs in the blocks that are done.
    pub runs_done: u64,
    /// The first run that failed, with its error.
    pub first_error: Option<(u64, String)>,
    /// Each arm.
    pub arms: Vec<ArmStatus>,
}

impl Status {
    /// Looks through a folder.
    ///
    /// # Errors
    /// If there is no campaign in it.
    pub fn of(dir: &Path) -> Result<Self, CampaignError> {
        let manifest = Manifest::of(dir)?;
        let campaign = manifest.campaign()?;
        let named = |name: &String| ArmStatus {
            name: name.clone(),
            ..ArmStatus::default()
        };
        let mut status = Self {
            arms: campaign.spec.arms.iter().map(|a| named(&a.name)).collect(),
            wanted: wanted(&campaign, dir, &manifest),
            blocks_done: 0,
            broken: Vec::new(),
            runs_done: 0,
            first_error: None,
            manifest,
        };
        for block in 0..status.manifest.n_blocks() {
            match read_block(dir, &status.manifest, block) {
                BlockState::Missing => {}
                BlockState::Broken(error) => status.broken.push(error),
                BlockState::Done(rows) => {
                    status.blocks_done += 1;
                    status.runs_done += rows.len() as u64;
                    for row in rows {
                        if let Some(arm) = status.arms.iter_mut().find(|a| a.name == row.arm) {
                            arm.runs += 1;
                            arm.successes += u64::from(row.success);
                            arm.failed += u64::from(row.error.is_some());
                        }
                        if let Some(error) = row.error {
                            status.first_error.get_or_insert((row.run, error));
                        }
                    }
                }
            }
        }
        Ok(status)
    }

    /// Whether every block is there and whole.
    #[must_use]
    pub fn complete(&self) -> bool {
        self.wanted.decided && self.blocks_done >= self.wanted.blocks
    }
}
