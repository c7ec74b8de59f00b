//! The page of a campaign shows the tracks of its best, median and worst runs.

use super::{ends, folder, rows};
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
    let folder = folder(2, "60", "20");
    let dir = folder.path();
    ends(dir, 0, &RUN);
    let report = |to: &str, more: &[&str]| {
        let args = ["report", "out", "--quiet", "--out", to];
        ends(dir, 0, &[&args, more].concat()).1
    };
    report("one", &["--jobs", "1"]);
    let one = page(dir, "one");
    assert_eq!(one.matches(FILM).count(), 6, "three of each arm");
    let stills = "<figure class=\"still\"><img src=\"data:image/png;base64,iVBOR";
    assert_eq!(one.matches(stills).count(), 6, "for print");
    for says in ["Best, median and worst run", "slow, sources[0].rate_g_s=", ": median run, number"] {
        assert!(one.contains(says), "{says}");
    }
    assert!(one.len() < 3_000_000, "{} bytes", one.len());
    report("two", &["--jobs", "2"]);
    assert!(one == page(dir, "two"), "on any number of threads");
    report("none", &["--no-tracks"]);
    let none = page(dir, "none");
    assert!(!none.contains(FILM) && !none.contains("<script"));

    // A row of another version of the program is told, and its run is not shown for it.
    let campaign = Manifest::open(&dir.join("out")).unwrap().campaign(&Registry::default()).unwrap();
    let row = rows(&dir.join("out")).swap_remove(3);
    assert!(campaign.film(&row).is_ok());
    let other = |row: RunRow| campaign.film(&row).expect_err("not that run");
    let digest = "0".repeat(32);
    let said = other(RunRow { digest: digest.clone(), ..row.clone() });
    assert!(said.contains("its row is out of date") && said.contains(&digest), "{said}");
    assert_eq!(other(RunRow { seed: 77, ..row }), "its row is of another campaign");
}

#[test]
fn without_its_key_a_campaign_is_reported_without_tracks() {
    let folder = folder(1, "30", "5");
    let dir = folder.path();
    let key = ["--key", "9 plovers, 3 whelks"];
    ends(dir, 0, &[&RUN[..], &key].concat());
    let (_, said) = ends(dir, 0, &["report", "out", "--quiet"]);
    assert!(said.contains("no tracks are shown: "), "{said}");
    assert!(said.contains("give it with --key"), "{said}");
    assert!(!page(dir, "out/report").contains(FILM));
    ends(dir, 0, &[&["report", "out", "--quiet"][..], &key].concat());
    assert!(page(dir, "out/report").contains(FILM));
}
