//! Inspection of told places, tick by tick.

use crate::StandardEyes;
use crate::testing::seen;
use nalgebra::Vector2;
use robots::handoff::{Manoeuvre, Outcome, Verdict};
use robots::strategy::{
    AddUpSpec, CameraPasses, Inspect, InspectSpec, Strategy, SurveySpec, ToldSpec, Verify, VerticalSpec,
};
use world::ranges::{Finite, Positive};
use world::seeds::Stream;

fn spec(places: &[[f64; 2]]) -> InspectSpec {
    let told = |p: &[f64; 2]| ToldSpec { east_m: Finite::new(p[0]), north_m: Finite::new(p[1]) };
    InspectSpec {
        places: places.iter().map(told).collect(),
        survey: SurveySpec {
            sidescan: None,
            camera: Some(CameraPasses {
                add_up: Some(AddUpSpec { most_lines: 2, ..AddUpSpec::default() }),
                ..CameraPasses::default()
            }),
            verify: Verify::Camera,
            ..SurveySpec::default()
        },
        speed_m_s: Positive::new(1.5),
        vertical: VerticalSpec::Altitude(Positive::new(2.5)),
    }
}

/// A vehicle without a camera that is at the end of every line at once.
#[test]
fn every_place_is_visited_declared_and_judged_in_order() {
    let places = [[50.0, 0.0], [-60.0, 30.0]];
    let mut s = Inspect::new(&spec(&places), &StandardEyes).expect("legal");
    let mut rng = Stream::new(1, "auv0", "strategy");
    let mut o = seen(0.0, Vector2::zeros(), 90.0, Some(Vector2::new(0.2, 0.0)));
    let (mut said, mut lines, mut last) = (Vec::new(), 0, 0);
    for k in 0..200 {
        o.t_s = 0.1 * f64::from(k);
        let d = s.step(&o, &mut rng);
        said.extend(d.declared);
        if d.goal.id != last {
            last = d.goal.id;
            match d.goal.manoeuvre {
                Manoeuvre::GoToPoint { point, .. } => o.estimate.position = point,
                Manoeuvre::FollowLine { to, .. } => {
                    lines += 1;
                    o.estimate.position = to;
                }
                other => panic!("{other:?}"),
            }
        }
        o.guidance.done = true;
        o.guidance.goal_id = d.goal.id;
        if d.outcome.is_some() {
            assert_eq!(d.outcome, Some(Outcome::Completed));
            break;
        }
    }
    let got: Vec<_> = said.iter().map(|d| (d.number, d.position, d.verdict)).collect();
    let want = |n: u32| (n, Vector2::from(places[n as usize]), Verdict::Unchecked);
    // Each once when it is reached, and once with the verdict: without a camera, none.
    assert_eq!(got, [want(0), want(0), want(1), want(1)]);
    assert_eq!(lines, 4);
}
