//! Campaigns that end when enough is known.

use super::{ends, folder, rows};
use std::fs;
use std::path::Path;
use studies::campaign::stats::wilson;

/// Four cells (two arms, two conditions), at most 400 seeds each, until a half width.
fn asked(half_width: &str) -> tempfile::TempDir {
    let dir = folder(400, "10", "1");
    let file = dir.path().join("c.ron");
    let text = fs::read_to_string(&file).unwrap();
    let until = format!("seeds: 400, until: (half_width: {half_width}),");
    fs::write(&file, text.replace("seeds: 400,", &until)).unwrap();
    dir
}

fn half_widths(dir: &Path) -> Vec<(u64, f64)> {
    let rows = rows(dir);
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

fn cell(row: &studies::campaign::RunRow) -> (String, String) {
    (row.arm.clone(), row.condition.clone())
}

#[test]
fn it_stops_when_the_intervals_are_as_narrow_as_asked_and_not_before() {
    // Nothing is found in one second: a share of 0 in n has a Wilson half width of 1.92 / (n + 3.84), so 0.05
    // takes 35 seeds; the first look, at 20, is not enough.
    let dir = asked("0.05");
    let out = dir.path().join("out");
    ends(dir.path(), 0, &["run", "c.ron", "--out", "out", "--block", "16", "--quiet"]);
    let reached = half_widths(&out);
    assert_eq!(reached.len(), 4);
    for (n, half_width) in &reached {
        assert!(*half_width <= 0.05, "{n} runs: {half_width}");
        assert_eq!(*n, 35, "35 are enough");
    }
    let (said, _) = ends(dir.path(), 0, &["status", "out"]);
    assert!(said.contains("of at most 1600 runs done"), "{said}");
    let (said, err) = ends(dir.path(), 0, &["merge", "out", "-o", "all.parquet"]);
    assert!(said.contains("rows in all.parquet"), "{said}");
    assert!(err.is_empty(), "{err}");
}

#[test]
fn shares_wait_for_each_other_and_come_to_the_same_rows() {
    let dir = asked("0.05");
    let in_blocks = |out: &str, code: i32, shard: &str, block: &str| {
        let args = ["run", "c.ron", "--out", out, "--block", block, "--quiet", "--shard", shard];
        ends(dir.path(), code, &args)
    };
    let run = |out: &str, code: i32, shard: &str| in_blocks(out, code, shard, "16");
    run("alone", 0, "1/1");
    // How many runs are enough does not hang on the length of blocks, nor on what they cost.
    in_blocks("long", 0, "1/1", "1000");
    ends(dir.path(), 0, &["run", "c.ron", "--out", "by_cost", "--quiet"]);
    // The first share cannot know whether 20 seeds are enough; the third sees them all and goes on with its
    // part of the next ones, for which the others have to come again.
    run("shared", 75, "1/3");
    run("shared", 75, "2/3");
    run("shared", 75, "3/3");
    run("shared", 75, "1/3");
    run("shared", 0, "2/3");
    let (alone, shared) = (dir.path().join("alone"), dir.path().join("shared"));
    assert_eq!(rows(&alone), rows(&shared));
    assert_eq!(rows(&alone).len(), 4 * 35);
    for other in ["long", "by_cost"] {
        assert_eq!(rows(&alone), rows(&dir.path().join(other)), "{other}");
        ends(dir.path(), 0, &["status", other]);
    }
}
