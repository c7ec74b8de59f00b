//! The same decisions give the same run, whoever makes them.

use super::kit::{AMP, Run, asking, channel, channel_of, client, controller, external};
use crate::common;
use crate::waits::PATIENCE;
use rheotaxis::control::{Question, QuestionContent, Response, consultation_json};
use rheotaxis::scenario::Id;
use rheotaxis::trial::{Event, Observer, Trial};
use robots::handoff::Reply;
use serde_json::{Value, json};
use world::ranges::Finite;
use world::seeds::{Seed, Stream};
use zenoh::Wait;

/// Long enough for a plume to be found, lost and found again, s.
const LONG_S: f64 = 400.0;
/// The run in this process, where no deadline counts, of which `planner_answers.json` has the text.
const EACH_STEP: &str = "External(period_s: 0.02, deadline_s: 20, on_late: Abort)";

#[derive(Default)]
struct Answers(Vec<Value>);

impl Observer for Answers {
    fn see(&mut self, event: &Event) {
        if let Event::Exchange(exchange) = event {
            self.0.push(consultation_json(exchange)["answer"].clone());
        }
    }
}

/// What the planner of the paper answers in each step, and the digest of its run.
fn recorded(limit_s: f64) -> (Vec<Value>, String) {
    let plain = channel_of(AMP, limit_s);
    let inside = Trial::assemble(&plain, 1).expect("legal").finish_quietly();
    let mut trial = Trial::assemble(&channel_of(EACH_STEP, limit_s), 1).expect("legal");
    let ocean = trial.simulation.ocean();
    let robot = &plain.scenario.robots[0];
    let setting = robot.setting(&ocean.area, &ocean.terrain, &ocean.obstacles);
    let mut planner = robot.strategy.build(&setting).expect("legal");
    let mut rng = Stream::new(Seed::from(1), "auv0", "strategy");
    let decide = move |question: &Question| match &question.seen {
        QuestionContent::Robot(seen, _) => Response::Answer(Reply::from(&planner.step(seen, &mut rng))),
        QuestionContent::Gantry(..) => Response::Absent,
    };
    trial.control("auv0", decide).expect("it asks");
    let mut answers = Answers::default();
    assert_eq!(trial.run(&mut answers).digest, inside.digest);
    (answers.0, inside.digest)
}

#[test]
fn a_stream_of_decisions_over_zenoh_gives_the_digest_of_the_planner_itself() {
    let (answers, digest) = recorded(40.0);
    let run = Run::controlled(&channel(&asking(0.02, "Abort"), 40.0));
    let session = client(&run.endpoint);
    let decided = answers.clone();
    let _controller = controller(&session, "auv0", move |question| {
        let number = question["number"].as_u64().expect("a number") as usize;
        decided[number].to_string()
    });
    let end = run.end();
    assert_eq!(end.digest(), digest, "{}", end.said);
    assert_eq!(end.count(0, "answered"), answers.len() as u64);
    end.run_again();
    session.close().wait().unwrap();
}

/// The same stream for the tests of other doors: each answer with how often it comes in a row.
#[test]
fn the_stream_that_other_doors_are_tested_with_is_the_planners() {
    let (answers, digest) = recorded(LONG_S);
    let mut runs: Vec<(Value, u64)> = Vec::new();
    for answer in answers {
        match runs.last_mut() {
            Some((known, times)) if *known == answer => *times += 1,
            _ => runs.push((answer, 1)),
        }
    }
    let scenario = channel(EACH_STEP, LONG_S);
    let now = json!({"scenario": scenario, "seed": 1, "digest": digest, "answers": runs});
    let path = common::root().join("tests/golden/planner_answers.json");
    if std::env::var_os("RHEOTAXIS_BLESS").is_some() {
        std::fs::write(&path, format!("{now:#}\n")).expect("written");
    }
    let kept = std::fs::read_to_string(&path).expect("it is there");
    let kept: Value = serde_json::from_str(&kept).expect("JSON");
    assert!(kept == now, "the planner's answers have changed: write them with RHEOTAXIS_BLESS=1");
}

#[test]
fn each_robot_has_a_controller_of_its_own() {
    let both = channel_of(&external("Hold"), 5.0).edit(|s| {
        let mut second = s.robots[0].clone();
        second.id = Id::try_from("auv1".to_string()).expect("a name");
        second.start.north_m = Finite::new(30.0);
        s.robots.push(second);
    });
    let run = Run::controlled(&both.text());
    let session = client(&run.endpoint);
    let to = |robot: &'static str, rad: f64| {
        controller(&session, robot, move |question| {
            assert_eq!(question["robot"], robot);
            json!({"number": question["number"], "steer": {"heading_rad": rad}, "behaviour": robot}).to_string()
        })
    };
    let controllers = [to("auv0", 1.0), to("auv1", 2.0)];
    let end = run.end();
    for robot in [0, 1] {
        assert_eq!(end.count(robot, "answered"), 5, "{}", end.summary);
        let name = format!("auv{robot}");
        assert_eq!(end.summary["robots"][robot]["last_behaviour"], name);
    }
    end.run_again();
    drop(controllers);
    session.close().wait().unwrap();
}

#[test]
fn a_gantry_goes_where_it_is_told() {
    let deadline_s = PATIENCE.as_secs().to_string();
    let patient =
        [("time.limit_s", "6"), ("time.spin_up_s", "2"), ("gantries[0].tracker.deadline_s", deadline_s.as_str())];
    let run = Run::controlled(&common::scenario("flume_external", &patient).text());
    let session = client(&run.endpoint);
    let _controller = controller(&session, "crab0", |question| {
        let scans = question["scans"].as_array().expect("scans").len();
        let end = (question["number"] == 20).then_some("completed");
        let mut answer = json!({"head": {"target_m": [0.1, 0.3], "behaviour": "step_up"}});
        if let Some(end) = end {
            answer["end"] = json!(end);
        }
        assert!(scans > 0 || question["number"] == 0);
        answer.to_string()
    });
    let end = run.end();
    let gantry = &end.summary["gantries"][0];
    assert_eq!(gantry["consulted"]["answered"], 21, "{gantry}");
    end.run_again();
    session.close().wait().unwrap();
}
