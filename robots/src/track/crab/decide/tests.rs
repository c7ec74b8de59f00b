//! The decision unit, driven with steps written by hand.

use super::*;
use crate::handoff::Behaviour as B;
use crate::track::crab::spec::CrabSpec;
use crate::track::crab::stop::{Experience, StopSpec};
use crate::track::data::Tally;
use crate::track::testing::{layout, spike};

struct Hand {
    unit: DecisionUnit,
    map: DataBuilder,
    rng: Stream,
    here: Vector2<f64>,
}

impl Hand {
    fn new(spec: &CrabSpec) -> Self {
        let rules = spec.rules(&layout()).expect("legal");
        Self {
            unit: DecisionUnit::new(rules, StopRule::new(&spec.stop)),
            map: DataBuilder::default(),
            rng: Stream::new(1, "hand", "strategy"),
            here: Vector2::new(0.2, 0.1),
        }
    }

    /// The answer at rest after such a step; the head then goes there.
    fn ask(&mut self, step: StepRecord, blocked: bool) -> Ask {
        let at = Progress { rest_s: Some(5.0), to_go_s: 0.0, blocked, here_m: self.here };
        let (ask, _) = self
            .unit
            .next(&at, &step, &mut self.map, &mut self.rng)
            .expect("at rest after five seconds something is due");
        if let Ask::Go(_, to, _) = ask {
            self.here = to;
        }
        ask
    }

    /// The head one step up-stream of the best place, `left_m`, of a sweep.
    fn swept(mut self, left_m: f64) -> Self {
        assert!(is(self.ask(StepRecord::default(), false), B::Sweep, 0.2, 0.3));
        assert!(is(self.ask(StepRecord::default(), false), B::Sweep, 0.2, -0.3));
        self.met(0.2, left_m, 1.0);
        assert!(is(self.ask(StepRecord::default(), false), B::ToBest, 0.2, left_m));
        assert!(is(self.ask(StepRecord::default(), false), B::StepUp, 0.3, left_m));
        self
    }

    fn met(&mut self, x: f64, y: f64, magnitude_v: f64) {
        let mut s = spike(0.0, 0, magnitude_v);
        s.place_m = Vector2::new(x, y);
        self.map.add(&s);
    }
}

fn is(ask: Ask, behaviour: B, x: f64, y: f64) -> bool {
    matches!(ask, Ask::Go(b, to, _) if b == behaviour && (to - Vector2::new(x, y)).norm() < 1e-9)
}

/// A step with means (left, right) that is better or worse than the one before.
fn step(better: bool, left: f64, right: f64) -> StepRecord {
    let tally = |v: f64| {
        let mut t = Tally::default();
        t.add(v);
        t
    };
    StepRecord {
        period_s: 3.5,
        spikes: 2,
        mean_v: if better { 2.0 } else { 0.5 },
        previous_v: Some(1.0),
        predicted_v: Some(1.0),
        left: tally(left),
        right: tally(right),
    }
}

#[test]
fn sweeps_goes_to_the_best_place_and_up() {
    let mut h = Hand::new(&CrabSpec::default()).swept(0.12);
    assert!(is(h.ask(step(true, 1.0, 1.0), false), B::StepUp, 0.4, 0.12));
    // Thirty per cent difference between the sides: diagonal.
    assert!(is(h.ask(step(true, 1.0, 0.5), false), B::StepUp, 0.5, 0.17));
    assert!(is(h.ask(step(true, 0.1, 0.5), false), B::StepUp, 0.6, 0.12));
}

#[test]
fn the_adaptive_contrast_gathers_until_it_suffices() {
    let contrast = CrabSpec::adaptive().contrast;
    let mut h = Hand::new(&CrabSpec { contrast, ..CrabSpec::default() }).swept(0.0);
    let left = StepRecord { right: Tally::default(), ..step(true, 1.0, 0.0) };
    // One spike per step, on the left only: 1, 1.41, 1.73 standard errors.
    assert!(is(h.ask(left, false), B::StepUp, 0.4, 0.0));
    assert!(is(h.ask(left, false), B::StepUp, 0.5, 0.0));
    assert!(is(h.ask(left, false), B::StepUp, 0.6, 0.05));
    // On the new lane it begins anew.
    assert!(is(h.ask(left, false), B::StepUp, 0.7, 0.05));
}

#[test]
fn a_loss_casts_to_the_side_of_the_contrast_then_to_the_other_then_sweeps() {
    let mut h = Hand::new(&CrabSpec::default()).swept(0.0);
    assert!(is(h.ask(step(false, 0.9, 1.0), false), B::Cast, 0.3, -0.05));
    assert!(is(h.ask(step(false, 1.0, 0.5), false), B::Cast, 0.3, 0.05));
    assert!(is(h.ask(step(false, 1.0, 0.5), false), B::Sweep, 0.3, 0.3));
    assert!(is(h.ask(StepRecord::default(), false), B::Sweep, 0.3, -0.3));
}

#[test]
fn a_neighbour_that_smells_more_is_followed() {
    let mut h = Hand::new(&CrabSpec::default()).swept(0.0);
    assert!(is(h.ask(step(false, 1.0, 0.9), false), B::Cast, 0.3, 0.05));
    assert!(is(h.ask(step(true, 1.0, 1.0), false), B::StepUp, 0.4, 0.05));
    // The next loss begins a cast of its own.
    assert!(is(h.ask(step(false, 0.0, 1.0), false), B::Cast, 0.4, 0.0));
}

#[test]
fn gives_up_after_three_empty_sweeps_and_at_the_end_of_the_travel() {
    let mut h = Hand::new(&CrabSpec::default());
    let none = StepRecord::default();
    for _ in 0..3 {
        assert!(is(h.ask(none, false), B::Sweep, 0.2, 0.3));
        assert!(is(h.ask(none, false), B::Sweep, 0.2, -0.3));
    }
    assert_eq!(h.ask(none, false), Ask::Stop(false));
    let mut h = Hand::new(&CrabSpec::default()).swept(0.0);
    for k in 4..=20 {
        let x = f64::from(k) * 0.1;
        assert!(is(h.ask(step(true, 1.0, 1.0), false), B::StepUp, x, 0.0));
    }
    assert_eq!(h.ask(step(true, 1.0, 1.0), false), Ask::Stop(false));
}

#[test]
fn goes_round_what_blocks_it_or_gives_up() {
    let mut h = Hand::new(&CrabSpec::default()).swept(0.0);
    // Blocked up-stream: to the side of the contrast, and on that side until the way is free.
    assert!(is(h.ask(step(true, 1.0, 0.9), true), B::Cast, 0.3, 0.05));
    assert!(is(h.ask(step(true, 0.1, 0.9), false), B::StepUp, 0.4, 0.05));
    h.here.x = 0.3;
    assert!(is(h.ask(step(true, 0.1, 0.9), true), B::Cast, 0.3, 0.10));
    assert!(is(h.ask(step(true, 0.1, 0.9), false), B::StepUp, 0.4, 0.10));
    // Free: steering is back.
    assert!(is(h.ask(step(true, 0.1, 0.9), false), B::StepUp, 0.5, 0.05));
    // At the end of the travel it turns to the other side.
    h.here = Vector2::new(0.5, 0.5);
    assert!(is(h.ask(step(true, 1.0, 0.1), true), B::Cast, 0.5, 0.45));
    let mut h = Hand::new(&CrabSpec::default()).swept(0.0);
    let asks: Vec<Ask> = (0..6).map(|_| h.ask(step(true, 1.0, 0.9), true)).collect();
    assert!(asks[..5].iter().all(|a| matches!(a, Ask::Go(..))));
    assert_eq!(asks[5], Ask::Stop(false));
}

#[test]
fn an_empty_sweep_at_the_end_of_the_trail_ends_the_search_there() {
    let spec = CrabSpec { stop: StopSpec::Experience(Experience::default()), ..CrabSpec::default() };
    let mut h = Hand::new(&spec).swept(0.0);
    for x in [0.52, 0.51, 0.50, 0.45] {
        h.met(x, 0.02, 1.0);
    }
    let none = StepRecord::default();
    assert!(is(h.ask(step(true, 1.0, 1.0), false), B::StepUp, 0.4, 0.0));
    let cast = h.ask(none, false);
    assert!(matches!(cast, Ask::Go(B::Cast, ..)));
    assert!(matches!(h.ask(none, false), Ask::Go(B::Cast, ..)));
    assert!(is(h.ask(none, false), B::Sweep, 0.4, 0.3));
    assert!(is(h.ask(none, false), B::Sweep, 0.4, -0.3));
    assert!(is(h.ask(none, false), B::ToBest, 0.4, 0.02));
    assert_eq!(h.ask(none, false), Ask::Stop(true));
}
