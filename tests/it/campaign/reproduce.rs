//! The table of the papers' figures: from a row file to its results.

use crate::common::rheotaxis_in;
use std::fs;
use std::path::Path;

const ROW: &str = r#"(
    id: "channel",
    what: "A channel, cut short",
    source: "made for this test",
    scenario: "channel.ron",
    figures: [
        (name: "declared", quantity: Share(declared), paper: Count(7, 8), note: "of | 8"),
        (name: "error", quantity: Median(error_m), paper: Run(1e6)),
        (name: "path", quantity: Median(travelled_m)),
    ],
)"#;

/// A row whose scenario runs in a fraction of a second.
fn write_row(dir: &Path) {
    let text = include_str!("../../../scenarios/catalog/uniform_channel.ron");
    let short = crate::common::with_fields(text, &[("spin_up_s", "200"), ("limit_s", "120")]);
    fs::write(dir.join("channel.ron"), short).unwrap();
    fs::write(dir.join("row.ron"), ROW).unwrap();
}

fn reproduce(dir: &Path, options: &[&str]) -> (Option<i32>, String, String) {
    let mut args = vec!["reproduce", "--quiet"];
    args.extend_from_slice(options);
    let end = rheotaxis_in(dir, &args);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (end.status.code(), text(&end.stdout), text(&end.stderr))
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

#[test]
fn writes_the_same_table_with_one_thread_and_with_two() {
    let dir = tempfile::tempdir().unwrap();
    write_row(dir.path());
    for jobs in ["1", "2"] {
        let (code, out, error) = reproduce(dir.path(), &["row.ron", "--seeds", "3", "--jobs", jobs, "--out", jobs]);
        assert_eq!(code, Some(0), "{error}");
        assert!(out.contains("3 runs, seeds 1 to 3"), "{out}");
        assert!(out.contains("7/8 = 87.5 % [52.9 to 97.8 %]"), "{out}");
        assert!(out.contains("too few (n = 3)"), "{out}");
        assert!(out.contains("spin-up") && out.contains("mission"), "{out}");
    }
    let table = |jobs: &str| fs::read_to_string(dir.path().join(jobs).join("figures.csv")).unwrap();
    assert_eq!(table("1"), table("2"));
    assert_eq!(table("1").lines().count(), 1 + 3);
    let rows = |jobs: &str| without_walls(&dir.path().join(jobs).join("rows.csv"));
    assert_eq!(rows("1"), rows("2"));
    assert_eq!(rows("1").len(), 1 + 3);
    let page = fs::read_to_string(dir.path().join("1/REPRODUCTION.md")).unwrap();
    for says in ["## channel", "made for this test", "| declared | ", "- declared: of | 8."] {
        assert!(page.contains(says), "{says}: {page}");
    }
}

#[test]
fn says_first_how_many_trials_it_makes() {
    let dir = tempfile::tempdir().unwrap();
    write_row(dir.path());
    let arms = ROW.replace("figures:", "arms: [(name: \"a\"), (name: \"b\")], figures:");
    let arms = arms.replace("quantity:", "arm: \"b\", quantity:");
    fs::write(dir.path().join("arms.ron"), arms).unwrap();
    let said = |options: &[&str]| {
        let mut args = vec!["reproduce", "--seeds", "1", "--out", "o"];
        args.extend_from_slice(options);
        let end = rheotaxis_in(dir.path(), &args);
        let said = String::from_utf8_lossy(&end.stderr).into_owned();
        assert!(end.status.success(), "{said}");
        said
    };
    let both = said(&["arms.ron"]);
    assert!(both.contains("channel (2 arms): 1 seed each, 2 trials"), "{both}");
    let one = said(&["arms.ron", "--arm", "b"]);
    assert!(one.contains("channel: 1 seed each, 1 trial"), "{one}");
    assert_eq!(without_walls(&dir.path().join("o/rows.csv")).len(), 1 + 1);
    let (code, _, error) = reproduce(dir.path(), &["arms.ron", "--arm", "c"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("no row asked for has an arm `c`; there are: `a`, `b`"), "{error}");
}

#[test]
fn a_first_look_takes_the_seeds_of_each_row_and_says_what_is_left() {
    let dir = tempfile::tempdir().unwrap();
    write_row(dir.path());
    for (id, seeds) in [("some", 3), ("few", 2)] {
        let row = ROW.replace("id: \"channel\"", &format!("id: \"{id}\""));
        let row = row.replace("figures:", &format!("quick: {seeds}, figures:"));
        fs::write(dir.path().join(format!("{id}.ron")), row).unwrap();
    }
    let args = ["reproduce", "some.ron", "few.ron", "--quick", "--jobs", "1", "--out", "o"];
    let end = rheotaxis_in(dir.path(), &args);
    let said = String::from_utf8_lossy(&end.stderr).into_owned();
    assert!(end.status.success(), "{said}");
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
    assert_eq!(without_walls(&dir.path().join("o/rows.csv")).len(), 1 + 5);
}

#[test]
fn stops_by_width_or_at_the_most_allowed() {
    let dir = tempfile::tempdir().unwrap();
    write_row(dir.path());
    let n = |width: &str, most: &str| {
        let (code, _, error) = reproduce(dir.path(), &["row.ron", "--until-width", width, "--max", most, "--out", "o"]);
        assert_eq!(code, Some(0), "{error}");
        without_walls(&dir.path().join("o/rows.csv")).len() - 1
    };
    // A half width of 0.3 needs 8 runs at most, but the first look comes after 20.
    assert_eq!(n("0.3", "100"), 20);
    assert_eq!(n("0.001", "2"), 2);
}

#[test]
fn wrong_rows_folders_and_options_are_refused_before_anything_runs() {
    let dir = tempfile::tempdir().unwrap();
    let (code, _, error) = reproduce(dir.path(), &["nobody"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("no row `nobody`") && error.contains("duck_st"), "{error}");

    fs::write(dir.path().join("bad.ron"), ROW.replace("declared)", "luck)")).unwrap();
    let (code, _, error) = reproduce(dir.path(), &["bad.ron"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("bad.ron") && error.contains("luck"), "{error}");

    fs::write(dir.path().join("file"), "").unwrap();
    let (code, _, error) = reproduce(dir.path(), &["duck_st", "--out", "file/out"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("file/out"), "{error}");

    for usage in [&["--quick", "--seeds", "5"][..], &["--max", "5"], &["--until-width", "0.5"], &["--seeds", "0"]] {
        assert_eq!(reproduce(dir.path(), usage).0, Some(2), "{usage:?}");
    }
}

/// Kept runs are taken, added to and checked; those of another program are out of date.
#[test]
fn kept_runs_stay_and_are_checked() {
    let dir = tempfile::tempdir().unwrap();
    write_row(dir.path());
    let go = |more: &[&str]| {
        let mut args = vec!["row.ron", "--keep", "kept", "--out", "out"];
        args.extend_from_slice(more);
        reproduce(dir.path(), &args)
    };
    let file = dir.path().join("kept/channel.csv");
    let kept = || fs::read_to_string(&file).unwrap();
    let (code, _, error) = go(&["--seeds", "2"]);
    assert_eq!(code, Some(0), "{error}");
    let two = kept();
    // A head, the names, and a line for each run.
    assert_eq!(two.lines().count(), 4, "{two}");
    let (code, out, error) = go(&["--seeds", "3"]);
    assert_eq!(code, Some(0), "{error}");
    assert!(out.contains("3 runs, seeds 1 to 3"), "{out}");
    let three = kept();
    assert_eq!(three.lines().count(), 5);
    // But the head, which has a fingerprint of the rows.
    let rows = || two.lines().zip(three.lines()).skip(1);
    assert!(rows().all(|(a, b)| a == b));
    let (code, out, error) = go(&["--no-runs", "--check", "3"]);
    assert_eq!(code, Some(0), "{error}");
    assert!(out.contains("3 runs, seeds 1 to 3"), "{out}");
    let digest = three.lines().nth(2).unwrap().split(',').nth(8).unwrap();
    assert_eq!(digest.len(), 32);
    fs::write(&file, three.replace(digest, &"0".repeat(32))).unwrap();
    let (code, _, error) = go(&["--seeds", "4", "--check", "3"]);
    assert_eq!(code, Some(1));
    for says in ["channel.csv", "changed after it was written", "--anew"] {
        assert!(error.contains(says), "{says}: {error}");
    }
    let (code, _, error) = go(&["--seeds", "2", "--check", "3", "--anew"]);
    assert_eq!(code, Some(0), "{error}");
    assert_eq!(kept(), two);
}
