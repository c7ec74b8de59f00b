//! Tests of the forward ranging.

use super::super::testing::{BED, assert_normal, at, nose_up, run, slope};
use super::*;
use crate::handoff::testing::block;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

fn pile(east_m: f64, north_m: f64) -> Obstacles {
    Obstacles(vec![block(&BED, "pile", [east_m, north_m], [1.0, 1.0, 8.0])])
}

fn ranging(spec: RangingSpec) -> Ranging {
    Ranging::new(&spec, Vector3::new(0.8, 0.0, 0.0), &OnBoard::new("auv0", 1, 0.02)).unwrap()
}

fn quiet() -> RangingSpec {
    RangingSpec { noise_m: NonNegative::new(0.0), dropout: Fraction::new(0.0), ..Default::default() }
}

fn ping(spec: RangingSpec, truth: &Truth, solids: &Obstacles, bed: &Terrain) -> RangeScan {
    ranging(spec).read(&Clock::new(0.02), truth, &EchoTarget { terrain: bed, obstacles: solids }).unwrap()
}

#[test]
fn the_beam_ahead_meets_the_pile_and_the_others_pass_it() {
    // Heading north, the nose at 0.8 m: the pile's face is at 19.5 m.
    let scan = ping(quiet(), &at(0.0, 0.0, -4.0), &pile(0.0, 20.0), &BED);
    assert_eq!(scan.beams.len(), 41);
    let ahead = scan.beams[20];
    assert!((ahead.dir_B - Vector3::x()).norm() < 1e-12);
    assert!((ahead.echo_m.unwrap() - 18.7).abs() < 1e-9);
    // Three degrees to the side the line passes 0.98 m from the axis.
    assert!(scan.beams.iter().filter(|b| b.echo_m.is_some()).count() == 1);
    // To the left of the body is west: a pile there echoes in the beams on the left.
    let west = ping(quiet(), &at(0.0, 0.0, -4.0), &pile(-8.0, 8.0), &BED);
    let hit = west.beams.iter().find(|b| b.echo_m.is_some()).unwrap();
    assert!(hit.dir_B.y > 0.6);
}

#[test]
fn beyond_its_range_it_hears_nothing_and_too_near_it_says_nothing() {
    let scan = ping(quiet(), &at(0.0, 0.0, -4.0), &pile(0.0, 42.0), &BED);
    assert!(scan.beams.len() == 41 && scan.beams.iter().all(|b| b.echo_m.is_none()));
    let near = ping(quiet(), &at(0.0, 0.0, -4.0), &pile(0.0, 1.6), &BED);
    assert!(near.beams.len() < 41 && near.beams.iter().all(|b| b.echo_m != Some(0.0)));
}

#[test]
fn noise_and_dropout_are_those_asked_for() {
    let spec =
        RangingSpec { noise_m: NonNegative::new(0.2), dropout: Fraction::new(0.1), beams: 1, ..Default::default() };
    let mut r = ranging(spec);
    let (t, solids) = (at(0.0, 0.0, -4.0), pile(0.0, 20.0));
    let scans = run(500_000, 0.02, |c| r.read(c, &t, &EchoTarget { terrain: &BED, obstacles: &solids }));
    assert_eq!(scans.len(), 20_000);
    let got: Vec<f64> = scans.iter().flat_map(|s| s.beams.iter().filter_map(|b| b.echo_m)).collect();
    // 20 000 draws at 0.9: five standard errors are 212.
    assert!((got.len() as f64 - 18_000.0).abs() < 212.0, "{}", got.len());
    assert_normal(&got, 18.7, 0.2);
}

#[test]
fn beams_that_look_down_end_on_the_bed() {
    let slope = slope(0.0, 9.0);
    let fan = RangingSpec { rows: 5, height_deg: NonNegative::new(40.0), ..quiet() };
    for truth in [at(0.0, 0.0, -5.0), nose_up(at(0.0, 0.0, -5.0), -10.0)] {
        let scan = ping(fan.clone(), &truth, &Obstacles::default(), &slope);
        let from = truth.pose.point(scan.p_BS);
        let mut met = 0;
        for b in scan.beams.iter() {
            let end = from + truth.pose.R_WB * b.dir_B * b.echo_m.unwrap_or(scan.max_m);
            let above = end.z - slope.bed_z(end.x, end.y);
            if b.echo_m.is_some() {
                met += 1;
                assert!(above.abs() < 1e-4, "{above}");
            } else {
                assert!(above > 0.0);
            }
        }
        assert!(met > 40, "{met}");
    }
}
