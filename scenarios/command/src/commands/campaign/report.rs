//! `rheotaxis campaign report`: compares the arms of a campaign.

use crate::args::campaign::ReportArgs;
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::progress::bar;
use crate::{say, stop};
use studies::campaign::report::{About, RemadeRun, picks, write};
use studies::campaign::{Arm, Campaign, Manifest, RunRow, read_rows, wanted};
use world::registry::Registry;

/// Writes the report and prints its tables.
pub(super) fn report(registry: &Registry, args: &ReportArgs) -> Result<Exit, Failure> {
    let manifest = Manifest::open(&args.dir)?;
    let campaign = manifest.campaign(registry)?;
    let (time, success) = (campaign.success_time()?, campaign.success_rules()?);
    let rows = read_rows(&args.dir)?;
    let spec = &campaign.spec;
    let arms: Vec<String> = spec.arms.iter().map(|a| a.name.clone()).collect();
    let sets: Vec<String> = spec.arms.iter().map(Arm::describe).collect();
    if let Some(arm) = args.against.as_ref().filter(|arm| !arms.contains(arm)) {
        let there = format!("the arms of this campaign: {}", arms.join(", "));
        return Err(hinted(format!("--against: there is no arm \"{arm}\""), there));
    }
    let shown = if args.no_tracks { Vec::new() } else { tracks(args, &manifest, &campaign, &arms, &rows) };
    let about = About {
        name: &manifest.name,
        title: &spec.title,
        scenario: &manifest.scenario_name,
        hash: &manifest.campaign_hash,
        version: &manifest.version,
        arms: &arms,
        sets: &sets,
        seeds: &spec.seeds.describe(),
        success: &success,
        against: args.against.as_deref(),
        columns: say::columns(),
        limit_s: Some(time.limit_s),
        within_m: time.within_m,
        planned: wanted(&campaign, &args.dir, &manifest).runs,
        shown: &shown,
    };
    let out = args.out.clone().unwrap_or_else(|| args.dir.join("report"));
    let written = write(&out, &about, &rows)?;
    if let Some(removed) = say::removed(&out, &written.removed) {
        say::note(removed);
    }
    say::line(written.text);
    say::line(format_args!("results in {}: open report.html", out.display()));
    Ok(Exit::Success)
}

/// Makes the runs anew whose tracks are shown. Ctrl-C leaves out those that have not begun.
fn tracks(
    args: &ReportArgs,
    manifest: &Manifest,
    campaign: &Campaign,
    arms: &[String],
    rows: &[RunRow],
) -> Vec<RemadeRun> {
    let mut campaign = campaign.clone();
    campaign.key = args.key.get();
    if let Err(error) = manifest.same_key(&campaign) {
        say::note(format_args!("no tracks are shown: {error}"));
        return Vec::new();
    }
    let picks = picks(arms, rows);
    let bar = bar(args.quiet, picks.len() as u64, "tracks: {pos} of {len} runs made anew [{bar:30}] {eta} left");
    bar.tick();
    let shown = campaign.films(picks, args.jobs, stop::listen(), &|| bar.inc(1));
    bar.finish_and_clear();
    shown
}
