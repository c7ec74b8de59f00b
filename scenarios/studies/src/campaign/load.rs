//! Reads campaign files.

use super::error::CampaignError;
use super::plan::Campaign;
use super::spec::CampaignSpec;
use rheotaxis::scenario::{ScenarioError, Template, load_with};
use std::io::ErrorKind;
use std::path::Path;
use world::files;
use world::registry::Registry;

/// Longest file read, bytes: a campaign is text of a few kilobytes.
const LONGEST: u64 = 1 << 20;

macro_rules! catalog {
    ($($name:literal),* $(,)?) => {
        &[$(Template {
            name: $name,
            text: include_str!(concat!("../../campaigns/", $name, ".ron")),
            files: &[],
        }),*]
    };
}

/// The campaigns that come with the program.
pub const CAMPAIGNS: &[Template] = catalog![
    "duck_beta",
    "uniform_beta",
    "crab_units",
    "crab_identify",
    "crab_morphology",
    "crab_flow",
    "wp_maps",
    "moth_plus",
    "kinematic_steps",
    "reactive",
    "cognitive"
];

/// Reads a campaign from a file or, if there is none, the one of that name that comes with the program. Its scenario may
/// use what a registry adds.
///
/// # Errors
/// If it or its base scenario cannot be read. [`Campaign::check`] checks the scenarios of the arms.
pub fn load(registry: &Registry, path: &Path) -> Result<Campaign, CampaignError> {
    let shown = path.display().to_string();
    let refused = |problem: String, help: Option<String>| {
        let path = shown.clone();
        CampaignError::from(ScenarioError::File { path, problem, help })
    };
    let text = match files::read_text(path, LONGEST) {
        Ok(text) => text,
        Err(e) if e.kind() == ErrorKind::NotFound => {
            let template = CAMPAIGNS.iter().find(|t| t.name == shown);
            let names: Vec<&str> = CAMPAIGNS.iter().map(|t| t.name).collect();
            template.map(|t| t.text.to_string()).ok_or_else(|| {
                let known = format!("campaigns that come with the program: {}", names.join(", "));
                refused("there is no such file".to_string(), Some(known))
            })?
        }
        Err(e) => return Err(refused(format!("cannot be read: {e}"), None)),
    };
    let name = path.file_stem().map_or_else(|| shown.clone(), |s| s.to_string_lossy().into_owned());
    let spec = CampaignSpec::parse(&shown, &text)?;
    let beside = path.parent().unwrap_or(Path::new("")).join(&spec.base);
    let base = if beside.is_file() { &beside } else { Path::new(&spec.base) };
    let base = load_with(registry, base)?;
    Campaign::new(&shown, &name, &text, base)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_campaign_reads_and_checks() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../catalog/campaigns");
        assert_eq!(std::fs::read_dir(folder).unwrap().count(), CAMPAIGNS.len());
        for template in CAMPAIGNS {
            let mut campaign = load(&Registry::default(), Path::new(template.name)).unwrap();
            assert!(campaign.n_arms() > 1);
            // Of thousands of drawn arms, some.
            campaign.spec.arms.truncate(50);
            campaign.check().unwrap();
        }
    }

    #[test]
    fn an_arm_that_asks_a_searcher_outside_is_refused() {
        let base = load_with(&Registry::default(), Path::new("duck_external")).unwrap();
        let text =
            "(version: 2, title: \"t\", base: \"duck_external\", seeds: 2, arms: [(name: \"a\"), (name: \"b\")])";
        let refused = Campaign::new("own.ron", "own", text, base).unwrap().check();
        let said = refused.unwrap_err().to_string();
        assert!(said.contains("auv0 asks a searcher outside the program"), "{said}");
    }

    #[test]
    fn a_missing_file_is_named() {
        let said = load(&Registry::default(), Path::new("nowhere.ron")).unwrap_err().to_string();
        assert!(said.starts_with("nowhere.ron: "), "{said}");
    }
}
