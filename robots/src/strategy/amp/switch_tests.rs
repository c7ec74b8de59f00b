//! The transitions of Fig. 5, one by one, with observations written by hand.

use super::super::survey::AfterDeclaration;
use super::{Amp, AmpSpec, Detections, StartAt};
use crate::declare::{AlongFlow, DeclareSpec};
use crate::handoff::testing::{seen, smelling};
use crate::handoff::{Behaviour, Goal, Manoeuvre, Outcome};
use crate::strategy::testing::{Blind, Ticked};
use nalgebra::Vector2;
use std::num::NonZeroUsize;
use world::ranges::Finite;
use world::seeds::Stream;

/// A planner and its last goal; the flow goes south, so up-flow is north.
struct Desk {
    amp: Amp,
    rng: Stream,
    t_s: f64,
    goal: Option<Goal>,
}

impl Desk {
    fn new(spec: &AmpSpec) -> Self {
        Self {
            amp: Amp::new(spec, &Blind).expect("a legal spec"),
            rng: Stream::new(1, "auv0", "strategy"),
            t_s: 0.0,
            goal: None,
        }
    }

    fn tick(&mut self, north: f64, smells: bool, arrived: bool, aborted: bool) -> Ticked {
        self.t_s += 0.1;
        let flow = Some(Vector2::new(0.0, -0.2));
        let mut o = smelling(seen(self.t_s, Vector2::new(0.0, north), 350.0, flow), smells);
        if let Some(goal) = self.goal {
            o.guidance.goal_id = goal.id;
            o.guidance.done = arrived;
        }
        o.guidance.aborted = aborted;
        let decision = Ticked::step(&mut self.amp, &o, &mut self.rng);
        self.goal = Some(decision.goal);
        decision
    }

    fn quiet(&mut self, north: f64) -> Ticked {
        self.tick(north, false, false, false)
    }

    fn smell(&mut self, north: f64) -> Ticked {
        self.tick(north, true, false, false)
    }

    fn arrive(&mut self, north: f64) -> Ticked {
        self.tick(north, false, true, false)
    }

    /// Nothing for more than lambda.
    fn lose(&mut self, north: f64) -> Ticked {
        self.t_s += 5.0;
        self.quiet(north)
    }

    /// Detects at `north` and loses the plume there; ends in Track-Out.
    fn point(&mut self, north: f64) -> Ticked {
        self.smell(north);
        let d = self.lose(north + 10.0);
        assert_eq!(d.behaviour, Behaviour::TrackOut);
        d
    }
}

fn plain() -> Desk {
    Desk::new(&AmpSpec::default())
}

#[test]
fn find_until_a_detection_then_track_in() {
    let mut d = plain();
    let first = d.quiet(0.0);
    assert_eq!(first.behaviour, Behaviour::Find);
    assert_eq!(d.quiet(0.0).goal, first.goal, "a goal given stands");
    let tracked = d.smell(1.0);
    assert_eq!(tracked.behaviour, Behaviour::TrackIn);
    assert_eq!(tracked.goal.id, first.goal.id + 1);
    // The course changes under one id.
    assert_eq!(d.smell(2.0).goal.id, tracked.goal.id);
    assert_eq!(d.quiet(2.0).behaviour, Behaviour::TrackIn);
}

#[test]
fn track_in_to_track_out_stores_the_point() {
    let mut d = plain();
    let out = d.point(4.0);
    assert_eq!(out.shown.lost_points, [Vector2::new(0.0, 4.0)]);
    let Manoeuvre::GoToPoint { point, .. } = out.goal.manoeuvre else {
        panic!("track-out goes to a point");
    };
    // Nose at 350, left of up-flow: crosses to the right.
    assert!((point - Vector2::new(18.0, 22.0)).norm() < 1e-9);
}

#[test]
fn track_out_to_track_in_on_detection_and_to_reacquire_on_arrival() {
    let mut d = plain();
    d.point(0.0);
    assert_eq!(d.smell(20.0).behaviour, Behaviour::TrackIn);
    d.lose(30.0);
    let again = d.arrive(40.0);
    assert_eq!(again.behaviour, Behaviour::Reacquire);
    assert!(matches!(again.goal.manoeuvre, Manoeuvre::FollowLine { .. }));
    assert_eq!(d.smell(45.0).behaviour, Behaviour::TrackIn);
}

#[test]
fn reacquire_to_find_when_the_list_is_empty() {
    let mut d = plain();
    d.point(0.0);
    d.smell(40.0);
    d.lose(50.0);
    assert_eq!(d.arrive(60.0).behaviour, Behaviour::Reacquire);
    // Two points, two bowties each, two lines each.
    for line in 1..8 {
        let now = d.arrive(60.0);
        assert_eq!(now.behaviour, Behaviour::Reacquire, "line {line}");
        assert_eq!(now.shown.lost_points.len(), if line < 4 { 2 } else { 1 });
    }
    let found = d.arrive(60.0);
    assert_eq!(found.behaviour, Behaviour::Find);
    assert!(found.shown.lost_points.is_empty());
}

#[test]
fn declares_at_the_end_of_track_out_only() {
    let mut d = plain();
    d.point(0.0);
    d.point(1.0);
    // The third point is on the list now, but the test waits for Track-Out's end.
    assert_eq!(d.point(2.5).declared, None);
    assert_eq!(d.quiet(15.0).declared, None);
    let end = d.arrive(20.0);
    let declared = end.declared.expect("three points within 2.5 m");
    assert_eq!(declared.position, Vector2::new(0.0, 2.5));
    assert_eq!(declared.rule, "AlongFlow");
    assert_eq!(end.behaviour, Behaviour::GoHome);
    // Declared once; detections no longer matter; reaching home ends the mission.
    let home = d.smell(10.0);
    assert_eq!((home.behaviour, home.declared), (Behaviour::GoHome, None));
    assert_eq!(home.outcome, None);
    let done = d.arrive(-250.0);
    assert_eq!(done.behaviour, Behaviour::Done);
    assert_eq!(done.outcome, Some(Outcome::Completed));
    assert_eq!(d.smell(-250.0).outcome, Some(Outcome::Completed));
}

#[test]
fn a_detection_in_track_out_is_tested_before_it_is_followed() {
    let mut d = plain();
    d.point(0.0);
    d.point(1.0);
    d.point(2.0);
    let end = d.smell(15.0);
    assert!(end.declared.is_some());
    assert_eq!(end.behaviour, Behaviour::GoHome);
}

#[test]
fn points_far_apart_are_not_declared() {
    let mut d = plain();
    d.point(0.0);
    d.point(2.0);
    d.point(4.5);
    let end = d.arrive(20.0);
    assert_eq!((end.declared, end.behaviour), (None, Behaviour::Reacquire));
}

#[test]
fn at_most_six_points_are_kept_the_most_up_flow_ones() {
    let mut d = plain();
    let mut last = d.point(0.0);
    for k in 1..8 {
        last = d.point(10.0 * f64::from(k));
    }
    let norths: Vec<f64> = last.shown.lost_points.iter().map(|p| p.y).collect();
    assert_eq!(norths, [70.0, 60.0, 50.0, 40.0, 30.0, 20.0]);
}

#[test]
fn may_stop_on_the_spot() {
    let mut d = Desk::new(&AmpSpec { after_declaration: AfterDeclaration::Stop, ..AmpSpec::default() });
    d.point(0.0);
    d.point(0.0);
    d.point(0.0);
    let end = d.arrive(20.0);
    assert!(end.declared.is_some());
    assert_eq!(end.behaviour, Behaviour::Done);
    assert_eq!(end.outcome, Some(Outcome::Completed));
}

#[test]
fn a_cage_abort_ends_the_mission_in_any_behaviour() {
    for prepare in [0, 1, 2, 3] {
        let mut d = plain();
        d.quiet(0.0);
        if prepare > 0 {
            d.smell(0.0);
        }
        if prepare > 1 {
            d.lose(1.0);
        }
        if prepare > 2 {
            d.arrive(20.0);
        }
        let end = d.tick(0.0, true, false, true);
        assert_eq!(end.behaviour, Behaviour::Done);
        assert_eq!(end.outcome, Some(Outcome::Aborted));
        assert_eq!(d.quiet(0.0).outcome, Some(Outcome::Aborted));
    }
}

#[test]
fn detections_on_the_way_to_the_start_as_told() {
    let start = |detections| AmpSpec {
        start_at: Some(StartAt { east_m: Finite::new(50.0), north_m: Finite::new(-100.0), detections }),
        ..AmpSpec::default()
    };
    let mut d = Desk::new(&start(Detections::Ignored));
    let go = d.smell(0.0);
    assert_eq!(go.behaviour, Behaviour::GoTo);
    assert!(matches!(
        go.goal.manoeuvre,
        Manoeuvre::GoToPoint { point, .. } if point == Vector2::new(50.0, -100.0)
    ));
    assert_eq!(d.smell(0.0).behaviour, Behaviour::GoTo);
    assert_eq!(d.arrive(-100.0).behaviour, Behaviour::Find);
    assert_eq!(d.smell(-100.0).behaviour, Behaviour::TrackIn);

    let mut d = Desk::new(&start(Detections::Heeded));
    assert_eq!(d.quiet(0.0).behaviour, Behaviour::GoTo);
    assert_eq!(d.smell(0.0).behaviour, Behaviour::TrackIn);
}

#[test]
fn a_rule_on_more_points_than_are_remembered_is_refused() {
    let spec = |points| AmpSpec {
        declare: DeclareSpec::new(AlongFlow {
            points: NonZeroUsize::new(points).expect("not zero"),
            ..AlongFlow::default()
        }),
        ..AmpSpec::default()
    };
    assert!(Amp::new(&spec(6), &Blind).is_ok());
    let error = Amp::new(&spec(7), &Blind).map(|_| ()).expect_err("never declares");
    assert_eq!(
        error.to_string(),
        "declare.AlongFlow.points: must be at most lost_points, 6, got 7: it would never declare"
    );
}
