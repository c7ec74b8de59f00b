//! Reads campaign files.

use super::error::CampaignError;
use super::plan::Campaign;
use super::spec::CampaignSpec;
use crate::shipped::{beside, stem, text_of};
use rheotaxis::scenario::{Template, load_with};
use std::path::Path;
use world::registry::Registry;

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
    "meander_memory",
];

/// Reads a campaign from a file or, if there is none, the one of that name that comes with the program. Its scenario
/// may use what a registry adds.
///
/// # Errors
/// If it or its base scenario cannot be read. [`Campaign::check`] checks the scenarios of the arms.
pub fn load(registry: &Registry, path: &Path) -> Result<Campaign, CampaignError> {
    let text = text_of(path, CAMPAIGNS, "campaigns")?;
    let shown = path.display().to_string();
    let spec = CampaignSpec::parse(&shown, &text)?;
    let base = load_with(registry, &beside(path, &spec.base))?;
    Campaign::new(&shown, &stem(path), &text, base)
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
