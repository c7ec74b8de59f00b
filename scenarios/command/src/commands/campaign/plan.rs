//! `rheotaxis campaign plan`: describes a campaign and estimates its cost.

use crate::args::campaign::PlanArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::say;
use crate::say::count;
use studies::campaign::{Campaign, LONGEST, RunName, block_of, load, one_run};
use world::registry::Registry;

/// Arms that are written out: a campaign may draw thousands.
const MOST_ARMS: usize = 40;

/// Checks a campaign and counts its runs. Unless `--no-probe` is given, makes the first run to estimate the cost.
pub(super) fn plan(registry: &Registry, args: &PlanArgs) -> Result<Exit, Failure> {
    let campaign = load(registry, &args.file)?;
    campaign.check()?;
    let (runs, conditions) = (campaign.n_runs(), campaign.spec.n_conditions());
    let seeds = campaign.spec.seeds;
    say::line(format_args!("{}: {}", campaign.name, campaign.spec.title));
    say::line(format_args!(
        "  {runs} runs: {} x {} x {} on {}",
        count(campaign.n_arms(), "arm"),
        count(conditions, "condition"),
        count(seeds.count(), "seed"),
        campaign.base.name
    ));
    if let Some(until) = &campaign.spec.until {
        say::line(format_args!(
            "  fewer if every success share is known to plus or minus {:.1} % before",
            100.0 * until.half_width
        ));
    }
    if let Some(block) = args.block {
        blocks(runs, block.next_multiple_of(campaign.n_arms()));
    }
    say::line(format_args!("  {}", seeds.describe()));
    let arms = &campaign.spec.arms;
    for arm in arms.iter().take(MOST_ARMS) {
        say::line(format_args!("  arm {}: {}", arm.name, arm.describe()));
    }
    if arms.len() > MOST_ARMS {
        say::line(format_args!("  and {} more arms", arms.len() - MOST_ARMS));
    }
    let shown = conditions.min(12);
    for condition in (0..shown).filter(|_| conditions > 1) {
        say::line(format_args!("  condition {condition}: {}", campaign.condition_name(condition)));
    }
    if shown < conditions {
        say::line(format_args!("  and {} more", conditions - shown));
    }
    let place = campaign.place(0);
    say::line(format_args!(
        "  run 0 is `rheotaxis run --seed {}` of {} with the values of arm {} and its condition",
        place.seed,
        campaign.base.name,
        campaign.arm(place.arm).name
    ));
    if args.no_probe {
        if args.block.is_none() {
            say::line(format_args!("  a block is what one thread does in half a minute, at most {LONGEST} runs"));
        }
        return Ok(Exit::Success);
    }
    cost(&campaign, args.block.is_none())
}

/// Makes the first run and prints what all will cost; with `by_cost`, also the size of the blocks, which follows from
/// it.
fn cost(campaign: &Campaign, by_cost: bool) -> Result<Exit, Failure> {
    let name = RunName { seed: campaign.place(0).seed, ..RunName::default() };
    let row = one_run(&campaign.of_run(&campaign.place(0))?, &name);
    if let Some(error) = row.error {
        return Err(format!("the first run fails: {error}").into());
    }
    let runs = campaign.n_runs();
    let (spin_up, mission) = (row.spin_up_wall_s, row.mission_wall_s);
    if by_cost {
        blocks(runs, block_of(campaign, spin_up, mission, 1));
    }
    let (apart, shared) = (runs as f64, runs as f64 / campaign.n_arms() as f64);
    say::line(format_args!(
        "  the first run took {spin_up:.2} s for the spin-up and {mission:.2} s for the mission; all runs take \
         about {} on one core, or at most {} if the arms have the same water and sources",
        hours(apart * (spin_up + mission)),
        hours(shared * spin_up + apart * mission)
    ));
    Ok(Exit::Success)
}

fn blocks(runs: u64, block: u64) {
    say::line(format_args!("  {} of {block} runs", count(runs.div_ceil(block), "block")));
}

fn hours(seconds: f64) -> String {
    match seconds {
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
