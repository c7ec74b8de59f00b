//! Tests of A* as a planner.

use super::*;
use crate::plan::testing::{block, from, room};
use crate::plan::{PotentialField, PotentialFieldParams};

fn a_star() -> AStar {
    AStar::new(&Params::default()).unwrap()
}

fn free(room: &FreeSpace, path: &Path) -> bool {
    let skip = usize::from(path.leaves_solid);
    path.points[skip..].windows(2).all(|w| room.line_free(&w[0], &w[1]))
}

/// A U that is open to the vehicle's side.
fn trap() -> FreeSpace {
    room(
        [100, 100, 1],
        [1.0; 3],
        vec![
            block("back", 40.0, 50.0, [4.0, 40.0, 8.0]),
            block("north", 52.0, 68.0, [28.0, 4.0, 8.0]),
            block("south", 52.0, 32.0, [28.0, 4.0, 8.0]),
        ],
    )
}

#[test]
fn leaves_the_dead_end_that_holds_the_potential_field() {
    let r = trap();
    let (start, goal) = (from(56.0, 51.0, 270.0), Vector3::new(20.0, 50.0, -4.0));
    let path = a_star().plan(&r, &start, &goal).unwrap();
    assert_eq!(path.reach, Reach::Goal);
    assert!(free(&r, &path));
    let mut field = PotentialField::new(&PotentialFieldParams::default()).unwrap();
    let caught = field.plan(&r, &start, &goal).unwrap();
    let end = caught.points[caught.points.len() - 1];
    assert!(matches!(caught.reach, Reach::Caught(m) if m > 15.0) && (42.0..66.0).contains(&end.x), "{caught:?}");
}

/// The setting is the least radius; a hull that turns wider gets wider turns.
#[test]
fn turns_are_as_wide_as_the_hull_needs() {
    let r = room([200, 200, 1], [1.0; 3], vec![]);
    let goal = Vector3::new(100.0, 20.0, -4.0);
    let tightest = |radius_m: f64| {
        let start = PathStart { turning_radius_m: radius_m, ..from(150.0, 150.0, 270.0) };
        let path = a_star().plan(&r, &start, &goal).unwrap();
        assert_eq!(path.reach, Reach::Goal);
        path.tightest_m
    };
    for radius_m in [0.0, 12.0] {
        assert!((tightest(radius_m) - 12.0).abs() < 1e-9, "{radius_m}");
    }
    assert!((tightest(30.0) - 30.0).abs() < 1e-9);
}

#[test]
fn ends_are_the_ends_asked_for_and_turns_are_the_vehicles() {
    let r = room([120, 120, 1], [1.0; 3], vec![block("b", 60.0, 60.0, [12.0, 40.0, 8.0])]);
    let (start, goal) = (from(100.3, 61.2, 270.0), Vector3::new(18.7, 58.4, -9.0));
    let path = a_star().plan(&r, &start, &goal).unwrap();
    assert_eq!((path.reach, path.leaves_solid), (Reach::Goal, false));
    assert_eq!(path.points[0], start.p_W);
    assert_eq!(path.points[path.points.len() - 1], Vector3::new(18.7, 58.4, -4.0));
    assert!(free(&r, &path) && path.tightest_m >= 3.0, "{path:?}");
    assert!(path.length_m() < 110.0, "{}", path.length_m());
}

#[test]
fn what_cannot_be_reached_has_a_defined_answer() {
    let r = trap();
    let in_wall = Vector3::new(40.0, 50.0, -4.0);
    let path = a_star().plan(&r, &from(60.0, 50.0, 270.0), &in_wall).unwrap();
    assert!(matches!(path.reach, Reach::Nearest(m) if (3.0..5.0).contains(&m)), "{path:?}");
    assert!(free(&r, &path));
    let out = a_star()
        .plan(&r, &PathStart { p_W: in_wall, ..from(0.0, 0.0, 270.0) }, &Vector3::new(90.0, 50.0, -4.0))
        .unwrap();
    assert!(out.leaves_solid && out.reach == Reach::Goal && free(&r, &out));
    let outside = a_star().plan(&r, &from(60.0, 50.0, 270.0), &Vector3::new(60.0, 300.0, -4.0)).unwrap();
    assert!(matches!(outside.reach, Reach::Nearest(m) if (m - 200.5).abs() < 1.0), "{outside:?}");
    let here = a_star().plan(&r, &from(60.0, 50.0, 270.0), &Vector3::new(60.1, 50.0, -4.0)).unwrap();
    assert_eq!(here.reach, Reach::Goal);
    let full = room([8, 8, 1], [1.0; 3], vec![block("b", 4.0, 4.0, [20.0, 20.0, 8.0])]);
    assert_eq!(a_star().plan(&full, &from(1.0, 1.0, 270.0), &in_wall), Err(NoPath::Full));
}

#[test]
fn goes_over_a_reef_in_space_and_stays_off_bed_and_surface() {
    // A wall from side to side, 4 m high on a bed 8 m deep.
    let r = room([60, 30, 16], [1.0, 1.0, 0.5], vec![block("reef", 30.0, 15.0, [4.0, 60.0, 4.0])]);
    let deep = PathStart { p_W: Vector3::new(50.0, 15.0, -6.0), ..from(50.0, 15.0, 270.0) };
    let path = a_star().plan(&r, &deep, &Vector3::new(10.0, 15.0, -6.0)).unwrap();
    assert_eq!(path.reach, Reach::Goal);
    assert!(free(&r, &path));
    let over = path.points.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    assert!((-4.0..-0.8).contains(&over), "{over}");
}

#[test]
fn replans_when_the_room_changes() {
    let mut r = room([60, 60, 1], [1.0; 3], vec![]);
    let (start, goal) = (from(50.0, 30.0, 270.0), Vector3::new(10.0, 30.0, -4.0));
    let mut planner = a_star();
    let before = planner.plan(&r, &start, &goal).unwrap();
    for k in 0..40 {
        let hit = Vector3::new(30.5, 10.5 + f64::from(k), -4.0);
        r.beam(&(hit + Vector3::x()), &hit, true);
    }
    r.refresh();
    assert!(!free(&r, &before));
    let after = planner.plan(&r, &start, &goal).unwrap();
    assert!(free(&r, &after) && after.reach == Reach::Goal && after.length_m() > before.length_m() + 5.0);
}

#[test]
fn one_planner_serves_many_rooms() {
    // The same number of changes and of cells: only the contents differ.
    let wall = |east_m| room([60, 60, 1], [1.0; 3], vec![block("w", east_m, 30.0, [4.0, 40.0, 8.0])]);
    let (start, goal) = (from(55.0, 30.0, 270.0), Vector3::new(5.0, 30.0, -4.0));
    for cost in [Cost::Metric, Cost::Paper] {
        let params = Params { cost, ..Params::default() };
        let mut used = AStar::new(&params).unwrap();
        for r in [wall(20.0), wall(40.0), wall(55.0), wall(20.0)] {
            let fresh = AStar::new(&params).unwrap().plan(&r, &start, &goal);
            assert_eq!(used.plan(&r, &start, &goal), fresh);
        }
    }
    // Copies that developed differently: a wall of echoes in one, another wall elsewhere in the other.
    let mut first = room([60, 60, 1], [1.0; 3], vec![]);
    let mut second = first.clone();
    assert_eq!(first.revision(), second.revision());
    assert_ne!(first.revision(), wall(20.0).revision());
    for k in 0..40 {
        for (r, east) in [(&mut first, 30.5), (&mut second, 40.5)] {
            let hit = Vector3::new(east, 10.5 + f64::from(k), -4.0);
            r.beam(&hit, &hit, true);
        }
    }
    let mut used = a_star();
    for r in [&first, &second] {
        let path = used.plan(r, &start, &goal).unwrap();
        assert!(free(r, &path) && path.reach == Reach::Goal, "{path:?}");
    }
}
