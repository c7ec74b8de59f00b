//! Live state as a subscriber sees it: whoever comes before, during or after the end sees schemas,
//! state and end, and nobody who dies or stalls can hold the run.
//!
//! No sleeps: a client that holds an answer has been heard by the run with all it declared before,
//! because zenoh keeps the order on a link.

use nalgebra::{Vector2, Vector3};
use rheotaxis::frame::{Frame, PlumeFrame, RobotFrame};
use rheotaxis::live::{Live, LiveError, LiveMeta, LiveOptions, Payload, topics};
use robots::handoff::{
    ActuatorCommand, Attitude, Behaviour, ChemicalReading, Command, Declaration, Estimate,
    FlowEstimate, Goal, Manoeuvre, Setpoint, Vertical,
};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read};
use std::net::TcpListener;
use std::process::{Child, Stdio};
use std::time::Duration;
use world::frames::{Pose, Truth};
use world::units::Heading;
use zenoh::handlers::FifoChannelHandler;
use zenoh::pubsub::Subscriber;
use zenoh::sample::{Sample, SampleKind};
use zenoh::{Config, Session, Wait};
use zenoh_ext::{AdvancedSubscriberBuilderExt, HistoryConfig};

/// Longest wait for something that must come; only a failing test waits that long.
const PATIENCE: Duration = Duration::from_secs(20);

type Samples = Subscriber<FifoChannelHandler<Sample>>;

fn meta() -> LiveMeta {
    LiveMeta {
        scenario_text: "(version: 1)".to_owned(),
        scenario_name: "Duck".to_owned(),
        seed: 7,
        version: "0.1.0".to_owned(),
    }
}

fn options(run: &str) -> LiveOptions {
    LiveOptions {
        listen: Some("tcp/127.0.0.1:0".to_owned()),
        state_period: Duration::ZERO,
        plume_period: Duration::ZERO,
        ..LiveOptions::new(run.to_owned())
    }
}

fn start(run: &str) -> Live {
    Live::start(&options(run), meta()).expect("any free port will do")
}

/// A state in which everything is said that can be.
fn frame(step: u64) -> Frame {
    let heading = Heading::from_deg(45.0);
    let pose = Pose::level(Vector3::new(10.0, 20.0, -3.0), heading);
    let estimate = Estimate {
        t_s: step as f64 / 10.0,
        position: Vector2::new(11.0, 19.0),
        depth_m: 3.1,
        altitude_m: Some(2.0),
        attitude: Attitude {
            heading,
            roll_rad: 0.0,
            pitch_rad: 0.1,
            rates_rad_s: Vector3::zeros(),
        },
        v_ground_body: Vector3::new(2.0, 0.0, 0.0),
        flow: Some(FlowEstimate {
            velocity: Vector2::new(0.1, -0.2),
            age_s: 0.5,
        }),
        fix_jump_m: 0.0,
    };
    let vertical = Vertical::Altitude(2.0);
    let robot = RobotFrame {
        id: "auv0".to_owned(),
        truth: Truth::at_rest(pose),
        altitude_m: 2.2,
        estimate,
        goal: Some(Goal {
            id: 3,
            manoeuvre: Manoeuvre::GoToPoint {
                point: Vector2::new(50.0, 60.0),
                radius_m: Some(5.0),
            },
            vertical,
            speed_m_s: 2.0,
        }),
        command: Some(Command::Steer(Setpoint {
            heading,
            water_speed_m_s: 2.0,
            vertical,
        })),
        actuators: ActuatorCommand::default(),
        chemical: Some(ChemicalReading {
            volts: 1.0,
            of_full_scale: 0.2,
            detected: true,
        }),
        detected: true,
        behaviour: Behaviour::TrackIn,
        lost_points: vec![Vector2::new(1.0, 2.0)],
        declaration: Some(Declaration {
            t_s: 1.0,
            position: Vector2::new(5.0, 6.0),
            rule: "p09",
        }),
    };
    Frame {
        t_s: step as f64 / 10.0,
        step,
        robots: vec![robot],
    }
}

fn plume(points: usize) -> PlumeFrame {
    PlumeFrame {
        t_s: 0.5,
        total: 10 * points,
        points: vec![[1.0, 2.0, -3.0, 0.5, 1e-6]; points],
    }
}

fn client(endpoint: &str) -> Session {
    let config = format!(
        r#"{{ mode: "client", connect: {{ endpoints: ["{endpoint}"] }}, scouting: {{ multicast: {{ enabled: false }} }} }}"#
    );
    let config = Config::from_json5(&config).expect("written here");
    zenoh::open(config).wait().expect("the run listens")
}

fn listen(session: &Session, run: &str) -> Samples {
    let key = format!("rheotaxis/{run}/**");
    session
        .declare_subscriber(key)
        .wait()
        .expect("key is valid")
}

/// What the run keeps, by key below the run's.
fn kept(session: &Session, run: &str) -> BTreeMap<String, Sample> {
    let base = format!("rheotaxis/{run}/");
    let replies = session
        .get(format!("{base}**"))
        .timeout(PATIENCE)
        .wait()
        .expect("session is open");
    replies
        .iter()
        .map(|reply| reply.into_result().expect("only samples are answered"))
        .map(|s| (s.key_expr().as_str()[base.len()..].to_owned(), s))
        .collect()
}

fn next(samples: &Samples) -> Sample {
    samples
        .recv_timeout(PATIENCE)
        .expect("session is open")
        .expect("something should have come by now")
}

fn json(sample: &Sample) -> Value {
    serde_json::from_slice(&sample.payload().to_bytes()).expect("payload is JSON")
}

/// The next message with this end of its key.
fn next_of(samples: &Samples, end: &str) -> Value {
    loop {
        let sample = next(samples);
        if sample.key_expr().as_str().ends_with(end) {
            return json(&sample);
        }
    }
}

/// Waits until everything handed over was sent or superseded.
fn sent(live: &Live) {
    while live.counts().sent + live.counts().superseded < live.counts().offered {
        std::thread::yield_now();
    }
}

/// Every way in which a value breaks a schema, of as much of JSON Schema as ours use.
fn broken(schema: &Value, value: &Value, at: &str, out: &mut Vec<String>) {
    let fits = match schema["type"].as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_u64() || value.is_i64(),
        Some("string") => value.is_string(),
        Some("boolean") => value.is_boolean(),
        _ => false,
    };
    if !fits {
        out.push(format!("{at}: {value} is no {}", schema["type"]));
        return;
    }
    for name in schema["required"].as_array().into_iter().flatten() {
        if value.get(name.as_str().unwrap_or_default()).is_none() {
            out.push(format!("{at}: {name} is missing"));
        }
    }
    for (name, field) in value.as_object().into_iter().flatten() {
        match schema["properties"].get(name) {
            Some(schema) => broken(schema, field, &format!("{at}.{name}"), out),
            None if schema["additionalProperties"] == false => {
                out.push(format!("{at}: {name} is unknown"));
            }
            None => {}
        }
    }
    if let Some(items) = value.as_array() {
        let n = items.len() as u64;
        let most = schema["maxItems"].as_u64().unwrap_or(u64::MAX);
        if n < schema["minItems"].as_u64().unwrap_or(0) || n > most {
            out.push(format!("{at}: {n} items"));
        }
        for item in items {
            broken(&schema["items"], item, at, out);
        }
    }
    if let Some(words) = schema["enum"].as_array()
        && !words.contains(value)
    {
        out.push(format!("{at}: {value} is none of {words:?}"));
    }
}

/// What every client must have seen in the end, whenever it came.
fn assert_whole(seen: &BTreeMap<String, Sample>, last_step: u64) {
    for topic in topics() {
        let schema = json(&seen[&format!("meta/schema/{}", topic.name)]);
        assert_eq!(schema, topic.schema());
    }
    assert_eq!(json(&seen["meta/scenario"])["name"], "Duck");
    assert_eq!(json(&seen["meta/version"])["version"], "0.1.0");
    assert_eq!(json(&seen["auv/auv0/behaviour"])["behaviour"], "track_in");
    assert_eq!(json(&seen["meta/digest"]), json!({"digest": "d1"}));
    let clock = json(&seen["clock"]);
    assert_eq!(
        (clock["step"].as_u64(), &clock["ended"]),
        (Some(last_step), &json!(true))
    );
}

#[test]
fn a_subscriber_started_before_the_run_sees_schema_state_and_end() {
    let port = TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let config = format!(
        r#"{{ mode: "peer", listen: {{ endpoints: [] }}, scouting: {{ multicast: {{ enabled: false }} }},
             connect: {{ endpoints: ["{endpoint}"], retry: {{ period_init_ms: 20, period_max_ms: 100 }} }} }}"#
    );
    let session = zenoh::open(Config::from_json5(&config).unwrap())
        .wait()
        .unwrap();
    let samples = listen(&session, "before_1");
    let alive = session
        .liveliness()
        .declare_subscriber("rheotaxis/*/@live/sim")
        .history(true)
        .wait()
        .unwrap();

    let options = LiveOptions {
        listen: Some(endpoint),
        ..options("before_1")
    };
    let live = Live::start(&options, meta()).unwrap();
    let token = next(&alive);
    assert_eq!(token.key_expr().as_str(), "rheotaxis/before_1/@live/sim");
    assert_eq!(token.kind(), SampleKind::Put);

    let mut seen = kept(&session, "before_1");
    live.publish(&frame(4));
    live.finish("d1");
    while !(seen.contains_key("clock") && json(&seen["clock"])["ended"] == true) {
        let sample = next(&samples);
        let key = sample.key_expr().as_str()["rheotaxis/before_1/".len()..].to_owned();
        seen.insert(key, sample);
    }
    assert_whole(&seen, 4);
    assert_eq!(next(&alive).kind(), SampleKind::Delete);
    session.close().wait().unwrap();
}

#[test]
fn a_subscriber_started_during_the_run_sees_schema_state_and_end() {
    let live = start("during_1");
    live.publish(&frame(1));
    sent(&live);
    let session = client(live.endpoint());
    let samples = listen(&session, "during_1");
    let mut seen = kept(&session, "during_1");
    assert_eq!(
        json(&seen["clock"])["step"],
        1,
        "the state at hand is told at once"
    );
    assert!(
        !seen.contains_key("meta/digest"),
        "no digest before the end"
    );

    live.publish(&frame(2));
    live.finish("d1");
    while json(&seen["clock"])["ended"] != true {
        let sample = next(&samples);
        let key = sample.key_expr().as_str()["rheotaxis/during_1/".len()..].to_owned();
        seen.insert(key, sample);
    }
    assert_whole(&seen, 2);
    session.close().wait().unwrap();
}

#[test]
fn a_subscriber_started_after_the_end_sees_schema_state_and_end_until_the_run_closes() {
    let live = start("after_1");
    live.publish(&frame(9));
    live.end("d1");
    // The end is published by another thread: ask until it is there.
    let session = client(live.endpoint());
    let mut seen = kept(&session, "after_1");
    while !seen
        .get("clock")
        .is_some_and(|clock| json(clock)["ended"] == true)
    {
        seen = kept(&session, "after_1");
    }
    assert_whole(&seen, 9);

    let alive = session
        .liveliness()
        .declare_subscriber("rheotaxis/after_1/@live/sim")
        .history(true)
        .wait()
        .unwrap();
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
    while seen.len() < 3 {
        let sample = samples.recv_timeout(PATIENCE).unwrap().expect("cached");
        seen.insert(sample.key_expr().as_str().to_owned(), json(&sample));
    }
    assert_eq!(
        seen["rheotaxis/advanced_1/meta/digest"],
        json!({"digest": "d1"})
    );
    assert_eq!(
        seen["rheotaxis/advanced_1/meta/version"]["version"],
        "0.1.0"
    );
    assert_eq!(seen["rheotaxis/advanced_1/meta/scenario"]["seed"], 7);
    drop(samples);
    drop(live);
    session.close().wait().unwrap();
}

#[test]
fn a_run_that_breaks_off_never_says_that_it_ended() {
    let live = start("broken_1");
    let session = client(live.endpoint());
    let samples = listen(&session, "broken_1");
    let alive = session
        .liveliness()
        .declare_subscriber("rheotaxis/broken_1/@live/sim")
        .history(true)
        .wait()
        .unwrap();
    assert_eq!(next(&alive).kind(), SampleKind::Put);
    live.publish(&frame(1));
    sent(&live);
    drop(live);
    assert_eq!(next(&alive).kind(), SampleKind::Delete);
    let clocks: Vec<Value> = samples
        .drain()
        .filter(|s| s.key_expr().as_str().ends_with("/clock"))
        .map(|s| json(&s))
        .collect();
    assert!(!clocks.is_empty());
    assert!(clocks.iter().all(|c| c["ended"] == false), "{clocks:?}");
    session.close().wait().unwrap();
}

#[test]
fn every_message_keeps_its_published_schema() {
    let live = start("schema_1");
    live.publish(&frame(3));
    live.plume(&plume(100));
    live.end("d1");
    let session = client(live.endpoint());
    let mut seen = kept(&session, "schema_1");
    while !seen
        .get("clock")
        .is_some_and(|clock| json(clock)["ended"] == true)
    {
        seen = kept(&session, "schema_1");
    }
    for topic in topics() {
        let schema = json(&seen[&format!("meta/schema/{}", topic.name)]);
        let key = topic.key.replace("<id>", "auv0").replace("<name>", "clock");
        let sample = seen
            .get(&key)
            .unwrap_or_else(|| panic!("{key} is not published"));
        let value = match topic.payload {
            Payload::Json | Payload::Schema => json(sample),
            Payload::PackedF32 => {
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
    let known: Vec<String> = topics()
        .iter()
        .map(|t| t.key.replace("<id>", "auv0"))
        .collect();
    for key in seen.keys().filter(|k| !k.starts_with("meta/schema/")) {
        assert!(known.contains(key), "{key} is published but in no table");
    }
    let packed = seen["plume"].payload().to_bytes();
    assert_eq!(packed.len(), 100 * 5 * 4);
    let mass = f32::from_le_bytes(packed[16..20].try_into().unwrap());
    assert_eq!(mass, 1e-6);
    session.close().wait().unwrap();
}

/// A subscriber in a process of its own, told by its environment where to connect and how to behave.
#[test]
#[ignore = "started by the tests below as a process of its own"]
fn subscriber_process() {
    let endpoint = std::env::var("LIVE_ENDPOINT").expect("started by another test");
    let session = client(&endpoint);
    let _samples = session
        .declare_subscriber("rheotaxis/**")
        .callback(|_| {
            println!("\nSTALLED");
            loop {
                std::thread::park();
            }
        })
        .wait()
        .unwrap();
    // An answer means that the run knows of the subscription.
    session
        .get("rheotaxis/*/clock")
        .wait()
        .unwrap()
        .recv()
        .unwrap();
    println!("\nREADY");
    loop {
        std::thread::park();
    }
}

struct Process(Child, BufReader<std::process::ChildStdout>);

impl Process {
    fn start(endpoint: &str) -> Self {
        let mut child = std::process::Command::new(std::env::current_exe().unwrap())
            .args([
                "--exact",
                "--ignored",
                "--nocapture",
                "live::subscriber_process",
            ])
            .env("LIVE_ENDPOINT", endpoint)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        let mut process = Self(child, out);
        process.wait_for("READY");
        process
    }

    fn wait_for(&mut self, word: &str) {
        let said = self
            .1
            .by_ref()
            .lines()
            .map_while(Result::ok)
            .any(|line| line == word);
        assert!(said, "the subscriber ended before it said {word}");
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

#[test]
fn a_killed_subscriber_changes_nothing_for_the_others() {
    let live = start("killed_1");
    live.publish(&frame(0));
    sent(&live);
    let session = client(live.endpoint());
    let samples = listen(&session, "killed_1");
    kept(&session, "killed_1");
    let mut victim = Process::start(live.endpoint());
    live.publish(&frame(1));
    victim.wait_for("STALLED");
    drop(victim);
    live.publish(&frame(2));
    sent(&live);
    live.finish("d1");
    while next_of(&samples, "/clock")
        != json!({"t_s": 0.2, "step": 2, "ended": true, "sent": 3, "superseded": 0})
    {}
    session.close().wait().unwrap();
}

#[test]
fn a_stalled_subscriber_holds_neither_the_run_nor_its_end() {
    let live = start("stalled_1");
    live.publish(&frame(0));
    sent(&live);
    let mut stalled = Process::start(live.endpoint());
    live.publish(&frame(1));
    stalled.wait_for("STALLED");
    // 12 MB, more than what sockets and queues between the two can take.
    let plume = plume(10_000);
    for step in 2..62 {
        live.plume(&plume);
        live.publish(&frame(step));
        sent(&live);
    }
    // The run meets a thread busy with a full queue, and goes on.
    for step in 62..10_062 {
        live.plume(&plume);
        live.publish(&frame(step));
    }
    assert_eq!(live.counts().offered, 10_062);
    assert!(live.counts().superseded > 0, "{:?}", live.counts());
    // One who comes now is served while the other still stalls.
    let session = client(live.endpoint());
    let samples = listen(&session, "stalled_1");
    kept(&session, "stalled_1");
    live.finish("d1");
    loop {
        let clock = next_of(&samples, "/clock");
        if clock["ended"] == true {
            assert_eq!(clock["step"], 10_061);
            break;
        }
    }
    drop(stalled);
    session.close().wait().unwrap();
}

#[test]
fn a_busy_port_is_named_with_the_cure() {
    let other = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = other.local_addr().unwrap().port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let options = LiveOptions {
        listen: Some(endpoint.clone()),
        ..options("busy_1")
    };
    let error = Live::start(&options, meta()).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "zenoh cannot listen on {endpoint}: port {port} is already in use; \
             choose another with --zenoh-listen, or run with --no-zenoh"
        )
    );
    assert_eq!(error, LiveError::BusyPort { endpoint, port });
}

#[test]
fn without_a_port_given_the_next_free_one_is_taken_and_told() {
    // Whoever holds it, ourselves or another program: it is busy.
    let _held = TcpListener::bind("127.0.0.1:7447");
    let options = LiveOptions {
        listen: None,
        ..options("default_1")
    };
    let live = Live::start(&options, meta()).unwrap();
    assert_ne!(live.endpoint(), "tcp/127.0.0.1:7447");
    assert_eq!(
        live.notice(),
        Some(&*format!(
            "port 7447 is already in use: zenoh listens on {}",
            live.endpoint()
        ))
    );
    let session = client(live.endpoint());
    assert!(kept(&session, "default_1").contains_key("meta/version"));
    session.close().wait().unwrap();
}

#[test]
fn a_configuration_file_is_honoured_whole() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("zenoh.json5");
    let port = TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port();
    let text = format!(
        r#"{{ mode: "peer", listen: {{ endpoints: ["tcp/127.0.0.1:{port}"] }}, scouting: {{ multicast: {{ enabled: false }} }} }}"#
    );
    std::fs::write(&file, text).unwrap();
    let options = LiveOptions {
        listen: None,
        config_file: Some(file),
        ..options("config_1")
    };
    let live = Live::start(&options, meta()).unwrap();
    assert_eq!(live.endpoint(), format!("tcp/127.0.0.1:{port}"));
    assert_eq!(live.notice(), None);
    let session = client(live.endpoint());
    assert_eq!(
        session.info().peers_zid().wait().count(),
        1,
        "the file says peer, so a peer it is"
    );
    assert!(kept(&session, "config_1").contains_key("meta/version"));
    session.close().wait().unwrap();
}

#[test]
fn a_wrong_configuration_or_endpoint_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.json5");
    let wrong = folder.path().join("wrong.json5");
    std::fs::write(&wrong, r#"{ mode: "captain" }"#).unwrap();
    for file in [missing, wrong] {
        let options = LiveOptions {
            config_file: Some(file.clone()),
            ..options("wrong_1")
        };
        let text = Live::start(&options, meta()).unwrap_err().to_string();
        let named = format!("zenoh configuration {}: ", file.display());
        assert!(text.starts_with(&named) && !text.contains(".rs:"), "{text}");
    }
    let options = LiveOptions {
        listen: Some("7447".to_owned()),
        ..options("wrong_1")
    };
    assert_eq!(
        Live::start(&options, meta()).unwrap_err().to_string(),
        "`7447` is not a zenoh endpoint; write one like tcp/127.0.0.1:7447"
    );
}
