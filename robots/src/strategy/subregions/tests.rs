//! The switching between subregions, with observations written by hand.

use super::{EdgeSpec, Entry, GridSpec, RegionsSpec, Subregions, SubregionsSpec};
use crate::handoff::testing::seen;
use crate::handoff::{Behaviour, Outcome, RegionState};
use crate::strategy::testing::{Desk, Ticked, point_of, setting};
use crate::strategy::{AmpSpec, OpenLoopSpec, StrategySpec, VerticalSpec};
use nalgebra::Vector2;
use std::num::NonZeroU32;
use world::ranges::{NonNegative, Positive};

const TIMEOUT_S: f64 = 600.0;
const FLOW: Option<Vector2<f64>> = Some(Vector2::new(-0.02, -0.2));

/// The area's south half, then its north half.
fn spec(entry: Entry) -> SubregionsSpec {
    SubregionsSpec {
        regions: RegionsSpec::Grid(GridSpec {
            along: NonZeroU32::new(2).expect("2 > 0"),
            across: NonZeroU32::MIN,
            order: vec![(0, 0), (1, 0)],
        }),
        search: StrategySpec::new(AmpSpec::default()),
        timeout_s: Positive::new(TIMEOUT_S),
        entry,
        edge: EdgeSpec::default(),
        speed_m_s: Positive::new(1.5),
        vertical: VerticalSpec::Depth(NonNegative::new(3.0)),
    }
}

/// A mission; the flow goes south, a little westward.
fn desk(entry: Entry) -> Desk<Subregions> {
    let mission = Subregions::new(&spec(entry), &setting(6.0, false)).expect("a legal spec");
    Desk { flow: FLOW, ..Desk::new(mission) }
}

/// A mission that has just begun to search the first region.
fn searching() -> Desk<Subregions> {
    let mut d = desk(Entry::Centre);
    d.quiet(-200.0);
    let begun = d.arrive(-150.0);
    assert_eq!(begun.shown.regions.now, Some(0));
    d
}

/// Three points close together and the end of Track-Out: the inner strategy declares.
fn declare(d: &mut Desk<Subregions>, north: f64) -> Ticked {
    d.near_the_source(north);
    d.arrive(north + 20.0)
}

fn states(d: &Ticked) -> Vec<RegionState> {
    d.shown.regions.all.iter().map(|r| r.state).collect()
}

#[test]
fn goes_to_the_down_flow_corner_and_heeds_no_detection_on_the_way() {
    let mut d = desk(Entry::DownFlowCorner);
    d.flow = None;
    // Without a flow there is no down-flow direction: go to the middle until the flow is known.
    assert_eq!(point_of(&d.quiet(-250.0)), Vector2::new(0.0, -150.0));
    d.flow = FLOW;
    let first = d.quiet(-250.0);
    // South-west corner (-200, -300), 20 m inside.
    assert!((point_of(&first) - Vector2::new(-180.0, -280.0)).norm() < 1e-9);
    assert_eq!((first.behaviour, first.shown.regions.now), (Behaviour::GoTo, None));
    for _ in 0..20 {
        let on_the_way = d.smell(-250.0);
        assert_eq!(on_the_way.behaviour, Behaviour::GoTo);
        assert_eq!((on_the_way.goal, on_the_way.declared), (first.goal, None));
    }
    assert_eq!(first.goal.speed_m_s, 1.5);
    assert_eq!(d.arrive(-280.0).behaviour, Behaviour::Find);
    assert_eq!(d.smell(-280.0).behaviour, Behaviour::TrackIn);
}

#[test]
fn arrival_of_the_transit_is_none_of_the_search() {
    let mut d = searching();
    let find = d.goal.expect("a goal was given");
    // The guidance still reports the transit as done: the search's own goal remains.
    let mut o = seen(d.t_s + 0.1, Vector2::new(0.0, -150.0), 350.0, d.flow);
    (o.guidance.goal_id, o.guidance.done) = (find.id - 1, true);
    let next = Ticked::step(&mut d.strategy, &o, &mut d.rng);
    assert_eq!((next.behaviour, next.goal), (Behaviour::Find, find));
    assert_eq!(states(&next), [RegionState::Searching, RegionState::Waiting]);
}

#[test]
fn a_time_out_does_not_call_the_region_source_free() {
    let mut d = searching();
    d.smell(-100.0);
    let from = d.t_s;
    d.t_s += TIMEOUT_S - 1.0;
    let last = d.quiet(-100.0);
    assert_eq!(last.shown.regions.now, Some(0), "{:.1} s", d.t_s - from);
    d.t_s += 1.0;
    let over = d.quiet(-100.0);
    assert_eq!((over.declared, over.behaviour), (None, Behaviour::GoTo));
    assert_eq!(states(&over), [RegionState::TimedOut, RegionState::Waiting]);
    assert_eq!(point_of(&over), Vector2::new(0.0, 150.0));
    assert_eq!(over.goal.id, last.goal.id + 1);
    let [first, _] = over.shown.regions.all[..] else { panic!("two regions") };
    assert!((first.until_s.unwrap() - first.from_s.unwrap() - TIMEOUT_S).abs() < 0.5);
}

#[test]
fn a_declaration_inside_ends_the_search_of_its_region() {
    let mut d = searching();
    let end = declare(&mut d, -150.0);
    let first = end.declared.expect("three points within 2.5 m");
    assert_eq!((first.number, first.region), (0, Some(0)));
    assert_eq!((first.rule, first.position), ("AlongFlow", Vector2::new(0.0, -147.5)));
    assert_eq!((end.behaviour, end.shown.regions.now), (Behaviour::GoTo, None));
    assert_eq!(states(&end), [RegionState::Declared, RegionState::Waiting]);
    // It is not declared twice, and no detection counts on the way.
    let transit = d.smell(-100.0);
    assert_eq!((transit.declared, transit.behaviour), (None, Behaviour::GoTo));
    // The next search starts afresh; its declarations continue the numbering.
    let begun = d.arrive(150.0);
    assert_eq!((begun.behaviour, begun.shown.regions.now), (Behaviour::Find, Some(1)));
    assert!(begun.shown.lost_points.is_empty());
    let second = declare(&mut d, 150.0).declared.expect("three points within 2.5 m");
    assert_eq!((second.number, second.region), (1, Some(1)));
}

#[test]
fn a_plume_traced_to_the_up_flow_edge_is_declared_there() {
    let mut d = searching();
    // The edge is at 0 m N; within 20 m of it, a detection is enough.
    let near = d.smell(-21.0);
    assert_eq!((near.declared, near.behaviour), (None, Behaviour::TrackIn));
    let end = d.smell(-19.0);
    let at = end.declared.expect("19 m from the edge");
    assert_eq!((at.rule, at.region, at.number), ("up_flow_edge", Some(0), 0));
    // From the mean of the two detections (0, -20) up-flow: 0.1 m east for each metre north.
    assert!((at.position - Vector2::new(2.0, 0.0)).norm() < 1e-9, "{at:?}");
    assert_eq!(end.behaviour, Behaviour::GoTo);
    assert_eq!(states(&end), [RegionState::UpFlowEdge, RegionState::Waiting]);
}

#[test]
fn to_come_near_the_edge_without_a_detection_declares_nothing() {
    let mut d = searching();
    d.smell(-60.0);
    for north in [-30, -10, 5] {
        let now = d.quiet(f64::from(north));
        assert_eq!((now.declared, now.shown.regions.now), (None, Some(0)));
    }
}

#[test]
fn home_after_the_last_region_and_completed_there() {
    let mut d = searching();
    declare(&mut d, -150.0);
    d.arrive(150.0);
    d.t_s += TIMEOUT_S;
    let home = d.quiet(200.0);
    assert_eq!((home.behaviour, home.outcome), (Behaviour::GoHome, None));
    assert_eq!(point_of(&home), Vector2::new(10.0, -250.0));
    assert_eq!(states(&home), [RegionState::Declared, RegionState::TimedOut]);
    assert_eq!(d.smell(0.0).behaviour, Behaviour::GoHome);
    let done = d.arrive(-250.0);
    assert_eq!((done.behaviour, done.outcome), (Behaviour::Done, Some(Outcome::Completed)));
    assert_eq!(d.smell(-250.0).outcome, Some(Outcome::Completed));
}

#[test]
fn a_cage_abort_ends_the_mission_wherever_it_is() {
    for begun in [false, true] {
        let mut d = if begun { searching() } else { desk(Entry::Centre) };
        let end = d.tick(0.0, true, false, true);
        assert_eq!((end.behaviour, end.outcome), (Behaviour::Done, Some(Outcome::Aborted)));
        assert_eq!(end.declared, None);
        assert_eq!(d.smell(0.0).outcome, Some(Outcome::Aborted));
    }
}

#[test]
fn faults_of_the_searching_strategy_name_their_field() {
    let with = |search| SubregionsSpec { search, ..spec(Entry::Centre) };
    let said = |spec: &SubregionsSpec| {
        let built = Subregions::new(spec, &setting(6.0, false));
        built.map(drop).expect_err("illegal").to_string()
    };
    let table = StrategySpec::new(OpenLoopSpec { table: Vec::new(), end_s: Positive::new(1.0) });
    assert!(said(&with(table)).contains("search."));
    let nested = StrategySpec::new(spec(Entry::Centre));
    assert!(said(&with(nested)).contains("search"));
}
