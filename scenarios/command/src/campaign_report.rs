//! `rheotaxis campaign report`: compares the arms of a campaign.

use super::args_campaign::ReportArgs;
use super::campaign::refused;
use super::exit::Exit;
use super::{say, stop};
use indicatif::{ProgressBar, ProgressStyle};
use studies::campaign::report::{About, RemadeRun, picks, write};
use studies::campaign::{Arm, Campaign, CampaignError, Manifest, RunRow, read_rows, wanted};
use world::registry::Registry;

/// Writes the report and prints its tables.
pub(super) fn report(registry: &Registry, args: &ReportArgs) -> Exit {
    let read = match read(registry, args) {
        Ok(read) => read,
        Err(error) => return refused(error),
    };
    let spec = &read.campaign.spec;
    let arms: Vec<String> = spec.arms.iter().map(|a| a.name.clone()).collect();
    let sets: Vec<String> = spec.arms.iter().map(Arm::describe).collect();
    if let Some(arm) = args.against.as_ref().filter(|arm| !arms.contains(arm)) {
        let there = format!("the arms of this campaign: {}", arms.join(", "));
        say::error(format!("--against: there is no arm \"{arm}\""), Some(&there));
        return Exit::Error;
    }
    let shown = if args.no_tracks { Vec::new() } else { tracks(args, &read, &arms) };
    let about = About {
        name: &read.manifest.name,
        title: &spec.title,
        scenario: &read.manifest.scenario_name,
        hash: &read.manifest.campaign_hash,
        version: &read.manifest.version,
        arms: &arms,
        sets: &sets,
        seeds: &spec.seeds.describe(),
        success: &read.success,
        against: args.against.as_deref(),
        columns: say::columns(),
        limit_s: Some(read.limit_s),
        planned: read.planned,
        shown: &shown,
    };
    let out = args.out.clone().unwrap_or_else(|| args.dir.join("report"));
    match write(&out, &about, &read.rows) {
        Ok(written) => {
            if let Some(removed) = say::removed(&out, &written.removed) {
                say::note(removed);
            }
            say::line(written.text);
            say::line(format_args!("results in {}: open report.html", out.display()));
            Exit::Success
        }
        Err(error) => {
            say::error(error, None);
            Exit::Error
        }
    }
}

/// Makes the runs anew whose tracks are shown. Ctrl-C leaves out those that have not begun.
fn tracks(args: &ReportArgs, read: &Read, arms: &[String]) -> Vec<RemadeRun> {
    let mut campaign = read.campaign.clone();
    campaign.key = args.key.get();
    if let Err(error) = read.manifest.same_key(&campaign) {
        say::note(format_args!("no tracks are shown: {error}"));
        return Vec::new();
    }
    let picks = picks(arms, &read.rows);
    let bar = if args.quiet { ProgressBar::hidden() } else { ProgressBar::new(picks.len() as u64) };
    bar.set_style(
        ProgressStyle::with_template("tracks: {pos} of {len} runs made anew [{bar:30}] {eta} left")
            .expect("the template is well formed")
            .progress_chars("=> "),
    );
    bar.tick();
    let shown = campaign.films(picks, args.jobs, stop::listen(), &|| bar.inc(1));
    bar.finish_and_clear();
    shown
}

struct Read {
    manifest: Manifest,
    campaign: Campaign,
    planned: u64,
    limit_s: f64,
    success: Vec<String>,
    rows: Vec<RunRow>,
}

fn read(registry: &Registry, args: &ReportArgs) -> Result<Read, CampaignError> {
    let manifest = Manifest::open(&args.dir)?;
    let campaign = manifest.campaign(registry)?;
    Ok(Read {
        planned: wanted(&campaign, &args.dir, &manifest).runs,
        limit_s: campaign.limit_s()?,
        success: campaign.success_rules()?,
        rows: read_rows(&args.dir)?,
        manifest,
        campaign,
    })
}
