//! Every campaign and every row of figures that comes with the program, cut short: its rows are those of runs alone.

use crate::common::{lasting, timeless};
use rheotaxis::lanes::group_by_ocean;
use rheotaxis::scenario::{Loaded, cost};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use studies::campaign::{
    CAMPAIGNS, Campaign, RunEnded, RunName, RunOptions, RunPlace, RunRow, load, one_run, read_rows, run,
};
use studies::reproduce::{Plan, RowResult, reproduce, wanted};
use world::registry::Registry;
use world::seeds::{Key, Seed};

/// How many of these runs go in lanes together, group by group.
fn groups(runs: &[(&Loaded, Seed)]) -> Vec<usize> {
    let groups = group_by_ocean(runs, cost::MEMORY);
    groups.iter().map(Vec::len).collect()
}

/// The row is that of the run alone.
#[track_caller]
fn is_of_the_run_alone(row: RunRow, loaded: &Loaded, seed: Seed) {
    assert!(row.error.is_none(), "{row:?}");
    let (arm, condition) = (row.arm.clone(), row.condition.clone());
    let name = RunName { run: row.run, arm, condition, seed_index: row.seed_index, seed };
    assert_eq!(timeless(row), timeless(one_run(loaded, &name)), "{}", loaded.name);
}

/// One seed under each condition, with a short spin-up and mission, and eight drawn arms if it draws any.
fn cut_campaign(name: &str) -> Campaign {
    let whole = load(&Registry::default(), Path::new(name)).unwrap();
    let mut text = whole.text.replace("n: 5005", "n: 8");
    let from = text.find("seeds: ").unwrap();
    let length = text[from..].find(",\n").unwrap();
    text.replace_range(from..from + length, "seeds: Literal(first: 4, count: 1)");
    Campaign::new(&whole.shown, &whole.name, &text, lasting(whole.base, 15.0, 8.0)).unwrap()
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
            let place = campaign.place(of_seed[0].run);
            let loaded: Vec<Loaded> =
                (0..arms).map(|arm| campaign.of_run(&RunPlace { arm, ..place }).unwrap()).collect();
            let runs: Vec<_> = loaded.iter().map(|l| (l, place.seed)).collect();
            // The arms of all these campaigns differ in the searcher alone, but for one that compares steps, one that
            // draws temperature and structure of the release, and one that compares flows and releases.
            let lanes = groups(&runs);
            let (want, spins_up) = match template.name {
                "kinematic_steps" => (vec![1; arms], 1),
                "crab_identify" => (vec![1, 1, 1, 1, 2, 2], 6),
                // Two of the eleven have the water of another one.
                "crab_flow" => (vec![1, 1, 1, 1, 1, 1, 1, 2, 2], 9),
                _ => (vec![arms], 1),
            };
            let mut sorted = lanes.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, want, "{}", template.name);
            // One spins up for all with the same water, even if they do not go in lanes together.
            let spun = of_seed.iter().filter(|row| row.spin_up_wall_s > 0.0).count();
            assert_eq!(spun, spins_up, "{}", template.name);
            for (row, loaded) in of_seed.iter().zip(&loaded) {
                is_of_the_run_alone(row.clone(), loaded, place.seed);
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
            *loaded = lasting(loaded.clone(), 10.0, 3.0 + 0.5 * k as f64);
        }
        let runs: Vec<_> = (reference.arms.iter()).map(|(_, loaded)| (loaded, Seed::from(5))).collect();
        let groups = groups(&runs);
        // Without an ocean in common each run is one alone.
        if groups.iter().all(|n| *n == 1) {
            continue;
        }
        let plan = Plan { n: 1, first_seed: 5, key: Key::public(), until_half_width: None, jobs: 1 };
        let stop = AtomicBool::new(false);
        let row = RowResult::begin(&reference);
        let done = reproduce(&reference, row, plan, None, &stop, |_, _| {}, |_| Ok(())).unwrap();
        assert_eq!(done.runs.len(), reference.arms.len());
        shared.push(format!("{} {groups:?}", reference.row.id));
        for (row, (arm, loaded)) in done.runs.into_iter().zip(&reference.arms) {
            assert_eq!(row.arm, *arm);
            is_of_the_run_alone(row, loaded, Seed::from(5));
        }
    }
    assert!(shared.len() >= 5, "{shared:#?}");
}
