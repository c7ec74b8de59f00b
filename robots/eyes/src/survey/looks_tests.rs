//! Tests of lines and points chosen by pictures.

use super::*;
use crate::testing::seen;
use robots::behave::Stride;
use robots::handoff::Manoeuvre;

fn begun(highest_m: f64) -> (PictureSum, Observation) {
    let o = seen(0.0, Vector2::zeros(), 0.0, Some(Vector2::new(0.0, -0.2)));
    let (place, north) = (Vector2::new(10.0, 20.0), Heading::from_deg(0.0));
    let added = PictureSum::begin(&AddUpSpec::default(), highest_m, place, north, &o, false);
    (added, o)
}

fn line(passes: Option<Passes>) -> (Vector2<f64>, Vector2<f64>) {
    match passes.expect("a line").step(true) {
        Stride::Start(Manoeuvre::FollowLine { from, to }) => (from, to),
        other => panic!("{other:?}"),
    }
}

#[test]
fn lines_go_to_and_fro_over_the_place_and_end() {
    let (mut added, o) = begun(2.5);
    for n in 0..8 {
        let (from, to) = line(added.next_line(14.0, &o));
        let north = if n % 2 == 0 { 14.0 } else { -14.0 };
        assert!((from - Vector2::new(10.0, 20.0 - north)).norm() < 1e-9, "{n}");
        assert!((to - Vector2::new(10.0, 20.0 + north)).norm() < 1e-9, "{n}");
        assert_eq!(added.altitude_m(), 2.5);
    }
    assert!(added.next_line(14.0, &o).is_none());
    let e = added.evidence();
    assert_eq!((e.lines, e.pictures, e.visibility_m), (8, 0, None));
}

/// The told place moves by the mean of what the fixes say, not by each of them.
#[test]
fn jumps_of_the_navigation_do_not_tear_the_place() {
    let (mut added, mut o) = begun(2.5);
    for (jump, mean) in [(0.6, 0.6), (-0.6, 0.3), (-0.6, 0.0)] {
        o.estimate.fix_jump = Vector2::new(jump, 0.0);
        o.estimate.position.x += jump;
        added.follow(&o, false);
        assert!(added.position(&o).norm() < 1e-12, "where the pictures lie, it did not move");
        assert!((added.middle() - Vector2::new(10.0 - mean, 20.0)).norm() < 1e-12);
    }
}

/// A camera that looks ahead by 30° from straight down is held that much farther back.
#[test]
fn points_are_held_where_the_camera_shows_them() {
    let (mut added, o) = begun(2.0);
    let below = added.next_point(&o).expect("a point");
    assert!((below - Vector2::new(10.0, 20.0)).norm() < 1e-9, "{below}");
    added.looks_at = Vector2::new(math::tan(30f64.to_radians()), 0.1);
    let back = added.next_point(&o).expect("a point");
    // Lines lie along north: ahead is north, left is west.
    let want = below - Vector2::new(-0.2, 2.0 * math::tan(30f64.to_radians()));
    assert!((back - want).norm() < 1e-9, "{back}");
}

#[test]
fn murky_water_is_looked_at_from_as_low_as_the_limits_allow() {
    let altitude = |visibility_m: f64, over_m: f64, bed_m: f64| {
        let (mut added, mut o) = begun(2.5);
        o.estimate.altitude_m = Some(over_m);
        o.estimate.depth_m = bed_m - over_m;
        added.follow(&o, true);
        added.choose(Some(SeenClarity { attenuation_per_m: 4.8 / visibility_m }));
        added.altitude_m()
    };
    assert_eq!(altitude(30.0, 2.5, 10.0), 2.5);
    let middle = altitude(4.2, 2.5, 10.0);
    assert!(middle > 1.4 && middle < 2.5, "{middle}");
    assert_eq!(altitude(1.5, 2.5, 10.0), 1.4);
    // The altimeter has shown 0.2 m less than the clearance of 0.6 m: higher by that.
    assert!((altitude(1.5, 0.4, 10.0) - 1.6).abs() < 1e-12);
    // In 2.4 m of water it keeps half of it.
    assert!((altitude(1.5, 1.2, 2.4) - 1.2).abs() < 1e-12);
}
