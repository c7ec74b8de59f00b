//! The cache of the command: on by default, shown and cleared, and never in the way.

use super::kit::files;
use crate::common::{self, Ended, says};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A folder with a short mission, `s.ron`, that ends without success.
fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    common::write(dir.path(), "s.ron", &common::short("uniform_channel", 60.0, 5.0));
    dir
}

/// Runs a command with the cache on, in `<dir>/kept`, for whatever is made, however quickly.
fn cached(command: &mut Command, dir: &Path) -> Ended {
    command.env_remove("RHEOTAXIS_NO_CACHE");
    Ended::of(command.env("RHEOTAXIS_CACHE", dir.join("kept")).env("RHEOTAXIS_CACHE_FROM", "0"))
}

fn rheotaxis(dir: &Path, args: &[&str]) -> Ended {
    cached(&mut common::command(dir, args), dir)
}

const TAKEN: &str = "spin-up taken from the cache";

/// Digest of a run, and whether its spin-up was taken from the cache.
fn made(folder: &Path) -> (String, bool) {
    let taken = common::summary(folder)["run"]["spin_up_kept"].as_bool().unwrap();
    (common::digest(folder), taken)
}

/// Runs the mission.
#[track_caller]
fn run(dir: &Path, out: &str, more: &[&str]) -> (String, bool) {
    let args = ["run", "s.ron", "--no-zenoh", "--no-record", "--out", out];
    let end = rheotaxis(dir, &[&args, more].concat()).with(3);
    let made = made(&dir.join(out));
    assert_eq!(end.err.contains(TAKEN), made.1, "{}", end.err);
    assert_eq!(end.out.contains(", taken from the cache"), made.1);
    made
}

#[test]
fn the_second_run_of_a_seed_takes_the_first_ones_spin_up() {
    let folder = folder();
    let dir = folder.path();
    let (alone, taken) = run(dir, "alone", &["--no-cache"]);
    assert!(!taken && !dir.join("kept").exists());
    assert_eq!(run(dir, "first", &[]), (alone.clone(), false));
    assert_eq!(run(dir, "second", &[]), (alone.clone(), true));
    assert_eq!(run(dir, "anew", &["--no-cache"]), (alone.clone(), false));
    assert!(!run(dir, "other", &["--seed", "2"]).1);
    rheotaxis(dir, &["picture", "s.ron", "--at=-3,0,-2"]).with(0);
    assert_eq!(files(&dir.join("kept")).len(), 2, "a picture takes it too");
    common::write(dir, "s.ron", &common::short("uniform_channel", 60.0, 6.0));
    let (other, taken) = run(dir, "longer", &[]);
    assert!(taken && other != alone);
    let secret = ["--key", "9 plovers, 3 whelks"];
    assert!(!run(dir, "keyed", &secret).1 && !run(dir, "keyed", &secret).1);
    assert_eq!(files(&dir.join("kept")).len(), 2);

    let told = |args: &[&str]| rheotaxis(dir, args).out;
    let place = dir.join("kept");
    says(&told(&["cache"]), &[place.to_str().unwrap(), "2 spin-ups, ", "2.0 GB"]);
    fs::write(place.join("notes.txt"), "mine").unwrap();
    says(&told(&["cache", "clear"]), &["removed 2 spin-ups"]);
    assert_eq!(files(&place), [place.join("notes.txt")]);
    says(&told(&["cache"]), &["0 spin-ups, 0 MB"]);
    assert_eq!(run(dir, "after", &[]), (other, false));
}

#[test]
fn scenarios_of_one_command_that_share_a_plume_take_it_together() {
    let folder = folder();
    let dir = folder.path();
    common::write(dir, "t.ron", &common::short("uniform_channel", 60.0, 4.0));
    let both = |out: &str, more: &[&str]| {
        let args = ["run", "s.ron", "t.ron", "--no-zenoh", "--no-record", "--out", out];
        let said = rheotaxis(dir, &[&args, more].concat()).with(3).err;
        let made = ["s", "t"].map(|name| made(&dir.join(out).join(name)));
        // Each says so when it begins its mission.
        let taken = made.iter().filter(|(_, taken)| *taken).count();
        assert_eq!(said.matches(TAKEN).count(), taken, "{said}");
        (made, said)
    };
    let taken = |of: [(String, bool); 2]| of.map(|(digest, _)| (digest, true));
    let (alone, _) = both("alone", &["--no-cache"]);
    assert!(!dir.join("kept").exists() && alone[0] != alone[1]);
    assert_eq!(both("first", &[]).0, alone);
    assert_eq!(files(&dir.join("kept")).len(), 1);
    assert_eq!(both("second", &[]).0, taken(alone.clone()));
    assert_eq!(run(dir, "s", &[]), taken(alone.clone())[0]);
    // A folder that cannot be used is told once, and the runs go on.
    fs::remove_dir_all(dir.join("kept")).unwrap();
    fs::write(dir.join("kept"), "a file").unwrap();
    let (made, said) = both("without", &[]);
    assert_eq!(made, alone);
    assert_eq!(said.matches("spin-ups are not kept").count(), 1, "{said}");
    says(&rheotaxis(dir, &["cache"]).with(1).err, &["kept"]);
}

#[test]
fn another_build_of_the_program_makes_its_own() {
    let folder = folder();
    let dir = folder.path();
    let (digest, _) = run(dir, "first", &[]);
    // The same code, but not the same file: as a build would be that differs in one byte.
    let other = dir.join("rheotaxis");
    fs::copy(common::binary(), &other).unwrap();
    let mut file = fs::File::options().append(true).open(&other).unwrap();
    std::io::Write::write_all(&mut file, &[0]).unwrap();
    drop(file);
    let by_other = |out: &str| {
        let mut command = Command::new(&other);
        command.args(["run", "s.ron", "--no-zenoh", "--no-record", "--out", out]).current_dir(dir);
        cached(common::apart(&mut command), dir).with(3);
        made(&dir.join(out))
    };
    assert_eq!(by_other("other"), (digest.clone(), false), "it does not trust the other program");
    assert_eq!(by_other("again"), (digest, true));
    assert!(run(dir, "second", &[]).1);
    assert_eq!(files(&dir.join("kept")).len(), 2);
}

#[cfg(unix)]
#[test]
fn a_full_disk_keeps_nothing_and_stops_nothing() {
    let folder = folder();
    let dir = folder.path();
    common::write(dir, "s.ron", &common::short("uniform_channel", 600.0, 1.0));
    let (alone, _) = run(dir, "alone", &["--no-cache"]);
    let args = "run s.ron --no-zenoh --no-record --out out";
    let said = cached(&mut common::with_little_room(dir, 64, args), dir).err;
    says(&said, &["spin-ups are not kept", "too large"]);
    assert_eq!(common::digest(&dir.join("out")), alone, "{said}");
    assert_eq!(files(&dir.join("kept")).len(), 0, "nothing half done");
}

const CAMPAIGN: &str = r#"(
    version: 2,
    title: "Two speeds",
    base: "s.ron",
    seeds: 2,
    arms: [
        (name: "slow", set: [("robots[0].strategy.speed_m_s", "1.2")]),
        (name: "fast"),
    ],
)
"#;

const ROW: &str = r#"(
    id: "channel",
    what: "A channel, cut short",
    source: "made for this test",
    scenario: "s.ron",
    figures: [(name: "path", quantity: Median(travelled_m))],
)"#;

#[test]
fn campaigns_and_reproduced_rows_share_it_with_runs() {
    let folder = folder();
    let dir = folder.path();
    fs::write(dir.join("c.ron"), CAMPAIGN).unwrap();
    fs::write(dir.join("row.ron"), ROW).unwrap();
    let kept = || files(&dir.join("kept")).len();
    let campaign = |out: &str, more: &[&str]| {
        let args = ["campaign", "run", "c.ron", "--out", out, "--quiet", "--jobs", "2"];
        rheotaxis(dir, &[&args, more].concat()).with(0);
        let rows = studies::campaign::read_rows(&dir.join(out)).unwrap();
        let mut rows: Vec<_> = rows.into_iter().map(|r| (r.run, r.digest)).collect();
        rows.sort();
        rows
    };
    let alone = campaign("alone", &["--no-cache"]);
    assert!(!dir.join("kept").exists());
    // The arms of a seed share one.
    for out in ["first", "second"] {
        assert_eq!(campaign(out, &[]), alone);
        assert_eq!(kept(), 2);
    }
    let (digest, taken) = run(dir, "run", &["--seed", "2"]);
    assert!(taken && alone.iter().any(|(_, d)| *d == digest));
    rheotaxis(dir, &["reproduce", "row.ron", "--seeds", "3", "--quiet", "--out", "rows"]).with(0);
    assert_eq!(kept(), 3);
    assert!(run(dir, "third", &["--seed", "3"]).1);
    // A rerun is a check of a row, and makes everything anew.
    fs::remove_dir_all(dir.join("kept")).unwrap();
    rheotaxis(dir, &["campaign", "rerun", "first", "--run", "1", "--quiet"]).with(0);
    assert!(!dir.join("kept").exists());
}
