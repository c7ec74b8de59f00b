//! `rheotaxis arena`: searchers against each other, in several kinds of water.

use super::cache;
use super::campaign::run_shown;
use crate::args::arena::ArenaArgs;
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::say;
use crate::stop;
use output::files::make_folder;
use output::live::{LiveAsk, LiveOptions, Plane};
use rheotaxis::control::Controller;
use rheotaxis::trial::controlled;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use studies::arena::{Contest, Family, campaign, families, searchers, standing, write};
use studies::campaign::{Campaign, CampaignError, Manifest, Outside, RunName, RunOptions, merge, read_rows};
use world::registry::Registry;

/// Runs what is left of each family, then shows all that there is.
pub(crate) fn arena(registry: &Registry, args: &ArenaArgs) -> Result<Exit, Failure> {
    let families = families(registry, &args.family)?;
    let searchers = searchers(&args.searcher)?;
    let contest =
        Contest { seeds: (!args.quick).then_some(args.seeds), first_seed: args.first_seed, key: args.key.get() };
    // A family for which none of the searchers is made is left out, unless it was asked for.
    let machines: Vec<_> = searchers.iter().map(|s| s.machine).collect();
    let wanted = |f: &&Family| !args.family.is_empty() || machines.contains(&f.spec.machine);
    let mut all: Vec<(&Family, Campaign)> = Vec::new();
    let mut asked = Vec::new();
    for family in families.iter().filter(wanted) {
        let planned = campaign(family, &searchers, &contest)?;
        planned.check_with(true)?;
        for arm in 0..planned.spec.arms.len() {
            asked.extend(controlled(&planned.typical(0, arm)?.scenario));
        }
        all.push((family, planned));
    }
    make_folder(&args.out)?;
    let outside = if asked.is_empty() { None } else { Some(open(args)?) };
    let shard = args.share.shard()?;
    let kept = cache::opened(&args.share.cache).map(Arc::new);
    let begun = now();
    let mut exit = Exit::Success;
    for (family, planned) in &all {
        let left = args.share.max_wall.map(|most| most.saturating_sub(begun.elapsed()));
        if exit != Exit::Success || left == Some(Duration::ZERO) {
            exit = Exit::Unfinished;
            break;
        }
        let options = RunOptions {
            shard,
            jobs: args.share.jobs,
            max_wall: left,
            kept: kept.clone(),
            outside: outside.clone(),
            checked: true,
            ..RunOptions::default()
        };
        let ended = run_shown(planned, &args.out.join(&family.name), &options, args.share.quiet);
        exit = ended.map_err(|e| match e.downcast_ref() {
            Some(CampaignError::Differs { .. }) => hinted(e, "give another --out: other searchers, seeds or a key"),
            _ => e,
        })?;
    }
    cache::tell_fault(kept.as_deref());
    show(args, registry, &all, &searchers)?;
    Ok(exit)
}

/// Searchers outside, asked over one session of zenoh.
struct OverZenoh {
    ask: LiveAsk,
    wait: Duration,
}

impl Outside for OverZenoh {
    fn controller(&self, run: &RunName, robot: &str, deadline_s: f64) -> Result<Box<dyn Controller>, String> {
        // Each run has a key of its own, for several go at the same time.
        let name = format!("arena {} {}", run.arm, run.run);
        let going = Arc::new(|| !stop::listen().load(Ordering::Relaxed));
        let times = [Duration::from_secs_f64(deadline_s), self.wait];
        let asked = self.ask.controller(&name, robot, times, going);
        asked.map_or_else(|e| Err(e.to_string()), |asked| Ok(Box::new(asked) as Box<dyn Controller>))
    }
}

fn open(args: &ArenaArgs) -> Result<Arc<dyn Outside>, Failure> {
    let mut options = LiveOptions::new("arena".to_string());
    options.listen = args.zenoh_listen.clone();
    options.config_file = args.zenoh_config.clone();
    options.plane = Arc::new(Plane::new(true, None));
    options.control_from_anywhere = args.control_from_anywhere;
    let ask = LiveAsk::open(&options)?;
    ask.notices().for_each(say::note);
    say::note(format_args!(
        "searchers outside are asked at {} under rheotaxis/*/ask/*; each run waits up to {} s for one",
        ask.endpoint(),
        args.control_wait
    ));
    Ok(Arc::new(OverZenoh { ask, wait: Duration::from_secs_f64(args.control_wait) }))
}

/// Writes page, tables and figures of all rows that there are.
fn show(
    args: &ArenaArgs,
    registry: &Registry,
    all: &[(&Family, Campaign)],
    searchers: &[studies::arena::SearcherSpec],
) -> Result<(), Failure> {
    let mut standings = Vec::new();
    for (family, planned) in all {
        let dir = args.out.join(&family.name);
        let Some(found) = Manifest::find(&dir)? else { continue };
        let differs = found.differences(&Manifest::new(planned, found.block));
        if !differs.is_empty() {
            let differs = differs.join(", ");
            say::note(format_args!("{} is left out: it holds another contest ({differs})", dir.display()));
            continue;
        }
        standings.push(standing(family, searchers, planned, &read_rows(&dir)?)?);
        merge(registry, &dir, &args.out.join(format!("{}.parquet", family.name)), None)?;
    }
    let key = args.key.get().mark();
    let written = write(&args.out, &standings, searchers, key.as_deref(), &made_by(args))?;
    say::line(written.text.trim());
    say::line(format_args!("\nresults in {}: report.html, RANKING.md, arena.csv, figures", args.out.display()));
    Ok(())
}

/// The command that makes these runs, without its key.
fn made_by(args: &ArenaArgs) -> String {
    let mut words = "rheotaxis arena".to_string();
    args.family.iter().for_each(|f| words.push_str(&format!(" --family {}", f.display())));
    args.searcher.iter().for_each(|s| words.push_str(&format!(" --searcher \"{s}\"")));
    words.push_str(&if args.quick { " --quick".to_string() } else { format!(" --seeds {}", args.seeds) });
    if args.first_seed != 1 {
        words.push_str(&format!(" --first-seed {}", args.first_seed));
    }
    words
}

#[allow(clippy::disallowed_methods, reason = "the limit of wall time decides when to stop, never what a run does")]
fn now() -> Instant {
    Instant::now()
}
