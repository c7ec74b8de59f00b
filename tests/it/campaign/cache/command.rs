//! The cache of the command: on by default, shown and cleared, and never in the way.

use super::kit::files;
use crate::common;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A folder with a short mission, `s.ron`, that ends without success.
fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let text = include_str!("../../../../scenarios/catalog/uniform_channel.ron");
    let short = common::with_fields(text, &[("spin_up_s", "60"), ("limit_s", "5")]);
    fs::write(dir.path().join("s.ron"), short).unwrap();
    dir
}

/// Turns the cache of a command on, in `<dir>/kept`, for whatever is made, however quickly.
fn cached<'a>(command: &'a mut Command, dir: &Path) -> &'a mut Command {
    command.env_remove("RHEOTAXIS_NO_CACHE").env("RHEOTAXIS_CACHE", dir.join("kept")).env("RHEOTAXIS_CACHE_FROM", "0")
}

fn rheotaxis(dir: &Path, args: &[&str]) -> Output {
    let mut command = common::command(dir, args);
    cached(&mut command, dir).output().expect("rheotaxis starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[track_caller]
fn summary(dir: &Path, out: &str) -> Value {
    let path = dir.join(out).join("summary.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

const TAKEN: &str = "spin-up taken from the cache";

/// Runs the mission; its digest, and whether its spin-up was taken from the cache.
#[track_caller]
fn run(dir: &Path, out: &str, more: &[&str]) -> (String, bool) {
    let args = ["run", "s.ron", "--no-zenoh", "--no-record", "--out", out];
    let end = rheotaxis(dir, &[&args, more].concat());
    let said = text(&end.stderr);
    assert_eq!(end.status.code(), Some(3), "{said}");
    let summary = summary(dir, out);
    let taken = summary["run"]["spin_up_kept"].as_bool().unwrap();
    assert_eq!(said.contains(TAKEN), taken, "{said}");
    assert_eq!(text(&end.stdout).contains(", taken from the cache"), taken);
    (summary["digest"].as_str().unwrap().to_string(), taken)
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
    let at = ["picture", "s.ron", "--at=-3,0,-2"];
    assert!(rheotaxis(dir, &at).status.success());
    assert_eq!(files(&dir.join("kept")).len(), 2, "a picture takes it too");
    let faster = fs::read_to_string(dir.join("s.ron")).unwrap();
    let faster = common::with_fields(&faster, &[("limit_s", "6")]);
    fs::write(dir.join("s.ron"), faster).unwrap();
    let (other, taken) = run(dir, "longer", &[]);
    assert!(taken && other != alone);
    let secret = ["--key", "9 plovers, 3 whelks"];
    assert!(!run(dir, "keyed", &secret).1 && !run(dir, "keyed", &secret).1);
    assert_eq!(files(&dir.join("kept")).len(), 2);

    let told = |args: &[&str]| text(&rheotaxis(dir, args).stdout);
    let shown = told(&["cache"]);
    let place = dir.join("kept");
    assert!(shown.starts_with(place.to_str().unwrap()), "{shown}");
    assert!(shown.contains("2 spin-ups, ") && shown.contains("2.0 GB"), "{shown}");
    fs::write(place.join("notes.txt"), "mine").unwrap();
    let cleared = told(&["cache", "clear"]);
    assert!(cleared.starts_with("removed 2 spin-ups"), "{cleared}");
    assert_eq!(files(&place), [place.join("notes.txt")]);
    assert!(told(&["cache"]).contains("0 spin-ups, 0 MB"));
    assert_eq!(run(dir, "after", &[]), (other, false));
}

#[test]
fn scenarios_of_one_command_that_share_a_plume_take_it_together() {
    let folder = folder();
    let dir = folder.path();
    let s = fs::read_to_string(dir.join("s.ron")).unwrap();
    fs::write(dir.join("t.ron"), common::with_fields(&s, &[("limit_s", "4")])).unwrap();
    let both = |out: &str, more: &[&str]| {
        let args = ["run", "s.ron", "t.ron", "--no-zenoh", "--no-record", "--out", out];
        let end = rheotaxis(dir, &[&args, more].concat());
        let said = text(&end.stderr);
        assert_eq!(end.status.code(), Some(3), "{said}");
        ["s", "t"].map(|name| {
            let summary = summary(&dir.join(out), name);
            let taken = summary["run"]["spin_up_kept"].as_bool().unwrap();
            // Each says so when it begins its mission.
            assert_eq!(said.matches(TAKEN).count(), if taken { 2 } else { 0 }, "{said}");
            (summary["digest"].as_str().unwrap().to_string(), taken)
        })
    };
    let taken = |of: [(String, bool); 2]| of.map(|(digest, _)| (digest, true));
    let alone = both("alone", &["--no-cache"]);
    assert!(!dir.join("kept").exists() && alone[0] != alone[1]);
    assert_eq!(both("first", &[]), alone);
    assert_eq!(files(&dir.join("kept")).len(), 1);
    assert_eq!(both("second", &[]), taken(alone.clone()));
    assert_eq!(run(dir, "s", &[]), taken(alone)[0]);
}

#[test]
fn another_build_of_the_program_makes_its_own() {
    let folder = folder();
    let dir = folder.path();
    let (digest, _) = run(dir, "first", &[]);
    // The same code, but not the same file: as a build would be that differs in one byte.
    let other = dir.join("rheotaxis");
    let mut bytes = fs::read(common::binary()).unwrap();
    bytes.push(0);
    fs::write(&other, bytes).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(&other, fs::Permissions::from_mode(0o755)).unwrap();
    }
    let by_other = |out: &str| {
        let mut command = Command::new(&other);
        command.args(["run", "s.ron", "--no-zenoh", "--no-record", "--out", out]);
        let end = cached(common::apart(command.current_dir(dir)), dir).output();
        let end = end.expect("it starts");
        assert_eq!(end.status.code(), Some(3), "{}", text(&end.stderr));
        let summary = summary(dir, out);
        assert_eq!(summary["digest"], digest.as_str());
        summary["run"]["spin_up_kept"].as_bool().unwrap()
    };
    assert!(!by_other("other"), "it does not trust the other program");
    assert!(by_other("again"));
    assert!(run(dir, "second", &[]).1);
    assert_eq!(files(&dir.join("kept")).len(), 2);
}

#[test]
fn processes_at_once_leave_one_whole_file() {
    let folder = folder();
    let dir = folder.path();
    let children: Vec<_> = (0..3)
        .map(|n| {
            let out = n.to_string();
            let args = ["run", "s.ron", "--no-zenoh", "--no-record", "--out", &out];
            let mut command = common::command(dir, &args);
            command.stderr(std::process::Stdio::piped());
            command.stdout(std::process::Stdio::null());
            cached(&mut command, dir).spawn().expect("it starts")
        })
        .collect();
    let ends: Vec<_> = (children.into_iter()).map(|c| c.wait_with_output().unwrap()).collect();
    for (n, end) in ends.iter().enumerate() {
        let said = text(&end.stderr);
        assert_eq!(end.status.code(), Some(3), "{said}");
        assert!(!said.contains("damaged") && !said.contains("not kept"), "{said}");
        assert_eq!(summary(dir, &n.to_string())["digest"], summary(dir, "0")["digest"]);
    }
    assert_eq!(files(&dir.join("kept")).len(), 1);
    let (digest, taken) = run(dir, "after", &[]);
    assert!(taken && summary(dir, "0")["digest"] == digest.as_str());
}

#[test]
fn a_cache_that_cannot_be_used_is_told_once_and_the_runs_go_on() {
    let folder = folder();
    let dir = folder.path();
    let (alone, _) = run(dir, "alone", &["--no-cache"]);
    fs::write(dir.join("kept"), "a file").unwrap();
    fs::copy(dir.join("s.ron"), dir.join("t.ron")).unwrap();
    let args = ["run", "s.ron", "t.ron", "--no-zenoh", "--out", "out"];
    let end = rheotaxis(dir, &args);
    let said = text(&end.stderr);
    assert_eq!(end.status.code(), Some(3), "{said}");
    assert_eq!(said.matches("spin-ups are not kept").count(), 1, "{said}");
    for name in ["out/s", "out/t"] {
        assert_eq!(summary(dir, name)["digest"], alone.as_str());
    }
    let shown = rheotaxis(dir, &["cache"]);
    assert_eq!(shown.status.code(), Some(1));
    assert!(text(&shown.stderr).contains("kept"));
}

/// A limit on the length of files stands for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_keeps_nothing_and_stops_nothing() {
    let folder = folder();
    let dir = folder.path();
    let many = fs::read_to_string(dir.join("s.ron")).unwrap();
    let many = common::with_fields(&many, &[("spin_up_s", "600"), ("limit_s", "1")]);
    fs::write(dir.join("s.ron"), many).unwrap();
    let (alone, _) = run(dir, "alone", &["--no-cache"]);
    let script = format!(
        "trap '' XFSZ; ulimit -f 64; exec '{}' run s.ron --no-zenoh --no-record --out out",
        common::binary().display()
    );
    let mut bash = Command::new("bash");
    bash.args(["-c", &script]).current_dir(dir);
    let end = cached(common::apart(&mut bash), dir).output().unwrap();
    let said = text(&end.stderr);
    assert!(said.contains("spin-ups are not kept"), "{said}");
    assert!(said.contains("too large"), "{said}");
    assert_eq!(summary(dir, "out")["digest"], alone.as_str(), "{said}");
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
    let done = |args: &[&str]| {
        let mut command = common::command(dir, args);
        let command = cached(&mut command, dir);
        for name in ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID", "JOB_COMPLETION_INDEX"] {
            command.env_remove(name);
        }
        let end = command.output().unwrap();
        assert_eq!(end.status.code(), Some(0), "{}", text(&end.stderr));
    };
    let campaign = |out: &'static str, more: &[&str]| {
        let args = ["campaign", "run", "c.ron", "--out", out, "--quiet", "--jobs", "2"];
        done(&[&args, more].concat());
        let digest = |r: studies::campaign::RunRow| (r.run, r.digest);
        let mut rows: Vec<_> = studies::campaign::read_rows(&dir.join(out)).unwrap().into_iter().map(digest).collect();
        rows.sort();
        rows
    };
    let alone = campaign("alone", &["--no-cache"]);
    assert!(!dir.join("kept").exists());
    assert_eq!(campaign("first", &[]), alone);
    // The arms of a seed share one.
    assert_eq!(files(&dir.join("kept")).len(), 2);
    assert_eq!(campaign("second", &[]), alone);
    assert_eq!(files(&dir.join("kept")).len(), 2);
    let (digest, taken) = run(dir, "run", &["--seed", "2"]);
    assert!(taken && alone.iter().any(|(_, d)| *d == digest));
    done(&["reproduce", "row.ron", "--seeds", "3", "--quiet", "--out", "rows"]);
    assert_eq!(files(&dir.join("kept")).len(), 3);
    assert!(run(dir, "third", &["--seed", "3"]).1);
    // A rerun is a check of a row, and makes everything anew.
    fs::remove_dir_all(dir.join("kept")).unwrap();
    done(&["campaign", "rerun", "first", "--run", "1", "--quiet"]);
    assert!(!dir.join("kept").exists());
}
