//! Every message of runs of each kind keeps the schema that the run itself publishes.

use super::kit::broken;
use crate::common::{lasting, scenario, short};
use output::live::topics;
use rheotaxis::control::{Question, Response, read_answer};
use rheotaxis::registry::{Registry, messages};
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, Trial};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Holds each message of each state against its schema.
struct Checking {
    /// Name, key and schema of each topic.
    topics: Vec<(&'static str, &'static str, Value)>,
    /// The topics that something was said of.
    said: BTreeSet<&'static str>,
    /// The manoeuvres and commands that were said.
    words: BTreeSet<String>,
}

impl Checking {
    fn new() -> Self {
        let topics = topics(&Registry::default()).into_iter();
        Self {
            topics: topics.map(|t| (t.name, t.key, t.schema())).collect(),
            said: BTreeSet::new(),
            words: BTreeSet::new(),
        }
    }
}

impl Observer for Checking {
    fn see(&mut self, event: &Event) {
        let Event::Frame(frame) = event else {
            return;
        };
        for (key, value) in messages(frame) {
            let of = |pattern: &str| {
                let chunks = pattern.split('/').zip(key.split('/'));
                pattern.split('/').count() == key.split('/').count() && { chunks }
                    .all(|(p, k)| p.starts_with('<') || p == k)
            };
            let topic = self.topics.iter().find(|(_, pattern, _)| of(pattern));
            let (name, _, schema) = topic.unwrap_or_else(|| panic!("{key} is in no table"));
            let mut wrong = Vec::new();
            broken(schema, &value, &key, &mut wrong);
            assert!(wrong.is_empty(), "at {} s: {wrong:#?}\n{value}", frame.t_s);
            self.said.insert(name);
            let words = ["manoeuvre", "kind"].map(|field| value[field].as_str());
            self.words.extend(words.into_iter().flatten().map(str::to_owned));
        }
    }
}

/// The beginning of a run, and what it has said.
fn checked(loaded: &Loaded) -> Checking {
    let mut checking = Checking::new();
    let mut trial = Trial::assemble(loaded, 1).expect("legal");
    trial.run(&mut checking);
    checking
}

#[test]
fn vehicles_of_each_kind_and_searchers_of_each_kind_keep_their_schemas() {
    let robots = ["truth", "estimate", "goal", "command", "behaviour"];
    for (name, more) in [
        ("uniform_channel", "chemical"),
        ("t13_siz", "layers"),
        ("duck_mt", "flow"),
        ("lauv_bay", "chemical"),
        ("glider_shelf", "chemical"),
        ("surface_lake", "chemical"),
    ] {
        let said = checked(&short(name, 1.0, 2.0)).said;
        for topic in robots.iter().chain(&[more]) {
            assert!(said.contains(topic), "{name} says no {topic}: {said:?}");
        }
    }
    let said = checked(&short("flume_crab", 1.0, 1.0)).said;
    let gantry = ["joints", "probes", "spikes", "gantry_behaviour"];
    assert!(gantry.iter().all(|t| said.contains(t)), "{said:?}");
}

/// A run of a scenario whose searcher gives these answers, again and again.
fn answered(loaded: &Loaded, robot: &str, answers: Vec<Value>) -> Checking {
    let mut checking = Checking::new();
    let mut trial = Trial::assemble(loaded, 1).expect("legal");
    let mut next = answers.into_iter().cycle();
    let answer = move |asked: &Question| {
        let text = next.next().expect("without end").to_string();
        let read = read_answer(text.as_bytes(), asked.number, asked.t_s);
        read.map_or_else(|why| panic!("{text}: {why}"), Response::Answer)
    };
    trial.control(robot, answer).expect("it asks");
    trial.run(&mut checking);
    let consulted = trial.score().searchers[0].consulted.expect("it asked");
    assert_eq!(consulted.answered, consulted.asked, "each can be carried out");
    checking
}

#[test]
fn searchers_outside_keep_the_schemas_with_all_that_they_may_order() {
    let place = [10.0, -20.0];
    let goal = |manoeuvre: Value| json!({"goal": {"manoeuvre": manoeuvre, "altitude_m": 3.0, "speed_m_s": 1.0}});
    let orders = |drives: usize| {
        vec![
            goal(json!({"go_to_point": {"point_m": place}})),
            goal(json!({"go_to_point": {"point_m": place, "radius_m": 4.0}})),
            goal(json!({"follow_line": {"from_m": place, "to_m": [0.0, 0.0]}})),
            goal(json!({"go_to_point_with_heading": {"point_m": place, "heading_rad": 1.0}})),
            goal(json!({"hold": {"point_m": place}})),
            goal(json!({"hold": {"point_m": place, "heading_rad": 1.0}})),
            goal(json!({"slide_to": {"point_m": place, "heading_rad": 1.0}})),
            goal(json!({"slide_to": {"point_m": place, "radius_m": 4.0, "heading_rad": 1.0}})),
            goal(json!({"course": {"heading_rad": 1.0}})),
            json!({"steer": {"heading_rad": 1.0, "speed_m_s": 1.0, "depth_m": 3.0}}),
            json!({"slide": {"heading_rad": 1.0, "velocity_m_s": [0.5, 0.1]}}),
            json!({"drives": {"set": vec![0.1; drives]}}),
            json!({"behaviour": "own_word", "declare": {"position_m": place, "rule": "own_rule"}}),
        ]
    };
    for (vehicle, drives, fins) in
        [("Remus100()", 3, true), ("Kinematic()", 3, false), ("Shipped(\"bluerov2_heavy\")", 8, false)]
    {
        let values = [("robots[0].vehicle", vehicle), ("robots[0].strategy", "External(period_s: 0.2)")];
        let loaded = lasting(scenario("uniform_channel", &values), 1.0, 3.5);
        let mut orders = orders(drives);
        if fins {
            orders.push(goal(json!({"direct": {"rudder_rad": 0.1, "stern_rad": 0.0, "rpm": 900.0}})));
        }
        let checking = answered(&loaded, "auv0", orders);
        assert!(checking.said.contains("declaration"), "{vehicle}");
        let (_, _, schema) = (checking.topics.iter()).find(|(name, ..)| *name == "goal").expect("a topic");
        let words = schema["properties"]["manoeuvre"]["enum"].as_array();
        for word in words.expect("a list").iter().filter_map(Value::as_str) {
            let said = checking.words.contains(word);
            assert!(said || word == "direct", "{vehicle}: {word}");
        }
    }
    let heads = vec![
        json!({"head": {"target_m": [1.0, 0.0], "behaviour": "step_up"}}),
        json!({"head": {"target_m": [0.9, 0.1], "speed_m_s": [0.05, 0.05]}}),
        json!({"declare": {"position_m": [0.1, 0.2]}, "end": "completed"}),
    ];
    let flume = answered(&short("flume_external", 1.0, 3.0), "crab0", heads);
    let said = ["joints", "gantry_behaviour", "gantry_declaration"];
    assert!(said.iter().all(|t| flume.said.contains(t)), "{:?}", flume.said);
}
