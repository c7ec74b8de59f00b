//! The control plane without a run in a thread of its own; that a run does as it is told is a test of whole missions.

use super::*;
use std::sync::mpsc::{Receiver, channel};

type Answer = Result<Value, String>;

/// Where the answer to a command comes.
fn asked(plane: &Plane, name: &str, parameter: Option<&str>) -> Receiver<Answer> {
    let (tell, told) = channel();
    plane.command(name, parameter, move |said| {
        let _heard = tell.send(said);
    });
    told
}

/// The answer to a command.
fn command(plane: &Plane, name: &str, parameter: Option<&str>) -> Answer {
    asked(plane, name, parameter).recv().expect("an answer")
}

/// A run that may be controlled, and is to pause.
fn paused() -> Plane {
    let plane = Plane::new(true, None);
    command(&plane, "pause", None).unwrap();
    plane
}

#[test]
fn only_a_run_that_allows_it_is_controlled_and_only_with_a_pace() {
    let plane = Plane::new(false, None);
    assert_eq!(command(&plane, "status", None).unwrap()["paused"], false);
    assert!(command(&plane, "pause", None).is_err());
    assert!(plane.hold(0.1, || true));
    for wrong in ["0", "-1", "NaN", "inf", "fast"] {
        assert!(command(&Plane::new(true, None), "speed", Some(wrong)).is_err(), "{wrong}");
    }
}

#[test]
fn steps_are_made_one_after_the_other_and_each_answers_with_its_time() {
    let plane = paused();
    // A part of a step of 1 s is a whole one.
    let all = [Some("2"), None, Some("1.5"), Some("3")].map(|s| asked(&plane, "step", s));
    for t_s in 1..8 {
        assert!(plane.hold(f64::from(t_s), || true));
    }
    let told = |told: &Receiver<Answer>| {
        let told = told.try_recv().ok()?.unwrap();
        Some([&told["t_s"], &told["steps"]].map(Value::as_f64))
    };
    let times: Vec<_> = all.iter().map(told).collect();
    let at = |t_s: f64| Some([Some(t_s); 2]);
    assert_eq!(times, [at(2.0), at(3.0), at(5.0), None]);
    // The run is held after the last one only, and whoever would end it ends that.
    assert!(!plane.hold(8.0, || false));
    assert_eq!(told(&all[3]), at(8.0));
    assert_eq!(command(&plane, "status", None).unwrap()["paused"], true);
}

#[test]
fn a_step_that_is_not_made_says_why() {
    let plane = Plane::new(true, None);
    for name in ["pause", "resume"] {
        let step = asked(&plane, "step", Some("9"));
        assert!(plane.hold(1.0, || true) && step.try_recv().is_err());
        command(&plane, name, None).unwrap();
        let why = step.recv().unwrap().unwrap_err();
        assert!(why.contains(name) && why.contains("1 s"), "{why}");
    }
    let step = asked(&plane, "step", None);
    command(&plane, "stop", None).unwrap();
    plane.ended();
    for told in [step.recv().unwrap(), command(&plane, "step", None)] {
        assert_eq!(told.unwrap()["ended"], true);
    }
}

#[test]
fn whoever_ends_the_run_ends_a_pause() {
    let plane = paused();
    assert!(!plane.hold(1.0, || false));
    command(&plane, "resume", None).unwrap();
    assert!(plane.hold(2.0, || true));
    command(&plane, "speed", Some("1e-9")).unwrap();
    plane.hold(2.0, || false);
    assert!(!plane.hold(1000.0, || false), "far ahead of its pace");
}
