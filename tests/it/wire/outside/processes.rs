//! Controllers that are not there, die, stall, talk nonsense or flood: the run goes on as its scenario says.

use super::kit::{KEYS, Run, channel, client, controller, endless, external, rerun};
use super::plane::command;
use crate::common::says;
use crate::waits::until;
use serde_json::json;
use std::io::{BufRead, BufReader, Read, Write, stdin};
use std::process::{ChildStdin, ChildStdout, Command, Stdio};
use zenoh::Wait;
use zenoh::qos::CongestionControl;

/// The question before whose answer a controller process waits for a line from the test.
const HELD: u64 = 3;

/// A controller in a process of its own, told by its environment where to connect. It says which question it has, and
/// gives some of its answers late.
#[test]
#[ignore = "started by the tests below as a process of its own"]
fn controller_process() {
    let endpoint = std::env::var("CONTROL_ENDPOINT").expect("started by another test");
    let session = client(&endpoint);
    let _controller = controller(&session, "auv0", |question| {
        let mut out = std::io::stdout();
        let number = question["number"].as_u64().expect("a number");
        let told = writeln!(out, "\nASKED {number}").and_then(|()| out.flush());
        told.expect("the parent listens");
        if number == HELD {
            stdin().read_line(&mut String::new()).expect("it speaks");
        }
        json!({"steer": {"heading_rad": 1.5, "altitude_m": 3, "speed_m_s": 1.5}}).to_string()
    });
    loop {
        std::thread::park();
    }
}

struct Process {
    process: crate::waits::Process,
    out: BufReader<ChildStdout>,
    line: ChildStdin,
}

impl Process {
    fn start(endpoint: &str) -> Self {
        let name = "wire::outside::processes::controller_process";
        let mut command = Command::new(std::env::current_exe().unwrap());
        (command.args(["--exact", "--ignored", "--nocapture", name]))
            .env("CONTROL_ENDPOINT", endpoint)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped());
        let mut process = crate::waits::Process::start(&mut command);
        let out = BufReader::new(process.0.stdout.take().expect("piped"));
        let line = process.0.stdin.take().expect("piped");
        Self { process, out, line }
    }

    /// Waits for a question with this number or a later one: where nobody was there, a number was asked in vain.
    fn wait_for(&mut self, number: u64) {
        let mut lines = self.out.by_ref().lines().map_while(Result::ok);
        let asked = |said: &str| said.strip_prefix("ASKED ")?.parse::<u64>().ok();
        assert!(lines.any(|said| asked(&said).is_some_and(|n| n >= number)), "it ended before question {number}");
    }
}

/// Killed while it is asked.
#[test]
fn a_killed_controller_aborts_the_mission_or_leaves_it_to_the_fallback() {
    for on_late in ["Abort", "Fallback(Amp(speed_m_s: 1.5, vertical: Altitude(2)))"] {
        let run = Run::controlled(&channel(&external(on_late), 30.0));
        let mut process = Process::start(&run.endpoint);
        process.wait_for(HELD);
        drop(process);
        let end = run.end();
        assert_eq!(end.count(0, "answered"), HELD, "{}", end.summary);
        let lost = end.count(0, "gone") + end.count(0, "absent");
        if on_late == "Abort" {
            assert_eq!((end.code, lost), (3, 1), "{}", end.said);
            assert_eq!(end.summary["outcome"], "aborted");
        } else {
            assert_eq!(lost, 30 - HELD, "{}", end.summary);
            assert_ne!(end.summary["robots"][0]["last_behaviour"], "external");
        }
        end.run_again();
    }
}

#[test]
fn a_stopped_controller_is_late_until_it_goes_on() {
    // On a slow machine it is stopped for long: zenoh then gives it up, and it connects anew.
    let asks = "External(period_s: 1, deadline_s: 2, on_late: Hold)";
    let run = Run::start(&endless(asks), &["--allow-control", "--speed", "4"]);
    let session = client(&run.endpoint);
    let mut process = Process::start(&run.endpoint);
    process.wait_for(HELD);
    process.process.signal("-STOP");
    let t_s = || {
        let status = command(&session, "status").unwrap();
        status["t_s"].as_f64().unwrap()
    };
    let stopped_s = t_s();
    until("the run does not wait for ever", || (t_s() > stopped_s + 3.0).then_some(()));
    process.process.signal("-CONT");
    writeln!(process.line).unwrap();
    process.wait_for(HELD + 10);
    command(&session, "stop").unwrap();
    let end = run.end();
    assert!(end.count(0, "late") > 0, "{}", end.summary);
    assert!(end.count(0, "answered") > 0, "{}", end.summary);
    end.run_again();
    session.close().wait().unwrap();
}

#[test]
fn nobody_there_is_told_apart_and_the_run_ends() {
    let text = channel(&external("Hold"), 10.0);
    let run = Run::start(&text, &["--allow-control", "--control-wait", "0"]);
    let end = run.end();
    assert_eq!((end.count(0, "asked"), end.count(0, "absent")), (10, 10));
    end.run_again();
}

#[test]
fn nonsense_floods_and_a_hundred_watchers_change_nothing() {
    let text = channel(&external("Hold"), 10.0);
    let quiet = Run::start(&text, &["--allow-control", "--control-wait", "0"]).end();

    let run = Run::controlled(&text);
    let sessions: Vec<_> = (0..10).map(|_| client(&run.endpoint)).collect();
    let watchers: Vec<_> = (sessions.iter().flat_map(|s| (0..10).map(move |_| s)))
        .map(|s| s.declare_subscriber("rheotaxis/**").callback(|_| {}).wait().unwrap())
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
    let text = channel(&external("Hold"), 10.0);
    let end = Run::start(&text, &[]).end();
    assert_eq!(end.code, 1);
    says(&end.said, &["auv0", "--allow-control"]);
    assert!(end.summary.is_null(), "nothing was written");
}

#[test]
fn what_is_no_recording_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("run.mcap"), b"\x89MCAP0\r\nand no more").unwrap();
    for file in ["run.mcap", "nowhere.mcap"] {
        says(&rerun(dir.path(), file).with(1).err, &[file]);
    }
}
