//! The control plane of a run: pause, step, speed, stop; and its refusal.

use super::kit::{AMP, Run, client, endless};
use crate::waits::{PATIENCE, until};
use serde_json::{Value, json};
use zenoh::{Session, Wait};

/// The answer to a command, or why it was refused.
pub(super) fn command(session: &Session, command: &str) -> Result<Value, String> {
    command_to(session, "asks_1", command)
}

/// The same of a run, or of any.
fn command_to(session: &Session, run: &str, command: &str) -> Result<Value, String> {
    let replies = session.get(format!("rheotaxis/{run}/rpc/{command}")).timeout(PATIENCE).wait().unwrap();
    let Ok(reply) = replies.recv() else {
        return Err("nobody answers".to_string());
    };
    match reply.result() {
        Ok(sample) => Ok(serde_json::from_slice(&sample.payload().to_bytes()).expect("JSON")),
        Err(error) => Err(String::from_utf8_lossy(&error.payload().to_bytes()).into_owned()),
    }
}

/// Waits until the mission has begun and the run is held; its time, s.
fn held(session: &Session) -> f64 {
    until("the run is held", || {
        let told = command(session, "status").unwrap();
        let again = command(session, "status").unwrap();
        let begun = told["steps"].as_u64() > Some(0);
        let held = told["paused"] == true && begun && told["t_s"] == again["t_s"];
        held.then(|| told["t_s"].as_f64().unwrap())
    })
}

#[test]
fn a_run_pauses_steps_and_stops_when_told() {
    let run = Run::start(&endless(AMP), &["--allow-control", "--speed", "5"]);
    let session = client(&run.endpoint);
    command(&session, "pause").unwrap();
    let t_s = held(&session);
    // The answer comes when the step is done, whether the run is named or not.
    let mut at = t_s;
    for (run, step, s) in
        [("asks_1", "step?s=2", 2.0), ("asks_1", "step", 0.02), ("*", "step", 0.02), ("**", "step?s=1", 1.0)]
    {
        let told = command_to(&session, run, step).unwrap();
        let now = told["t_s"].as_f64().unwrap();
        assert!((now - at - s).abs() < 1e-6, "{run} {step}: {at} {now}");
        assert_eq!((&told["paused"], held(&session)), (&json!(true), now));
        at = now;
    }
    assert_eq!(command_to(&session, "*", "status").unwrap()["t_s"], at);
    // None of two at once is lost.
    let both = ["step?s=2", "step?s=1"].map(|step| {
        let replies = session.get(format!("rheotaxis/asks_1/rpc/{step}"));
        replies.timeout(PATIENCE).wait().unwrap()
    });
    for replies in both {
        assert!(replies.recv().unwrap().result().is_ok());
    }
    assert!((held(&session) - at - 3.0).abs() < 1e-6);
    assert!(command(&session, "speed?times=-1").unwrap_err().contains("above 0"));
    assert!(command(&session, "fly").unwrap_err().contains("resume"));
    command(&session, "speed?times=max").unwrap();
    let told = command(&session, "step?s=30").unwrap();
    assert!(told["t_s"].as_f64() > Some(30.0) && told["t_s"] == held(&session));
    command(&session, "stop").unwrap();
    let end = run.end();
    assert_eq!(end.code, 130, "{}", end.said);
    assert_eq!(end.summary["outcome"], "interrupted");
    end.run_again();
    session.close().wait().unwrap();
}

#[test]
fn a_run_that_does_not_allow_it_only_tells_how_it_stands() {
    let run = Run::start(&endless(AMP), &["--speed", "0.5"]);
    let session = client(&run.endpoint);
    let status = || command(&session, "status").unwrap();
    assert_eq!(status()["controllable"], false);
    for name in ["pause", "stop", "speed?times=9", "step", "resume"] {
        let refused = command(&session, name).unwrap_err();
        assert!(refused.contains("--allow-control"), "{refused}");
    }
    for (name, value) in [("paused", false.into()), ("stopping", false.into()), ("times", json!(0.5))] {
        assert_eq!(status()[name], value, "{name}");
    }
    let steps = || status()["steps"].as_u64();
    let before = steps();
    until("it goes on", || (steps() > before).then_some(()));
    run.interrupt();
    session.close().wait().unwrap();
}
