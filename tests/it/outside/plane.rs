//! The control plane of a run: pause, step, speed, stop; and its refusal.

use super::kit::{Run, channel, client};
use serde_json::Value;
use zenoh::{Session, Wait};

const AMP: &str = "Amp(speed_m_s: 1.5, vertical: Altitude(2))";

/// The answer to a command, or why it was refused.
pub(super) fn command(session: &Session, command: &str) -> Result<Value, String> {
    let replies = session
        .get(format!("rheotaxis/asks_1/rpc/{command}"))
        .wait()
        .unwrap();
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
    loop {
        let told = command(session, "status").unwrap();
        let again = command(session, "status").unwrap();
        if told["paused"] == true && told["steps"].as_u64() > Some(0) && told["t_s"] == again["t_s"]
        {
            return told["t_s"].as_f64().unwrap();
        }
    }
}

#[test]
fn a_run_pauses_steps_and_stops_when_told() {
    let run = Run::start(&channel(AMP, 600.0), &["--allow-control", "--speed", "20"]);
    let session = client(&run.endpoint);
    command(&session, "pause").unwrap();
    let t_s = held(&session);
    command(&session, "step?s=2").unwrap();
    let after = held(&session);
    assert!((after - t_s - 2.0).abs() < 1e-6, "{t_s} {after}");
    command(&session, "step").unwrap();
    assert!((held(&session) - after - 0.02).abs() < 1e-6);
    assert!(
        command(&session, "speed?times=-1")
            .unwrap_err()
            .contains("above 0")
    );
    assert!(command(&session, "fly").unwrap_err().contains("resume"));
    command(&session, "speed?times=max").unwrap();
    command(&session, "step?s=30").unwrap();
    assert!(held(&session) > 30.0);
    command(&session, "stop").unwrap();
    let end = run.end();
    assert_eq!(end.code, 130, "{}", end.said);
    assert_eq!(end.summary["outcome"], "interrupted");
    end.run_again();
    session.close().wait().unwrap();
}

#[test]
fn a_run_that_does_not_allow_it_only_tells_how_it_stands() {
    let run = Run::start(&channel(AMP, 5.0), &["--speed", "5"]);
    let session = client(&run.endpoint);
    assert_eq!(command(&session, "status").unwrap()["controllable"], false);
    for name in ["pause", "stop", "speed?times=9", "step", "resume"] {
        let refused = command(&session, name).unwrap_err();
        assert!(refused.contains("--allow-control"), "{refused}");
    }
    let end = run.end();
    assert_ne!(end.code, 130);
    session.close().wait().unwrap();
}
