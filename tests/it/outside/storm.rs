//! Sessions that connect, answer or watch for a moment and leave, again and again, while a run asks.
#![allow(
    clippy::disallowed_methods,
    reason = "visitors come and go in real time, which never reaches a run"
)]

use super::kit::{Run, channel, client, controller};
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;
use zenoh::{Config, Wait};

const QUESTIONS: u64 = 100;
/// Sessions that come and go at the same time.
const AT_ONCE: usize = 4;

fn answer(question: &Value) -> String {
    let heading = question["number"].as_f64().expect("a number") * 0.1;
    json!({"steer": {"heading_rad": heading}}).to_string()
}

/// Comes, answers and watches for a moment, and goes; `false` once the run is over.
fn visit(endpoint: &str) -> bool {
    let config = format!(
        r#"{{ mode: "client", scouting: {{ multicast: {{ enabled: false }} }},
             connect: {{ timeout_ms: 500, endpoints: ["{endpoint}"] }} }}"#
    );
    let config = Config::from_json5(&config).expect("legal");
    let Ok(session) = zenoh::open(config).wait() else {
        return false;
    };
    let there = controller(&session, "auv0", answer);
    let watching = session.declare_subscriber("rheotaxis/**").wait();
    std::thread::sleep(Duration::from_millis(5));
    drop((there, watching));
    let _closed = session.close().wait();
    true
}

#[test]
fn a_storm_of_controllers_that_come_and_go_loses_nothing() {
    let asks = channel(
        "External(period_s: 0.1, deadline_s: 20, on_late: Abort)",
        10.0,
    );
    let run = Run::controlled(&asks);
    let steady = client(&run.endpoint);
    let _controller = controller(&steady, "auv0", |question| {
        // So that the storm has time to blow.
        std::thread::sleep(Duration::from_millis(10));
        answer(question)
    });
    let (over, visits) = (
        Arc::new(AtomicBool::new(false)),
        Arc::new(AtomicU64::new(0)),
    );
    let storm = (0..AT_ONCE).map(|_| {
        let (endpoint, over, visits) = (run.endpoint.clone(), over.clone(), visits.clone());
        std::thread::spawn(move || {
            while !over.load(Ordering::Relaxed) && visit(&endpoint) {
                visits.fetch_add(1, Ordering::Relaxed);
            }
        })
    });
    let storm: Vec<_> = storm.collect();
    let end = run.end();
    over.store(true, Ordering::Relaxed);
    for visitor in storm {
        visitor.join().expect("sound");
    }
    let visits = visits.load(Ordering::Relaxed);
    assert!(visits > 20, "only {visits} visits");
    assert_eq!(
        end.count(0, "answered"),
        QUESTIONS,
        "{} {}",
        end.said,
        end.summary
    );
    assert_eq!(end.count(0, "asked"), QUESTIONS);
    end.run_again();
    let _closed = steady.close().wait();
}
