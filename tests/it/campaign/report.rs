//! `campaign report`: the arm that is asked for, tables that fit the terminal, and the tracks of some runs.

use super::{ends, folder, rows};
use crate::common::{self, Ended, says};
use std::fs;
use std::path::Path;
use studies::campaign::{Manifest, RunRow};
use world::registry::Registry;

const RUN: [&str; 5] = ["run", "c.ron", "--out", "out", "--quiet"];
const FILM: &str = "<section class=\"film\"";

fn page(dir: &Path, report: &str) -> String {
    fs::read_to_string(dir.join(report).join("report.html")).unwrap()
}

#[test]
fn best_median_and_worst_run_of_each_arm_are_made_anew() {
    let folder = folder(2, 60.0, 20.0);
    let dir = folder.path();
    ends(dir, 0, &RUN);
    let report = |to: &str, more: &[&str]| {
        let args = ["report", "out", "--quiet", "--out", to];
        ends(dir, 0, &[&args, more].concat());
        page(dir, to)
    };
    let one = report("one", &["--jobs", "1"]);
    assert_eq!(one.matches(FILM).count(), 6, "three of each arm");
    let stills = "<figure class=\"still\"><img src=\"data:image/png;base64,iVBOR";
    assert_eq!(one.matches(stills).count(), 6, "for print");
    says(&one, &["slow, sources[0].rate_g_s=", ": median run, number"]);
    assert!(one.len() < 3_000_000, "{} bytes", one.len());
    assert!(one == report("two", &["--jobs", "2"]), "on any number of threads");
    let none = report("none", &["--no-tracks"]);
    assert!(!none.contains(FILM) && !none.contains("<script"));

    // A row of another version of the program is told, and its run is not shown for it.
    let campaign = Manifest::open(&dir.join("out")).unwrap().campaign(&Registry::default()).unwrap();
    let row = rows(&dir.join("out")).swap_remove(3);
    assert!(campaign.film(&row).is_ok());
    let other = |row: RunRow| campaign.film(&row).expect_err("not that run");
    let digest = "0".repeat(32);
    says(&other(RunRow { digest: digest.clone(), ..row.clone() }), &["out of date", &digest]);
    says(&other(RunRow { seed: 77, ..row }), &["another campaign"]);

    // The arm that is asked for, and a narrow terminal.
    for (against, pair) in [("fast", "slow,fast,"), ("slow", "fast,slow,")] {
        report("against", &["--no-tracks", "--against", against]);
        let csv = fs::read_to_string(dir.join("against/differences.csv")).unwrap();
        let lines: Vec<&str> = csv.lines().skip(1).collect();
        assert!(!lines.is_empty() && lines.iter().all(|l| l.starts_with(pair)), "{csv}");
    }
    let (_, said) = ends(dir, 1, &["report", "out", "--no-tracks", "--quiet", "--against", "quick"]);
    says(&said, &["quick", "slow, fast"]);
    let mut narrow = common::command(dir, &["campaign", "report", "out", "--no-tracks", "--quiet"]);
    let narrow = Ended::of(narrow.env("COLUMNS", "72")).out;
    says(&narrow, &["Success: a source is declared within", "Pooled: "]);
    for line in narrow.lines() {
        assert!(line.chars().count() <= 72, "{line}");
    }
}

#[test]
fn without_its_key_a_campaign_is_reported_without_tracks() {
    let folder = folder(1, 30.0, 5.0);
    let dir = folder.path();
    let key = ["--key", "9 plovers, 3 whelks"];
    ends(dir, 0, &[&RUN[..], &key].concat());
    let (_, said) = ends(dir, 0, &["report", "out", "--quiet"]);
    says(&said, &["no tracks are shown", "--key"]);
    assert!(!page(dir, "out/report").contains(FILM));
    ends(dir, 0, &[&["report", "out", "--quiet"][..], &key].concat());
    assert!(page(dir, "out/report").contains(FILM));
}
