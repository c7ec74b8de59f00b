//! Every campaign and every row of figures that comes with the program, cut short: its rows are those of runs alone.

use super::{alone, cut};
use crate::common::with_fields;
use rheotaxis::lanes::group_by_ocean;
use rheotaxis::scenario::{Loaded, cost, load_text};
use rheotaxis::trial::Trial;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use studies::campaign::{CAMPAIGNS, Campaign, RunEnded, RunName, RunOptions, RunRow, load, one_run, read_rows, run};
use studies::reproduce::{Plan, RowResult, reproduce, wanted};
use world::registry::Registry;
use world::seeds::{Key, Seed};

fn timeless(row: RunRow) -> RunRow {
    RunRow { spin_up_wall_s: 0.0, mission_wall_s: 0.0, ..row }
}

/// How many of these runs go in lanes together, group by group.
fn groups(runs: &[(&Loaded, Seed)]) -> Vec<usize> {
    let groups = group_by_ocean(runs, cost::MEMORY);
    groups.iter().map(Vec::len).collect()
}

/// The row of the run alone; that of the first arm is the run of its scenario, by whatever makes rows.
#[track_caller]
fn row_alone(loaded: &Loaded, name: &RunName, first: bool) -> RunRow {
    let row = timeless(one_run(loaded, name));
    if first {
        let mut trial = Trial::assemble(loaded, name.seed).unwrap();
        let ended = trial.run(&mut rheotaxis::trial::Unwatched);
        assert_eq!(row.digest, ended.digest, "{}: {}", loaded.name, name.arm);
    }
    row
}

/// One seed under each condition, with a short spin-up and mission.
fn cut_campaign(name: &str) -> Campaign {
    let whole = load(&Registry::default(), Path::new(name)).unwrap();
    let base = with_fields(&whole.base.text(), &[("spin_up_s", "15"), ("limit_s", "8")]);
    let base = load_text(&Registry::default(), &whole.base.name, &base).unwrap();
    let seeds = format!("seeds: {},", whole.spec.seeds.count());
    assert_eq!(whole.text.matches(&seeds).count(), 1, "{name}");
    let text = whole.text.replace(&seeds, "seeds: Literal(first: 4, count: 1),");
    Campaign::new(&whole.shown, &whole.name, &text, base).unwrap()
}

#[test]
fn lanes_of_every_bundled_campaign_give_the_rows_of_runs_alone() {
    for template in CAMPAIGNS {
        let campaign = cut_campaign(template.name);
        let dir = tempfile::tempdir().unwrap();
        let options = RunOptions { jobs: 1, block: Some(campaign.n_arms()), ..RunOptions::default() };
        let stop = AtomicBool::new(false);
        let ended = run(&campaign, dir.path(), &options, &stop, &|_| {}).unwrap();
        assert_eq!(ended, RunEnded::Complete);
        let rows = read_rows(dir.path()).unwrap();
        assert_eq!(rows.len() as u64, campaign.n_runs());
        let arms = campaign.spec.arms.len();
        for of_seed in rows.chunks(arms) {
            let condition = campaign.place(of_seed[0].run).condition;
            let loaded: Vec<Loaded> = (0..arms).map(|arm| campaign.loaded(condition, arm).unwrap()).collect();
            let seed = campaign.place(of_seed[0].run).seed;
            let runs: Vec<_> = loaded.iter().map(|l| (l, seed)).collect();
            // The arms of all these campaigns differ in the searcher alone, but for one that compares steps.
            let want = match template.name {
                "kinematic_steps" => vec![1; arms],
                _ => vec![arms],
            };
            assert_eq!(groups(&runs), want, "{}", template.name);
            for (arm, (row, loaded)) in of_seed.iter().zip(&loaded).enumerate() {
                let name = RunName {
                    run: row.run,
                    arm: row.arm.clone(),
                    condition: row.condition.clone(),
                    seed_index: row.seed_index,
                    seed,
                };
                assert!(row.error.is_none(), "{row:?}");
                assert_eq!(timeless(row.clone()), row_alone(loaded, &name, arm == 0));
            }
        }
    }
}

#[test]
fn lanes_of_every_row_of_figures_give_the_rows_of_runs_alone() {
    let mut shared = Vec::new();
    // A row that draws values makes a scenario anew for each seed and arm: what is cut here would not hold, and no two
    // of its arms share an ocean.
    let rows = wanted(&Registry::default(), &[], &[]).unwrap();
    for mut reference in rows.into_iter().filter(|r| r.row.draw.is_empty()) {
        for (k, (_, loaded)) in reference.arms.iter_mut().enumerate() {
            // Each arm ends at another time.
            cut(loaded, 10.0, 3.0 + 0.5 * k as f64);
        }
        let runs: Vec<_> = (reference.arms.iter()).map(|(_, loaded)| (loaded, Seed::from(5))).collect();
        let groups = groups(&runs);
        // Without an ocean in common each run is one alone.
        if groups.iter().all(|n| *n == 1) {
            continue;
        }
        let plan = Plan { n: 1, first_seed: 5, key: Key::public(), until_half_width: None, jobs: 1 };
        let id = reference.row.id.clone();
        let stop = AtomicBool::new(false);
        let row = RowResult::begin(&reference);
        let done = reproduce(&reference, row, plan, None, &stop, |_, _| {}, |_| Ok(())).unwrap();
        assert_eq!(done.runs.len(), reference.arms.len());
        shared.push(format!("{id} {groups:?}"));
        for (k, (row, (arm, loaded))) in done.runs.iter().zip(&reference.arms).enumerate() {
            let name = RunName {
                run: row.run,
                arm: arm.clone(),
                condition: String::new(),
                seed_index: 0,
                seed: Seed::from(5),
            };
            assert!(row.error.is_none(), "{row:?}");
            assert_eq!(timeless(row.clone()), row_alone(loaded, &name, k == 0), "{id}");
        }
    }
    assert!(shared.len() >= 5, "{shared:#?}");
}

/// A lane is the same run with all that is known of it, not only in its row.
#[test]
fn lanes_with_other_strategies_maps_and_sensors_end_as_alone() {
    let campaign = cut_campaign("moth_plus");
    let all: Vec<Loaded> = (0..campaign.spec.arms.len()).map(|arm| campaign.loaded(0, arm).unwrap()).collect();
    let (ends, _) = super::in_lanes(&all.iter().collect::<Vec<_>>());
    for (end, loaded) in ends.into_iter().zip(&all) {
        assert_eq!(end.unwrap(), alone(loaded));
    }
}
