//! `campaign.json`: what the blocks of a folder were made from, so that they are never mixed.

use super::error::CampaignError;
use super::plan::{Campaign, hash};
use super::seeds::MOST;
use super::spec::CampaignSpec;
use rheotaxis::cache::program_mark;
use rheotaxis::scenario::load_text_in;
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use world::files::{self, write_new, write_on_disk};
use world::registry::Registry;

/// Its name in the folder.
pub(super) const FILE: &str = "campaign.json";
/// Version of the format of a campaign's folder. Since 2, the declarations stand in a table of their own, in the files
/// `declarations-<block>.parquet`, and every file of a block has a seal.
const FORMAT: u32 = 2;

fn first_format() -> u32 {
    1
}

/// Longest one read, bytes: it holds two escaped texts of at most a megabyte each.
const LONGEST: u64 = 16 << 20;

/// The content of `campaign.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of the folder's format: [`FORMAT`]. Folders of the first version do not say it.
    #[serde(default = "first_format")]
    pub(super) format: u32,
    /// Name of the campaign.
    pub name: String,
    /// Version of the program that runs it.
    pub version: String,
    /// Mark of that program's file: two builds with other algorithms may have one version.
    #[serde(default)]
    pub program: String,
    /// Hash of the campaign's text.
    pub campaign_hash: String,
    /// Hash of the base scenario's text.
    pub scenario_hash: String,
    /// Runs in a block.
    pub block: u64,
    /// Total number of runs.
    pub runs: u64,
    /// The runs' seeds, for people; the campaign's text is what counts.
    #[serde(default)]
    pub seeds: String,
    /// The mark of the key that the runs have beside their seeds; `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Name of the base scenario.
    pub scenario_name: String,
    /// Folder to which paths in the scenario are relative.
    pub base_dir: PathBuf,
    /// The campaign's text.
    pub campaign_text: String,
    /// The base scenario's text.
    pub scenario_text: String,
}

impl Manifest {
    /// For a campaign that this program runs in blocks of that many runs.
    pub fn new(campaign: &Campaign, block: u64) -> Self {
        let base = &campaign.base;
        Self {
            format: FORMAT,
            name: campaign.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_string(),
            program: program_mark(),
            campaign_hash: campaign.hash.clone(),
            scenario_hash: base.hash(),
            block,
            runs: campaign.n_runs(),
            seeds: campaign.spec.seeds.describe(),
            key: campaign.key.mark(),
            scenario_name: base.name.clone(),
            base_dir: std::path::absolute(&base.base_dir).unwrap_or_else(|_| base.base_dir.clone()),
            campaign_text: campaign.text.clone(),
            scenario_text: base.text().into_owned(),
        }
    }

    /// Number of blocks.
    pub fn n_blocks(&self) -> u64 {
        self.runs.div_ceil(self.block)
    }

    /// The runs of a block.
    pub fn runs_of(&self, block: u64) -> std::ops::Range<u64> {
        let first = block * self.block;
        first..(first + self.block).min(self.runs)
    }

    /// Reads the manifest of a folder; `None` if there is none yet.
    ///
    /// # Errors
    /// If it cannot be read, has another format, or contains a number that this program does not write.
    pub fn find(dir: &Path) -> Result<Option<Self>, CampaignError> {
        let path = dir.join(FILE);
        let text = match files::read_text(&path, LONGEST) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) => {
                let problem = e.to_string();
                return Err(CampaignError::Read { path, problem });
            }
        };
        let unlike = |problem: String| CampaignError::Read { path: path.clone(), problem };
        let read: Self =
            serde_json::from_str(&text).map_err(|e| unlike(format!("it is not what this program writes: {e}")))?;
        if read.format != FORMAT {
            let problem = format!(
                "the folder has format {}, this program reads and writes format {FORMAT}: \
                 use version {} of the program, which made it, or another folder",
                read.format, read.version
            );
            return Err(unlike(problem));
        }
        for (field, value) in [("block", read.block), ("runs", read.runs)] {
            if !(1..=MOST).contains(&value) {
                let problem = format!("{field}: must be from 1 to {MOST}, got {value}");
                return Err(unlike(problem));
            }
        }
        Ok(Some(read))
    }

    /// Reads the manifest of a folder, which must exist.
    ///
    /// # Errors
    /// If there is none, or it cannot be read.
    pub fn open(dir: &Path) -> Result<Self, CampaignError> {
        Self::find(dir)?.ok_or_else(|| CampaignError::NoCampaign {
            dir: dir.to_owned(),
            problem: format!("there is no {FILE} in it"),
        })
    }

    /// The campaign that it describes; its scenario may use what a registry adds.
    ///
    /// # Errors
    /// If this program cannot read its texts, or if its hashes and numbers do not belong to them.
    pub fn campaign(&self, registry: &Registry) -> Result<Campaign, CampaignError> {
        self.check()?;
        let base = load_text_in(registry, &self.scenario_name, &self.scenario_text, &self.base_dir)?;
        Campaign::new(&self.name, &self.name, &self.campaign_text, base)
    }

    /// Checks that its hashes and numbers belong to its texts.
    ///
    /// # Errors
    /// What does not.
    pub(super) fn check(&self) -> Result<(), CampaignError> {
        let unlike = |problem: String| CampaignError::Read { path: PathBuf::from(FILE), problem };
        for (what, text, said) in [
            ("campaign", &self.campaign_text, &self.campaign_hash),
            ("scenario", &self.scenario_text, &self.scenario_hash),
        ] {
            let is = hash(text);
            if is != *said {
                let problem = format!("{what}_text: its hash is {is}, {what}_hash says {said}: one was changed");
                return Err(unlike(problem));
            }
        }
        let campaign = CampaignSpec::parse(&self.name, &self.campaign_text)?;
        let (runs, arms) = (campaign.n_runs(), campaign.n_arms());
        if self.runs != runs {
            let problem = format!("runs: must be the campaign's {runs}, got {}", self.runs);
            return Err(unlike(problem));
        }
        if !self.block.is_multiple_of(arms) {
            let problem = format!("block: must be a multiple of the campaign's {arms} arms, got {}", self.block);
            return Err(unlike(problem));
        }
        Ok(())
    }

    /// Refuses to make a run again under another key than that of the folder.
    ///
    /// # Errors
    /// Names the mark of the folder's key.
    pub fn same_key(&self, campaign: &Campaign) -> Result<(), CampaignError> {
        if self.key == campaign.key.mark() {
            return Ok(());
        }
        let problem = match &self.key {
            Some(mark) => format!("its runs have the key with the mark {mark}: give it with --key"),
            None => "its runs have no key: leave out --key and RHEOTAXIS_KEY".to_string(),
        };
        Err(CampaignError::Read { path: PathBuf::from(FILE), problem })
    }

    /// What differs from another manifest, in words; empty if blocks of both may lie in one folder.
    pub fn differences(&self, ours: &Self) -> Vec<String> {
        let key = |m: &Self| m.key.clone().unwrap_or_else(|| "none".to_string());
        let pairs = [
            ("scenario", &self.scenario_hash, &ours.scenario_hash),
            ("campaign", &self.campaign_hash, &ours.campaign_hash),
            ("version", &self.version, &ours.version),
            ("program", &self.program, &ours.program),
            ("block size", &self.block.to_string(), &ours.block.to_string()),
            ("mark of the key", &key(self), &key(ours)),
        ];
        (pairs.iter())
            .filter(|(_, there, here)| there != here)
            .map(|(what, there, here)| format!("{what} {there} there, {here} here"))
            .collect()
    }

    /// Writes it into the folder, completely or not at all, in place of an existing one.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn write(&self, dir: &Path) -> Result<(), CampaignError> {
        write_on_disk(&dir.join(FILE), self.text().as_bytes())?;
        Ok(())
    }

    /// Writes it into the folder unless there is one. Of several processes, the first one determines the length of
    /// blocks, unless a length was `asked` for. Returns the manifest that the folder has afterwards.
    ///
    /// # Errors
    /// If it cannot be written or read, or if there is another campaign's.
    pub(super) fn write_first(&self, dir: &Path, asked: bool) -> Result<Self, CampaignError> {
        match write_new(&dir.join(FILE), self.text().as_bytes()) {
            Err(e) if e.source.kind() != ErrorKind::AlreadyExists => return Err(e.into()),
            _ => {}
        }
        let there = Self::open(dir)?;
        let block = if asked { self.block } else { there.block };
        let what = there.differences(&Self { block, ..self.clone() });
        if what.is_empty() {
            return Ok(there);
        }
        let dir = dir.to_owned();
        Err(CampaignError::Differs { dir, what })
    }

    fn text(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("plain data becomes JSON");
        text.push('\n');
        text
    }
}

#[cfg(test)]
mod tests {
    use super::super::load;
    use super::*;
    use std::fs;

    #[test]
    fn the_first_of_several_processes_says_how_long_blocks_are() {
        let campaign = load(&Registry::default(), Path::new("uniform_beta")).unwrap();
        let dir = tempfile::tempdir().unwrap();
        let write = |block, asked| Manifest::new(&campaign, block).write_first(dir.path(), asked);
        let (first, second) = (write(4, false).unwrap(), write(8, false).unwrap());
        let said = write(8, true).unwrap_err().to_string();
        assert!(said.contains("block size 4 there, 8 here"), "{said}");
        // The same version with another strategy of somebody's own.
        let built_anew = Manifest { program: "0".repeat(32), ..Manifest::new(&campaign, 4) };
        let refused = built_anew.write_first(dir.path(), true).unwrap_err();
        let ours = program_mark();
        let said = refused.to_string();
        assert!(said.contains(&format!("program {ours} there, 0000")), "{said}");
        assert_eq!((first.block, second.block), (4, 4));
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
        assert_eq!(first.seeds, "seeds 1 to 10");
        assert_eq!(Manifest::open(dir.path()).unwrap().campaign(&Registry::default()).unwrap().n_runs(), 40);
    }

    #[test]
    fn absurd_numbers_are_errors_with_field_and_legal_range() {
        let campaign = load(&Registry::default(), Path::new("uniform_beta")).unwrap();
        let dir = tempfile::tempdir().unwrap();
        let good = serde_json::to_value(Manifest::new(&campaign, 4)).unwrap();
        let said = |json: &serde_json::Value| -> String {
            fs::write(dir.path().join(FILE), json.to_string()).unwrap();
            let read = Manifest::open(dir.path()).and_then(|m| m.campaign(&Registry::default()).map(drop));
            read.unwrap_err().to_string()
        };
        for (field, value, says) in [
            ("block", 0.into(), "block: must be from 1 to 1099511627776, got 0"),
            ("block", 3.into(), "block: must be a multiple of the campaign's 2 arms, got 3"),
            ("block", (1_u64 << 63).into(), "got 9223372036854775808"),
            ("block", (-4).into(), "-4"),
            ("runs", 0.into(), "runs: must be from 1 to 1099511627776, got 0"),
            ("runs", (1_u64 << 63).into(), "runs: must be from 1 to 1099511627776, got 9223372036854775808"),
            ("runs", 41.into(), "runs: must be the campaign's 40, got 41"),
            ("campaign_text", "(version: 2)".into(), "campaign_text: its hash is"),
            ("scenario_hash", "00".into(), "scenario_hash says 00"),
            ("format", 3.into(), "the folder has format 3"),
        ] {
            let mut odd = good.clone();
            odd[field] = value;
            let said = said(&odd);
            assert!(said.contains(says), "{field}: {said}");
        }
        // From an older program: without the field that it did not know.
        let mut old = good.clone();
        old.as_object_mut().unwrap().remove("format");
        let said = said(&old);
        assert!(said.contains("the folder has format 1, this program reads and writes format 2"), "{said}");
    }
}
