//! A map with several vehicles tells them apart; one with a single vehicle is as it was.

use super::map;
use super::tests::reported;
use crate::charts::palette;
use crate::figures::vehicles::{AFTER, over_from};
use crate::sample::{frames, source};
use rheotaxis::frame::Frame;
use robots::handoff::Behaviour;

/// The sample's mission, and a second vehicle beside it whose mission is over after 150 of 400 frames.
fn two() -> Vec<Frame> {
    let mut all = frames(400);
    for (k, frame) in all.iter_mut().enumerate() {
        let mut other = frame.robots[0].clone();
        other.id = "other".into();
        other.truth.pose.p_WB.x += 40.0;
        other.estimate.position.x += 40.0;
        other.declarations.clear();
        if k >= 150 {
            other.behaviour = Behaviour::Done;
        }
        frame.robots.push(other);
    }
    all
}

#[test]
fn each_of_several_vehicles_has_a_colour_and_ends_faintly() {
    let told = reported(&two(), &[source()]);
    let svg = map(&told.report());
    for (k, t) in told.track.robots.iter().enumerate() {
        // The band and its key.
        assert!(svg.matches(palette::vehicle(k)).count() >= 2, "{k}");
        assert!(svg.contains(&t.info.id), "{}", t.info.id);
    }
    assert_eq!(over_from(&told.track.robots[1]), 150);
    assert!(svg.contains("after the end of its mission"));
    assert!(svg.contains(&format!("opacity=\"{AFTER}\"")), "no faint end");
}

#[test]
fn a_single_vehicle_has_no_band() {
    let svg = map(&reported(&frames(400), &[source()]).report());
    assert!((0..6).all(|k| !svg.contains(palette::vehicle(k))));
    assert!(!svg.contains("after the end") && !svg.contains("Vehicle, by"));
}

#[test]
fn no_vehicle_has_the_colour_of_a_behaviour() {
    let rgb = |c: &str| -> [i32; 3] { [1, 3, 5].map(|k| i32::from_str_radix(&c[k..k + 2], 16).expect("a colour")) };
    let apart = |a: &str, b: &str| -> i32 { rgb(a).iter().zip(rgb(b)).map(|(x, y)| (x - y).abs()).sum() };
    for k in 0..6 {
        let own = palette::vehicle(k);
        for b in Behaviour::ALL {
            assert!(apart(own, palette::behaviour(b)) > 60, "{own}, {b:?}");
        }
        for other in (0..6).filter(|j| *j != k) {
            assert!(apart(own, palette::vehicle(other)) > 100, "{own}");
        }
    }
}
