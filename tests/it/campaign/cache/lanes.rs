//! Lanes and runs alone share what is kept.

use super::kit::{all, developed, files, short};
use rheotaxis::cache::{SpinUp, SpinUps};
use rheotaxis::lanes::{LaneError, Lanes};
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, RunEnd, Trial};
use std::cell::RefCell;
use std::rc::Rc;
use world::ranges::HeadingDeg;
use world::seeds::{Key, Seed};

/// What an observer was told of the spin-up.
#[derive(Clone, Debug, Default, PartialEq)]
struct Told {
    shares: usize,
    kept: Option<bool>,
}

/// An observer that notes what it is told, and may stop its run in the spin-up or panic at its end.
#[derive(Clone, Default)]
struct Listener {
    number: usize,
    told: Rc<RefCell<Told>>,
    stops: bool,
    stopped: bool,
    panics: bool,
}

impl Observer for Listener {
    fn see(&mut self, event: &Event) {
        match event {
            Event::SpinUp(_) => {
                self.told.borrow_mut().shares += 1;
                self.stopped = self.stops;
            }
            Event::SpinUpFromCache(kept) => {
                assert!(!self.panics, "no room to write");
                self.told.borrow_mut().kept = Some(*kept);
            }
            _ => {}
        }
    }
    fn goes_on(&mut self) -> bool {
        !self.stopped
    }
}

/// Two searchers in a channel; the second has the shorter mission.
fn searchers() -> [Loaded; 2] {
    [(10.0, 6.0), (200.0, 5.0)].map(|(heading_deg, limit_s)| {
        short("uniform_channel", 60.0, limit_s).edit(|s| s.robots[0].start.heading_deg = HeadingDeg::new(heading_deg))
    })
}

/// Runs both in lanes: what the spin-up was, and how each ended.
fn together(
    searchers: &[Loaded; 2],
    seed: Seed,
    kept: &SpinUps,
    listeners: &[Listener; 2],
) -> (Option<SpinUp>, [Result<RunEnd, String>; 2]) {
    let mut lanes = Lanes::default();
    let mut ends = [const { None }; 2];
    for (n, loaded) in searchers.iter().enumerate() {
        let listener = Listener { number: n, ..listeners[n].clone() };
        let added = lanes.add(loaded, seed, || Ok::<_, LaneError>(listener));
        added.unwrap();
    }
    let developed = lanes.spin_up_with(kept);
    lanes.run(|listener, run| {
        ends[listener.number] = Some(run.map(Trial::ended).map_err(|e| e.to_string()));
    });
    (developed, ends.map(Option::unwrap))
}

#[test]
fn lanes_take_what_lanes_or_runs_have_kept() {
    let dir = tempfile::tempdir().unwrap();
    let searchers = searchers();
    let alone = |n: usize| Ok(Trial::assemble(&searchers[n], 7).unwrap().finish_quietly());
    let alone = [alone(0), alone(1)];
    for there in [false, true] {
        let listeners = [Listener::default(), Listener::default()];
        let kept = all(dir.path());
        let (developed, ends) = together(&searchers, 7.into(), &kept, &listeners);
        assert_eq!(developed.unwrap().kept, there);
        assert_eq!(ends, alone);
        for listener in listeners {
            let told = listener.told.borrow();
            assert_eq!(told.kept, Some(there));
            assert_eq!(told.shares == 0, there);
        }
        assert!(kept.fault().is_none());
    }
    assert_eq!(files(dir.path()).len(), 1);
    let (mut trial, taken) = developed(&searchers[0], 7, &all(dir.path()));
    assert!(taken);
    assert_eq!(Ok(trial.run(&mut Listener::default())), alone[0]);
    // And the other way round.
    developed(&searchers[1], 8, &all(dir.path()));
    let listeners = [Listener::default(), Listener::default()];
    let (developed, _) = together(&searchers, 8.into(), &all(dir.path()), &listeners);
    assert!(developed.unwrap().kept);
}

#[test]
fn a_lane_that_fails_or_stops_does_not_touch_what_the_other_takes() {
    let dir = tempfile::tempdir().unwrap();
    let searchers = searchers();
    let alone = Trial::assemble(&searchers[1], 7).unwrap().finish_quietly();
    for stops in [true, false] {
        let first = Listener { stops, panics: !stops, ..Listener::default() };
        let listeners = [first, Listener::default()];
        let (developed, ends) = together(&searchers, 7.into(), &all(dir.path()), &listeners);
        assert_eq!(developed.unwrap().kept, !stops);
        match &ends[0] {
            Ok(ended) => assert!(stops && ended.steps == 0),
            Err(said) => assert_eq!((stops, said.as_str()), (false, "panicked: no room to write")),
        }
        assert_eq!(ends[1].as_ref(), Ok(&alone));
    }
}

#[test]
fn lanes_that_all_stop_or_have_a_secret_key_keep_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let searchers = searchers();
    let stopping = Listener { stops: true, ..Listener::default() };
    let listeners = [stopping.clone(), stopping];
    let (developed, _) = together(&searchers, 7.into(), &all(dir.path()), &listeners);
    assert!(developed.is_none());
    let secret = Key::secret("9 plovers, 3 whelks").seed(7);
    for _ in 0..2 {
        let listeners = [Listener::default(), Listener::default()];
        let (developed, _) = together(&searchers, secret, &all(dir.path()), &listeners);
        assert!(!developed.unwrap().kept);
    }
    assert!(files(dir.path()).is_empty());
}
