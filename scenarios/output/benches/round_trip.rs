//! A question to a controller in another session and its answer, over loopback:
//! `cargo bench -p rheotaxis-output --features live --bench round_trip`.

use divan::Bencher;
use output::live::{Live, LiveMeta, LiveOptions, Plane};
use rheotaxis::control::{Controller, Response};
use rheotaxis::scenario::{Loaded, load};
use rheotaxis::trial::{Trial, Unwatched};
use std::sync::Arc;
use std::time::Duration;
use zenoh::query::Query;
use zenoh::{Config, Wait};

const ANSWER: &str = r#"{"steer": {"heading_rad": 1.5, "speed_m_s": 1.5, "altitude_m": 2.0}}"#;
const LONG: Duration = Duration::from_secs(20);

fn main() {
    divan::main();
}

/// A channel in which the robot asks.
fn channel() -> Loaded {
    let channel = load("uniform_channel".as_ref()).expect("in the catalogue");
    let asks = channel.set("robots[0].strategy", "External()").expect("legal");
    asks.set("time.spin_up_s", "10").expect("legal")
}

#[divan::bench(sample_count = 2000, sample_size = 1)]
fn question_and_answer(bencher: Bencher<'_, '_>) {
    let mut trial = Trial::assemble(&channel(), 1).expect("legal");
    let question = trial.until_asked(&mut Unwatched).remove(0);
    let options = LiveOptions {
        listen: Some("tcp/127.0.0.1:0".to_owned()),
        plane: Arc::new(Plane::new(true, None)),
        ..LiveOptions::new("bench_1".to_owned())
    };
    let meta = LiveMeta {
        scenario_text: String::new(),
        scenario_name: "bench".to_owned(),
        seed: 1,
        version: String::new(),
        scene: None,
        topics: Vec::new(),
    };
    let live = Live::start(&options, meta).expect("it starts");
    let config = format!(
        r#"{{ mode: "client", scouting: {{ multicast: {{ enabled: false }} }}, connect: {{ endpoints: ["{}"] }} }}"#,
        live.endpoint()
    );
    let session = zenoh::open(Config::from_json5(&config).expect("legal")).wait().expect("open");
    let reply = |query: Query| {
        let key = query.key_expr().clone();
        let _gone = query.reply(key, ANSWER).wait();
    };
    let there = session.declare_queryable("rheotaxis/*/ask/auv0").callback(reply).wait();
    let going = Arc::new(|| true);
    let mut controller = live.controller("auv0", [LONG, LONG], going).expect("it asks");
    bencher.bench_local(|| {
        let heard = controller.answer(&question);
        assert!(matches!(heard, Response::Answer(_)), "{heard:?}");
    });
    drop(there);
    let _closed = session.close().wait();
}
