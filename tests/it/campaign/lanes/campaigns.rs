//! Campaigns whose arms go in lanes: killed, continued, with arms that end at different times.

use crate::common::{self, timeless_rows as rows};
use crate::waits::{Process, kill_again_and_again};
use rheotaxis::trial::Trial;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use studies::campaign::{load, read_rows};
use world::registry::Registry;
use world::seeds::Stream;

/// Arms that end one after the other; those of other water have an ocean of their own.
const CAMPAIGN: &str = r#"(
    version: 2,
    title: "Lanes",
    base: "pond.ron",
    seeds: 24,
    arms: [
        (name: "long"),
        (name: "short", set: [("time.limit_s", "2")]),
        (name: "fast water", set: [("water.currents[0].speed_m_s", "0.3")]),
        (name: "slow", set: [("robots[0].strategy.speed_m_s", "1.2"), ("time.limit_s", "3")]),
        (name: "fast water, slow", set: [
            ("water.currents[0].speed_m_s", "0.3"),
            ("robots[0].strategy.speed_m_s", "1.2"),
        ]),
        (name: "seldom", set: [("time.drift_period_s", "1.5")]),
    ],
)
"#;

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let channel = include_str!("../../../../scenarios/catalog/uniform_channel.ron");
    let times = [("spin_up_s", "10"), ("limit_s", "4")];
    let pond = common::with_fields(channel, &times);
    fs::write(dir.path().join("pond.ron"), pond).unwrap();
    fs::write(dir.path().join("c.ron"), CAMPAIGN).unwrap();
    dir
}

fn start(dir: &Path, out: &str) -> Process {
    let args = ["campaign", "run", "c.ron", "--out", out, "--block", "6", "--quiet", "--jobs", "2"];
    let mut command = common::command(dir, &args);
    for name in ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID", "JOB_COMPLETION_INDEX"] {
        command.env_remove(name);
    }
    Process::start(command.stdout(Stdio::null()).stderr(Stdio::null()))
}

#[test]
fn a_campaign_killed_in_the_middle_of_lanes_ends_with_the_rows_of_runs_alone() {
    let folder = folder();
    let dir = folder.path();
    let out = dir.join("out");
    let mut draw = Stream::new(2, "kill", "after");
    let mut before = Vec::new();
    let killed = || {
        let begun = out.join("campaign.json").exists();
        let now = if begun { read_rows(&out).unwrap() } else { Vec::new() };
        // What was written stays as it was, wall times included.
        for row in &before {
            assert!(now.contains(row), "run {} was lost or done again", row.run);
        }
        before = now;
    };
    let parts = || {
        let names = fs::read_dir(&out).into_iter().flatten();
        let names = names.map(|f| f.unwrap().file_name().into_string().unwrap());
        let whole = |name: &String| name.starts_with("part-") && name.ends_with(".parquet");
        names.filter(whole).count()
    };
    let start_again = || start(dir, "out");
    let [kills, grew] = kill_again_and_again(start_again, parts, || draw.uniform(), killed);
    assert!(kills >= 12 && grew >= 3, "{kills} kills, {grew} with blocks");
    let done = rows(&out);
    assert_eq!(done.len(), 144);
    let campaign = load(&Registry::default(), &dir.join("c.ron")).unwrap();
    for row in done.iter().take(24) {
        let place = campaign.place(row.run);
        let loaded = campaign.loaded(place.condition, place.arm).unwrap();
        let alone = Trial::assemble(&loaded, place.seed).unwrap();
        assert_eq!(row.digest, alone.finish_quietly().digest, "{}", row.arm);
    }
    assert!(start(dir, "straight").end().success());
    assert_eq!(done, rows(&dir.join("straight")));
}

/// Wall time of a spin-up belongs to one run of those that share it, and that of the missions to all.
#[test]
fn lanes_share_the_spin_up_and_the_wall_time() {
    let folder = folder();
    let dir = folder.path();
    assert!(start(dir, "out").end().success());
    for of_seed in read_rows(&dir.join("out")).unwrap().chunks(6) {
        let spun = |arms: &[usize]| -> usize {
            let of_arm = |arm: &&usize| of_seed[**arm].spin_up_wall_s > 0.0;
            arms.iter().filter(of_arm).count()
        };
        // The seldom drifting arm takes the spin-up of the others over.
        assert_eq!(spun(&[0, 1, 3, 5]), 1);
        assert_eq!(spun(&[2, 4]), 1);
        assert!(of_seed.iter().all(|row| row.mission_wall_s > 0.0));
    }
}
