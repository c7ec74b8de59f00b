//! The table of the papers' figures: from a row file to its results.

use crate::common::{Ended, rheotaxis_in, says, short, write};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A row with this name and more fields.
fn row(id: &str, more: &str) -> String {
    format!(
        r#"(
    id: "{id}",
    what: "A channel, cut short",
    source: "made for this test",
    scenario: "channel.ron",
    {more}
    figures: [
        (name: "declared", quantity: Share(declared), paper: Count(7, 8), note: "of | 8"),
        (name: "error", quantity: Median(error_m), paper: Run(1e6)),
        (name: "path", quantity: Median(travelled_m)),
    ],
)"#
    )
}

/// A folder with these rows, whose scenario runs in a fraction of a second.
fn folder(rows: &[(&str, String)]) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "channel.ron", &short("uniform_channel", 200.0, 120.0));
    for (file, text) in rows {
        fs::write(dir.path().join(file), text).unwrap();
    }
    dir
}

fn reproduce(dir: &TempDir, options: &[&str]) -> Ended {
    rheotaxis_in(dir.path(), &[&["reproduce"], options].concat())
}

/// Lines of a CSV without the columns of wall time.
fn without_walls(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let keep = |line: &str| {
        let cells = line.split(',').zip(&head).filter(|(_, name)| !name.ends_with("_wall_s"));
        cells.map(|(cell, _)| cell).collect::<Vec<_>>().join(",")
    };
    text.lines().map(keep).collect()
}

/// How many runs the rows in the folder `o` have.
fn runs(dir: &TempDir) -> usize {
    without_walls(&dir.path().join("o/rows.csv")).len() - 1
}

#[test]
fn one_thread_and_two_write_the_same_table() {
    let dir = folder(&[("row.ron", row("channel", ""))]);
    for jobs in ["1", "2"] {
        let out = reproduce(&dir, &["--quiet", "row.ron", "--seeds", "3", "--jobs", jobs, "--out", jobs]).with(0).out;
        says(&out, &["3 runs, seeds 1 to 3", "7/8 = 87.5 % [52.9 to 97.8 %]", "too few (n = 3)", "spin-up", "mission"]);
    }
    let table = |jobs: &str| fs::read_to_string(dir.path().join(jobs).join("figures.csv")).unwrap();
    assert_eq!(table("1"), table("2"));
    assert_eq!(table("1").lines().count(), 1 + 3);
    let rows = |jobs: &str| without_walls(&dir.path().join(jobs).join("rows.csv"));
    assert_eq!(rows("1"), rows("2"));
    assert_eq!(rows("1").len(), 1 + 3);
    let page = fs::read_to_string(dir.path().join("1/REPRODUCTION.md")).unwrap();
    says(&page, &["## channel", "made for this test", "| declared | ", "- declared: of | 8."]);
}

#[test]
fn arms_are_asked_for_by_name_and_trials_counted_before_they_are_made() {
    let arms = row("channel", "arms: [(name: \"a\"), (name: \"b\")],").replace("quantity:", "arm: \"b\", quantity:");
    let dir = folder(&[("arms.ron", arms)]);
    let go = |arm: &[&str]| reproduce(&dir, &[&["arms.ron", "--seeds", "1", "--out", "o"], arm].concat());
    says(&go(&[]).with(0).err, &["channel (2 arms): 1 seed each, 2 trials"]);
    says(&go(&["--arm", "b"]).with(0).err, &["channel: 1 seed each, 1 trial"]);
    assert_eq!(runs(&dir), 1);
    says(&go(&["--arm", "c"]).with(1).err, &["`c`", "`a`, `b`"]);
}

#[test]
fn a_first_look_takes_the_seeds_of_each_row_and_says_what_is_left() {
    let dir = folder(&[("some.ron", row("some", "quick: 3,")), ("few.ron", row("few", "quick: 2,"))]);
    let args = ["some.ron", "few.ron", "--quick", "--jobs", "1", "--out", "o"];
    let said = reproduce(&dir, &args).with(0).err;
    let lines: Vec<&str> = said.lines().collect();
    // A seed of each row first: then it is known what the other three take.
    for (line, begin) in [
        "some (3 seeds), few (2 seeds): 5 trials",
        "some: 1 trial done",
        "few: 1 trial done, about ",
        "some: 3 trials done, about ",
        "few: 2 trials done, about ",
    ]
    .iter()
    .enumerate()
    {
        assert!(lines[line].starts_with(begin), "{begin}: {said}");
    }
    assert!(!lines[1].contains("left"), "{said}");
    assert_eq!(runs(&dir), 5);
}

#[test]
fn it_stops_by_width_or_at_the_most_allowed() {
    let dir = folder(&[("row.ron", row("channel", ""))]);
    let n = |width: &str, most: &str| {
        reproduce(&dir, &["--quiet", "row.ron", "--until-width", width, "--max", most, "--out", "o"]).with(0);
        runs(&dir)
    };
    // A half width of 0.3 needs 8 runs at most, but the first look comes after 20.
    assert_eq!(n("0.3", "100"), 20);
    assert_eq!(n("0.001", "2"), 2);
}

#[test]
fn wrong_rows_folders_and_options_are_refused_before_anything_runs() {
    let dir = folder(&[("bad.ron", row("channel", "").replace("declared)", "luck)")), ("file", String::new())]);
    for (args, parts) in [
        (&["nobody"][..], ["nobody", "duck_st"]),
        (&["bad.ron"], ["bad.ron", "luck"]),
        (&["duck_st", "--out", "file/out"], ["file/out"; 2]),
    ] {
        says(&reproduce(&dir, args).with(1).err, &parts);
    }
    for usage in [&["--quick", "--seeds", "5"][..], &["--max", "5"], &["--until-width", "0.5"], &["--seeds", "0"]] {
        assert_eq!(reproduce(&dir, usage).code, Some(2), "{usage:?}");
    }
}

/// Kept runs are taken, added to and checked; those of another program are out of date.
#[test]
fn kept_runs_stay_and_are_checked() {
    let dir = folder(&[("row.ron", row("channel", ""))]);
    let go = |code: i32, more: &[&str]| {
        let args = ["--quiet", "row.ron", "--keep", "kept", "--out", "out"];
        reproduce(&dir, &[&args, more].concat()).with(code)
    };
    let file = dir.path().join("kept/channel.csv");
    let kept = || fs::read_to_string(&file).unwrap();
    go(0, &["--seeds", "2"]);
    let two = kept();
    // A head, the names, and a line for each run.
    assert_eq!(two.lines().count(), 4, "{two}");
    says(&go(0, &["--seeds", "3"]).out, &["3 runs, seeds 1 to 3"]);
    let three = kept();
    assert_eq!(three.lines().count(), 5);
    // But the head, which has a fingerprint of the rows.
    let rows = || two.lines().zip(three.lines()).skip(1);
    assert!(rows().all(|(a, b)| a == b));
    says(&go(0, &["--no-runs", "--check", "3"]).out, &["3 runs, seeds 1 to 3"]);
    let digest = three.lines().nth(2).unwrap().split(',').nth(8).unwrap();
    assert_eq!(digest.len(), 32);
    fs::write(&file, three.replace(digest, &"0".repeat(32))).unwrap();
    says(&go(1, &["--seeds", "4", "--check", "3"]).err, &["channel.csv", "changed", "--anew"]);
    go(0, &["--seeds", "2", "--check", "3", "--anew"]);
    assert_eq!(kept(), two);
}
