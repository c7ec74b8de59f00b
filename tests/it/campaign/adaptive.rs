//! Campaigns that end when enough is known.

use super::{ends, folder_of, rows};
use crate::common::says;
use std::path::Path;
use studies::campaign::stats::wilson;

fn half_widths(dir: &Path) -> Vec<(u64, f64)> {
    let rows = rows(dir);
    let cell = |row: &studies::campaign::RunRow| (row.arm.clone(), row.condition.clone());
    let mut cells: Vec<(String, String)> = rows.iter().map(cell).collect();
    cells.sort();
    cells.dedup();
    let one = |c: &(String, String)| {
        let of: Vec<_> = rows.iter().filter(|r| cell(r) == *c).collect();
        let found = of.iter().filter(|r| r.success).count() as u64;
        (of.len() as u64, wilson(found, of.len() as u64).half_width())
    };
    cells.iter().map(one).collect()
}

/// Four cells (two arms, two conditions), at most 400 seeds each. Nothing is found in one second: a share of 0 in n has
/// a
/// Wilson half width of 1.92 / (n + 3.84), so 0.05 takes 35 seeds; the first look, at 20, is not enough.
#[test]
fn it_stops_when_the_intervals_are_as_narrow_as_asked_and_shares_come_to_the_same_rows() {
    let dir = folder_of("400, until: (half_width: 0.05)", 10.0, 1.0);
    let dir = dir.path();
    let run = |out: &str, code: i32, more: &[&str]| {
        ends(dir, code, &[&["run", "c.ron", "--out", out, "--quiet"], more].concat());
    };
    run("alone", 0, &["--block", "16"]);
    let reached = half_widths(&dir.join("alone"));
    assert_eq!(reached.len(), 4);
    for (n, half_width) in &reached {
        assert!(*half_width <= 0.05, "{n} runs: {half_width}");
        assert_eq!(*n, 35, "35 are enough");
    }
    says(&ends(dir, 0, &["status", "alone"]).0, &["of at most 1600 runs done"]);
    let (said, err) = ends(dir, 0, &["merge", "alone", "-o", "all.parquet"]);
    says(&said, &["140 rows in all.parquet"]);
    assert!(err.is_empty(), "{err}");
    // How many runs are enough does not hang on the length of blocks, nor on what they cost.
    run("by_cost", 0, &[]);
    ends(dir, 0, &["status", "by_cost"]);
    // The first share cannot know whether 20 seeds are enough; the third sees them all and goes on with its
    // part of the next ones, for which the others have to come again.
    for (shard, code) in [("1/3", 75), ("2/3", 75), ("3/3", 75), ("1/3", 75), ("2/3", 0)] {
        run("shared", code, &["--block", "16", "--shard", shard]);
    }
    for other in ["shared", "by_cost"] {
        assert_eq!(rows(&dir.join("alone")), rows(&dir.join(other)), "{other}");
    }
}
