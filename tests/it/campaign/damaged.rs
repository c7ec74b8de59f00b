//! Folders of campaigns with something in them that no campaign put there.

use super::{ends, folder, rows};
use crate::common::says;
use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};
use studies::campaign::{Event, RunEnded, RunOptions, block_path, load, run};
use world::registry::Registry;

const RUN: [&str; 7] = ["run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
const MERGE: [&str; 4] = ["merge", "out", "-o", "all.parquet"];

#[test]
fn an_absurd_manifest_is_an_error_for_every_command() {
    let folder = folder(1, 30.0, 1.0);
    let dir = folder.path();
    ends(dir, 0, &RUN);
    let path = dir.join("out/campaign.json");
    let mut json: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    json["runs"] = (1_u64 << 40).into();
    fs::write(path, json.to_string()).unwrap();
    let rerun = ["rerun", "out", "--run", "0"];
    let commands: [&[&str]; 5] = [&["status", "out"], &["report", "out"], &rerun, &MERGE, &RUN];
    for args in commands {
        says(&ends(dir, 1, args).1, &["campaign.json", "runs: ", "4, got 1099511627776"]);
    }
}

#[cfg(unix)]
#[test]
fn a_device_in_the_place_of_a_block_is_said_and_stays() {
    let folder = folder(2, 30.0, 1.0);
    let dir = folder.path();
    ends(dir, 0, &RUN);
    let good = rows(&dir.join("out"));
    let block = dir.join("out/part-000001.parquet");
    fs::remove_file(&block).unwrap();
    std::os::unix::fs::symlink("/dev/zero", &block).unwrap();
    let part = "out/part-000001.parquet is not whole: it is a device";
    says(&ends(dir, 75, &["status", "out"]).0, &[part, "6 of 8 runs done"]);
    for args in [&RUN[..], &MERGE, &["report", "out"]] {
        says(&ends(dir, 1, args).1, &[part]);
    }
    assert!(fs::symlink_metadata(&block).unwrap().is_symlink());
    fs::remove_file(&block).unwrap();
    ends(dir, 0, &RUN);
    assert_eq!(rows(&dir.join("out")), good);
}

/// What is removed while the campaign runs is made again before it says that all is done.
#[test]
fn a_block_that_is_removed_meanwhile_is_made_again() {
    let folder = folder(4, 10.0, 2.0);
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
    let folder = folder(1, 10.0, 2.0);
    let dir = folder.path();
    ends(dir, 0, &RUN);
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
    ends(dir, 0, &RUN);
    assert_eq!(left.map(|name| dir.join(name).exists()), [false, true, false]);
    ends(dir, 0, &[&MERGE[..], &["--csv"]].concat());
    assert!(!of_merge.iter().any(|name| dir.join(name).exists()));
    assert!(others.iter().all(|name| dir.join(name).exists()));
}
