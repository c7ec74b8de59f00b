//! Sessions that connect, answer or watch for a moment and leave, again and again, while a run asks.

use super::kit::{Run, asking, channel, client, controller};
use crate::waits::{pause, until};
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use zenoh::query::{Query, Queryable};
use zenoh::{Config, Session, Wait};

const QUESTIONS: u64 = 100;
/// Sessions that come and go at the same time.
const AT_ONCE: usize = 4;

fn answer(question: &Value) -> String {
    let heading = question["number"].as_f64().expect("a number") * 0.1;
    json!({"steer": {"heading_rad": heading}}).to_string()
}

/// Questions that wait until the storm has blown: one in so many.
const HELD: u64 = 10;
/// How many visits each of these waits for.
const VISITS: u64 = 3;

/// Answers what is asked but for the questions that are held, which the steady controller answers.
fn visitor(session: &Session) -> Queryable<()> {
    let reply = |query: Query| {
        let asked = query.payload().expect("a question").to_bytes();
        let question: Value = serde_json::from_slice(&asked).expect("a question is JSON");
        if !question["number"].as_u64().expect("a number").is_multiple_of(HELD) {
            let _gone = query.reply(query.key_expr(), answer(&question)).wait();
        }
    };
    (session.declare_queryable("rheotaxis/*/ask/auv0")).callback(reply).wait().expect("a queryable")
}

/// Comes, answers and watches for a moment, and goes; `false` if there is no run to come to.
fn visit(endpoint: &str) -> bool {
    let config = format!(
        r#"{{ mode: "client", scouting: {{ multicast: {{ enabled: false }} }},
             connect: {{ timeout_ms: 500, endpoints: ["{endpoint}"] }} }}"#
    );
    let config = Config::from_json5(&config).expect("legal");
    let Ok(session) = zenoh::open(config).wait() else {
        return false;
    };
    let there = visitor(&session);
    let watching = session.declare_subscriber("rheotaxis/**").wait();
    pause(0.005);
    drop((there, watching));
    let _closed = session.close().wait();
    true
}

#[test]
fn a_storm_of_controllers_that_come_and_go_loses_nothing() {
    let run = Run::controlled(&channel(&asking(0.1, "Abort"), 10.0));
    let steady = client(&run.endpoint);
    let (over, visits) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicU64::new(0)));
    let seen = Arc::clone(&visits);
    let _controller = controller(&steady, "auv0", move |question| {
        let number = question["number"].as_u64().expect("a number");
        if number % HELD == 0 {
            let wanted = VISITS * (1 + number / HELD);
            until("the storm blows", || (seen.load(Ordering::Relaxed) >= wanted).then_some(()));
        }
        answer(question)
    });
    let storm = (0..AT_ONCE).map(|_| {
        let (endpoint, over, visits) = (run.endpoint.clone(), over.clone(), visits.clone());
        std::thread::spawn(move || {
            while !over.load(Ordering::Relaxed) {
                visits.fetch_add(u64::from(visit(&endpoint)), Ordering::Relaxed);
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
    assert!(visits >= VISITS * QUESTIONS / HELD, "only {visits} visits");
    assert_eq!(end.count(0, "answered"), QUESTIONS, "{} {}", end.said, end.summary);
    assert_eq!(end.count(0, "asked"), QUESTIONS);
    end.run_again();
    let _closed = steady.close().wait();
}
