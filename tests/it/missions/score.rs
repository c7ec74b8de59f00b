//! What a run is judged by hangs on nothing that is written down, and on no order but the file's.

use crate::common::short;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::{Id, Loaded, ReachedSpec, SuccessSpec, load};
use rheotaxis::score::Score;
use rheotaxis::trial::{Event, Observer, RunEnd, Trial, Unwatched};
use std::path::Path;
use world::ranges::{Finite, Positive};

/// How it ended, and the least distance from a source, m.
fn run(loaded: &Loaded) -> (RunEnd, f64) {
    let mut trial = Trial::assemble(loaded, 5).unwrap();
    let ended = trial.run(&mut Unwatched);
    let closest_m = trial.simulation.world.resource::<Score>().closest_m();
    (ended, closest_m)
}

#[test]
fn reaching_a_source_does_not_hang_on_how_often_frames_are_taken() {
    let mut loaded = short("uniform_channel", 60.0, 120.0);
    // From 20 m south of the source it goes north, whatever it is after.
    let start = &mut loaded.scenario.robots[0].start;
    (start.east_m, start.north_m) = (Finite::new(-150.0), Finite::new(-20.0));
    let (_, closest_m) = run(&loaded);
    assert!(closest_m < 15.0, "{closest_m}");
    let ends = [0.1, 1.0, 7.3, 1000.0].map(|period_s| {
        loaded.scenario.record.frame_period_s = Positive::new(period_s);
        [1.001, 0.999].map(|part| {
            let within_m = Positive::new(part * closest_m);
            loaded.scenario.success = SuccessSpec::Reached(ReachedSpec { within_m });
            run(&loaded)
        })
    });
    for [reached, missed] in &ends {
        assert_eq!(reached.0.outcome, RunOutcome::Found);
        assert_ne!(missed.0.outcome, RunOutcome::Found);
        // Whatever is written down, it is the same run; what it is said to have reached is part of it.
        assert_eq!(reached.0.digest, ends[0][0].0.digest);
        assert_eq!(missed.0.digest, ends[0][1].0.digest);
        assert_ne!(reached.0.digest, missed.0.digest);
        assert_eq!([reached.1, missed.1], [closest_m; 2]);
    }
}

/// Ids of the robots in each frame.
#[derive(Default)]
struct Order(Vec<Vec<String>>);

impl Observer for Order {
    fn see(&mut self, event: &Event) {
        if let Event::Frame(frame) = event {
            let ids = frame.robots.iter().map(|r| r.id.clone());
            self.0.push(ids.collect());
        }
    }
}

/// A robot with a map is stored apart from those without: stored first or last, never in the middle.
#[test]
fn robots_come_in_the_order_of_the_file_however_they_are_stored() {
    let mut loaded = short("uniform_channel", 60.0, 2.0);
    let map = load(Path::new("wp_laminar")).unwrap().scenario.robots[0].map.clone();
    assert!(map.is_some());
    let one = loaded.scenario.robots[0].clone();
    let robot = |(n, id): (usize, &str)| {
        let mut robot = one.clone();
        robot.id = Id::try_from(id.to_string()).unwrap();
        robot.start.east_m = Finite::new(one.start.east_m.get() + 9.0 * n as f64);
        robot.map = map.clone().filter(|_| id.starts_with("mapper"));
        robot
    };
    for ids in [["a", "mapper_b", "c", "mapper_d", "e"], ["mapper_a", "b", "mapper_c", "d", "mapper_e"]] {
        loaded.scenario.robots = ids.into_iter().enumerate().map(robot).collect();
        let mut order = Order::default();
        let mut trial = Trial::assemble(&loaded, 5).unwrap();
        trial.run(&mut order);
        assert!(order.0.len() > 10);
        for frame in order.0 {
            assert_eq!(frame, ids);
        }
        let score = trial.simulation.world.resource::<Score>();
        let scored: Vec<_> = score.searchers.iter().map(|s| s.id.as_str()).collect();
        assert_eq!(scored, ids);
    }
}
