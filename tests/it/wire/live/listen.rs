//! `Listener`: what was published before, what comes, and the end of a run; nothing twice and nothing commanded.

use super::kit::{client, frame, kept, meta, options, plume, sent, start};
use super::readings::picture;
use crate::common::free_endpoint;
use crate::waits::until;
use output::live::{ListenOptions, Listener, Live, LiveOptions, News, Plane, topics};
use rheotaxis::trial::Event;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;
use world::registry::Registry;
use zenoh::bytes::Encoding;
use zenoh::{Config, Wait};

fn at(live: &Live, key: Option<&str>) -> Listener {
    let options = ListenOptions {
        key: key.map(str::to_owned),
        connect: Some(live.endpoint().to_owned()),
        topics: topics(&Registry::default()),
        config_file: None,
    };
    Listener::open(&options).expect("it connects by itself")
}

fn next(listener: &mut Listener) -> News {
    until("news of a run", || listener.next(Duration::from_millis(20)).expect("open"))
}

/// The next message; nothing else comes before it.
fn message(listener: &mut Listener) -> Value {
    match next(listener) {
        News::Message(line) => line,
        other => panic!("{other:?}"),
    }
}

/// All messages until a run has ended, and that.
fn to_the_end(listener: &mut Listener) -> (Vec<Value>, News) {
    let mut all = Vec::new();
    loop {
        match next(listener) {
            News::Message(line) => all.push(line),
            end => return (all, end),
        }
    }
}

#[test]
fn a_listener_hears_what_was_published_what_comes_and_the_end() {
    let live = start("heard_1");
    live.see(&Event::Frame(Arc::new(frame(1))));
    live.see(&Event::Plume(Arc::new(plume(100))));
    live.see(&Event::Picture(Arc::new(picture(1.0))));
    // Another thread sends them: they are asked for until all are there.
    let session = client(live.endpoint());
    until("the run keeps all three", || {
        let seen = kept(&session, "heard_1");
        let all = ["clock", "plume", "auv/auv0/picture"];
        all.iter().all(|key| seen.contains_key(*key)).then_some(())
    });
    let mut listener = at(&live, None);
    assert_eq!(listener.notice(), None);
    assert_eq!(next(&mut listener), News::Begun("heard_1".to_owned()));
    // The newest of each key, in the order of the keys: the clock is not the first.
    let mut earlier = Vec::new();
    let clock = loop {
        let line = message(&mut listener);
        if line["key"] == "rheotaxis/heard_1/clock" {
            break line;
        }
        earlier.push(line);
    };
    assert_eq!(clock["message"]["step"], 1);
    assert_eq!(earlier[0]["key"], "rheotaxis/heard_1/auv/auv0/behaviour");

    live.see(&Event::Frame(Arc::new(frame(2))));
    live.finish("d1");
    let (later, end) = to_the_end(&mut listener);
    assert_eq!(end, News::Ended("heard_1".to_owned()));
    let all: Vec<&Value> = earlier.iter().chain([&clock]).chain(&later).collect();
    // Of what two states say, only what has their time must differ: both say the same declarations.
    let different = |line: &&&Value| {
        let t_s = line["message"]["t_s"].as_f64();
        t_s.is_none_or(|t_s| t_s == 0.1 || t_s == 0.2)
    };
    let texts: Vec<String> = (all.iter().filter(different)).map(ToString::to_string).collect();
    let once: BTreeSet<&String> = texts.iter().collect();
    assert_eq!(once.len(), texts.len(), "a message came twice");
    assert!(texts.len() > 20);
    let of = |end: &str| -> Vec<&&Value> {
        let of_key = |line: &&&Value| line["key"].as_str().expect("a key").ends_with(end);
        all.iter().filter(of_key).collect()
    };
    assert_eq!(of("/auv0/truth").len(), 2, "before and after it came");
    assert_eq!(of("/truth")[1]["message"]["t_s"], 0.2);
    assert_eq!(of("/meta/scene")[0]["message"]["version"], 2);
    assert_eq!(of("/meta/digest")[0]["message"], json!({"digest": "d1"}));
    assert!(of("schema/clock").is_empty(), "schemas only if asked for");
    let masses = &of("/plume")[0]["packed"]["mass"];
    let equal = json!({"count": 100, "min": 1e-5, "max": 1e-5, "mean": 1e-5});
    assert_eq!((of("/plume").len(), masses), (1, &equal));
    assert!(of("/picture")[0]["jpeg"]["bytes"].as_u64() > Some(100));
    // The run answers and sends at the same time, so the last answers may come after the last clock.
    assert_eq!(of("heard_1/clock").last().unwrap()["message"]["ended"], true);
}

/// A run keeps a message before it sends it: who asks between the two is answered, and then hears the same.
#[test]
fn a_message_that_is_answered_and_then_sent_is_heard_once() {
    let endpoint = free_endpoint();
    let config = format!(
        r#"{{ mode: "peer", listen: {{ endpoints: ["{endpoint}"] }}, scouting: {{ multicast: {{ enabled: false }} }} }}"#
    );
    let run = zenoh::open(Config::from_json5(&config).unwrap()).wait();
    let run = run.unwrap();
    let sends = run.clone();
    let truth = "rheotaxis/between_1/auv/auv0/truth";
    let _queryable = run
        .declare_queryable("rheotaxis/between_1/**")
        .callback(move |query| {
            let say = |key: &str, text: &str| {
                let put = sends.put(key, text).encoding(Encoding::APPLICATION_JSON);
                put.wait().unwrap();
            };
            let reply = query.reply(truth, r#"{"t_s": 1}"#);
            let reply = reply.encoding(Encoding::APPLICATION_JSON);
            reply.wait().unwrap();
            drop(query);
            for text in [r#"{"t_s": 1}"#, r#"{"t_s": 2}"#, r#"{"t_s": 2}"#] {
                say(truth, text);
            }
            say("rheotaxis/between_1/clock", r#"{"ended": true}"#);
        })
        .wait()
        .unwrap();
    let token = run.liveliness().declare_token("rheotaxis/between_1/@live/sim");
    let _alive = token.wait().unwrap();
    let options = ListenOptions { connect: Some(endpoint), ..ListenOptions::default() };
    let mut listener = Listener::open(&options).unwrap();
    assert_eq!(next(&mut listener), News::Begun("between_1".to_owned()));
    let (lines, end) = to_the_end(&mut listener);
    assert_eq!(end, News::Ended("between_1".to_owned()));
    let truths: Vec<&Value> =
        (lines.iter().filter(|line| line["key"] == truth)).map(|line| &line["message"]["t_s"]).collect();
    // What is sent twice is heard twice.
    assert_eq!(truths, [1, 2, 2]);
}

#[test]
fn a_key_narrows_what_is_heard_and_the_end_is_heard_in_any_case() {
    let live = start("narrow_1");
    live.see(&Event::Frame(Arc::new(frame(1))));
    sent(&live);
    let heard = ["auv/*/truth", "rheotaxis/narrow_1/meta/schema/clock", "auv/*/smell"];
    let mut listeners = heard.map(|key| at(&live, Some(key)));
    let other = &mut at(&live, Some("rheotaxis/another_1/**"));
    for listener in &mut listeners {
        assert_eq!(next(listener), News::Begun("narrow_1".to_owned()));
    }
    live.end("d1");
    let [poses, schema, nothing] = listeners.each_mut().map(|listener| {
        let (lines, end) = to_the_end(listener);
        assert_eq!(end, News::Ended("narrow_1".to_owned()));
        lines
    });
    assert_eq!(poses[0]["key"], "rheotaxis/narrow_1/auv/auv0/truth");
    assert_eq!((poses.len(), schema.len(), nothing.len()), (1, 1, 0));
    let notices = listeners.each_ref().map(|listener| listener.notice().is_some());
    assert_eq!(notices, [false, false, true]);
    // All that has come by now.
    for _ in 0..50 {
        assert_eq!(other.next(Duration::ZERO), Ok(None), "of another run");
    }
}

#[test]
fn a_run_that_breaks_off_is_gone_and_one_of_the_same_id_is_heard_anew() {
    let options = LiveOptions { listen: Some(free_endpoint()), ..options("again_1") };
    let live = Live::start(&options, meta()).unwrap();
    let mut listener = at(&live, Some("clock"));
    assert_eq!(next(&mut listener), News::Begun("again_1".to_owned()));
    drop(live);
    assert_eq!(next(&mut listener), News::Gone("again_1".to_owned()));
    let live = Live::start(&options, meta()).unwrap();
    assert_eq!(next(&mut listener), News::Begun("again_1".to_owned()));
    // A run that ends before it knows of its listener is gone to it.
    live.see(&Event::Frame(Arc::new(frame(1))));
    assert_eq!(message(&mut listener)["key"], "rheotaxis/again_1/clock");
    live.finish("d1");
    let (lines, end) = to_the_end(&mut listener);
    assert_eq!(end, News::Ended("again_1".to_owned()));
    assert_eq!(lines.last().expect("a clock")["message"]["ended"], true);
}

#[test]
fn whoever_listens_to_the_keys_of_commands_commands_nothing() {
    let plane = Arc::new(Plane::new(true, None));
    let options = LiveOptions { plane: Arc::clone(&plane), ..options("commanded_1") };
    let live = Live::start(&options, meta()).unwrap();
    let mut listener = at(&live, Some("rpc/stop"));
    assert_eq!(next(&mut listener), News::Begun("commanded_1".to_owned()));
    live.finish("d1");
    let (lines, end) = to_the_end(&mut listener);
    assert_eq!(end, News::Ended("commanded_1".to_owned()));
    assert_eq!(lines, Vec::<Value>::new());
    assert!(plane.hold(1.0, || true), "it was told to stop");
}

#[test]
fn without_an_endpoint_it_finds_the_port_that_a_run_has_taken() {
    let live = LiveOptions { listen: None, ..options("found_1") };
    let live = Live::start(&live, meta()).unwrap();
    // Other runs may be there, too.
    let options = ListenOptions { key: Some("rheotaxis/found_1/meta/version".to_owned()), ..ListenOptions::default() };
    let mut listener = Listener::open(&options).unwrap();
    assert_eq!(next(&mut listener), News::Begun("found_1".to_owned()));
    let version = message(&mut listener);
    assert_eq!(version["message"]["version"], "0.1.0");
    drop(live);
}
