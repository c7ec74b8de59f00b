use super::*;
use crate::behave::testing::{course, memory, step};
use crate::handoff::testing::{area, seen};
use proptest::prelude::*;

fn zigzag() -> ZigZag {
    ZigZag::new(&Params::default()).expect("defaults are legal")
}

fn go(z: &mut ZigZag, m: &mut PlumeMemory, east: f64, north: f64) -> Option<f64> {
    let o = seen(0.0, Vector2::new(east, north), 10.0, None);
    course(step(z, &o, false, m))
}

#[test]
fn flow_along_the_area_gives_a_billiard_reflection() {
    let (mut z, mut m) = (zigzag(), memory(Some(0.0), &[]));
    let near = |a: Option<f64>, b: f64| assert!((a.expect("a new leg") - b).abs() < 1e-6, "{a:?}");
    // From the south-west corner: eastward, leaning up-flow.
    near(go(&mut z, &mut m, -180.0, -280.0), 70.0);
    assert_eq!(go(&mut z, &mut m, 0.0, -230.0), None);
    // East edge: keeps going north, reverses east.
    near(go(&mut z, &mut m, 190.0, -150.0), 290.0);
    assert_eq!(go(&mut z, &mut m, 188.0, -149.0), None);
    // West edge, then the north edge: keeps going east, now southward.
    near(go(&mut z, &mut m, -190.0, 0.0), 70.0);
    near(go(&mut z, &mut m, 100.0, 290.0), 110.0);
    // In the south-east corner both turn.
    near(go(&mut z, &mut m, 190.0, -290.0), 290.0);
}

#[test]
fn without_a_solution_it_runs_along_the_edge_until_the_flow_allows_one() {
    // Flow to the south-west: the four are 115, 335, 155, 295 (up-flow 45).
    let (mut z, mut m) = (zigzag(), memory(Some(45.0), &[]));
    let first = go(&mut z, &mut m, 0.0, 0.0).expect("a first leg");
    assert!((first - 335.0).abs() < 1e-6 || (first - 115.0).abs() < 1e-6);
    z.phase = Phase::Leg(Heading::from_deg(335.0));
    // North edge on 335 (westward): west and south are needed: none of 115, 335, 155, 295.
    let along = go(&mut z, &mut m, 0.0, 290.0).expect("runs along");
    assert!((along - 270.0).abs() < 1e-6);
    assert_eq!(go(&mut z, &mut m, -50.0, 290.0), None);
    // The flow turns to south: 250 leads west and south.
    m.up_flow = Some(Heading::from_deg(0.0));
    let leg = go(&mut z, &mut m, -60.0, 290.0).expect("a leg again");
    assert!((leg - 250.0).abs() < 1e-6);
}

#[test]
fn waits_for_the_flow_on_its_heading_reflected_at_edges() {
    let (mut z, mut m) = (zigzag(), memory(None, &[]));
    assert!((go(&mut z, &mut m, 0.0, 0.0).expect("begins") - 10.0).abs() < 1e-6);
    assert!((go(&mut z, &mut m, 40.0, 290.0).expect("reflected") - 170.0).abs() < 1e-6);
    m.up_flow = Some(Heading::from_deg(0.0));
    assert!(go(&mut z, &mut m, 42.0, 280.0).is_some());
}

#[test]
fn the_corner_comes_first_when_asked_for() {
    let params = Params { start: From::DownFlowCorner, ..Params::default() };
    let (mut z, mut m) = (ZigZag::new(&params).expect("legal"), memory(Some(10.0), &[]));
    let o = seen(0.0, Vector2::zeros(), 0.0, None);
    // Up-flow 10 degrees: the south-west corner lies farthest down-flow.
    let Stride::Start(Manoeuvre::GoToPoint { point, .. }) = step(&mut z, &o, false, &mut m) else {
        panic!("goes to the corner first");
    };
    assert!((point - Vector2::new(-180.0, -280.0)).norm() < 1e-6);
    assert_eq!(step(&mut z, &o, false, &mut m), Stride::Keep);
    let there = seen(9.0, point, 200.0, None);
    let leg = course(step(&mut z, &there, true, &mut m)).expect("a leg");
    assert!((leg - 80.0).abs() < 1e-6);
}

proptest! {
    #![proptest_config(crate::handoff::testing::fixed(256))]

    // A point that moves on the given courses: it stays inside and sees both halves of the area.
    #[test]
    fn stays_inside_and_sweeps(up in 0.0..360.0, east in -150.0..150.0, north in -250.0..250.0) {
        let (mut z, mut m) = (zigzag(), memory(Some(up), &[]));
        let mut p = Vector2::new(east, north);
        let mut h = Heading::from_deg(0.0);
        let (mut east_seen, mut west_seen, mut legs) = (false, false, 0);
        let mut north_span = (north, north);
        for k in 0..6000 {
            let o = seen(f64::from(k), p, 0.0, None);
            if let Some(deg) = course(step(&mut z, &o, false, &mut m)) {
                h = Heading::from_deg(deg);
                legs += 1;
            }
            p += h.unit() * 2.0;
            prop_assert!(area().edge_distance(p).0 > 0.0, "left the area at {p:?} on {}", h.deg());
            east_seen |= p.x > 150.0;
            west_seen |= p.x < -150.0;
            north_span = (north_span.0.min(p.y), north_span.1.max(p.y));
        }
        prop_assert!(legs > 3);
        prop_assert!((east_seen && west_seen) || north_span.1 - north_span.0 > 400.0);
    }
}
