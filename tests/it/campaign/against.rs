//! `campaign report`: the arm that is asked for, the rule of success, and tables that fit the terminal.

use super::{campaign, ends, folder, scheduler_free};
use crate::common;
use std::fs;

#[test]
fn a_report_compares_with_the_arm_that_is_asked_for_and_fits_the_terminal() {
    let folder = folder(2, "30", "4");
    let dir = folder.path();
    ends(dir, 0, &["run", "c.ron", "--out", "out", "--quiet"]);
    let report = ["report", "out", "--no-tracks", "--quiet"];
    for (against, pair) in [("fast", "slow,fast,"), ("slow", "fast,slow,")] {
        ends(dir, 0, &[&report[..], &["--against", against]].concat());
        let csv = fs::read_to_string(dir.join("out/report/differences.csv")).unwrap();
        let lines: Vec<&str> = csv.lines().skip(1).collect();
        assert!(!lines.is_empty() && lines.iter().all(|l| l.starts_with(pair)), "{csv}");
    }
    let (_, said) = ends(dir, 1, &[&report[..], &["--against", "quick"]].concat());
    assert!(said.contains("there is no arm \"quick\"") && said.contains("slow, fast"), "{said}");

    let wide = String::from_utf8(campaign(dir, &report).stdout).unwrap();
    for says in
        ["Success: a source is declared within", "Pooled: each figure of an arm is over all 2 conditions", "success, %"]
    {
        assert!(wide.contains(says), "{says}: {wide}");
    }
    let args = [&["campaign"][..], &report].concat();
    let mut narrow = scheduler_free(common::command(dir, &args));
    let ended = narrow.env("COLUMNS", "72").output().expect("rheotaxis starts");
    let narrow = String::from_utf8(ended.stdout).unwrap();
    assert_ne!(narrow, wide);
    for line in narrow.lines() {
        assert!(line.chars().count() <= 72, "{line}");
    }
}
