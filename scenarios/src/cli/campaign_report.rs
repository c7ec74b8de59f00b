//! `rheotaxis campaign report`: the arms of a campaign against each other.

use super::args_campaign::ReportArgs;
use super::campaign::refused;
use super::exit::Exit;
use super::say;
use crate::campaign::report::{About, write};
use crate::campaign::{CampaignError, Manifest, RunRow, read_rows, wanted};

/// Writes the report and prints its tables.
pub(super) fn report(args: &ReportArgs) -> Exit {
    let (manifest, planned, arms, rows) = match read(args) {
        Ok(read) => read,
        Err(error) => return refused(error),
    };
    let about = About {
        name: &manifest.name,
        scenario: &manifest.scenario_name,
        hash: &manifest.campaign_hash,
        version: &manifest.version,
        arms: &arms,
        planned,
    };
    let out = args.out.clone().unwrap_or_else(|| args.dir.join("report"));
    match write(&out, &about, &rows) {
        Ok(written) => {
            say::line(written.text);
            say::line(format_args!(
                "results in {}: open report.html",
                out.display()
            ));
            Exit::Success
        }
        Err(error) => {
            say::error(error, None);
            Exit::Error
        }
    }
}

fn read(args: &ReportArgs) -> Result<(Manifest, u64, Vec<String>, Vec<RunRow>), CampaignError> {
    let manifest = Manifest::of(&args.dir)?;
    let campaign = manifest.campaign()?;
    let arms = campaign
        .spec
        .arms
        .iter()
        .map(|a| a.name.to_string())
        .collect();
    let planned = wanted(&campaign, &args.dir, &manifest).runs(&manifest);
    Ok((manifest, planned, arms, read_rows(&args.dir)?))
}
