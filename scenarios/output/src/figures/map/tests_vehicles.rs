//! A map with several vehicles tells them apart; one with a single vehicle is as it was.

use super::map;
use super::tests::reported;
use crate::charts::palette;
use crate::figures::vehicles::{AFTER, over_from};
use crate::sample::{area, frames, source};
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
    reported(&two(), &area(), &[source()], &[], |run| {
        let svg = map(run);
        let both = [0, 1].map(palette::vehicle);
        for (colour, t) in both.iter().zip(&run.track.robots) {
            // The band and its key.
            assert!(svg.matches(colour).count() >= 2, "{colour}");
            assert!(svg.contains(&t.info.id), "{}", t.info.id);
        }
        let other = &run.track.robots[1];
        assert_eq!(over_from(other), 150);
        assert!(svg.contains("after the end of its mission"));
        assert!(svg.contains(&format!("opacity=\"{AFTER}\"")), "no faint end");
    });
}

#[test]
fn a_single_vehicle_has_no_band() {
    reported(&frames(400), &area(), &[source()], &[], |run| {
        let svg = map(run);
        for k in 0..6 {
            assert!(!svg.contains(palette::vehicle(k)));
        }
        assert!(!svg.contains("after the end") && !svg.contains("Vehicle, by"));
    });
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
