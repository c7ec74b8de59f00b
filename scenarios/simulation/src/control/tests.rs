use super::*;
use crate::ocean::Ocean;
use crate::outcome::RunOutcome;
use crate::scenario::{Loaded, load_text, template};
use crate::trial::{Event, Observer, RunEnd, Trial, Unwatched};
use nalgebra::Vector2;
use robots::handoff::{Declaration, GantryLayout, HeadGoal, Manoeuvre, MotionOrder, MoveOrder};
use robots::strategy::Strategy;
use robots::vehicles::Gantry;
use world::registry::Registry;
use world::seeds::{Seed, Stream};
use world::units::Heading;

const SEED: u64 = 3;

/// A scenario of the catalogue with some of its text replaced.
fn changed(name: &str, changes: &[(&str, &str)]) -> Loaded {
    let mut text = template(name).expect("in the catalogue").text.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "{name} has no {from:?}");
        text = text.replacen(from, to, 1);
    }
    load_text(&Registry::default(), "changed", &text).expect("legal")
}

/// A channel of 120 s, and the same with a searcher outside.
fn channels() -> [Loaded; 2] {
    let short = ("limit_s: 1800", "limit_s: 120");
    let plain = changed("uniform_channel", &[short]);
    let mut outside = plain.clone();
    let period_s = plain.scenario.time.step_s;
    outside.scenario.robots[0].strategy = external(period_s.get());
    [plain, outside]
}

fn external(period_s: f64) -> robots::strategy::StrategySpec {
    robots::strategy::StrategySpec::new(robots::strategy::ExternalSpec {
        period_s: world::ranges::Positive::new(period_s),
        ..Default::default()
    })
}

/// The strategy of a scenario's robot, built anew by a user of the library.
fn own_strategy(plain: &Loaded) -> (Box<dyn Strategy>, Stream) {
    let trial = Trial::assemble(plain, SEED).expect("legal");
    let ocean: &Ocean = trial.simulation.ocean();
    let robot = &plain.scenario.robots[0];
    let setting = robot.setting(&ocean.area, &ocean.terrain, &ocean.obstacles);
    let strategy = robot.strategy.build(&setting).expect("legal");
    let rng = Stream::new(Seed::from(SEED), robot.id.as_str(), "strategy");
    (strategy, rng)
}

fn controller(plain: &Loaded) -> impl Controller + 'static {
    let (mut strategy, mut rng) = own_strategy(plain);
    move |question: &Question| match &question.seen {
        QuestionContent::Robot(seen, _) => Response::Answer(Reply::from(&strategy.step(seen, &mut rng))),
        QuestionContent::Gantry(..) => panic!("a robot asks"),
    }
}

/// Keeps what is told.
#[derive(Default)]
struct Kept(Vec<Exchange>);

impl Observer for Kept {
    fn see(&mut self, event: &Event) {
        if let Event::Exchange(exchange) = event {
            self.0.push(Exchange::clone(exchange));
        }
    }
}

fn run(loaded: &Loaded, controller: impl Controller + 'static) -> (RunEnd, Vec<Exchange>) {
    let mut trial = Trial::assemble(loaded, SEED).expect("legal");
    let name = trial.controlled().first().expect("asks").clone();
    trial.control(&name, controller).expect("it asks");
    let mut kept = Kept::default();
    let ended = trial.run(&mut kept);
    (ended, kept.0)
}

#[test]
fn a_strategy_of_this_program_gives_the_same_digest_from_outside() {
    let [plain, outside] = channels();
    let inside = Trial::assemble(&plain, SEED).expect("legal").finish_quietly();
    let (ended, told) = run(&outside, controller(&plain));
    assert_eq!(ended.digest, inside.digest);
    assert_eq!((ended.outcome, ended.steps), (inside.outcome, inside.steps));
    assert_eq!(told.len() as u64, ended.steps, "asked in every step");
    assert!(told.iter().all(|t| t.response.name() == "answered"));

    // Written and read again, the answers make the same run.
    let read = told.iter().map(|t| {
        let text = consultation_json(t).to_string();
        let read = read_consultation(&text).expect("as it was written");
        assert_eq!(consultation_json(&read).to_string(), text);
        read
    });
    let (again, _) = run(&outside, Replay::new(read));
    assert_eq!(again.digest, inside.digest);
}

/// A declaration moves nothing, and the run answers for it: its digest is another.
#[test]
fn runs_that_differ_only_in_what_is_declared_have_different_digests() {
    let [plain, outside] = channels();
    let declaring = |east_m: Option<f64>| {
        let mut steers = controller(&plain);
        let (ended, _) = run(&outside, move |question: &Question| {
            let mut heard = steers.answer(question);
            if let (200, Response::Answer(answer), Some(east_m)) = (question.number, &mut heard, east_m) {
                let place = Vector2::new(east_m, 0.0);
                answer.declared = Some(Declaration::first(question.t_s, place, "outside"));
            }
            heard
        });
        assert_eq!(ended.outcome == RunOutcome::NotFound, east_m.is_some());
        (ended.steps, ended.digest)
    };
    let ends = [Some(-40.0), Some(-41.0), None, Some(-40.0)].map(declaring);
    assert!(ends.iter().all(|end| end.0 == ends[0].0));
    assert_eq!(ends[0], ends[3]);
    let differ = |a: usize, b: usize| ends[a].1 != ends[b].1;
    assert!(differ(0, 1) && differ(0, 2) && differ(1, 2), "{ends:?}");
}

#[test]
fn stopping_at_the_questions_changes_nothing() {
    let [plain, outside] = channels();
    let (ended, _) = run(&outside, controller(&plain));
    let mut controller = controller(&plain);
    let mut trial = Trial::assemble(&outside, SEED).expect("legal");
    loop {
        let questions = trial.until_asked(&mut Unwatched);
        let Some(question) = questions.first() else {
            break;
        };
        let heard = controller.answer(question);
        let told = trial.answer("auv0", heard.clone(), &mut Unwatched).expect("it asked");
        assert_eq!(told.response.name(), "answered");
        assert_eq!(trial.answer("auv0", heard, &mut Unwatched), None, "once");
    }
    assert_eq!(trial.ended().digest, ended.digest);
    let counts = trial.score().searchers[0].consulted.expect("it asked");
    assert_eq!((counts.asked, counts.answered), (ended.steps, ended.steps));
}

#[test]
fn what_cannot_be_carried_out_is_nonsense_and_told() {
    let [_, mut outside] = channels();
    outside.scenario.robots[0].strategy = external(10.0);
    let wrong = [
        ("{\"drives\": {\"set\": [0.1]}}", "3 drives, got 1"),
        ("{\"steer\": {\"heading_rad\": 1.0, \"speed_m_s\": -1}}", "`speed_m_s` must be from 0"),
        ("{\"head\": {\"target_m\": [1, 2]}}", "order for a gantry"),
        ("{\"steer\": {\"heading_rad\": 1.0, \"depth_m\": 1, \"altitude_m\": 2}}", "not both"),
        ("{\"steer\": {\"heading_deg\": 90}}", "unknown field `heading_deg`"),
        ("{\"number\": 4, \"end\": \"completed\"}", "answers question 4, not 5"),
        ("{\"behaviour\": \"Go!\"}", "characters a-z"),
        ("{\"declare\": {\"position_m\": [1e9, 0]}}", "`declare.position_m`"),
        ("[1, 2", "expected"),
    ];
    let mut next = wrong.into_iter();
    let (_, told) = run(&outside, move |question: &Question| {
        let (text, _) = next.next().unwrap_or(("{}", ""));
        match read_answer(text.as_bytes(), question.number, question.t_s) {
            Ok(answer) => Response::Answer(answer),
            Err(why) => Response::Nonsense(why),
        }
    });
    assert!(told.len() >= wrong.len(), "{}", told.len());
    for (told, (text, why)) in told.iter().zip(wrong) {
        let Response::Nonsense(said) = &told.response else {
            panic!("{text} is nonsense, but: {:?}", told.response);
        };
        assert!(said.contains(why), "{text}: {said}");
    }
}

#[test]
fn a_goal_is_read_as_its_manoeuvre() {
    let read = |manoeuvre: &str| {
        let text = format!("{{\"goal\": {{\"manoeuvre\": {manoeuvre}}}}}");
        read_answer(text.as_bytes(), 0, 0.0).map(|answer| match answer.order {
            Some(MotionOrder::Move(order)) => order.manoeuvre,
            other => panic!("{other:?}"),
        })
    };
    // Whole turns too many are taken away.
    let course = Manoeuvre::Course { course: Heading::from_rad(7.0) };
    assert_eq!(read("{\"course\": {\"heading_rad\": 7.0}}"), Ok(course));
    let hold = Manoeuvre::Hold { point: Vector2::new(1.0, -2.0), heading: None };
    assert_eq!(read("{\"hold\": {\"point_m\": [1, -2]}}"), Ok(hold));
    // What an answer asks for in fields of its own is no manoeuvre of a goal.
    for (wrong, why) in [
        ("{\"steer\": {\"heading_rad\": 1.0}}", "unknown variant `steer`, expected one of `go_to_point`"),
        ("{\"hold\": {\"point\": [1, -2]}}", "unknown field `point`, expected `point_m` or `heading_rad`"),
        ("{\"hold\": {\"point_m\": [1]}}", "invalid length 1, expected an array of length 2"),
    ] {
        let said = read(wrong).expect_err(wrong);
        assert!(said.contains(why), "{said}");
    }
}

#[test]
fn nothing_that_is_not_a_number_comes_in() {
    let [_, outside] = channels();
    let mut trial = Trial::assemble(&outside, SEED).expect("legal");
    trial.until_asked(&mut Unwatched);
    let order = |speed_m_s, heading| {
        Response::Answer(Reply {
            order: Some(MotionOrder::Move(MoveOrder {
                id: None,
                manoeuvre: Manoeuvre::Steer { heading: Heading::from_rad(heading) },
                vertical: None,
                speed_m_s: Some(speed_m_s),
            })),
            ..Reply::default()
        })
    };
    let told = trial.answer("auv0", order(f64::NAN, 0.0), &mut Unwatched);
    assert_eq!(told.expect("it asked").response.name(), "nonsense");
    trial.until_asked(&mut Unwatched);
    let told = trial.answer("auv0", order(1.0, f64::INFINITY), &mut Unwatched);
    assert_eq!(told.expect("it asked").response.name(), "nonsense");
}

#[test]
fn nobody_controls_a_robot_that_does_not_ask() {
    let [plain, outside] = channels();
    let mut trial = Trial::assemble(&plain, SEED).expect("legal");
    let refused = trial.control("auv0", |_: &Question| Response::Late);
    assert!(refused.unwrap_err().to_string().ends_with("none has"));
    let mut trial = Trial::assemble(&outside, SEED).expect("legal");
    let refused = trial.control("auv1", |_: &Question| Response::Late);
    assert!(refused.unwrap_err().to_string().ends_with("those that have: auv0"));
    assert!(!trial.step() || trial.score().searchers[0].consulted.is_some_and(|c| c.absent == 1));
}

#[test]
fn a_question_tells_what_was_sensed_since_the_last_one() {
    let [_, mut outside] = channels();
    outside.scenario.robots[0].strategy = external(2.0);
    let mut trial = Trial::assemble(&outside, SEED).expect("legal");
    trial.until_asked(&mut Unwatched);
    let questions = trial.until_asked(&mut Unwatched);
    let said = question_json(&questions[0]);
    assert_eq!((questions[0].number, questions[0].t_s), (1, 2.0));
    let readings = said["gathered"]["readings"].as_u64().expect("a count");
    assert!(readings > 1, "{said}");
    for field in ["estimate", "guidance", "home_m", "area_m", "able"] {
        assert!(!said[field].is_null(), "{field}");
    }
}

/// A searcher of a gantry, built anew by a user of the library.
fn own_tracker(loaded: &Loaded) -> (Box<dyn Strategy<HeadGoal>>, Stream) {
    let block = &loaded.scenario.gantries[0];
    let gantry = Gantry::load(&block.gantry, &crate::scenario::FolderFiles(&loaded.base_dir));
    let layout: GantryLayout = block.layout(&gantry.expect("legal"));
    let strategy = block.tracker.build(&layout).expect("legal");
    (strategy, Stream::new(Seed::from(SEED), block.id.as_str(), "tracker"))
}

#[test]
fn a_searcher_of_a_gantry_gives_the_same_digest_from_outside() {
    let plain = changed("flume_crab", &[]);
    let mut plain = plain;
    plain.scenario.time.limit_s = world::ranges::Positive::new(40.0);
    plain.scenario.time.spin_up_s = world::ranges::NonNegative::new(5.0);
    let mut outside = plain.clone();
    outside.scenario.gantries[0].tracker = robots::track::GantryStrategySpec::new(robots::track::ExternalSpec {
        period_s: plain.scenario.time.step_s,
        ..Default::default()
    });
    let inside = Trial::assemble(&plain, SEED).expect("legal").finish_quietly();
    let (mut strategy, mut rng) = own_tracker(&plain);
    let (ended, _) = run(&outside, move |question: &Question| match &question.seen {
        QuestionContent::Gantry(seen, _) => Response::Answer(Reply::from(&strategy.step(seen, &mut rng))),
        QuestionContent::Robot(..) => panic!("a gantry asks"),
    });
    assert_eq!(ended.digest, inside.digest);
}

#[test]
fn nobody_can_be_asked_more_often_than_there_are_steps() {
    let [_, mut outside] = channels();
    outside.scenario.robots[0].strategy = external(0.001);
    let found = crate::scenario::check(&outside.scenario, &outside.base_dir);
    let lines: Vec<String> = (found.iter()).map(|f| format!("{}: {}", f.path, f.message)).collect();
    assert_eq!(lines, ["robots[0].strategy.period_s: must be at least time.step_s, 0.02, got 0.001"]);
}
