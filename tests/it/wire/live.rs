//! Live state as a subscriber sees it: whoever comes before, during or after the end sees schemas,
//! state and end, and nobody who dies or stalls can hold the run.
//!
//! No sleeps: a client that holds an answer has been heard by the run with all it declared before,
//! because zenoh keeps the order on a link.

mod hostile;
mod kit;
mod listen;
mod readings;
mod ros2;
mod schemas;
mod setup;

use crate::common::free_endpoint;
use crate::waits::until;
use image::Rgb;
use kit::{
    Samples, broken, client, frame, json, kept, kept_at_the_end, listen, meta, next, options, plume, scene_document,
    start, water,
};
use output::live::{Live, LiveOptions, Payload, topics};
use readings::{picture, ping};
use rheotaxis::trial::Event;
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::Arc;
use world::registry::Registry;
use zenoh::bytes::Encoding;
use zenoh::sample::{Sample, SampleKind};
use zenoh::{Config, Wait};
use zenoh_ext::{AdvancedSubscriberBuilderExt, HistoryConfig};

/// What every client must have seen in the end, whenever it came.
fn assert_whole(seen: &BTreeMap<String, Sample>, last_step: u64) {
    for topic in topics(&Registry::default()) {
        let schema = json(&seen[&format!("meta/schema/{}", topic.name)]);
        assert_eq!(schema, topic.schema());
    }
    assert_eq!(json(&seen["meta/scenario"])["name"], "Duck");
    assert_eq!(json(&seen["meta/version"])["version"], "0.1.0");
    assert_eq!(json(&seen["auv/auv0/behaviour"])["behaviour"], "track_in");
    assert_eq!(json(&seen["gantry/crab0/behaviour"])["found"], true);
    assert_eq!(json(&seen["meta/digest"]), json!({"digest": "d1"}));
    let clock = json(&seen["clock"]);
    assert_eq!((clock["step"].as_u64(), &clock["ended"]), (Some(last_step), &json!(true)));
}

/// Adds what comes until the clock says that the run has ended, by key below the run's.
fn hear_the_end(samples: &Samples, base: &str, seen: &mut BTreeMap<String, Sample>) {
    while !seen.get("clock").is_some_and(|clock| json(clock)["ended"] == true) {
        let sample = next(samples);
        let key = sample.key_expr().as_str()[base.len()..].to_owned();
        seen.insert(key, sample);
    }
}

/// A topic's key for the vehicle or the gantry of the run.
fn key_of(key: &str) -> String {
    key.replace("auv/<id>", "auv/auv0")
        .replace("<number>", "0")
        .replace("gantry/<id>", "gantry/crab0")
        .replace("map/<id>", "map/auv0")
}

#[test]
fn a_subscriber_started_before_the_run_sees_schema_state_and_end() {
    let endpoint = free_endpoint();
    let config = format!(
        r#"{{ mode: "peer", listen: {{ endpoints: [] }}, scouting: {{ multicast: {{ enabled: false }} }},
             connect: {{ endpoints: ["{endpoint}"], retry: {{ period_init_ms: 20, period_max_ms: 100 }} }} }}"#
    );
    let session = zenoh::open(Config::from_json5(&config).unwrap()).wait().unwrap();
    let samples = listen(&session, "before_1");
    let alive = session.liveliness().declare_subscriber("rheotaxis/*/@live/sim").history(true).wait().unwrap();

    let options = LiveOptions { listen: Some(endpoint), ..options("before_1") };
    let live = Live::start(&options, meta()).unwrap();
    let token = next(&alive);
    assert_eq!(token.key_expr().as_str(), "rheotaxis/before_1/@live/sim");
    assert_eq!(token.kind(), SampleKind::Put);

    let mut seen = kept(&session, "before_1");
    live.see(&Event::Frame(Arc::new(frame(4))));
    live.finish("d1");
    hear_the_end(&samples, "rheotaxis/before_1/", &mut seen);
    assert_whole(&seen, 4);
    assert_eq!(next(&alive).kind(), SampleKind::Delete);
    session.close().wait().unwrap();
}

#[test]
fn a_subscriber_started_during_the_run_sees_schema_state_and_end() {
    let live = start("during_1");
    live.see(&Event::Frame(Arc::new(frame(1))));
    let session = client(live.endpoint());
    let samples = listen(&session, "during_1");
    // Another thread sends it: it is asked for until it is there.
    let mut seen = until("the run keeps a state", || {
        let seen = kept(&session, "during_1");
        seen.contains_key("clock").then_some(seen)
    });
    assert_eq!(json(&seen["clock"])["step"], 1, "the state at hand is told at once");
    assert!(!seen.contains_key("meta/digest"), "no digest before the end");

    live.see(&Event::Frame(Arc::new(frame(2))));
    live.finish("d1");
    hear_the_end(&samples, "rheotaxis/during_1/", &mut seen);
    assert_whole(&seen, 2);
    session.close().wait().unwrap();
}

#[test]
fn a_subscriber_started_after_the_end_sees_schema_state_and_end_until_the_run_closes() {
    let live = start("after_1");
    live.see(&Event::Frame(Arc::new(frame(9))));
    live.end("d1");
    let session = client(live.endpoint());
    let seen = kept_at_the_end(&session, "after_1");
    assert_whole(&seen, 9);

    let alive = session.liveliness().declare_subscriber("rheotaxis/after_1/@live/sim").history(true).wait().unwrap();
    assert_eq!(next(&alive).kind(), SampleKind::Put);
    drop(live);
    assert_eq!(next(&alive).kind(), SampleKind::Delete);
    session.close().wait().unwrap();
}

#[test]
fn zenoh_s_own_advanced_subscriber_finds_the_cached_meta() {
    let live = start("advanced_1");
    let session = client(live.endpoint());
    let samples = session
        .declare_subscriber("rheotaxis/advanced_1/meta/*")
        .history(HistoryConfig::default().detect_late_publishers())
        .wait()
        .unwrap();
    let mut seen = BTreeMap::new();
    live.end("d1");
    // Scenario, scene, version and digest.
    while seen.len() < 4 {
        let sample = next(&samples);
        seen.insert(sample.key_expr().as_str().to_owned(), json(&sample));
    }
    assert_eq!(seen["rheotaxis/advanced_1/meta/digest"], json!({"digest": "d1"}));
    assert_eq!(seen["rheotaxis/advanced_1/meta/version"]["version"], "0.1.0");
    assert_eq!(seen["rheotaxis/advanced_1/meta/scenario"]["seed"], 7);
    drop(samples);
    drop(live);
    session.close().wait().unwrap();
}

#[test]
fn every_message_keeps_its_published_schema() {
    let live = start("schema_1");
    live.see(&Event::Frame(Arc::new(frame(3))));
    live.see(&Event::Plume(Arc::new(plume(100))));
    live.see(&Event::Water(Arc::new(water())));
    live.see(&Event::Picture(Arc::new(picture(1.0))));
    live.see(&Event::Ping(Arc::new(ping(1.0))));
    live.end("d1");
    let session = client(live.endpoint());
    let seen = kept_at_the_end(&session, "schema_1");
    for topic in topics(&Registry::default()) {
        let schema = json(&seen[&format!("meta/schema/{}", topic.name)]);
        let key = key_of(topic.key).replace("<name>", "clock");
        let sample = seen.get(&key).unwrap_or_else(|| panic!("{key} is not published"));
        let value = match topic.payload {
            Payload::Json | Payload::Schema => json(sample),
            Payload::PackedF32 | Payload::Jpeg => {
                let header = sample.attachment().expect("packed numbers have a header");
                serde_json::from_slice(&header.to_bytes()).unwrap()
            }
        };
        let mut wrong = Vec::new();
        broken(&schema, &value, &key, &mut wrong);
        assert!(wrong.is_empty(), "{wrong:#?}");
        // The check itself can fail: nothing of a schema allows an empty object.
        broken(&schema, &json!({}), &key, &mut wrong);
        assert!(!wrong.is_empty(), "{key}: the schema asks for nothing");
    }
    let known: Vec<String> = topics(&Registry::default()).iter().map(|t| key_of(t.key)).collect();
    for key in seen.keys().filter(|k| !k.starts_with("meta/schema/")) {
        assert!(known.contains(key), "{key} is published but in no table");
    }
    let packed = seen["plume"].payload().to_bytes();
    assert_eq!(packed.len(), 100 * 6 * 4);
    let mass = f32::from_le_bytes(packed[16..20].try_into().unwrap());
    assert_eq!(mass, 1e-5);
    let flow = seen["water"].payload().to_bytes();
    assert_eq!(flow.len(), 2 * 6 * 4);
    assert_eq!(f32::from_le_bytes(flow[12..16].try_into().unwrap()), 0.25);
    // The bytes are those of the recording's attachment.
    let scene = seen["meta/scene"].payload().to_bytes();
    assert_eq!(scene.as_ref(), scene_document().as_bytes());
    let seen_picture = &seen["auv/auv0/picture"];
    assert_eq!(seen_picture.encoding(), &Encoding::IMAGE_JPEG);
    let shown = image::load_from_memory(&seen_picture.payload().to_bytes()).unwrap();
    let Rgb([red, green, blue]) = *shown.to_rgb8().get_pixel(8, 4);
    // JPEG keeps an even colour within a few of 255.
    let near = |is: u8, should: u8| is.abs_diff(should) <= 4;
    assert_eq!((shown.width(), shown.height()), (16, 8));
    assert!(near(red, 200) && near(green, 30) && near(blue, 20));
    let echoes = seen["auv/auv0/sidescan"].payload().to_bytes();
    assert_eq!(f32::from_le_bytes(echoes[4..8].try_into().unwrap()), 2.0);
    session.close().wait().unwrap();
}
