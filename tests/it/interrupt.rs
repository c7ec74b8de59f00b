//! Ctrl-C ends a run in order: the recording is whole, the summary says so. A second one ends it at once.
#![allow(
    clippy::disallowed_methods,
    reason = "a process is interrupted after a while, whatever it was doing"
)]

use crate::common;
use std::process::{Command, Stdio};
use std::time::Duration;

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

/// Sends Ctrl-C until the process has ended, and says with which code, or nothing where it does not within a minute.
fn interrupted_until_it_ends(run: &mut std::process::Child) -> Option<i32> {
    let pid = run.id().to_string();
    for _ in 0..600 {
        if let Some(ended) = run.try_wait().unwrap() {
            return ended.code();
        }
        // It may have ended in between.
        let _ = Command::new("kill")
            .args(["-INT", &pid])
            .stderr(Stdio::null())
            .status();
        std::thread::sleep(Duration::from_millis(100));
    }
    run.kill().unwrap();
    None
}

/// While the water round a quay is worked out, which takes seconds, the first Ctrl-C waits; the second does not.
#[test]
fn a_second_ctrl_c_ends_a_run_at_once() {
    let dir = tempfile::tempdir().unwrap();
    let text = include_str!("../../scenarios/catalog/harbour_3d.ron");
    let cells = "blockage: (cell_m: 2, levels: 13, margin_m: 30)";
    assert_eq!(text.matches(cells).count(), 1);
    let fine = "blockage: (cell_m: 1, levels: 25, margin_m: 30)";
    std::fs::write(dir.path().join("s.ron"), text.replace(cells, fine)).unwrap();
    let args = ["run", "s.ron", "--no-zenoh", "--quiet", "--out", "out"];
    let mut run = common::command(dir.path(), &args)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(500));
    assert_eq!(interrupted_until_it_ends(&mut run), Some(130));
    assert!(!dir.path().join("out").exists(), "it ended in order");
}

#[test]
fn long_commands_end_at_ctrl_c() {
    for args in [
        &[
            "statistics",
            "uniform_channel",
            "--seconds",
            "1e6",
            "--quiet",
        ][..],
        &[
            "score-vision",
            "--scenes",
            "100000",
            "--quiet",
            "--out",
            "scores",
        ],
        &["reproduce", "duck_st", "--quiet", "--out", "rows"],
    ] {
        let dir = tempfile::tempdir().unwrap();
        let mut run = common::command(dir.path(), args)
            .stderr(Stdio::null())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        // Not before it listens.
        std::thread::sleep(Duration::from_secs(2));
        assert!(
            run.try_wait().unwrap().is_none(),
            "{args:?} ended by itself"
        );
        assert_eq!(interrupted_until_it_ends(&mut run), Some(130), "{args:?}");
    }
}

/// A pace at which the next moment is years away, and one at which it is too far away to be told.
#[test]
fn ctrl_c_ends_a_run_that_waits_for_its_pace() {
    for speed in ["1e-9", "5e-324"] {
        let dir = tempfile::tempdir().unwrap();
        let out = dir.path().join("out");
        let text = include_str!("../../scenarios/catalog/uniform_channel.ron");
        let text = common::with_fields(text, &[("spin_up_s", "5")]);
        std::fs::write(dir.path().join("s.ron"), text).unwrap();
        let args = [
            "run",
            "s.ron",
            "--no-zenoh",
            "--quiet",
            "--out",
            "out",
            "--speed",
        ];
        let mut run = common::command(dir.path(), &args)
            .arg(speed)
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let rows =
            || std::fs::read_to_string(out.join("track.csv")).map_or(0, |t| t.lines().count());
        while rows() < 2 {
            assert_eq!(
                run.try_wait().unwrap(),
                None,
                "the run ended by itself at {speed}"
            );
            std::thread::yield_now();
        }
        let pid = run.id().to_string();
        let sent = Command::new("kill").args(["-INT", &pid]).status();
        assert!(sent.unwrap().success());
        assert_eq!(run.wait().unwrap().code(), Some(130), "{speed}");
    }
}
