//! Ctrl-C ends a run in order: the recording is whole, the summary says so. A second one ends it at once.

use crate::common;
use crate::waits::{INT, Process, TERM, until};
use std::path::Path;
use std::process::Stdio;

/// Waits until a run's table has so many lines.
fn has_lines(run: &mut Process, out: &Path, n: usize) {
    until("the mission is under way", || {
        assert_eq!(run.ended(), None, "the run ended by itself");
        let table = std::fs::read_to_string(out.join("track.csv")).unwrap_or_default();
        (table.lines().count() >= n).then_some(())
    });
}

#[test]
fn ctrl_c_leaves_a_whole_recording_and_a_summary_marked_interrupted() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let args = ["run", "uniform_channel", "--speed", "2", "--no-zenoh", "--quiet", "--out"];
    let mut command = common::command(dir.path(), &args);
    let mut run = Process::start(command.arg(&out).stderr(Stdio::null()));
    has_lines(&mut run, &out, 20);
    run.signal("-INT");
    assert_eq!(run.end().code(), Some(130));

    assert_eq!(common::summary(&out)["outcome"], "interrupted");
    assert!(out.join("map.png").exists() && out.join("report.html").exists());

    assert!(!out.join("run.mcap.tmp").exists());
    let recorded = std::fs::read(out.join("run.mcap")).unwrap();
    let parts = mcap::Summary::read(&recorded).unwrap().expect("a whole file has a summary");
    let messages = parts.stats.expect("and counts").message_count;
    let read = mcap::MessageStream::new(&recorded).unwrap().map(Result::unwrap).count();
    assert!(messages > 100 && read as u64 == messages, "{read} of {messages}");
}

/// Waits until a process listens to Ctrl-C, sends it until the process has ended, and says with which code.
#[track_caller]
fn interrupted_until_it_ends(run: &mut Process) -> Option<i32> {
    assert!(run.handles(INT), "it ended by itself");
    until("it ends at Ctrl-C", || {
        run.signal("-INT");
        run.ended()
    })
    .code()
}

/// While the water round a quay is worked out, which takes seconds, the first Ctrl-C waits; the second does not.
#[test]
fn a_second_ctrl_c_ends_a_run_at_once() {
    let dir = tempfile::tempdir().unwrap();
    let fine = common::scenario("harbour_3d", &[("water.blockage", "(cell_m: 1, levels: 25, margin_m: 30)")]);
    common::write(dir.path(), "s.ron", &fine);
    let args = ["run", "s.ron", "--no-zenoh", "--quiet", "--out", "out"];
    let mut run = Process::start(common::command(dir.path(), &args).stderr(Stdio::null()));
    assert_eq!(interrupted_until_it_ends(&mut run), Some(130));
    assert!(!dir.path().join("out").exists(), "it ended in order");
}

#[test]
fn long_commands_end_at_ctrl_c() {
    for args in [
        &["statistics", "uniform_channel", "--seconds", "1e6", "--quiet"][..],
        &["score-vision", "--scenes", "100000", "--quiet", "--out", "scores"],
        &["reproduce", "duck_st", "--quiet", "--out", "rows"],
    ] {
        let dir = tempfile::tempdir().unwrap();
        let mut command = common::command(dir.path(), args);
        let mut run = Process::start(command.stderr(Stdio::null()).stdout(Stdio::null()));
        assert_eq!(interrupted_until_it_ends(&mut run), Some(130), "{args:?}");
    }
}

/// Nothing is half done there: they end at the first signal, and with the code of one.
#[test]
fn short_commands_end_at_a_signal_with_the_code_of_one() {
    for (signal, number) in [("-INT", INT), ("-TERM", TERM)] {
        for args in [
            &["picture", "duck_st", "--at", "0,0,-3"][..],
            &["vehicle", "trials", "remus100"],
            &["campaign", "plan", "duck_beta"],
        ] {
            let dir = tempfile::tempdir().unwrap();
            let mut command = common::command(dir.path(), args);
            let mut run = Process::start(command.stderr(Stdio::null()).stdout(Stdio::null()));
            assert!(run.handles(number), "{args:?} ended by itself");
            run.signal(signal);
            assert_eq!(run.end().code(), Some(130), "{args:?} at {signal}");
            assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 0);
        }
    }
}

/// A pace at which the next moment is years away, and one at which it is too far away to be told.
#[test]
fn ctrl_c_ends_a_run_that_waits_for_its_pace() {
    for speed in ["1e-9", "5e-324"] {
        let dir = tempfile::tempdir().unwrap();
        let out = dir.path().join("out");
        common::write(dir.path(), "s.ron", &common::short("uniform_channel", 5.0, 1800.0));
        let args = ["run", "s.ron", "--no-zenoh", "--quiet", "--out", "out", "--speed"];
        let mut command = common::command(dir.path(), &args);
        let mut run = Process::start(command.arg(speed).stderr(Stdio::null()));
        has_lines(&mut run, &out, 2);
        run.signal("-INT");
        assert_eq!(run.end().code(), Some(130), "{speed}");
    }
}
