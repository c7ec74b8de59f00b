//! `campaign.json`: what the blocks of a folder were made from, so that they are never mixed.

use super::error::CampaignError;
use super::plan::Campaign;
use crate::scenario::{Loaded, parse};
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Its name in the folder.
pub(super) const FILE: &str = "campaign.json";

/// What `campaign.json` says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Name of the campaign.
    pub name: String,
    /// Version of the program that runs it.
    pub version: String,
    /// Hash of the campaign's text.
    pub campaign_hash: String,
    /// Hash of the base scenario's text.
    pub scenario_hash: String,
    /// Runs in a block.
    pub block: u64,
    /// Runs in all.
    pub runs: u64,
    /// Name of the base scenario.
    pub scenario_name: String,
    /// Folder that paths in the scenario are relative to.
    pub base_dir: PathBuf,
    /// The campaign's text.
    pub campaign_text: String,
    /// The base scenario's text.
    pub scenario_text: String,
}

impl Manifest {
    /// Of a campaign run by this program in blocks of that many runs.
    #[must_use]
    pub fn new(campaign: &Campaign, block: u64) -> Self {
        let base = &campaign.base;
        Self {
            name: campaign.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_string(),
            campaign_hash: campaign.hash.clone(),
            scenario_hash: base.hash.clone(),
            block,
            runs: campaign.n_runs(),
            scenario_name: base.name.clone(),
            base_dir: std::path::absolute(&base.base_dir).unwrap_or_else(|_| base.base_dir.clone()),
            campaign_text: campaign.text.clone(),
            scenario_text: base.text.clone(),
        }
    }

    /// Number of blocks.
    #[must_use]
    pub fn n_blocks(&self) -> u64 {
        self.runs.div_ceil(self.block)
    }

    /// The runs of a block.
    #[must_use]
    pub fn runs_of(&self, block: u64) -> std::ops::Range<u64> {
        let first = block * self.block;
        first..(first + self.block).min(self.runs)
    }

    /// Reads a folder's; `None` where there is none yet.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn find(dir: &Path) -> Result<Option<Self>, CampaignError> {
        let path = dir.join(FILE);
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) => {
                let problem = e.to_string();
                return Err(CampaignError::Read { path, problem });
            }
        };
        let read: Result<Self, _> = serde_json::from_str(&text);
        read.map(Some).map_err(|e| CampaignError::Read {
            path,
            problem: format!("it is not what this program writes: {e}"),
        })
    }

    /// Reads a folder's, which must be there.
    ///
    /// # Errors
    /// If there is none, or it cannot be read.
    pub fn of(dir: &Path) -> Result<Self, CampaignError> {
        Self::find(dir)?.ok_or_else(|| CampaignError::NoCampaign {
            dir: dir.to_owned(),
            problem: format!("there is no {FILE} in it"),
        })
    }

    /// The campaign it tells of.
    ///
    /// # Errors
    /// If this program does not read its texts.
    pub fn campaign(&self) -> Result<Campaign, CampaignError> {
        let base = Loaded {
            scenario: parse(&self.scenario_name, &self.scenario_text)?,
            text: self.scenario_text.clone(),
            path: PathBuf::from(&self.scenario_name),
            name: self.scenario_name.clone(),
            base_dir: self.base_dir.clone(),
            hash: self.scenario_hash.clone(),
        };
        Campaign::new(&self.name, &self.name, &self.campaign_text, base)
    }

    /// What differs from another, in words: nothing if blocks of both may lie in one folder.
    #[must_use]
    pub fn differences(&self, ours: &Self) -> Vec<String> {
        let pairs = [
            ("scenario", &self.scenario_hash, &ours.scenario_hash),
            ("campaign", &self.campaign_hash, &ours.campaign_hash),
            ("version", &self.version, &ours.version),
            (
                "block size",
                &self.block.to_string(),
                &ours.block.to_string(),
            ),
        ];
        (pairs.iter())
            .filter(|(_, there, here)| there != here)
            .map(|(what, there, here)| format!("{what} {there} there, {here} here"))
            .collect()
    }

    /// Writes it into the folder, whole or not at all.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn write(&self, dir: &Path) -> Result<(), CampaignError> {
        let mut text = serde_json::to_string_pretty(self).expect("plain data becomes JSON");
        text.push('\n');
        // Shards start together: each writes its own, and the last one, which says the same, stays.
        let temporary = dir.join(format!("{FILE}.{}.tmp", std::process::id()));
        put_in_place(&temporary, &dir.join(FILE), text.as_bytes())
    }
}

/// Writes a file under a temporary name, makes sure it is on the disk, and only then names it.
pub(super) fn put_in_place(
    temporary: &Path,
    path: &Path,
    bytes: &[u8],
) -> Result<(), CampaignError> {
    let written = File::create(temporary).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    written
        .and_then(|()| fs::rename(temporary, path))
        .map_err(|e| {
            // Half a file is of no use, and on a full disk in the way.
            let _ = fs::remove_file(temporary);
            CampaignError::Write {
                path: path.to_owned(),
                problem: e.to_string(),
            }
        })?;
    // The name too must reach the disk; where a folder cannot be synced, the system sees to it.
    if let Some(dir) = path.parent().and_then(|dir| File::open(dir).ok()) {
        let _ = dir.sync_all();
    }
    Ok(())
}
