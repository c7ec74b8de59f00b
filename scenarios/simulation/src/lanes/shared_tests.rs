use super::*;
use crate::extend::Extend;
use crate::lanes::caught;
use crate::testing::{changed, external, short_channel};
use bevy_ecs::prelude::{Local, Resource};
use nalgebra::Vector2;
use robots::handoff::{Behaviour, HeadOrder, Manoeuvre, MotionOrder, MoveOrder, Reply};
use world::ranges::{NonNegative, Positive};
use world::registry::Registry;
use world::stage::Stage;
use world::units::Heading;

/// Twenty seconds of the channel with a searcher outside that is asked every second.
fn channel() -> Loaded {
    short_channel(&Registry::default(), 300.0, 20.0).edit(|s| s.robots[0].strategy = external(1.0))
}

/// An answer that follows from the question alone.
fn answer(question: &Question) -> Response {
    let heading = Heading::from_deg(40.0 * question.number as f64);
    let manoeuvre = Manoeuvre::Steer { heading };
    ordered(MotionOrder::Move(MoveOrder { id: None, manoeuvre, vertical: None, speed_m_s: Some(1.5) }))
}

fn ordered(order: MotionOrder) -> Response {
    Response::Answer(Reply { order: Some(order), ..Reply::default() })
}

/// An ocean with so many places, spun up before.
fn shared(loaded: &Loaded, places: usize) -> Shared {
    let kept = Shared::spin_up(loaded, 5).expect("legal");
    Shared::new(loaded, 5, places, Some(&kept)).expect("legal")
}

/// Answers everybody until a run in a place has ended; its digest.
fn digest(shared: &mut Shared, place: usize, mut open: Vec<(usize, Question)>) -> String {
    loop {
        for (place, question) in &open {
            let told = shared.answer(*place, "auv0", answer(question));
            assert_eq!(told.expect("it asked").response.name(), "answered");
        }
        open = shared.until_asked();
        if shared.standing(place) != Standing::Going {
            let ended = shared.look(place, |trial| trial.ended()).expect("it is there");
            assert_eq!((ended.steps, shared.standing(place)), (shared.step(), Standing::Ended));
            return ended.digest;
        }
    }
}

fn begin(shared: &mut Shared, place: usize, seed: u64) -> Vec<(usize, Question)> {
    let asked = shared.begin(place, seed).expect("legal");
    assert_eq!(asked.len(), 1, "it asks at once");
    asked.into_iter().map(|q| (place, q)).collect()
}

#[test]
fn from_the_first_step_it_is_the_run_alone() {
    let loaded = channel();
    let mut alone = Trial::assemble(&loaded, 5).expect("legal");
    alone.control("auv0", |q: &Question| answer(q)).expect("it asks");
    let alone = alone.finish_quietly().digest;
    for kept in [None, Some(Shared::spin_up(&loaded, 5).expect("legal"))] {
        let mut shared = Shared::new(&loaded, 5, 1, kept.as_ref()).expect("legal");
        let open = begin(&mut shared, 0, 5);
        assert_eq!(digest(&mut shared, 0, open), alone);
    }
}

#[test]
fn a_run_is_the_same_whoever_else_is_in_the_ocean() {
    let loaded = channel();
    let mut shared = self::shared(&loaded, 3);
    let mut open = begin(&mut shared, 0, 11);
    for _ in 0..7 {
        for (place, question) in &open {
            shared.answer(*place, "auv0", answer(question));
        }
        open = shared.until_asked();
    }
    // In the eighth second two others come.
    open.extend(begin(&mut shared, 2, 12));
    open.extend(begin(&mut shared, 1, 13));
    let step = shared.step();
    assert!(step > 0);
    let among_others = digest(&mut shared, 2, open);

    let alone = |seed: u64| {
        let mut alone = self::shared(&loaded, 1);
        alone.wait_for(step);
        let open = begin(&mut alone, 0, seed);
        digest(&mut alone, 0, open)
    };
    assert_eq!(alone(12), among_others);
    assert_ne!(alone(13), among_others, "noise of its own");
}

#[test]
fn a_place_is_used_again_and_unanswered_questions_count() {
    let loaded = channel();
    let mut shared = Shared::new(&loaded, 5, 2, None).expect("legal");
    assert_eq!(shared.standing(0), Standing::Empty);
    begin(&mut shared, 0, 1);
    assert_eq!(shared.until_asked().len(), 1);
    let absent = |shared: &mut Shared| {
        let counts = shared.look(0, |t| t.score().searchers[0].consulted);
        counts.expect("it is there").map(|c| (c.asked, c.absent))
    };
    assert_eq!(absent(&mut shared), Some((1, 1)));
    begin(&mut shared, 0, 1);
    assert_eq!(absent(&mut shared), None, "another run");
    while !shared.until_asked().is_empty() {}
    assert_eq!(shared.standing(0), Standing::Ended);
}

/// A run among three others, and alone: its digests.
fn digests(loaded: &Loaded, robot: &str, answer: impl Fn(&Question) -> Response + Copy) -> [String; 2] {
    [4, 1].map(|places| {
        let mut shared = shared(loaded, places);
        let begun = (0..places).flat_map(|place| {
            let asked = shared.begin(place, 20 + place as u64).expect("legal");
            asked.into_iter().map(move |q| (place, q))
        });
        let mut open: Vec<_> = begun.collect();
        while shared.standing(0) == Standing::Going {
            for (place, question) in open {
                shared.answer(place, robot, answer(&question)).expect("it asked");
            }
            open = shared.until_asked();
        }
        shared.look(0, |trial| trial.ended().digest).expect("it is there")
    })
}

#[test]
fn all_that_a_robot_can_have_is_its_own() {
    let values = [
        ("map", "Pomdp(grid: (along: 20, across: 6))"),
        ("energy", "(battery_wh: 0.5)"),
        ("faults", "[(at_s: 5, until_s: 9, what: Compass(Biased(5))), (at_s: 7, what: Fluorometer(Biased(0.5)))]"),
    ];
    let mut loaded = channel();
    for (field, value) in values {
        loaded = loaded.set(&format!("robots[0].{field}"), value).expect("legal");
    }
    let [among, alone] = digests(&loaded, "auv0", answer);
    assert_eq!(among, alone);
}

#[test]
fn gantries_share_a_flume() {
    let loaded = changed("flume_external", &[]).edit(|s| {
        s.time.spin_up_s = NonNegative::new(3.0);
        s.time.limit_s = Positive::new(4.0);
    });
    let [among, alone] = digests(&loaded, "crab0", |question| {
        let left = 0.1 * (question.number % 5) as f64;
        let target_m = Vector2::new(0.05 * question.number as f64, left);
        ordered(MotionOrder::Head(HeadOrder { id: None, target_m, speed_m_s: None, behaviour: Behaviour::StepUp }))
    });
    assert_eq!(among, alone);
}

#[test]
fn systems_of_other_crates_keep_their_values_for_each_run() {
    #[derive(Resource, Default)]
    struct Ticks(u64);
    let registry = Registry::default().with_systems(|systems| {
        systems.insert(Ticks::default());
        systems.add(Stage::Report, |world: &mut World, mut own: Local<u64>| {
            *own += 1;
            world.resource_mut::<Ticks>().0 = *own;
        });
    });
    let mut loaded = channel();
    let plain = digests(&loaded, "auv0", answer);
    loaded.registry = registry;
    assert_eq!(digests(&loaded, "auv0", answer), plain);
    let mut shared = Shared::new(&loaded, 5, 2, None).expect("legal");
    begin(&mut shared, 0, 1);
    begin(&mut shared, 1, 2);
    shared.until_asked();
    shared.until_asked();
    for place in [0, 1] {
        let ticks = shared.look(place, |t| t.simulation.world.resource::<Ticks>().0);
        assert_eq!(ticks, Some(shared.step()), "place {place}");
    }
}

#[test]
fn a_run_that_panics_in_the_middle_of_a_tick_does_not_touch_the_others() {
    let loaded = channel();
    let digest_with = |panics: bool| {
        let mut shared = self::shared(&loaded, 3);
        let mut open = begin(&mut shared, 0, 11);
        open.extend(begin(&mut shared, 1, 12));
        if panics {
            shared.hold().expect("there was one");
            let broken: Option<()> = shared.turn(1, |trial| {
                // Without its ocean no instrument can be read.
                let away = crate::ocean::Ocean::away();
                let ocean = std::mem::replace(&mut *trial.simulation.ocean_mut(), away);
                let said = caught(|| trial.simulation.observe()).expect_err("no ocean");
                *trial.simulation.ocean_mut() = ocean;
                panic!("{said}");
            });
            assert!(broken.is_none());
            assert_eq!(shared.standing(1), Standing::Failed);
            assert!(shared.failure(1).is_some_and(|said| said.contains("ocean")));
            open.pop();
            assert!(shared.answer(1, "auv0", Response::Absent).is_none());
        }
        digest(&mut shared, 0, open)
    };
    assert_eq!(digest_with(true), digest_with(false));
}
