//! Campaigns: the same rows however the work is dealt out, and nothing lost when it is cut off.

mod adaptive;
mod arena;
mod cache;
mod cut_off;
mod damaged;
mod keyed;
mod lanes;
mod plans;
mod report;
mod reproduce;
mod seeds;

use crate::common::{self, says, timeless_rows as rows};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use studies::campaign::{RunRow, block_path, declarations_path, read_rows};

/// Two arms, two conditions, in a channel so short that a run takes hundredths of a second.
fn text(seeds: &str) -> String {
    format!(
        r#"(
    version: 2,
    title: "Two speeds",
    base: "pond.ron",
    seeds: {seeds},
    arms: [
        (name: "slow", set: [("robots[0].strategy.speed_m_s", "1.2")]),
        (name: "fast"),
    ],
    conditions: Grid([("sources[0].rate_g_s", ["0.02", "0.04"])]),
)
"#
    )
}

/// A folder with the campaign `c.ron` of these seeds and its scenario.
fn folder_of(seeds: &str, spin_up_s: f64, limit_s: f64) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    common::write(dir.path(), "pond.ron", &common::short("uniform_channel", spin_up_s, limit_s));
    fs::write(dir.path().join("c.ron"), text(seeds)).unwrap();
    dir
}

/// The same of `4 * seeds` runs.
fn folder(seeds: u64, spin_up_s: f64, limit_s: f64) -> tempfile::TempDir {
    folder_of(&seeds.to_string(), spin_up_s, limit_s)
}

/// `rheotaxis campaign` ends with a code: what it said, on standard output and on standard error.
#[track_caller]
fn ends(dir: &Path, code: i32, args: &[&str]) -> (String, String) {
    let ended = common::rheotaxis_in(dir, &[&["campaign"], args].concat()).with(code);
    (ended.out, ended.err)
}

/// All files of blocks under their final name, with their bytes.
fn blocks(dir: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = fs::read_dir(dir).into_iter().flatten().map(|f| f.unwrap());
    files
        .map(|f| (f.file_name().into_string().unwrap(), f.path()))
        .filter(|(name, _)| name.starts_with("part-") && name.ends_with(".parquet"))
        .map(|(name, path)| (name, fs::read(path).unwrap()))
        .collect()
}

#[test]
fn rows_do_not_depend_on_shards_jobs_or_blocks() {
    // Hashed seeds are others in each condition, so that no two runs are alike.
    let dir = folder_of("Hashed(seed: 1, count: 6)", 30.0, 4.0);
    let dir = dir.path();
    let out = |name: &str, shards: u64, more: &[&str]| -> Vec<RunRow> {
        for i in 1..=shards {
            let shard = format!("{i}/{shards}");
            let args = ["run", "c.ron", "--quiet", "--out", name, "--shard", &shard];
            ends(dir, 0, &[&args, more].concat());
        }
        rows(&dir.join(name))
    };
    let one = out("one", 1, &["--jobs", "1", "--block", "4"]);
    assert_eq!(one.len(), 24);
    assert!(one.iter().enumerate().all(|(i, row)| row.run == i as u64));
    assert!(one.iter().all(|row| row.error.is_none() && !row.digest.is_empty()));
    // The arms have seed and water in common, but not the run; other seeds and conditions neither.
    for pair in one.chunks(2) {
        assert_eq!(pair[0].seed, pair[1].seed);
        assert_eq!((pair[0].arm.as_str(), pair[1].arm.as_str()), ("slow", "fast"));
    }
    let mut digests: Vec<&String> = one.iter().map(|row| &row.digest).collect();
    digests.sort();
    digests.dedup();
    assert_eq!(digests.len(), 24);
    assert_eq!(one, out("jobs", 1, &["--jobs", "2", "--block", "4"]));
    assert_eq!(one, out("three", 3, &["--jobs", "2", "--block", "4"]));
    assert_eq!(one, out("seven", 7, &["--jobs", "1", "--block", "2"]));
    assert_eq!(one, out("whole", 1, &["--jobs", "2"]));
    // The second arm of each pair took over the first one's spun-up state; the wall time of the missions is that of
    // both.
    let of_one = read_rows(&dir.join("one")).unwrap();
    let wall: Vec<f64> = of_one.iter().map(|r| r.spin_up_wall_s).collect();
    assert!(wall.chunks(2).all(|pair| pair[0] > 0.0 && pair[1] == 0.0), "{wall:?}");
    assert!(of_one.iter().all(|row| row.mission_wall_s > 0.0));
    // A run made again, by the ordinary way and spinning up itself, is the row's.
    let (said, _) = ends(dir, 0, &["rerun", "one", "--run", "13", "--record", "--quiet"]);
    let seed = format!("seed {}", one[13].seed);
    says(&said, &["run 13", "arm fast", "sources[0].rate_g_s=0.04", &seed, "the same digest", &one[13].digest]);
    assert!(dir.join("one/run-13/run.mcap").is_file());
    let (_, said) = ends(dir, 1, &["rerun", "one", "--run", "24"]);
    says(&said, &["no run 24", "has 24"]);
    // Merged, all rows are in both files.
    let (said, _) = ends(dir, 0, &["merge", "three", "-o", "all.parquet", "--csv"]);
    let declared: usize = one.iter().map(|r| r.declarations.len()).sum();
    says(&said, &["24 rows in all.parquet", &format!(", {declared} declaration"), "all-declarations.parquet"]);
    assert!(fs::read(dir.join("all.parquet")).unwrap().ends_with(b"PAR1"));
    let csv = fs::read_to_string(dir.join("all.csv")).unwrap();
    assert_eq!(csv.lines().count(), 25);
    let declarations = fs::read_to_string(dir.join("all-declarations.csv")).unwrap();
    assert_eq!(declarations.lines().count(), 1 + declared);
    assert!(csv.lines().nth(14).unwrap().contains(&one[13].digest), "{csv}");
}

#[test]
fn another_scenario_campaign_version_or_block_size_is_refused_by_name() {
    let folder = folder(1, 30.0, 1.0);
    let dir = folder.path();
    let run = ["run", "c.ron", "--out", "out", "--quiet"];
    ends(dir, 0, &[&run[..], &["--block", "2"]].concat());
    let read = |name: &str| fs::read_to_string(dir.join(name)).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&read("out/campaign.json")).unwrap();
    let there = |key: &str| format!("{} there, ", manifest[key].as_str().unwrap());
    let before = blocks(&dir.join("out"));

    let pond = read("pond.ron");
    fs::write(dir.join("pond.ron"), format!("{pond}// another\n")).unwrap();
    let (_, said) = ends(dir, 1, &[&run[..], &["--block", "4"]].concat());
    let here = rheotaxis::scenario::load(&dir.join("pond.ron")).unwrap().hash();
    let scenario = format!("scenario {}{here} here", there("scenario_hash"));
    says(&said, &[&scenario, "block size 2 there, 4 here", "--force"]);

    fs::write(dir.join("pond.ron"), &pond).unwrap();
    let campaign = read("c.ron");
    fs::write(dir.join("c.ron"), campaign.replace("Two speeds", "2 speeds")).unwrap();
    let (_, said) = ends(dir, 1, &run);
    says(&said, &[&format!("campaign {}", there("campaign_hash"))]);
    assert!(!said.contains("scenario "), "{said}");
    assert_eq!(blocks(&dir.join("out")), before);
    ends(dir, 0, &[&run[..], &["--force"]].concat());
    assert_eq!(blocks(&dir.join("out")), before);
    ends(dir, 0, &run);

    let mut other = manifest.clone();
    other["version"] = "0.0.1".into();
    fs::write(dir.join("out/campaign.json"), other.to_string()).unwrap();
    fs::write(dir.join("c.ron"), campaign).unwrap();
    let (_, said) = ends(dir, 1, &run);
    let version = manifest["version"].as_str().unwrap();
    says(&said, &[&format!("version 0.0.1 there, {version} here")]);
}

#[test]
fn blocks_that_are_not_whole_are_found_named_and_done_again() {
    let folder = folder(2, 30.0, 1.0);
    let dir = folder.path();
    let out = dir.join("out");
    let run = ["run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
    ends(dir, 0, &run);
    let good = rows(&out);
    let bytes = fs::read(block_path(&out, 1)).unwrap();
    let other = fs::read(block_path(&out, 2)).unwrap();
    let part = "out/part-000001.parquet";
    for broken in [&bytes[..bytes.len() / 2], &other] {
        fs::write(block_path(&out, 1), broken).unwrap();
        let (said, _) = ends(dir, 75, &["status", "out"]);
        says(&said, &["6 of 8 runs done, 3 of 4 blocks", part]);
        let (_, said) = ends(dir, 1, &["merge", "out", "-o", "all.parquet"]);
        says(&said, &[part]);
        let (_, said) = ends(dir, 0, &run);
        says(&said, &[part, "done again"]);
        assert_eq!(rows(&out), good);
        ends(dir, 0, &["status", "out"]);
    }
    // The same of its declarations.
    fs::write(declarations_path(&out, 1), b"PAR1").unwrap();
    let part = "out/declarations-000001.parquet";
    let (_, said) = ends(dir, 1, &["merge", "out", "-o", "all.parquet"]);
    says(&said, &[part]);
    let (_, said) = ends(dir, 0, &run);
    says(&said, &[part, "done again"]);
    assert_eq!(rows(&out), good);
}

#[test]
fn a_folder_that_cannot_be_written_is_said_and_the_rest_stays() {
    let folder = folder(2, 30.0, 1.0);
    let dir = folder.path();
    fs::write(dir.join("file"), "").unwrap();
    let (_, said) = ends(dir, 1, &["run", "c.ron", "--out", "file/out"]);
    says(&said, &["file/out"]);
    // Something in the place of the third block, whoever runs the tests: root writes anywhere.
    let out = dir.join("out");
    let run = ["run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
    ends(dir, 0, &run);
    let all = rows(&out);
    for block in [2, 3] {
        fs::remove_file(block_path(&out, block)).unwrap();
    }
    fs::create_dir(block_path(&out, 2)).unwrap();
    let (_, said) = ends(dir, 1, &run);
    says(&said, &["out/part-000002.parquet", "it is a folder"]);
    fs::remove_dir(block_path(&out, 2)).unwrap();
    assert_eq!(rows(&out), all[..4]);
    // A disk that is full half way through the last block.
    let args = format!("campaign {}", run.join(" "));
    let said = common::Ended::of(&mut common::with_little_room(dir, 1, &args)).with(1).err;
    says(&said, &["out/", "-00000", "too large", "blocks written before are whole"]);
    assert_eq!(rows(&out), all[..4]);
    let left = fs::read_dir(&out).unwrap().map(|f| f.unwrap().file_name());
    let left: Vec<_> = left.filter(|n| n.to_string_lossy().ends_with(".tmp")).collect();
    assert!(left.is_empty(), "{left:?}");
    ends(dir, 0, &run);
    assert_eq!(rows(&out), all);
}
