//! Folders of campaigns with something in them that no campaign put there.

use super::{ends, folder, rows};
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use studies::campaign::{Event, RunEnded, RunOptions, block_path, load, run};
use world::registry::Registry;

const RUN: [&str; 7] = ["run", "c.ron", "--out", "out", "--block", "2", "--quiet"];

/// The manifest of `out` with a field of another value.
fn with(dir: &Path, field: &str, value: serde_json::Value) {
    let path = dir.join("out/campaign.json");
    let text = fs::read_to_string(&path).unwrap();
    let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
    json[field] = value;
    fs::write(path, json.to_string()).unwrap();
}

#[test]
fn absurd_manifests_are_errors_with_field_and_range_for_every_command() {
    let folder = folder(1, "30", "1");
    let dir = folder.path();
    ends(dir, 0, &RUN);
    let good = fs::read(dir.join("out/campaign.json")).unwrap();
    let range = "must be from 1 to 1099511627776, got";
    for (field, value, says) in [
        ("block", 0_u64, format!("block: {range} 0")),
        ("block", 1 << 63, format!("block: {range} 9223372036854775808")),
        ("runs", 1 << 63, format!("runs: {range} 9223372036854775808")),
        ("runs", 1 << 40, "runs: must be the campaign's 4, got 1099511627776".to_string()),
    ] {
        with(dir, field, value.into());
        let rerun = ["rerun", "out", "--run", "0"];
        let merge = ["merge", "out", "-o", "all.parquet"];
        let commands: [&[&str]; 5] = [&["status", "out"], &["report", "out"], &rerun, &merge, &RUN];
        for args in commands {
            let (_, said) = ends(dir, 1, args);
            let differs = args[0] == "run" && said.contains("holds runs of another campaign");
            assert!(differs || said.contains("campaign.json") && said.contains(&says), "{args:?} {field}: {said}");
        }
        fs::write(dir.join("out/campaign.json"), &good).unwrap();
    }
    ends(dir, 0, &["status", "out"]);
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_in_the_place_of_a_block_are_said_and_stay() {
    let folder = folder(2, "30", "1");
    let dir = folder.path();
    ends(dir, 0, &RUN);
    let good = rows(&dir.join("out"));
    let block = dir.join("out/part-000001.parquet");
    fs::remove_file(&block).unwrap();
    std::os::unix::fs::symlink("/dev/zero", &block).unwrap();
    let says = "out/part-000001.parquet is not whole: it is a device, not a file";
    let (said, _) = ends(dir, 75, &["status", "out"]);
    assert!(said.contains(says) && said.contains("6 of 8 runs done"), "{said}");
    for args in [&RUN[..], &["merge", "out", "-o", "all.parquet"], &["report", "out"]] {
        let (_, said) = ends(dir, 1, args);
        assert!(said.contains(says), "{args:?}: {said}");
    }
    assert!(fs::symlink_metadata(&block).unwrap().is_symlink());
    fs::remove_file(&block).unwrap();
    let pipe = std::process::Command::new("mkfifo").arg(&block).status();
    if pipe.is_ok_and(|s| s.success()) {
        let (said, _) = ends(dir, 75, &["status", "out"]);
        let says = says.replace("a device", "a pipe");
        assert!(said.contains(&says), "{said}");
        fs::remove_file(&block).unwrap();
    }
    ends(dir, 0, &RUN);
    assert_eq!(rows(&dir.join("out")), good);
}

/// What is removed while the campaign runs is made again before it says that all is done.
#[test]
fn a_block_that_is_removed_meanwhile_is_made_again() {
    let folder = folder(4, "10", "2");
    let dir = folder.path();
    let campaign = load(&Registry::default(), &dir.join("c.ron")).unwrap();
    let (out, removed) = (dir.join("out"), AtomicBool::new(false));
    let options = RunOptions { block: Some(4), jobs: 1, ..RunOptions::default() };
    let tell = |event: Event<'_>| {
        if matches!(event, Event::Wrote(2)) && !removed.swap(true, Ordering::Relaxed) {
            fs::remove_file(block_path(&out, 0)).unwrap();
        }
    };
    let ended = run(&campaign, &out, &options, &AtomicBool::new(false), &tell);
    assert_eq!(ended.unwrap(), RunEnded::Complete);
    assert!(removed.into_inner());
    assert_eq!(rows(&out).len(), 16);
}

#[test]
fn what_killed_processes_left_goes_with_the_next_run_or_merge() {
    let folder = folder(1, "10", "2");
    let dir = folder.path();
    let run = ["run", "c.ron", "--out", "out", "--quiet"];
    ends(dir, 0, &run);
    let left =
        ["out/campaign.json.17-0.tmp", "out/part-000000.parquet.17-1.tmp", "out/declarations-000000.parquet.17-2.tmp"];
    let of_merge = ["all.parquet.17-0.tmp", "all-declarations.csv.17-3.tmp"];
    let others = ["out/notes.parquet.17-1.tmp", "rows.parquet.17-1.tmp"];
    for name in left.iter().chain(&of_merge).chain(&others) {
        fs::write(dir.join(name), "half").unwrap();
    }
    // One that is being written.
    let written = fs::File::open(dir.join(left[1])).unwrap();
    written.lock().unwrap();
    ends(dir, 0, &run);
    assert!(!dir.join(left[0]).exists() && !dir.join(left[2]).exists());
    assert!(dir.join(left[1]).exists());
    ends(dir, 0, &["merge", "out", "-o", "all.parquet", "--csv"]);
    assert!(!of_merge.iter().any(|name| dir.join(name).exists()));
    assert!(others.iter().all(|name| dir.join(name).exists()));
}
