//! Campaigns: the same rows however the work is dealt out, and nothing lost when it is cut off.

mod adaptive;
mod against;
mod cache;
mod cut_off;
mod damaged;
mod keyed;
mod lanes;
mod permeable;
mod plans;
mod reproduce;
mod seeds;
mod tracks;

use crate::common::{self, timeless_rows as rows};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Output;
use studies::campaign::{RunRow, block_path, declarations_path, read_rows};

/// Two arms, two conditions, in a channel so short that a run takes hundredths of a second.
const CAMPAIGN: &str = r#"(
    version: 2,
    title: "Two speeds",
    base: "pond.ron",
    seeds: SEEDS,
    arms: [
        (name: "slow", set: [("robots[0].strategy.speed_m_s", "1.2")]),
        (name: "fast"),
    ],
    conditions: Grid([("sources[0].rate_g_s", ["0.02", "0.04"])]),
)
"#;

/// A folder with the campaign `c.ron` of `4 * seeds` runs and its scenario.
fn folder(seeds: u64, spin_up_s: &str, limit_s: &str) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let channel = include_str!("../../scenarios/catalog/uniform_channel.ron");
    let times = [("spin_up_s", spin_up_s), ("limit_s", limit_s)];
    fs::write(dir.path().join("pond.ron"), common::with_fields(channel, &times)).unwrap();
    let text = CAMPAIGN.replace("SEEDS", &seeds.to_string());
    fs::write(dir.path().join("c.ron"), text).unwrap();
    dir
}

fn campaign(dir: &Path, args: &[&str]) -> Output {
    let mut all = vec!["campaign"];
    all.extend_from_slice(args);
    scheduler_free(common::command(dir, &all)).output().expect("rheotaxis starts")
}

/// Whoever runs the tests may do so in a cluster's job.
fn scheduler_free(mut command: std::process::Command) -> std::process::Command {
    for name in ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID", "JOB_COMPLETION_INDEX"] {
        command.env_remove(name);
    }
    command
}

#[track_caller]
fn ends(dir: &Path, code: i32, args: &[&str]) -> (String, String) {
    let end = campaign(dir, args);
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    let (out, err) = (text(&end.stdout), text(&end.stderr));
    assert_eq!(end.status.code(), Some(code), "{args:?}\n{out}{err}");
    (out, err)
}

/// All files of blocks under their final name, with their bytes.
fn blocks(dir: &Path) -> BTreeMap<String, Vec<u8>> {
    let Ok(files) = fs::read_dir(dir) else {
        return BTreeMap::new();
    };
    files
        .map(|f| f.unwrap())
        .map(|f| (f.file_name().into_string().unwrap(), f.path()))
        .filter(|(name, _)| name.starts_with("part-") && name.ends_with(".parquet"))
        .map(|(name, path)| (name, fs::read(path).unwrap()))
        .collect()
}

#[test]
fn rows_do_not_depend_on_shards_jobs_or_blocks() {
    let dir = folder(6, "30", "4");
    let dir = dir.path();
    // Hashed seeds are others in each condition, so that no two runs are alike.
    let text = fs::read_to_string(dir.join("c.ron")).unwrap();
    let hashed = text.replace("seeds: 6", "seeds: Hashed(seed: 1, count: 6)");
    assert_ne!(hashed, text);
    fs::write(dir.join("c.ron"), hashed).unwrap();
    let out = |name: &str, shards: u64, more: &[&str]| -> Vec<RunRow> {
        for i in 1..=shards {
            let shard = format!("{i}/{shards}");
            let mut args = vec!["run", "c.ron", "--quiet", "--out", name, "--shard", &shard];
            args.extend_from_slice(more);
            ends(dir, 0, &args);
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
    // The second arm of each pair took over the first one's spun-up state.
    let wall: Vec<f64> = read_rows(&dir.join("one")).unwrap().iter().map(|r| r.spin_up_wall_s).collect();
    assert!(wall.chunks(2).all(|pair| pair[0] > 0.0 && pair[1] == 0.0), "{wall:?}");
    // A run made again, by the ordinary way and spinning up itself, is the row's.
    let (said, _) = ends(dir, 0, &["rerun", "one", "--run", "13", "--record", "--quiet"]);
    assert_eq!(
        said,
        format!(
            "run 13 (arm fast, sources[0].rate_g_s=0.04, seed {}): the same digest as its row, {}\n",
            one[13].seed, one[13].digest
        )
    );
    assert!(dir.join("one/run-13/run.mcap").is_file());
    let (_, said) = ends(dir, 1, &["rerun", "one", "--run", "24"]);
    assert!(said.contains("there is no run 24: the campaign has 24, counted from 0"), "{said}");
    // Merged, all rows are in both files.
    let (said, _) = ends(dir, 0, &["merge", "three", "-o", "all.parquet", "--csv"]);
    assert!(said.starts_with("24 rows in all.parquet, ") && said.ends_with(" in all-declarations.parquet\n"), "{said}");
    assert!(fs::read(dir.join("all.parquet")).unwrap().ends_with(b"PAR1"));
    let csv = fs::read_to_string(dir.join("all.csv")).unwrap();
    assert_eq!(csv.lines().count(), 25);
    let declared: usize = one.iter().map(|r| r.declarations.len()).sum();
    let declarations = fs::read_to_string(dir.join("all-declarations.csv")).unwrap();
    assert_eq!(declarations.lines().count(), 1 + declared);
    assert!(said.contains(&format!(", {declared} declaration")), "{said}");
    assert!(csv.lines().nth(14).unwrap().contains(&one[13].digest), "{csv}");
}

#[test]
fn another_scenario_campaign_or_block_size_is_refused_by_name() {
    let folder = folder(1, "30", "1");
    let dir = folder.path();
    let run = ["run", "c.ron", "--out", "out", "--quiet"];
    ends(dir, 0, &[&run[..], &["--block", "2"]].concat());
    let manifest = fs::read_to_string(dir.join("out/campaign.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    let was = |key: &str| manifest[key].as_str().unwrap().to_string();
    let before = blocks(&dir.join("out"));

    let pond = fs::read_to_string(dir.join("pond.ron")).unwrap();
    fs::write(dir.join("pond.ron"), format!("{pond}// another\n")).unwrap();
    let (_, said) = ends(dir, 1, &[&run[..], &["--block", "4"]].concat());
    let scenario = rheotaxis::scenario::load(&dir.join("pond.ron")).unwrap().hash();
    let differs = format!(
        "out holds runs of another campaign: scenario {} there, {scenario} here; block size 2 there, 4 here",
        was("scenario_hash")
    );
    assert!(said.contains(&differs), "{said}\n{differs}");
    assert!(said.contains("give another --out; or --force"), "{said}");

    fs::write(dir.join("pond.ron"), &pond).unwrap();
    let text = fs::read_to_string(dir.join("c.ron")).unwrap();
    fs::write(dir.join("c.ron"), text.replace("Two speeds", "2 speeds")).unwrap();
    let (_, said) = ends(dir, 1, &run);
    let differs = format!("out holds runs of another campaign: campaign {} there, ", was("campaign_hash"));
    assert!(said.contains(&differs) && !said.contains("scenario "), "{said}");
    assert_eq!(blocks(&dir.join("out")), before);
    ends(dir, 0, &[&run[..], &["--force"]].concat());
    assert_eq!(blocks(&dir.join("out")), before);
    ends(dir, 0, &run);

    let mut other = manifest.clone();
    other["version"] = "0.0.1".into();
    fs::write(dir.join("out/campaign.json"), other.to_string()).unwrap();
    fs::write(dir.join("c.ron"), text).unwrap();
    let (_, said) = ends(dir, 1, &run);
    let here = format!("another campaign: version 0.0.1 there, {} here", was("version"));
    assert!(said.contains(&here), "{said}");
}

#[test]
fn blocks_that_are_not_whole_are_found_named_and_done_again() {
    let folder = folder(2, "30", "1");
    let dir = folder.path();
    let out = dir.join("out");
    let run = ["run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
    ends(dir, 0, &run);
    let good = rows(&out);
    let bytes = fs::read(block_path(&out, 1)).unwrap();
    let mut turned = bytes.clone();
    // Wide enough to hit what the rows are made from, wherever the writer puts it.
    let some = bytes.len() / 4;
    turned[some..some + 64].fill(0xff);
    let other = fs::read(block_path(&out, 2)).unwrap();
    for broken in [&bytes[..bytes.len() / 2], &bytes[..0], &turned, &other] {
        fs::write(block_path(&out, 1), broken).unwrap();
        let (said, _) = ends(dir, 75, &["status", "out"]);
        assert!(said.contains("6 of 8 runs done, 3 of 4 blocks"), "{said}");
        assert!(said.contains("out/part-000001.parquet is not whole: "), "{said}");
        let (_, said) = ends(dir, 1, &["merge", "out", "-o", "all.parquet"]);
        assert!(said.contains("out/part-000001.parquet is not whole: "), "{said}");
        let (_, said) = ends(dir, 0, &run);
        assert!(said.starts_with("out/part-000001.parquet is not whole: "), "{said}");
        assert!(said.ends_with("; it is done again\n"), "{said}");
        assert_eq!(rows(&out), good);
        ends(dir, 0, &["status", "out"]);
    }
    // The same of its declarations.
    let declarations = declarations_path(&out, 1);
    fs::write(&declarations, b"PAR1").unwrap();
    let says = "out/declarations-000001.parquet is not whole: ";
    let (_, said) = ends(dir, 1, &["merge", "out", "-o", "all.parquet"]);
    assert!(said.contains(says), "{said}");
    let (_, said) = ends(dir, 0, &run);
    assert!(said.starts_with(says) && said.ends_with("; it is done again\n"), "{said}");
    assert_eq!(rows(&out), good);
}

#[test]
fn a_folder_that_cannot_be_written_is_said_and_the_rest_stays() {
    let folder = folder(2, "30", "1");
    let dir = folder.path();
    fs::write(dir.join("file"), "").unwrap();
    let (_, said) = ends(dir, 1, &["run", "c.ron", "--out", "file/out"]);
    assert!(said.contains("file/out"), "{said}");
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
    let says = "out/part-000002.parquet is not whole: it is a folder, not a file";
    assert!(said.contains(says), "{said}");
    fs::remove_dir(block_path(&out, 2)).unwrap();
    assert_eq!(rows(&out), all[..4]);
    ends(dir, 0, &run);
    assert_eq!(rows(&out), all);
}

/// A limit on the length of files stands for a full disk: both end a write half way.
#[cfg(unix)]
#[test]
fn a_full_disk_is_said_and_what_was_done_stays_readable() {
    let folder = folder(2, "30", "1");
    let dir = folder.path();
    let out = dir.join("out");
    let run = ["run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
    ends(dir, 0, &run);
    let all = rows(&out);
    fs::remove_file(block_path(&out, 3)).unwrap();
    let script = format!("trap '' XFSZ; ulimit -f 1; exec '{}' campaign {}", common::binary().display(), run.join(" "));
    let end =
        common::apart(std::process::Command::new("bash").args(["-c", &script])).current_dir(dir).output().unwrap();
    let said = String::from_utf8(end.stderr).unwrap();
    assert_eq!(end.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write out/") && said.contains("-000003.parquet: File too large"), "{said}");
    assert!(said.contains("blocks written before are whole"), "{said}");
    assert_eq!(rows(&out), all[..6]);
    let left = fs::read_dir(&out).unwrap().map(|f| f.unwrap().file_name());
    let left: Vec<_> = left.filter(|n| n.to_string_lossy().ends_with(".tmp")).collect();
    assert!(left.is_empty(), "{left:?}");
    ends(dir, 0, &run);
    assert_eq!(rows(&out), all);
}
