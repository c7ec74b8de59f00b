use super::*;
use crate::outcome::RunOutcome;
use crate::scenario::{FolderFiles, Loaded, check};
use crate::testing::{changed, external, short_channel};
use crate::trial::{Event, Observer, RunEnd, Trial, Unwatched};
use nalgebra::Vector2;
use robots::handoff::{Declaration, GantryLayout, Manoeuvre, MotionOrder, MoveOrder};
use robots::strategy::Strategy;
use robots::track::{ExternalSpec, GantryStrategySpec};
use robots::vehicles::Gantry;
use world::ranges::{NonNegative, Positive};
use world::registry::Registry;
use world::seeds::{Seed, Stream};
use world::units::Heading;

const SEED: u64 = 3;

/// A channel of 120 s.
fn inside() -> Loaded {
    short_channel(&Registry::default(), 60.0, 120.0)
}

/// The same with a searcher outside, asked with this period or in each step.
fn outside(period_s: Option<f64>) -> Loaded {
    inside().edit(|s| s.robots[0].strategy = external(period_s.unwrap_or(s.time.step_s.get())))
}

fn assembled(loaded: &Loaded) -> Trial {
    Trial::assemble(loaded, SEED).expect("legal")
}

/// The strategy of the channel's robot, built anew by a user of the library.
fn controller() -> impl Controller + 'static {
    let plain = inside();
    let trial = assembled(&plain);
    let (ocean, robot) = (trial.simulation.ocean(), &plain.scenario.robots[0]);
    let setting = robot.setting(&ocean.area, &ocean.terrain, &ocean.obstacles);
    let mut strategy: Box<dyn Strategy> = robot.strategy.build(&setting).expect("legal");
    let mut rng = Stream::new(Seed::from(SEED), robot.id.as_str(), "strategy");
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
    let mut trial = assembled(loaded);
    let name = trial.controlled().first().expect("asks").clone();
    trial.control(&name, controller).expect("it asks");
    let mut kept = Kept::default();
    let ended = trial.run(&mut kept);
    (ended, kept.0)
}

#[test]
fn a_strategy_of_this_program_gives_the_same_digest_from_outside() {
    let (inside, outside) = (assembled(&inside()).finish_quietly(), outside(None));
    let (ended, told) = run(&outside, controller());
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
    assert_eq!(run(&outside, Replay::new(read)).0.digest, inside.digest);

    // Stopping at the questions changes nothing.
    let (mut controller, mut trial) = (controller(), assembled(&outside));
    while let Some(question) = trial.until_asked(&mut Unwatched).first() {
        let heard = controller.answer(question);
        let told = trial.answer("auv0", heard.clone(), &mut Unwatched).expect("it asked");
        assert_eq!(told.response.name(), "answered");
        assert_eq!(trial.answer("auv0", heard, &mut Unwatched), None, "once");
    }
    assert_eq!(trial.ended().digest, inside.digest);
    let counts = trial.score().searchers[0].consulted.expect("it asked");
    assert_eq!((counts.asked, counts.answered), (ended.steps, ended.steps));
}

/// A declaration moves nothing, and the run answers for it: its digest is another.
#[test]
fn runs_that_differ_only_in_what_is_declared_have_different_digests() {
    let declaring = |east_m: Option<f64>| {
        let mut steers = controller();
        let (ended, _) = run(&outside(None), move |question: &Question| {
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
fn what_cannot_be_carried_out_is_nonsense_and_told() {
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
    let (_, told) = run(&outside(Some(10.0)), move |question: &Question| {
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
    let mut trial = assembled(&outside(None));
    for (speed_m_s, heading) in [(f64::NAN, 0.0), (1.0, f64::INFINITY)] {
        trial.until_asked(&mut Unwatched);
        let order = MotionOrder::Move(MoveOrder {
            id: None,
            manoeuvre: Manoeuvre::Steer { heading: Heading::from_rad(heading) },
            vertical: None,
            speed_m_s: Some(speed_m_s),
        });
        let reply = Reply { order: Some(order), ..Reply::default() };
        let told = trial.answer("auv0", Response::Answer(reply), &mut Unwatched);
        assert_eq!(told.expect("it asked").response.name(), "nonsense");
    }
}

#[test]
fn nobody_controls_a_robot_that_does_not_ask() {
    let (mut plain, mut asks) = (assembled(&inside()), assembled(&outside(None)));
    for (trial, name, says) in [(&mut plain, "auv0", "none has"), (&mut asks, "auv1", "those that have: auv0")] {
        let refused = trial.control(name, |_: &Question| Response::Late).unwrap_err().to_string();
        assert!(refused.ends_with(says), "{refused}");
    }
    assert!(!asks.step() || asks.score().searchers[0].consulted.is_some_and(|c| c.absent == 1));
}

#[test]
fn a_question_tells_what_was_sensed_since_the_last_one() {
    let mut trial = assembled(&outside(Some(2.0)));
    trial.until_asked(&mut Unwatched);
    let questions = trial.until_asked(&mut Unwatched);
    let said = question_json(&questions[0]);
    assert_eq!((questions[0].number, questions[0].t_s), (1, 2.0));
    assert!(said["gathered"]["readings"].as_u64().is_some_and(|n| n > 1), "{said}");
    for field in ["estimate", "guidance", "home_m", "area_m", "able"] {
        assert!(!said[field].is_null(), "{field}");
    }
}

#[test]
fn a_searcher_of_a_gantry_gives_the_same_digest_from_outside() {
    let plain = changed("flume_crab", &[]).edit(|s| {
        s.time.limit_s = Positive::new(40.0);
        s.time.spin_up_s = NonNegative::new(5.0);
    });
    let outside = plain.clone().edit(|s| {
        let asked = ExternalSpec { period_s: s.time.step_s, ..Default::default() };
        s.gantries[0].tracker = GantryStrategySpec::new(asked);
    });
    let block = &plain.scenario.gantries[0];
    let gantry = Gantry::load(&block.gantry, &FolderFiles(&plain.base_dir)).expect("legal");
    let layout: GantryLayout = block.layout(&gantry);
    let mut strategy = block.tracker.build(&layout).expect("legal");
    let mut rng = Stream::new(Seed::from(SEED), block.id.as_str(), "tracker");
    let (ended, _) = run(&outside, move |question: &Question| match &question.seen {
        QuestionContent::Gantry(seen, _) => Response::Answer(Reply::from(&strategy.step(seen, &mut rng))),
        QuestionContent::Robot(..) => panic!("a gantry asks"),
    });
    assert_eq!(ended.digest, assembled(&plain).finish_quietly().digest);
}

#[test]
fn nobody_can_be_asked_more_often_than_there_are_steps() {
    let outside = outside(Some(0.001));
    let found = check(&outside.scenario, &outside.base_dir);
    assert_eq!((found.len(), found[0].path.as_str()), (1, "robots[0].strategy.period_s"));
    assert!(found[0].message.contains("at least time.step_s, 0.02"), "{found:?}");
}
