//! Controllers that are not there, die, stall, talk nonsense or flood: the run goes on as its scenario says.

use super::kit::{KEYS, Run, channel, client, controller};
use crate::common;
use serde_json::json;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdout, Command, Stdio};
use zenoh::Wait;
use zenoh::qos::CongestionControl;

/// A controller in a process of its own, told by its environment where to connect. It says how often it has answered.
#[test]
#[ignore = "started by the tests below as a process of its own"]
fn controller_process() {
    let endpoint = std::env::var("CONTROL_ENDPOINT").expect("started by another test");
    let session = client(&endpoint);
    let _controller = controller(&session, "auv0", |question| {
        let mut out = std::io::stdout();
        let told = writeln!(out, "\nANSWERED {}", question["number"]).and_then(|()| out.flush());
        told.expect("the parent listens");
        json!({"steer": {"heading_rad": 1.5, "altitude_m": 3, "speed_m_s": 1.5}}).to_string()
    });
    loop {
        std::thread::park();
    }
}

struct Process(Child, BufReader<ChildStdout>);

impl Process {
    fn start(endpoint: &str) -> Self {
        let name = "outside::processes::controller_process";
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "--ignored", "--nocapture", name])
            .env("CONTROL_ENDPOINT", endpoint)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        Self(child, out)
    }

    fn wait_for(&mut self, line: &str) {
        let mut lines = self.1.by_ref().lines().map_while(Result::ok);
        assert!(lines.any(|said| said == line), "it ended before {line}");
    }

    fn signal(&self, name: &str) {
        let pid = self.0.id().to_string();
        assert!(
            Command::new("kill")
                .args([name, &pid])
                .status()
                .unwrap()
                .success()
        );
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

fn external(deadline_s: f64, on_late: &str) -> String {
    format!("External(period_s: 1, deadline_s: {deadline_s}, on_late: {on_late})")
}

#[test]
fn a_killed_controller_aborts_the_mission_or_leaves_it_to_the_fallback() {
    for on_late in [
        "Abort",
        "Fallback(Amp(speed_m_s: 1.5, vertical: Altitude(2)))",
    ] {
        // Slow enough to be killed on the way.
        let text = channel(&external(20.0, on_late), 60.0);
        let run = Run::start(&text, &["--allow-control", "--speed", "10"]);
        let mut process = Process::start(&run.endpoint);
        process.wait_for("ANSWERED 3");
        drop(process);
        let end = run.end();
        // It says so before it replies.
        assert!(end.count(0, "answered") >= 3, "{}", end.summary);
        let lost = end.count(0, "gone") + end.count(0, "absent");
        if on_late == "Abort" {
            assert_eq!((end.code, lost), (3, 1), "{}", end.said);
            assert_eq!(end.summary["outcome"], "aborted");
        } else {
            assert!(lost > 10, "{}", end.summary);
            assert_ne!(end.summary["robots"][0]["last_behaviour"], "external");
        }
        end.run_again();
    }
}

#[test]
fn a_stopped_controller_is_late_until_it_goes_on() {
    let text = channel(&external(0.3, "Hold"), 30.0);
    let run = Run::start(&text, &["--allow-control", "--speed", "10"]);
    let mut process = Process::start(&run.endpoint);
    process.wait_for("ANSWERED 2");
    process.signal("-STOP");
    // The recording shows when it was late; it is read up to the last whole chunk.
    let late = || {
        let table = run.folder().join("track.csv");
        std::fs::read_to_string(table).map_or(0, |t| t.lines().count()) > 120
    };
    while !late() {
        std::thread::yield_now();
    }
    process.signal("-CONT");
    process.wait_for("ANSWERED 20");
    let end = run.end();
    assert!(end.count(0, "late") > 0, "{}", end.summary);
    assert!(end.count(0, "answered") > 5, "{}", end.summary);
    end.run_again();
}

#[test]
fn nobody_there_is_told_apart_and_the_run_ends() {
    let text = channel(&external(20.0, "Hold"), 10.0);
    let run = Run::start(&text, &["--allow-control", "--control-wait", "0"]);
    let end = run.end();
    assert_eq!((end.count(0, "asked"), end.count(0, "absent")), (10, 10));
    end.run_again();
}

#[test]
fn nonsense_floods_and_a_hundred_watchers_change_nothing() {
    let text = channel(&external(20.0, "Hold"), 10.0);
    let quiet = Run::start(&text, &["--allow-control", "--control-wait", "0"]).end();

    let run = Run::controlled(&text);
    let sessions: Vec<_> = (0..10).map(|_| client(&run.endpoint)).collect();
    let watchers: Vec<_> = (sessions.iter().flat_map(|s| (0..10).map(move |_| s)))
        .map(|s| {
            s.declare_subscriber("rheotaxis/**")
                .callback(|_| {})
                .wait()
                .unwrap()
        })
        .collect();
    let flood = sessions[0].clone();
    let _controller = controller(&sessions[1], "auv0", move |question| {
        for key in KEYS {
            for _ in 0..200 {
                let put = flood.put(format!("rheotaxis/asks_1/{key}"), "{\"t_s\": 1e9}");
                drop(put.congestion_control(CongestionControl::Drop).wait());
            }
        }
        match question["number"].as_u64() {
            Some(0) => "no JSON".to_string(),
            Some(1) => "{\"steer\": {\"heading_rad\": 1e400}}".to_string(),
            Some(2) => "{\"number\": 1}".to_string(),
            Some(3) => "{\"drives\": {\"set\": [1, 2, 3, 4]}}".to_string(),
            Some(4) => format!("{{\"behaviour\": \"{}\"}}", "x".repeat(100_000)),
            _ => "{\"teleport\": true}".to_string(),
        }
    });
    let end = run.end();
    assert_eq!(end.count(0, "nonsense"), 10, "{}", end.summary);
    assert_eq!(end.digest(), quiet.digest());
    end.run_again();
    drop(watchers);
    for session in sessions {
        session.close().wait().unwrap();
    }
}

#[test]
fn a_run_that_asks_needs_to_be_allowed() {
    let text = channel(&external(1.0, "Hold"), 10.0);
    let end = Run::start(&text, &[]).end();
    assert_eq!(end.code, 1);
    assert!(
        end.said
            .contains("auv0 of asks asks a searcher outside the program"),
        "{}",
        end.said
    );
    assert!(end.said.contains("--allow-control"), "{}", end.said);
    assert!(end.summary.is_null(), "nothing was written");
}

#[test]
fn what_is_no_recording_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("run.mcap"), b"\x89MCAP0\r\nand no more").unwrap();
    let end = super::kit::rerun(dir.path(), "run.mcap");
    assert_eq!(end.status.code(), Some(1));
    let said = String::from_utf8_lossy(&end.stderr);
    assert!(said.contains("run.mcap"), "{said}");
    let missing = common::rheotaxis_in(dir.path(), &["rerun", "nowhere.mcap"]);
    assert_eq!(missing.status.code(), Some(1));
}
