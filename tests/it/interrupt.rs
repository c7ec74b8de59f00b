//! Ctrl-C ends a run in order: the recording is whole, the summary says so.

use crate::common;
use std::process::{Command, Stdio};

#[test]
fn ctrl_c_leaves_a_whole_recording_and_a_summary_marked_interrupted() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let args = [
        "run",
        "uniform_channel",
        "--speed",
        "2",
        "--no-zenoh",
        "--quiet",
        "--out",
    ];
    let mut run = common::command(dir.path(), &args)
        .arg(&out)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // The mission is under way once its table has rows.
    let table = out.join("track.csv");
    let rows = || std::fs::read_to_string(&table).map_or(0, |t| t.lines().count());
    while rows() < 20 {
        assert!(run.try_wait().unwrap().is_none(), "the run ended by itself");
        std::thread::yield_now();
    }
    let pid = run.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &pid])
            .status()
            .unwrap()
            .success()
    );
    assert_eq!(run.wait().unwrap().code(), Some(130));

    let summary = std::fs::read_to_string(out.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["outcome"], "interrupted");
    assert!(out.join("map.png").exists() && out.join("report.html").exists());

    assert!(!out.join("run.mcap.tmp").exists());
    let recorded = std::fs::read(out.join("run.mcap")).unwrap();
    let parts = mcap::Summary::read(&recorded)
        .unwrap()
        .expect("a whole file has a summary");
    let messages = parts.stats.expect("and counts").message_count;
    let read = mcap::MessageStream::new(&recorded)
        .unwrap()
        .map(Result::unwrap)
        .count();
    assert!(
        messages > 100 && read as u64 == messages,
        "{read} of {messages}"
    );
}
