//! A run to listen to, and a client to listen with.

use crate::common::root;
use crate::waits::{PATIENCE, until};

use nalgebra::{Vector2, Vector3};
use output::live::{Live, LiveMeta, LiveOptions, Scene, topics};
use rheotaxis::frame::{Frame, NewestReadings, PlumeFrame, RobotFrame, TimedReading, WaterFrame};
use rheotaxis::gantry::GantryFrame;
use rheotaxis::scenario::load;
use robots::handoff::{
    Actuation, Attitude, Behaviour, Belief, BeliefGrid, ChemicalReading, Command, Declaration, Estimate, FlowEstimate,
    Goal, HeadGoal, JointReadings, Layer, LayerState, MAX_PROBES, Manoeuvre, Outcome, PictureEvidence, ProbeScan,
    Region, RegionState, Regions, Setpoint, Shown, TrackerState, Vertical, Zone,
};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;
use world::area::Area;
use world::frames::{Pose, Truth};
use world::physics::JointState;
use world::registry::Registry;
use world::units::Heading;
use zenoh::handlers::FifoChannelHandler;
use zenoh::pubsub::Subscriber;
use zenoh::sample::Sample;
use zenoh::{Config, Session, Wait};

pub(super) type Samples = Subscriber<FifoChannelHandler<Sample>>;

pub(super) fn meta() -> LiveMeta {
    LiveMeta {
        scenario_text: "(version: 1)".to_owned(),
        scenario_name: "Duck".to_owned(),
        seed: 7,
        version: "0.1.0".to_owned(),
        scene: Some(scene_document()),
        topics: topics(&Registry::default()),
    }
}

/// The document of a scene, as a run publishes it.
pub(super) fn scene_document() -> String {
    let path = root().join("scenarios/catalog/uniform_channel.ron");
    Scene::from_scenario(&load(&path).unwrap()).unwrap().document(7)
}

pub(super) fn options(run: &str) -> LiveOptions {
    LiveOptions {
        listen: Some("tcp/127.0.0.1:0".to_owned()),
        state_period: Duration::ZERO,
        plume_period: Duration::ZERO,
        ..LiveOptions::new(run.to_owned())
    }
}

pub(super) fn start(run: &str) -> Live {
    Live::start(&options(run), meta()).expect("any free port will do")
}

/// Two cells, the first more likely.
fn belief() -> Belief {
    Belief {
        t_s: 1.0,
        updates: 3,
        informed: true,
        grid: Arc::new(BeliefGrid {
            corner: Vector3::new(0.0, 0.0, -4.0),
            axes: [Vector2::x(), Vector2::y()],
            cell_m: [2.0, 3.0, 4.0],
            n: [2, 1, 1],
        }),
        p: Arc::new(vec![0.75, 0.25]),
        best: 0,
        entropy_nat: 0.562,
        credible_95: 12.0,
        odour: None,
        outlook: None,
    }
}

/// A state in which everything is said that can be.
pub(super) fn frame(step: u64) -> Frame {
    let heading = Heading::from_deg(45.0);
    let pose = Pose::level(Vector3::new(10.0, 20.0, -3.0), heading);
    let estimate = Estimate {
        t_s: step as f64 / 10.0,
        position: Vector2::new(11.0, 19.0),
        depth_m: 3.1,
        altitude_m: Some(2.0),
        attitude: Attitude { heading, roll_rad: 0.0, pitch_rad: 0.1, rates_rad_s: Vector3::zeros() },
        v_ground_body: Vector3::new(2.0, 0.0, 0.0),
        flow: Some(FlowEstimate { velocity: Vector2::new(0.1, -0.2), age_s: 0.5 }),
        fix_jump: Vector2::zeros(),
    };
    let vertical = Vertical::Altitude(2.0);
    let robot = RobotFrame {
        id: "auv0".to_owned(),
        truth: Truth::at_rest(pose),
        altitude_m: 2.2,
        estimate,
        goal: Some(Goal {
            id: 3,
            manoeuvre: Manoeuvre::GoToPoint { point: Vector2::new(50.0, 60.0), radius_m: Some(5.0) },
            vertical,
            speed_m_s: 2.0,
        }),
        command: Some(Command::Steer(Setpoint { heading, water_speed_m_s: 2.0, vertical })),
        keeps_height: true,
        actuators: Actuation::default(),
        readings: NewestReadings {
            ranging: Some(super::readings::ping_ahead()),
            other: BTreeMap::from([("pressure_pa", TimedReading { t_s: 1.0, value: 8e4 })]),
            ..NewestReadings::default()
        },
        shown: Shown {
            zone: Zone::round(vec![Vector2::zeros(), Vector2::x()], 6.0),
            layers: vec![
                Layer { name: "find", state: LayerState::Suppressed },
                Layer { name: "maintain", state: LayerState::Holds },
            ],
            lost_points: vec![Vector2::new(1.0, 2.0)],
            planned: Vec::new(),
            regions: Regions {
                all: vec![Region {
                    area: Area { centre: Vector2::zeros(), length_m: 100.0, width_m: 50.0, axis: heading },
                    state: RegionState::Searching,
                    from_s: Some(0.0),
                    until_s: None,
                }],
                now: Some(0),
            },
        },
        chemical: Some(ChemicalReading { volts: 1.0, of_full_scale: 0.2, detected: true }),
        detected: true,
        behaviour: Behaviour::TrackIn,
        belief: Some(belief()),
        declarations: vec![Declaration {
            region: Some(0),
            surveyed: Some(Vector2::new(5.5, 6.5)),
            looked: Some(PictureEvidence {
                pictures: 12,
                useless: 1,
                lines: 3,
                lowest_m: 1.5,
                visibility_m: Some(4.0),
                log_factor: 5.5,
            }),
            ..Declaration::first(1.0, Vector2::new(5.0, 6.0), "p09")
        }],
        fix_m: Some(3.0),
    };
    Frame {
        t_s: step as f64 / 10.0,
        step,
        robots: vec![robot],
        gantries: vec![gantry()],
        abnormal: Vec::new(),
        published: Vec::new(),
    }
}

/// A gantry that has stopped, leaning on something.
fn gantry() -> GantryFrame {
    let head_W = Vector3::new(0.2, 0.01, -0.125);
    let mut volts = [0.0; MAX_PROBES];
    volts[0] = -4.2;
    GantryFrame {
        id: "crab0".to_owned(),
        joint_names: ["along".to_owned(), "across".to_owned()],
        joints: [JointState::default(); 2],
        readings: JointReadings::default(),
        forward: Vector2::new(-1.0, 0.0),
        head_W,
        tips_W: vec![head_W],
        scan: Some(ProbeScan { t_s: 0.35, volts, count: 1 }),
        behaviour: Behaviour::Done,
        goal: HeadGoal { id: 12, ..HeadGoal::default() },
        outcome: Some(Outcome::Completed),
        shown: TrackerState { predicted_v: Some(0.4), ..TrackerState::default() },
        touching: Some("block".to_owned()),
        declarations: vec![Declaration::first(0.3, head_W.xy(), "stop")],
    }
}

pub(super) fn plume(points: usize) -> PlumeFrame {
    PlumeFrame {
        t_s: 0.5,
        total: 10 * points,
        points: vec![[1.0, 2.0, -3.0, 0.5, 1e-5, 10.0]; points],
        ..PlumeFrame::default()
    }
}

/// The flow at two places.
pub(super) fn water() -> WaterFrame {
    WaterFrame { t_s: 0.5, points: vec![[1.0, 2.0, -3.0, 0.25, 0.0, -0.5]; 2], ..WaterFrame::default() }
}

pub(super) fn client(endpoint: &str) -> Session {
    let config = format!(
        r#"{{ mode: "client", connect: {{ endpoints: ["{endpoint}"] }}, scouting: {{ multicast: {{ enabled: false }} }} }}"#
    );
    let config = Config::from_json5(&config).expect("written here");
    zenoh::open(config).wait().expect("the run listens")
}

pub(super) fn listen(session: &Session, run: &str) -> Samples {
    let key = format!("rheotaxis/{run}/**");
    session.declare_subscriber(key).wait().expect("key is valid")
}

/// What the run keeps, by key below the run's.
pub(super) fn kept(session: &Session, run: &str) -> BTreeMap<String, Sample> {
    let base = format!("rheotaxis/{run}/");
    let replies = session.get(format!("{base}**")).timeout(PATIENCE).wait().expect("session is open");
    replies
        .iter()
        .map(|reply| reply.into_result().expect("only samples are answered"))
        .map(|s| (s.key_expr().as_str()[base.len()..].to_owned(), s))
        .collect()
}

pub(super) fn next(samples: &FifoChannelHandler<Sample>) -> Sample {
    samples.recv_timeout(PATIENCE).expect("session is open").expect("something should have come by now")
}

pub(super) fn json(sample: &Sample) -> Value {
    serde_json::from_slice(&sample.payload().to_bytes()).expect("payload is JSON")
}

/// The next message with this end of its key.
pub(super) fn next_of(samples: &Samples, end: &str) -> Value {
    loop {
        let sample = next(samples);
        if sample.key_expr().as_str().ends_with(end) {
            return json(&sample);
        }
    }
}

/// What the run keeps once it has ended, which another thread publishes: asked for until it is there.
pub(super) fn kept_at_the_end(session: &Session, run: &str) -> BTreeMap<String, Sample> {
    until("the run's clock says that it has ended", || {
        let seen = kept(session, run);
        let ended = (seen.get("clock")).is_some_and(|clock| json(clock)["ended"] == true);
        ended.then_some(seen)
    })
}

/// Waits until everything handed over was sent or superseded.
#[track_caller]
pub(super) fn sent(live: &Live) {
    until("all is sent or superseded", || {
        let counts = live.counts();
        (counts.sent + counts.superseded >= counts.offered).then_some(())
    });
}

/// Every way in which a value breaks a schema, of as much of JSON Schema as ours use.
pub(super) fn broken(schema: &Value, value: &Value, at: &str, out: &mut Vec<String>) {
    // A list of types: that one, or null.
    let kinds = &schema["type"];
    if kinds[1] == "null" && value.is_null() {
        return;
    }
    let fits = match kinds[0].as_str().or(kinds.as_str()) {
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
    if schema["pattern"] == "^[a-z0-9_]+$" {
        let small = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if !value.as_str().is_some_and(|s| !s.is_empty() && s.chars().all(small)) {
            out.push(format!("{at}: {value} is no name"));
        }
    }
    if let Some(branches) = schema["anyOf"].as_array() {
        let fits = |branch: &Value| {
            let mut wrong = Vec::new();
            broken(branch, value, at, &mut wrong);
            wrong.is_empty()
        };
        if !branches.iter().any(fits) {
            out.push(format!("{at}: {value} fits none of {branches:?}"));
        }
    }
}
