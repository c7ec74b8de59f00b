//! The control plane, with a run in a thread of its own or none.

use super::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, channel};

/// Where the answer to a command comes.
fn asked(plane: &Plane, name: &str, parameter: Option<&str>) -> Receiver<Result<Value, String>> {
    let (tell, told) = channel();
    plane.command(name, parameter, move |said| {
        let _heard = tell.send(said);
    });
    told
}

/// The answer to a command.
fn command(plane: &Plane, name: &str, parameter: Option<&str>) -> Result<Value, String> {
    asked(plane, name, parameter).recv().expect("an answer")
}

#[test]
fn only_a_run_that_allows_it_is_controlled() {
    let plane = Plane::new(false, None);
    assert_eq!(command(&plane, "status", None).unwrap()["paused"], false);
    let refused = command(&plane, "pause", None).unwrap_err();
    assert!(refused.contains("--allow-control"), "{refused}");
    assert!(plane.hold(0.1, || true));
    let plane = Plane::new(true, None);
    assert!(command(&plane, "fly", None).unwrap_err().contains("resume"));
    for wrong in ["0", "-1", "NaN", "inf", "fast"] {
        assert!(command(&plane, "speed", Some(wrong)).is_err(), "{wrong}");
    }
}

/// Runs steps of 1 s in a thread of its own; how far it is.
fn runs(plane: &Arc<Plane>) -> (Arc<AtomicU64>, std::thread::JoinHandle<u64>) {
    let at = Arc::new(AtomicU64::new(0));
    let (plane, now) = (Arc::clone(plane), Arc::clone(&at));
    let run = std::thread::spawn(move || {
        let mut t_s = 0;
        loop {
            t_s += 1;
            now.store(t_s, Ordering::SeqCst);
            if !plane.hold(t_s as f64, || true) {
                return t_s;
            }
        }
    });
    (at, run)
}

/// Waits until the run is held; its time.
fn held(plane: &Plane, at: &AtomicU64) -> u64 {
    loop {
        let told = command(plane, "status", None).unwrap();
        let now = at.load(Ordering::SeqCst);
        // At first it is paused before it has begun.
        if now > 0 && told["paused"] == true && told["t_s"].as_f64() == Some(now as f64) {
            return now;
        }
        std::thread::yield_now();
    }
}

#[test]
fn a_held_run_steps_goes_on_and_stops() {
    let plane = Arc::new(Plane::new(true, None));
    command(&plane, "pause", None).unwrap();
    let (at, run) = runs(&plane);
    assert_eq!(held(&plane, &at), 1);
    // The answer comes with the end of the step, where the run is held again.
    for (s, t_s) in [(None, 2.0), (Some("3"), 5.0), (Some("1.5"), 7.0)] {
        let told = command(&plane, "step", s).unwrap();
        assert_eq!((&told["t_s"], &told["paused"]), (&json!(t_s), &json!(true)));
        assert_eq!(told["steps"].as_f64(), Some(t_s));
    }
    command(&plane, "resume", None).unwrap();
    while at.load(Ordering::SeqCst) < 50 {
        std::thread::yield_now();
    }
    command(&plane, "stop", None).unwrap();
    assert!(run.join().unwrap() >= 50);
}

#[test]
fn steps_are_made_one_after_the_other_and_each_answers_with_its_time() {
    let plane = Plane::new(true, None);
    let going = || true;
    command(&plane, "pause", None).unwrap();
    let all = [Some("2"), None, Some("3")].map(|s| asked(&plane, "step", s));
    for t_s in 1..6 {
        assert!(plane.hold(f64::from(t_s), going));
    }
    let times = |all: &[Receiver<Result<Value, String>>]| -> Vec<_> {
        (all.iter()).map(|told| told.try_recv().ok().map(|told| told.unwrap()["t_s"].as_f64())).collect()
    };
    assert_eq!(times(&all), [Some(Some(2.0)), Some(Some(3.0)), None]);
    // The run is held after the last one only, and whoever would end it ends that.
    assert!(!plane.hold(6.0, || false));
    assert_eq!(times(&all[2..]), [Some(Some(6.0))]);
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
    let plane = Plane::new(true, None);
    command(&plane, "pause", None).unwrap();
    assert!(!plane.hold(1.0, || false));
    command(&plane, "resume", None).unwrap();
    command(&plane, "speed", Some("1e-9")).unwrap();
    plane.hold(1.0, || false);
    assert!(!plane.hold(1000.0, || false), "far ahead of its pace");
}
