//! Tests of map and plan: a point vehicle of 2 m/s and 10 °/s in a world of blocks, with a map written by hand.

use super::super::setting::Setting;
use super::super::survey::AfterDeclaration;
use super::super::wishes::VerticalSpec;
use super::*;
use crate::handoff::testing::{seen, sure_of};
use crate::handoff::{Beam, Behaviour, Belief, BeliefGrid, Manoeuvre, Observation, Outcome, RangeScan, Vertical};
use crate::plan::testing::block;
use crate::strategy::testing::{Blind, Ticked};
use nalgebra::{Vector2, Vector3};
use std::sync::Arc;
use world::area::Area;
use world::obstacles::{Obstacle, Obstacles};
use world::ranges::NonNegative;
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

const BED: Terrain = Terrain::Level { depth_m: 8.0 };

fn area() -> Area {
    Area { centre: Vector2::new(50.0, 50.0), length_m: 100.0, width_m: 100.0, axis: Heading::from_deg(90.0) }
}

fn setting(chart: Vec<Obstacle>) -> Setting {
    Setting { area: area(), bed: BED, chart: Obstacles(chart), maps: true, outlook: true, eyes: Arc::new(Blind) }
}

fn spec() -> MapAndPlanSpec {
    MapAndPlanSpec {
        vertical: VerticalSpec::Depth(NonNegative::new(4.0)),
        after_declaration: AfterDeclaration::Stop,
        ..Default::default()
    }
}

/// A map over so many levels whose source is in the cell of a point.
fn belief(at: Vector3<f64>, levels: usize) -> Belief {
    let grid = BeliefGrid::over(&area(), 0.0, 8.0, [40, 25, levels]);
    let best = grid.cell(&at).expect("inside");
    sure_of(grid, best, 0.6)
}

/// The vehicle on its own.
struct Drive {
    strategy: MapAndPlan,
    truth: Obstacles,
    p: Vector2<f64>,
    heading: Heading,
    t_s: f64,
    belief: Option<Belief>,
    /// Nearest it came to a solid, m.
    nearest_m: f64,
    rng: Stream,
}

impl Drive {
    fn new(spec: &MapAndPlanSpec, chart: Vec<Obstacle>, truth: Vec<Obstacle>, p: [f64; 2], deg: f64) -> Self {
        Self {
            strategy: MapAndPlan::new(spec, &setting(chart)).expect("legal"),
            truth: Obstacles(truth),
            p: Vector2::new(p[0], p[1]),
            heading: Heading::from_deg(deg),
            t_s: 0.0,
            belief: None,
            nearest_m: f64::INFINITY,
            rng: Stream::new(1, "auv0", "strategy"),
        }
    }

    /// A level fan of 61 beams over 120°, without noise.
    fn ping(&self) -> RangeScan {
        let from = Vector3::new(self.p.x, self.p.y, -4.0);
        let beams = (0..61).map(|k| {
            let left = (f64::from(k) * 2.0 - 60.0).to_radians();
            let ahead = self.heading.turned(-left).unit();
            let (s, c) = world::math::sin_cos(left);
            Beam {
                dir_B: Vector3::new(c, s, 0.0),
                echo_m: self.truth.ray(&from, &Vector3::new(ahead.x, ahead.y, 0.0), 40.0),
            }
        });
        RangeScan { p_BS: Vector3::zeros(), max_m: 40.0, beams: beams.collect() }
    }

    fn step(&mut self) -> Ticked {
        let ping = ((self.t_s * 10.0).round() as u64).is_multiple_of(5);
        let mut o: Observation = seen(self.t_s, self.p, self.heading.deg(), Some(Vector2::new(0.5, 0.0)));
        o.estimate.depth_m = 4.0;
        o.area = area();
        o.belief = self.belief.clone();
        o.ranging = ping.then(|| self.ping());
        let d = Ticked::step(&mut self.strategy, &o, &mut self.rng);
        if let Manoeuvre::Course { course } = d.goal.manoeuvre {
            let most = 10f64.to_radians() * 0.1;
            let turn = self.heading.turn_to(course).clamp(-most, most);
            self.heading = self.heading.turned(turn);
        }
        // A wall stops it.
        let next = self.p + self.heading.unit() * 0.2;
        let clear_m = self.truth.distance(&Vector3::new(next.x, next.y, -4.0));
        self.nearest_m = self.nearest_m.min(clear_m);
        if clear_m > 0.1 {
            self.p = next;
        }
        self.t_s += 0.1;
        d
    }

    /// Runs until it is over, or for so long; returns the least distance to a place on the way.
    fn run(&mut self, for_s: f64, to: [f64; 2]) -> (Ticked, f64) {
        let to = Vector2::new(to[0], to[1]);
        let mut closest = f64::INFINITY;
        let end = self.t_s + for_s;
        loop {
            let d = self.step();
            closest = closest.min((self.p - to).norm());
            if d.outcome.is_some() || self.t_s >= end {
                return (d, closest);
            }
        }
    }
}

fn papers_block() -> Obstacle {
    block("block", 43.75, 50.0, [7.5, 20.0, 8.0])
}

#[test]
fn searches_then_follows_a_path_to_the_likeliest_cell_and_declares_it() {
    let mut d = Drive::new(&spec(), vec![papers_block()], vec![papers_block()], [61.25, 10.0], 0.0);
    assert_eq!(d.step().behaviour, Behaviour::Find);
    let source = Vector3::new(21.25, 50.0, -4.0);
    d.belief = Some(belief(source, 1));
    let first = d.step();
    assert_eq!(first.behaviour, Behaviour::FollowPath);
    assert!(first.shown.planned.len() > 2 && first.goal.vertical == Vertical::Depth(4.0));
    let (end, closest) = d.run(300.0, [21.25, 50.0]);
    let declared = end.declared.expect("declared");
    assert!((declared.position - source.xy()).norm() < 1e-9 && declared.rule == "Unchanged");
    assert_eq!((end.behaviour, end.outcome), (Behaviour::Done, Some(Outcome::Completed)));
    assert!(closest < 5.0 && d.nearest_m > 0.5, "{closest} {}", d.nearest_m);
    assert!(declared.t_s >= 30.0);
}

#[test]
fn a_leg_of_the_search_is_led_round_what_is_charted() {
    // The first leg of the zig-zag, from (61, 10) 20° west of north, runs through the block.
    let mut d = Drive::new(&spec(), vec![papers_block()], vec![papers_block()], [61.25, 10.0], 340.0);
    let (end, _) = d.run(120.0, [0.0, 0.0]);
    assert_eq!(end.behaviour, Behaviour::Find);
    assert!(d.nearest_m > 0.5, "{}", d.nearest_m);
}

#[test]
fn what_no_chart_has_the_ranging_finds() {
    let walls = vec![block("a", 45.0, 45.0, [4.0, 40.0, 8.0]), block("b", 60.0, 70.0, [26.0, 4.0, 8.0])];
    let mut d = Drive::new(&spec(), vec![], walls, [95.0, 50.0], 270.0);
    d.belief = Some(belief(Vector3::new(21.25, 50.0, -4.0), 1));
    let first = d.step();
    assert!(first.shown.planned.len() <= 3, "nothing known yet: {:?}", first.shown.planned);
    let (_, closest) = d.run(200.0, [21.25, 50.0]);
    assert!(closest < 6.0 && d.nearest_m > 0.3, "{closest} {}", d.nearest_m);
    assert!(d.strategy.sensed() > 20);
}

#[test]
fn a_cell_that_is_solid_through_and_through_is_no_target() {
    let mut d = Drive::new(&spec(), vec![papers_block()], vec![papers_block()], [80.0, 20.0], 0.0);
    // The second likeliest cell is that of the source.
    let mut b = belief(Vector3::new(43.75, 50.0, -4.0), 1);
    let second = b.grid.cell(&Vector3::new(21.25, 50.0, -4.0)).expect("inside");
    Arc::make_mut(&mut b.p)[second] = 0.1;
    d.belief = Some(b);
    let planned = d.step().shown.planned;
    let end = planned[planned.len() - 1];
    assert!((end.xy() - Vector2::new(21.25, 50.0)).norm() < 1e-9, "{end:?}");
}

#[test]
fn crossings_run_down_flow_of_the_target_before_it_is_declared() {
    let spec = MapAndPlanSpec { at_target: AtTarget::Cross(CrossSpec::default()), ..spec() };
    let mut d = Drive::new(&spec, vec![], vec![], [80.0, 20.0], 270.0);
    d.belief = Some(belief(Vector3::new(31.25, 50.0, -4.0), 1));
    let mut sides = [false; 2];
    let end = loop {
        let now = d.step();
        // The flow goes east: 5 m down-flow and 15 m to either side.
        for (k, north) in [35.0, 65.0].into_iter().enumerate() {
            sides[k] |= (d.p - Vector2::new(36.25, north)).norm() < 5.0;
        }
        if now.outcome.is_some() || d.t_s > 400.0 {
            break now;
        }
    };
    assert!(end.declared.is_some() && sides == [true; 2], "{sides:?} at {} s", d.t_s);
}

#[test]
fn goes_up_and_down_in_a_room_of_space() {
    let spec = MapAndPlanSpec { room: RoomSpec::Space(SpaceSpec::default()), hull_m: NonNegative::new(0.5), ..spec() };
    // A sill from side to side, 4 m high on a bed 8 m deep.
    let sill = || vec![block("sill", 50.0, 50.0, [6.0, 100.0, 3.0])];
    let mut d = Drive::new(&spec, sill(), sill(), [90.0, 50.0], 270.0);
    d.belief = Some(belief(Vector3::new(21.25, 50.0, -5.0), 4));
    let first = d.step();
    assert_eq!(first.behaviour, Behaviour::FollowPath);
    let over = first.shown.planned.iter().filter(|p| (p.x - 50.0).abs() < 3.0).map(|p| p.z);
    assert!(over.clone().count() == 0 || over.fold(f64::INFINITY, f64::min) > -5.0);
    assert!(matches!(first.goal.vertical, Vertical::Depth(m) if (0.0..8.0).contains(&m)));
}

#[test]
fn a_map_of_space_declares_a_height_and_a_flat_one_does_not() {
    let at = Vector3::new(31.25, 50.0, -5.0);
    let declared = |belief: Belief| {
        let mut d = Drive::new(&spec(), vec![], vec![], [60.0, 50.0], 270.0);
        d.belief = Some(belief);
        d.run(300.0, [31.25, 50.0]).0.declared.expect("declared").z_m
    };
    assert_eq!(declared(belief(at, 4)), Some(-5.0));
    assert_eq!(declared(belief(at, 1)), None);
}

#[test]
fn impossible_missions_are_refused() {
    let says =
        |spec: &MapAndPlanSpec, setting: &Setting| MapAndPlan::new(spec, setting).expect_err("impossible").to_string();
    let blind = Setting { maps: false, ..setting(vec![]) };
    assert!(says(&spec(), &blind).contains("add one, for example map: Pomdp()"));
    let full = setting(vec![block("b", 50.0, 50.0, [300.0, 300.0, 8.0])]);
    assert!(says(&spec(), &full).contains("no cell of the planner's room is free"));
    let tiny = world::ranges::Positive::new(0.01);
    let many = MapAndPlanSpec { room: RoomSpec::Plane(PlaneSpec { cell_m: (tiny, tiny) }), ..spec() };
    assert!(says(&many, &setting(vec![])).contains("100000000"));
}
