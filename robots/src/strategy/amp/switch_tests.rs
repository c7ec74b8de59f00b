//! The transitions of Fig. 5 that are the diagram's own, one by one, with observations written by hand. All others are
//! held against the layers of `subsumption`.

use super::{Amp, AmpSpec, Detections, StartAt};
use crate::declare::{AlongFlow, DeclareSpec};
use crate::handoff::Behaviour;
use crate::strategy::testing::{Blind, Desk, point_of};
use nalgebra::Vector2;
use std::num::NonZeroUsize;
use world::ranges::Finite;

fn desk(spec: &AmpSpec) -> Desk<Amp> {
    Desk::new(Amp::new(spec, &Blind).expect("a legal spec"))
}

#[test]
fn a_goal_stands_until_the_next_behaviour_and_the_course_changes_under_one_id() {
    let mut d = desk(&AmpSpec::default());
    let first = d.quiet(0.0);
    assert_eq!(d.quiet(0.0).goal, first.goal, "a goal given stands");
    let tracked = d.smell(1.0);
    assert_eq!(tracked.goal.id, first.goal.id + 1);
    assert_eq!(d.smell(2.0).goal.id, tracked.goal.id);
}

#[test]
fn detections_on_the_way_to_the_start_as_told() {
    let start = |detections| AmpSpec {
        start_at: Some(StartAt { east_m: Finite::new(50.0), north_m: Finite::new(-100.0), detections }),
        ..AmpSpec::default()
    };
    let mut d = desk(&start(Detections::Ignored));
    let go = d.smell(0.0);
    assert_eq!((go.behaviour, point_of(&go)), (Behaviour::GoTo, Vector2::new(50.0, -100.0)));
    assert_eq!(d.smell(0.0).behaviour, Behaviour::GoTo);
    assert_eq!(d.arrive(-100.0).behaviour, Behaviour::Find);
    assert_eq!(d.smell(-100.0).behaviour, Behaviour::TrackIn);

    let mut d = desk(&start(Detections::Heeded));
    assert_eq!(d.quiet(0.0).behaviour, Behaviour::GoTo);
    assert_eq!(d.smell(0.0).behaviour, Behaviour::TrackIn);
}

#[test]
fn a_rule_on_more_points_than_are_remembered_is_refused() {
    let built = |points| {
        let points = NonZeroUsize::new(points).expect("not zero");
        let declare = DeclareSpec::new(AlongFlow { points, ..AlongFlow::default() });
        Amp::new(&AmpSpec { declare, ..AmpSpec::default() }, &Blind).map(drop).map_err(|e| e.to_string())
    };
    assert_eq!(built(6), Ok(()));
    let error = built(7).expect_err("never declares");
    assert!(error.starts_with("declare.AlongFlow.points: must be at most lost_points, 6, got 7"), "{error}");
}
