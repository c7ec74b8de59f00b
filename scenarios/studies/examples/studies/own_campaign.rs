//! A campaign over arms of your own: a strategy of the program with two parameters, compared over the same seeds.
//!
//! Strategies of other crates take part in the same way, if `load_with` reads the scenario with the registry that knows
//! them (`own_strategy.rs` of the library).
//!
//! `cargo run --release -p rheotaxis-studies --example studies own_campaign`

use rheotaxis::scenario::load;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use studies::campaign::stats::wilson;
use studies::campaign::{Campaign, RunOptions, read_rows, run};

const CAMPAIGN: &str = r#"(
    version: 2,
    title: "Reacquiring with one loop or with two",
    base: "uniform_channel",
    seeds: 8,
    arms: [
        (name: "one", set: [("robots[0].strategy.reacquire", "Bowtie(repetitions: 1)")]),
        (name: "two", set: [("robots[0].strategy.reacquire", "Bowtie(repetitions: 2)")]),
    ],
)"#;

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let campaign = Campaign::new("own.ron", "own", CAMPAIGN, load(Path::new("uniform_channel"))?)?;
    campaign.check()?;
    let dir = std::env::temp_dir().join(format!("rheotaxis-own-campaign-{}", std::process::id()));
    // Both arms of a seed run in one and the same plume.
    run(&campaign, &dir, &RunOptions::default(), &AtomicBool::new(false), &|_| {})?;
    let rows = read_rows(&dir)?;
    for (arm, name) in ["one", "two"].iter().enumerate() {
        let own: Vec<_> = rows.iter().filter(|row| row.arm == *name).collect();
        let found = own.iter().filter(|row| row.success).count();
        let share = wilson(found as u64, own.len() as u64);
        println!(
            "{}: {found} of {} found the source ({:.0} to {:.0} %)",
            campaign.arm(arm).name,
            own.len(),
            100.0 * share.low,
            100.0 * share.high
        );
    }
    std::fs::remove_dir_all(&dir)?;
    if rows.len() != 16 {
        return Err("runs are missing".into());
    }
    Ok(())
}
