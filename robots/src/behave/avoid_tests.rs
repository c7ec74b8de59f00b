use super::*;
use crate::handoff::testing::seen;
use crate::handoff::{Beam, RangeScan};
use nalgebra::Vector3;

const BED: Terrain = Terrain::Level { depth_m: 8.0 };

fn avoid(params: Params) -> SoftAvoid {
    SoftAvoid::new(&params, BED).expect("legal")
}

/// A ping at the origin, heading north, 3 m deep, with one beam for each bearing (right positive, °) and range
/// (m).
fn ping(t_s: f64, echoes: &[(f64, f64)]) -> Observation {
    let mut o = seen(t_s, Vector2::zeros(), 0.0, None);
    let beam = |(bearing, range): &(f64, f64)| {
        let d = Heading::from_deg(-*bearing).unit();
        Beam {
            // FLU: forward is the unit vector's north, left is its east with the sign changed.
            dir_B: Vector3::new(d.y, d.x, 0.0),
            echo_m: Some(*range),
        }
    };
    o.ranging = Some(RangeScan { p_BS: Vector3::zeros(), max_m: 40.0, beams: echoes.iter().map(beam).collect() });
    o
}

fn north() -> Manoeuvre {
    Manoeuvre::Course { course: Heading::from_deg(0.0) }
}

fn turn_deg(m: Option<Manoeuvre>) -> f64 {
    match m {
        Some(Manoeuvre::Course { course }) => Heading::from_deg(0.0).turn_to(course).to_degrees(),
        other => panic!("wanted a course, got {other:?}"),
    }
}

#[test]
fn turns_in_proportion_and_to_the_freer_side() {
    let turn = |echoes: &[(f64, f64)]| turn_deg(avoid(Params::default()).step(&ping(0.0, echoes), &north()));
    for (bearing, range, wanted) in [
        // Ahead, slightly to the right: 8 m off it at asin(8 / 20) = 23.6 degrees; to the left 20.6, so 25.
        (3.0, 20.0, -25.0 * (35.0 - 20.0) / 17.0),
        // asin(8 / 26.5) = 17.6: 14.6 to the right, so 15, half of it.
        (-3.0, 26.5, 7.5),
        // Nearer than near_m: the whole turn.
        (3.0, 16.0, -30.0),
    ] {
        let t = turn(&[(bearing, range)]);
        assert!((t - wanted).abs() < 1e-9, "{bearing} degrees, {range} m: {t}");
    }
    // A wall that goes on to the left: to the right, though most of it is straight ahead or left.
    let wall: Vec<_> = (-12..3).map(|k| (f64::from(k) * 5.0, 16.0)).collect();
    assert!(turn(&wall) > 0.0);
    // Echoes all round: turn back.
    let ring: Vec<_> = (0..72).map(|k| (f64::from(k) * 5.0, 16.0)).collect();
    assert!((turn(&ring).abs() - 180.0).abs() < 1e-9, "{}", turn(&ring));
}

#[test]
fn what_is_not_in_the_way_does_not_count() {
    // Too far; beside the way (30 sin 20° = 10.3 m); behind.
    for echo in [(0.0, 36.0), (20.0, 30.0), (179.0, 5.0)] {
        let o = ping(0.0, &[echo]);
        assert_eq!(avoid(Params::default()).step(&o, &north()), None, "{echo:?}");
    }
    // The same echo counts if the destination lies there, and does not if the destination is much nearer.
    let o = ping(0.0, &[(20.0, 30.0)]);
    for (far_m, counts) in [(80.0, true), (13.0, true), (11.0, false)] {
        let there = Manoeuvre::GoToPoint { point: Heading::from_deg(20.0).unit() * far_m, radius_m: None };
        let turned = avoid(Params::default()).step(&o, &there);
        assert_eq!(turned.is_some(), counts, "{far_m}");
    }
}

#[test]
fn the_bed_is_no_obstacle() {
    let mut o = ping(0.0, &[(0.0, 20.0)]);
    // Nose down by 13 degrees: 4.5 m lower, 0.5 m over the bed.
    o.estimate.attitude.pitch_rad = -0.2269;
    assert_eq!(avoid(Params::default()).step(&o, &north()), None);
    o.estimate.depth_m = 2.0;
    assert!(avoid(Params::default()).step(&o, &north()).is_some());
}

#[test]
fn remembers_for_a_while_keeps_its_side_and_moves_with_fixes() {
    let mut a = avoid(Params::default());
    let first = turn_deg(a.step(&ping(0.0, &[(2.0, 20.0)]), &north()));
    assert!(first < 0.0);
    // Now there is more of it on the left; the side stays left.
    let o = ping(1.0, &[(-3.0, 20.0), (-5.0, 20.0)]);
    assert!(turn_deg(a.step(&o, &north())) < 0.0);
    let quiet = |t_s| seen(t_s, Vector2::zeros(), 0.0, None);
    assert!(a.step(&quiet(15.9), &north()).is_some());
    assert_eq!(a.step(&quiet(16.1), &north()), None);
    let mut b = avoid(Params::default());
    b.step(&ping(0.0, &[(0.0, 20.0)]), &north());
    let mut jumped = quiet(1.0);
    jumped.estimate.fix_jump = Vector2::new(6.0, 0.0);
    jumped.estimate.position = Vector2::new(6.0, 0.0);
    let (before, after) = (b.clone().echoes[0].1, turn_deg(b.step(&jumped, &north())));
    assert!((b.echoes[0].1 - before - Vector2::new(6.0, 0.0)).norm() < 1e-12);
    assert!(after.abs() > 0.0);
}

#[test]
fn turns_about_on_the_free_side() {
    // Nose north, a wall ahead to the right, the commanded way leads back: turn to the left.
    let mut a = avoid(Params::default());
    let wall: Vec<_> = (4..13).map(|k| (f64::from(k) * 10.0, 15.0)).collect();
    let back = Manoeuvre::Course { course: Heading::from_deg(170.0) };
    assert!((turn_deg(a.step(&ping(0.0, &wall), &back)) + 90.0).abs() < 1e-9);
    assert_eq!(avoid(Params::default()).step(&ping(0.0, &[]), &back), None);
}

#[test]
fn gives_up_once_in_a_while() {
    let mut a = avoid(Params::default());
    let mut given_up_s = Vec::new();
    for k in 0..1300 {
        let t_s = 0.1 * f64::from(k);
        assert!(a.step(&ping(t_s, &[(0.0, 20.0)]), &north()).is_some());
        if a.gives_up() {
            given_up_s.push(t_s.round());
        }
    }
    assert_eq!(given_up_s, [60.0, 120.0]);
    a.step(&seen(200.0, Vector2::zeros(), 0.0, None), &north());
    assert!(!a.gives_up());
}

/// The way is free for every second second, because what lies in it is forgotten and seen again.
#[test]
fn gives_up_where_turning_away_and_the_destination_take_turns() {
    let params = Params { memory_s: Positive::new(0.5), ..Params::default() };
    // On one spot, and on the way along a row of piles.
    for (speed_m_s, gives_up) in [(0.0, true), (1.0, false)] {
        let mut a = avoid(params.clone());
        let mut given_up_s = None;
        for k in 0..3000 {
            let t_s = 0.1 * f64::from(k);
            let mut o =
                if (k / 10) % 2 == 0 { ping(t_s, &[(0.0, 20.0)]) } else { seen(t_s, Vector2::zeros(), 0.0, None) };
            o.estimate.position.y = speed_m_s * t_s;
            a.step(&o, &north());
            if a.gives_up() {
                given_up_s.get_or_insert(t_s);
            }
        }
        assert_eq!(given_up_s.is_some(), gives_up, "{given_up_s:?}");
        assert!(given_up_s.is_none_or(|t_s| t_s < 121.0));
    }
}

#[test]
fn contradictions_are_refused() {
    let far = Params { near_m: Positive::new(40.0), ..Params::default() };
    assert!(SoftAvoid::new(&far, BED).is_err());
}
