//! `rheotaxis campaign`: plans and runs campaigns, shows their status, merges, reports and repeats runs.

mod identify;
mod plan;
mod report;

use super::cache;
use crate::args::RunArgs;
use crate::args::cache::CacheArgs;
use crate::args::campaign::{CampaignCommand, CampaignRunArgs, MergeArgs, RerunArgs, StatusArgs};
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::lane_observers::LaneObservers;
use crate::progress::bar;
use crate::run_observer::RunObserver;
use crate::say;
use crate::say::count;
use crate::stop;
use identify::identify_draws;
use output::shown::printable;
use plan::plan;
use report::report;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::trial::Trial;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use studies::campaign::{Campaign, Event, Manifest, RunEnded, RunOptions, Status, load, merge, read_row, run};
use world::registry::Registry;

/// Runs one of its subcommands.
pub(crate) fn campaign(registry: &Registry, command: &CampaignCommand) -> Result<Exit, Failure> {
    match command {
        CampaignCommand::Plan(args) => plan(registry, args),
        CampaignCommand::Run(args) => run_share(registry, args),
        CampaignCommand::Status(args) => status(registry, args),
        CampaignCommand::Merge(args) => merge_rows(registry, args),
        CampaignCommand::Report(args) => report(registry, args),
        CampaignCommand::Identify(args) => identify_draws(registry, args),
        CampaignCommand::Rerun(args) => rerun(registry, args),
    }
}

fn run_share(registry: &Registry, args: &CampaignRunArgs) -> Result<Exit, Failure> {
    let mut campaign = load(registry, &args.file)?;
    campaign.key = args.key.get();
    let kept = cache::opened(&args.share.cache).map(Arc::new);
    let options = RunOptions {
        shard: args.share.shard()?,
        jobs: args.share.jobs,
        block: args.block,
        max_wall: args.share.max_wall,
        force: args.force,
        kept: kept.clone(),
        ..RunOptions::default()
    };
    let exit = run_shown(&campaign, &args.out, &options, args.share.quiet);
    cache::tell_fault(kept.as_deref());
    exit
}

/// Runs what is left of a campaign and shows its progress.
pub(super) fn run_shown(campaign: &Campaign, out: &Path, options: &RunOptions, quiet: bool) -> Result<Exit, Failure> {
    let shard = options.shard;
    let bar = bar(quiet, 0, "{prefix} {pos} of {len} runs [{bar:30}] {per_sec}, {eta} left{msg}");
    bar.set_prefix(printable(&campaign.name).into_owned());
    let (failed, share) = (AtomicU64::new(0), AtomicU64::new(0));
    let say_so = |line: &str| {
        if !quiet {
            bar.suspend(|| say::note(line));
        }
    };
    let tell = |event: Event<'_>| match event {
        Event::Begun { runs, done } => {
            share.store(runs, Ordering::Relaxed);
            bar.set_length(runs);
            bar.set_position(done);
            bar.reset_eta();
            let part = if shard.count > 1 { format!(", share {shard}") } else { String::new() };
            let before = if done > 0 { format!(", {done} done before") } else { String::new() };
            say_so(&format!(
                "{}{part}: {}{before}; {}",
                campaign.name,
                count(runs, "run"),
                campaign.spec.seeds.describe()
            ));
        }
        // Printed even with --quiet, because something damaged the folder.
        Event::Broken(error) => bar.suspend(|| say::note(format_args!("{error}; it is done again"))),
        Event::Ran(row) => {
            bar.inc(1);
            if let Some(error) = &row.error
                && failed.fetch_add(1, Ordering::Relaxed) == 0
            {
                say_so(&format!("run {} failed: {error}", row.run));
                bar.set_message(", some failed");
            }
        }
        Event::Wrote(_) => {}
    };
    let ended = run(campaign, out, options, stop::listen(), &tell);
    bar.finish_and_clear();
    let exit = match ended? {
        RunEnded::Complete => {
            say_so(&format!(
                "{}: done, {} in {}",
                campaign.name,
                count(share.load(Ordering::Relaxed), "run"),
                out.display()
            ));
            Exit::Success
        }
        RunEnded::Waiting { missing } => {
            say_so(&format!(
                "{}: this share is done; whether more runs are needed depends on {} of other shares: \
                 run the same command again when they are done",
                campaign.name,
                count(missing, "missing block")
            ));
            Exit::Unfinished
        }
        RunEnded::Stopped { done, left } => {
            say_so(&format!(
                "{}: stopped: {} done and written, {left} left; the same command continues",
                campaign.name,
                count(done, "run")
            ));
            Exit::Unfinished
        }
    };
    let failed = failed.load(Ordering::Relaxed);
    if failed > 0 {
        say_so(&format!("  {} failed; the column `error` of the rows says why", count(failed, "run")));
    }
    Ok(exit)
}

fn status(registry: &Registry, args: &StatusArgs) -> Result<Exit, Failure> {
    let status = Status::examine(registry, &args.dir)?;
    let manifest = &status.manifest;
    let adaptive = status.wanted.runs < manifest.runs;
    say::line(format_args!(
        "{}: {} of {}{} done, {} of {} whole",
        manifest.name,
        status.runs_done,
        if adaptive { "at most " } else { "" },
        count(manifest.runs, "run"),
        status.blocks_done,
        count(status.wanted.blocks(manifest), "block")
    ));
    say::line(format_args!("  {}", status.seeds.describe()));
    for arm in &status.arms {
        say::line(format_args!(
            "  arm {}: {}, {} successful, {} failed",
            arm.name,
            count(arm.runs, "run"),
            arm.successes,
            arm.failed
        ));
    }
    if let Some((run, error)) = &status.first_error {
        say::line(format_args!("  the first failure is run {run}: {error}"));
    }
    for error in &status.broken {
        say::line(format_args!("  {error}; `rheotaxis campaign run` makes it again"));
    }
    Ok(if status.complete() { Exit::Success } else { Exit::Unfinished })
}

fn merge_rows(registry: &Registry, args: &MergeArgs) -> Result<Exit, Failure> {
    let csv = args.csv.then(|| args.out.with_extension("csv"));
    let merged = merge(registry, &args.dir, &args.out, csv.as_deref())?;
    say::line(format_args!(
        "{} in {}, {} in {}",
        count(merged.rows, "row"),
        args.out.display(),
        count(merged.declarations, "declaration"),
        merged.declarations_path.display()
    ));
    if merged.rows < merged.of {
        say::note(format_args!("the campaign is not complete: {} missing", count(merged.of - merged.rows, "run")));
    }
    Ok(Exit::Success)
}

fn rerun(registry: &Registry, args: &RerunArgs) -> Result<Exit, Failure> {
    let manifest = Manifest::open(&args.dir)?;
    let row = read_row(&args.dir, args.run)?;
    let mut campaign = manifest.campaign(registry)?;
    campaign.key = args.key.get();
    manifest.same_key(&campaign)?;
    let place = campaign.place(args.run);
    let mut what = format!("arm {}", campaign.arm(place.arm).name);
    let condition = campaign.condition_name(place.condition);
    if !condition.is_empty() {
        what += &format!(", {condition}");
    }
    let (loaded, seed) = (campaign.of_run(&place)?, place.seed);
    let out = args.out.clone().unwrap_or_else(|| args.dir.join(format!("run-{}", args.run)));
    let as_run = RunArgs {
        no_record: !args.record,
        cache: CacheArgs { no_cache: true, ..CacheArgs::default() },
        quiet: args.quiet,
        threads: 1,
        ..RunArgs::alone(seed.number(), &args.key, Some(&out))
    };
    let mut trial = Trial::assemble(&loaded, seed)?;
    let mut alone = LaneObservers::default();
    let mut onlooker = RunObserver::new(&loaded, &as_run, Some(&out), &mut alone, stop::listen())?;
    let ended = trial.run(&mut onlooker);
    let outcome = onlooker.finish(&trial, &ended, &mut alone)?;
    if outcome == RunOutcome::Interrupted {
        return Ok(Exit::Interrupted);
    }
    let (run, digest) = (args.run, ended.digest);
    match row {
        None => {
            say::line(format_args!("run {run} ({what}, seed {seed}) has no row yet to compare its digest with"));
        }
        Some(row) if row.digest == digest => {
            say::line(format_args!("run {run} ({what}, seed {seed}): the same digest as its row, {digest}"));
        }
        Some(row) => {
            let theirs = if row.digest.is_empty() { "none" } else { &row.digest };
            return Err(hinted(
                format!("run {run} has digest {digest}, but its row has {theirs}"),
                "was the campaign run by another version of the program?",
            ));
        }
    }
    Ok(Exit::Success)
}
