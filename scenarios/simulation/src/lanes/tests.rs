//! Lanes that fail, panic or stop, and what can be in lanes at all.

use super::{LaneError, Lanes, group_by_ocean};
use crate::error::AssembleError;
use crate::extend::{Extend, Systems};
use crate::outcome::RunOutcome;
use crate::scenario::{Loaded, cost};
use crate::testing::short_channel;
use crate::trial::{Event, Observer, RunEnd, Trial, Unwatched};
use bevy_ecs::prelude::World;
use world::clock::Clock;
use world::ranges::{HeadingDeg, Positive};
use world::registry::Registry;
use world::seeds::Seed;
use world::stage::Stage;

/// A short run of a channel in which the robot starts towards `heading_deg`.
fn channel(registry: &Registry, heading_deg: f64, limit_s: f64) -> Loaded {
    let heading_deg = HeadingDeg::try_from(heading_deg).expect("legal");
    short_channel(registry, 60.0, limit_s).edit(|s| s.robots[0].start.heading_deg = heading_deg)
}

fn plain(heading_deg: f64, limit_s: f64) -> Loaded {
    channel(&Registry::default(), heading_deg, limit_s)
}

fn with(add: impl Fn(&mut Systems) + Send + Sync + 'static) -> Loaded {
    channel(&Registry::default().with_systems(add), 77.0, 9.0)
}

/// A run that panics in this stage after three seconds.
fn panicking(stage: Stage) -> Loaded {
    with(move |systems| {
        systems.add(stage, |world: &mut World| {
            let t_s = world.resource::<Clock>().t_s();
            assert!(t_s < 3.0, "the hull is {} m long", -1);
        });
    })
}

fn alone(loaded: &Loaded) -> RunEnd {
    let trial = Trial::assemble(loaded, 7).expect("it can be assembled");
    trial.finish_quietly()
}

/// What becomes of each run in lanes.
fn in_lanes(all: &[&Loaded]) -> Vec<Result<RunEnd, String>> {
    watched(all, |_| Unwatched)
}

fn watched<O: Observer>(all: &[&Loaded], watch: impl Fn(usize) -> O) -> Vec<Result<RunEnd, String>> {
    let mut ends: Vec<_> = all.iter().map(|_| None).collect();
    let mut lanes = Lanes::default();
    for (n, loaded) in all.iter().enumerate() {
        let added = lanes.add(loaded, 7, || Ok::<_, LaneError>(Noted(n, watch(n))));
        ends[n] = added.err().map(|error| Err(error.to_string()));
    }
    lanes.run(|Noted(n, _), run| {
        let end = run.map(Trial::ended).map_err(|e| e.to_string());
        assert!(ends[n].replace(end).is_none(), "lane {n} ended twice");
    });
    ends.into_iter().map(|e| e.expect("it ended")).collect()
}

/// Lanes of these runs, which nobody watches.
fn lanes_of(all: &[&Loaded], seed: u64) -> Lanes<Unwatched> {
    let mut lanes = Lanes::default();
    for loaded in all {
        let added = lanes.add(loaded, seed, || Ok::<_, LaneError>(Unwatched));
        added.expect("the same ocean");
    }
    lanes
}

/// The observer of a lane, which it names.
struct Noted<W>(usize, W);

impl<O: Observer> Observer for Noted<O> {
    fn see(&mut self, event: &Event) {
        self.1.see(event);
    }
    fn goes_on(&mut self) -> bool {
        self.1.goes_on()
    }
}

#[test]
fn lanes_that_panic_do_not_touch_the_others() {
    let (first, last) = (plain(10.0, 9.0), plain(200.0, 6.0));
    for stage in [Stage::Sense, Stage::Physics, Stage::Drift, Stage::Report] {
        let broken = panicking(stage);
        let ends = in_lanes(&[&first, &broken, &last]);
        assert_eq!(ends[0], Ok(alone(&first)), "{stage:?}");
        assert_eq!(ends[1], Err("panicked: the hull is -1 m long".to_string()), "{stage:?}");
        assert_eq!(ends[2], Ok(alone(&last)), "{stage:?}");
    }
    assert_ne!(alone(&first).digest, alone(&last).digest);
}

#[test]
fn lanes_that_cannot_be_assembled_do_not_touch_the_others() {
    fn peek(_: &mut World) {}
    let fails = with(|systems| {
        systems.add_blind(Stage::Decide, peek);
    });
    let panics = with(|_| panic!("no such hull"));
    let sound = plain(10.0, 9.0);
    let alone_fails = Trial::assemble(&fails, 7).err().map(|e| e.to_string());
    let wanted = [Err(alone_fails.expect("it fails")), Err("panicked: no such hull".to_string()), Ok(alone(&sound))];
    for order in [[0, 1, 2], [2, 1, 0]] {
        let ends = in_lanes(&order.map(|k| [&fails, &panics, &sound][k]));
        assert_eq!(ends, order.map(|k| wanted[k].clone()));
    }
    assert_eq!(in_lanes(&[&fails, &panics]).len(), 2);
}

/// An observer that stops its run, or panics, at a share of the spin-up or a time of the mission.
#[derive(Default)]
struct Capricious {
    stop_share: Option<f64>,
    stop_s: Option<f64>,
    panic_s: Option<f64>,
    stops: bool,
}

impl Observer for Capricious {
    fn see(&mut self, event: &Event) {
        match *event {
            Event::SpinUp(share) => self.stops = self.stop_share.is_some_and(|at| share >= at),
            Event::Tick(t_s) => {
                assert!(self.panic_s.is_none_or(|at| t_s < at), "the disk is full");
                self.stops = self.stop_s.is_some_and(|at| t_s >= at);
            }
            _ => {}
        }
    }
    fn goes_on(&mut self) -> bool {
        !self.stops
    }
}

#[test]
fn an_observer_ends_its_own_lane_alone() {
    let all = [1.0, 2.0, 3.0, 4.0].map(|heading| plain(heading, 9.0));
    let ends = watched(&all.each_ref(), |n| Capricious {
        stop_share: (n == 0).then_some(0.5),
        stop_s: (n == 1).then_some(3.0),
        panic_s: (n == 2).then_some(4.0),
        stops: false,
    });
    let stopped = |n: usize| ends[n].as_ref().expect("it has an end");
    assert_eq!([stopped(0).outcome, stopped(1).outcome], [RunOutcome::Interrupted; 2]);
    assert_eq!(stopped(0).steps, 0);
    assert!((stopped(1).t_s - 3.0).abs() < 1e-9);
    let assembled = || Trial::assemble(&all[1], 7).expect("legal");
    let mut same = assembled();
    same.until(3.0);
    // The same but for the outcome, which is in the digest.
    assert_ne!(stopped(1).digest, same.ended().digest);
    let alone_too = assembled().run(&mut Capricious { stop_s: Some(3.0), ..Capricious::default() });
    assert_eq!(stopped(1).digest, alone_too.digest);
    assert_eq!(ends[2], Err("panicked: the disk is full".to_string()));
    assert_eq!(ends[3], Ok(alone(&all[3])));
    // If all stop in the spin-up, it ends.
    let ends = watched(&all.each_ref(), |_| Capricious { stop_share: Some(0.1), ..Capricious::default() });
    assert!(ends.iter().all(|e| e.as_ref().is_ok_and(|e| e.steps == 0)));
}

#[test]
fn a_lane_of_another_ocean_is_refused_by_what_differs() {
    type Change = (fn(&mut Loaded), &'static str);
    let changes: [Change; 4] = [
        (|l| l.scenario.time.step_s = Positive::new(0.025), "time.step_s"),
        (|l| l.scenario.time.drift_period_s = Positive::new(1.5), "time.drift_period_s"),
        (|l| l.scenario.permeable.push("pile".into()), "permeable"),
        (|l| l.scenario.sources[0].rate_g_s = Positive::new(0.7), "sources"),
    ];
    let base = plain(10.0, 9.0);
    let seed = Seed::from(7);
    let refused = |other: &Loaded, seed: Seed| {
        let mut lanes = lanes_of(&[&base], 7);
        lanes.add(other, seed, || Ok::<_, LaneError>(Unwatched)).expect_err("another ocean")
    };
    for (change, block) in changes {
        let mut other = base.clone();
        change(&mut other);
        let refused = refused(&other, seed);
        assert!(matches!(&refused, LaneError::Unlike(what) if what == block), "{refused}");
        let runs = [(&base, seed), (&other, seed), (&base, seed)];
        assert_eq!(group_by_ocean(&runs, cost::MEMORY), [vec![0, 2], vec![1]]);
    }
    let other = Seed::from(8);
    assert!(refused(&base, other).to_string().contains("`seed` differs"));
    assert_eq!(group_by_ocean(&[(&base, seed), (&base, other)], cost::MEMORY), [vec![0], vec![1]]);
}

#[test]
fn lanes_share_the_memory_that_a_run_may_use() {
    let base = plain(10.0, 9.0);
    let runs = vec![(&base, Seed::from(7)); 5];
    let one = cost::cost(&base.scenario).bytes();
    let lane = cost::of_lane(&base.scenario).bytes();
    assert!(lane > 0.0 && lane < one);
    let sizes = |bytes: f64| -> Vec<usize> { group_by_ocean(&runs, bytes).iter().map(Vec::len).collect() };
    assert_eq!(sizes(one + 4.5 * lane), [5]);
    assert_eq!(sizes(one + 1.5 * lane), [2, 2, 1]);
    // What does not fit by itself was refused when it was read; here it goes alone.
    assert_eq!(sizes(0.5 * one), [1; 5]);
    assert_eq!(sizes(f64::NAN), [1; 5]);
}

#[test]
fn lanes_take_over_a_spin_up_and_give_theirs() -> Result<(), AssembleError> {
    let (a, b) = (plain(10.0, 9.0), plain(200.0, 6.0));
    let mut first = Trial::assemble(&a, 7)?;
    let by_trial = first.spin_up(&mut Unwatched).expect("nobody stopped it");
    let ends = |lanes: Lanes<Unwatched>| {
        let mut digests = Vec::new();
        lanes.run(|_, run| digests.push(run.expect("it ends").ended().digest));
        digests
    };
    // The shorter one ends first.
    let expected = [alone(&b).digest, alone(&a).digest];
    let mut taking = lanes_of(&[&a, &b], 7);
    taking.take_over(&by_trial).expect("the same ocean");
    assert_eq!(ends(taking), expected);
    let mut giving = lanes_of(&[&a, &b], 7);
    let by_lanes = giving.spin_up().expect("nobody stopped it");
    assert_eq!(ends(giving), expected);
    let mut second = Trial::assemble(&b, 7)?;
    second.take_over(&by_lanes).expect("the same ocean");
    assert_eq!(second.run(&mut Unwatched).digest, expected[0]);
    let mut other = lanes_of(&[&a], 8);
    assert!(other.take_over(&by_lanes).is_err());
    // Refused, it spins up itself.
    let alone_8 = Trial::assemble(&a, 8)?.finish_quietly().digest;
    assert_eq!(ends(other), [alone_8]);
    Ok(())
}
