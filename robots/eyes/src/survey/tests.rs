//! Surveys flown by a vehicle that follows its goals exactly, with a real sonar over a real block.

use crate::StandardEyes;
use crate::testing::{self, area, seen};
use image::{Rgb, RgbImage};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use robots::behave::Stride;
use robots::handoff::{Behaviour, Declaration, Manoeuvre, Observation, Picture, Verdict, Vertical};
use robots::sense::{EchoTarget, OnBoard, Sidescan, SidescanSpec};
use robots::strategy::{
    AddUpSpec, AfterDeclaration, CameraPasses, PostDeclaration, Progress, SidescanPasses, SurveySpec, Verify,
};
use std::sync::Arc;
use world::clock::Clock;
use world::frames::{Pose, Truth};
use world::obstacles::Obstacles;
use world::ranges::Positive;
use world::terrain::Terrain;
use world::units::Heading;

const BED: Terrain = Terrain::Level { depth_m: 8.0 };
const PERIOD_S: f64 = 0.1;

fn block(at: Vector2<f64>) -> Obstacles {
    Obstacles(vec![testing::block(&BED, "block", [at.x, at.y], [1.0; 3])])
}

/// Water; with a source also dye and a dark body.
fn picture(source: bool) -> Picture {
    let image = RgbImage::from_fn(160, 120, |x, y| match (x, y) {
        (60..140, 50..70) if source => Rgb([230, 90, 100]),
        (40..60, 50..80) if source => Rgb([20, 25, 60]),
        _ => Rgb([110, 170, 175]),
    });
    Picture { image: Arc::new(image), p_BC: Vector3::zeros(), R_BC: UnitQuaternion::identity(), view_rad: 1.0 }
}

/// What the world holds for a survey.
struct Sea {
    solids: Obstacles,
    sonar: bool,
    /// What a picture shows; `None` without a camera.
    camera: Option<bool>,
}

struct SurveyFlight {
    last: Declaration,
    lines: Vec<(Vector2<f64>, Vector2<f64>)>,
    altitudes: Vec<f64>,
    pictures: usize,
}

/// Declares at a place and flies what follows: each line from end to end. The believed position differs from the true
/// one by `off`.
fn fly(spec: &SurveySpec, sea: &Sea, declared: Vector2<f64>, off: Vector2<f64>) -> SurveyFlight {
    let after = AfterDeclaration::Survey(Box::new(spec.clone()));
    let mut post = PostDeclaration::new(&after, &StandardEyes, false).unwrap();
    let mut sonar = Sidescan::new(&SidescanSpec::default(), Vector3::zeros(), &OnBoard::new("a", 3, PERIOD_S)).unwrap();
    let mut clock = Clock::new(PERIOD_S);
    let mut o = seen(0.0, declared, 0.0, None);
    let first = Declaration::first(0.0, declared, "test");
    let (stamped, next) = post.enter(first, &o, Heading::from_deg(30.0));
    assert_eq!((stamped, next), (first, Behaviour::Survey));
    let mut flown = SurveyFlight { last: first, lines: Vec::new(), altitudes: Vec::new(), pictures: 0 };
    let mut left = 0.0;
    let mut step = |o: &mut Observation, flown: &mut SurveyFlight, arrived: bool| {
        o.t_s = clock.t_s();
        o.estimate.t_s = o.t_s;
        let Some(Vertical::Altitude(altitude)) = flown.altitudes.last().map(|a| Vertical::Altitude(*a)) else {
            return post.step(o, arrived);
        };
        o.estimate.altitude_m = Some(altitude);
        let p = o.estimate.position - off;
        let truth = Truth::at_rest(Pose::level(Vector3::new(p.x, p.y, altitude - 8.0), o.estimate.attitude.heading));
        let target = EchoTarget { terrain: &BED, obstacles: &sea.solids };
        o.sidescan = (sea.sonar).then(|| sonar.read(&clock, &truth, &target, true)).flatten();
        let progress = post.step(o, arrived);
        o.picture = None;
        if post.picture() {
            o.picture = sea.camera.map(picture);
            flown.pictures += 1;
        }
        clock.advance();
        if let Some(Vertical::Altitude(a)) = post.vertical() {
            *flown.altitudes.last_mut().unwrap() = a;
        }
        progress
    };
    flown.altitudes.push(3.0);
    for _ in 0..20_000 {
        let arrived = left <= 0.0 && !flown.lines.is_empty();
        match step(&mut o, &mut flown, arrived) {
            Progress::Over(d) => {
                flown.last = d;
                return flown;
            }
            Progress::Go(Stride::Start(Manoeuvre::FollowLine { from, to })) => {
                flown.lines.push((from, to));
                let a = *flown.altitudes.last().unwrap();
                flown.altitudes.push(a);
                o.estimate.position = from;
                o.estimate.attitude.heading = Heading::from_vector(to - from);
                left = (to - from).norm();
            }
            Progress::Go(Stride::Keep) => {
                o.estimate.position += o.estimate.attitude.heading.unit() * (2.0 * PERIOD_S);
                left -= 2.0 * PERIOD_S;
            }
            other => panic!("{other:?}"),
        }
    }
    panic!("a survey without end");
}

fn place() -> Vector2<f64> {
    Vector2::new(20.0, 50.0)
}

fn sea(at: Option<Vector2<f64>>) -> Sea {
    Sea { solids: at.map(block).unwrap_or_default(), sonar: true, camera: None }
}

/// Wherever a block lies, and also where navigation errs: it is fixed in believed coordinates.
#[test]
fn no_strip_between_the_lines_is_left_unseen() {
    let right = Heading::from_deg(120.0).unit();
    let strips = [-24.0, -16.0, -12.0, -10.0, -8.0, -6.0, -3.0, 0.0, 4.0, 8.0, 11.0, 14.0, 20.0];
    let aside = strips.map(|across| (right * across, Vector2::zeros(), 0.9));
    let near = Vector2::new(-9.0, 6.0);
    // Half a cell and line, and the rest of the layover of its top.
    let errs = [(near, Vector2::zeros(), 0.7), (near, Vector2::new(3.0, -4.0), 0.7)];
    for (from, off, most_m) in aside.into_iter().chain(errs) {
        let got = fly(&SurveySpec::default(), &sea(Some(place() + from)), place(), off);
        assert_eq!((got.lines.len(), got.last.verdict), (2, Verdict::Verified), "{from}");
        assert_eq!((got.last.number, got.last.position), (0, place()));
        let error = got.last.surveyed.unwrap() - (place() + from + off);
        assert!(error.norm() < most_m, "{from}: {error}");
    }
}

#[test]
fn without_an_object_or_with_one_too_far_off_it_is_rejected() {
    let away = place() + Vector2::new(0.0, -29.0);
    let near = SurveySpec {
        sidescan: Some(SidescanPasses { within_m: Positive::new(20.0), ..SidescanPasses::default() }),
        ..SurveySpec::default()
    };
    for (spec, at) in [(SurveySpec::default(), None), (near, Some(away))] {
        let got = fly(&spec, &sea(at), place(), Vector2::zeros());
        assert_eq!((got.last.verdict, got.last.surveyed), (Verdict::Rejected, None));
    }
    assert_eq!(PostDeclaration::next(Verdict::Rejected), Behaviour::Find);
}

#[test]
fn an_instrument_that_never_reported_has_no_say() {
    let deaf = Sea { sonar: false, ..sea(Some(place())) };
    let got = fly(&SurveySpec::default(), &deaf, place(), Vector2::zeros());
    assert_eq!(got.last.verdict, Verdict::Unchecked);
    assert_eq!(PostDeclaration::next(Verdict::Unchecked), Behaviour::GoHome);
}

#[test]
fn the_camera_flies_over_what_the_sidescan_found_and_the_two_agree_as_told() {
    let truth = place() + Vector2::new(-9.0, 6.0);
    let verdict = |verify: Verify, object: bool, source: Option<bool>| {
        let spec = SurveySpec { camera: Some(CameraPasses::default()), verify, ..SurveySpec::default() };
        let there = Sea { camera: source, ..sea(object.then_some(truth)) };
        let got = fly(&spec, &there, place(), Vector2::zeros());
        let (from, to) = got.lines[2];
        let target = if object { truth } else { place() };
        assert!((0.5 * (from + to) - target).norm() < 0.7);
        // One picture per second on a line of 30 m at 2 m/s; the first that shows the source is enough.
        let most = if source == Some(true) { 1 } else { 15 };
        assert_eq!(got.pictures, most, "{object} {source:?}");
        got.last.verdict
    };
    use Verdict::{Rejected, Unchecked, Verified};
    for (object, source, want) in [
        (true, Some(true), [Verified; 4]),
        (true, Some(false), [Verified, Rejected, Verified, Rejected]),
        (false, Some(true), [Rejected, Verified, Verified, Rejected]),
        (false, Some(false), [Rejected; 4]),
        (true, None, [Verified, Unchecked, Verified, Unchecked]),
        (false, None, [Rejected, Unchecked, Rejected, Rejected]),
    ] {
        let ways = [Verify::Sidescan, Verify::Camera, Verify::Either, Verify::Both];
        let got = ways.map(|v| verdict(v, object, source));
        assert_eq!(got, want, "{object} {source:?}");
    }
}

/// Black pictures, added up, say nothing: neither verified nor rejected, and the lines come to an end.
#[test]
fn pictures_that_show_nothing_leave_the_place_open() {
    let add_up = AddUpSpec { most_lines: 3, ..AddUpSpec::default() };
    let spec = |verify| SurveySpec {
        sidescan: (verify == Verify::Both).then(SidescanPasses::default),
        camera: Some(CameraPasses { add_up: Some(add_up.clone()), ..CameraPasses::default() }),
        verify,
        ..SurveySpec::default()
    };
    // Levels of one colour throughout: the camera did not see.
    let blind = Sea { camera: Some(false), ..sea(Some(place())) };
    for (verify, lines) in [(Verify::Camera, 3), (Verify::Both, 5)] {
        let got = fly(&spec(verify), &blind, place(), Vector2::zeros());
        assert_eq!(got.last.verdict, Verdict::CannotTell, "{verify:?}");
        assert_eq!(got.lines.len(), lines);
        let looked = got.last.looked.expect("pictures were taken");
        assert_eq!((looked.pictures, looked.lines), (0, 3));
        assert!(looked.useless > 10, "{looked:?}");
        assert_eq!(PostDeclaration::next(got.last.verdict), Behaviour::GoHome);
    }
    let without = Sea { camera: None, ..sea(None) };
    let got = fly(&spec(Verify::Camera), &without, place(), Vector2::zeros());
    assert_eq!(got.last.verdict, Verdict::Unchecked);
}

#[test]
fn declarations_are_numbered_and_the_plain_ends_stay() {
    for (after, next) in [(AfterDeclaration::GoHome, Behaviour::GoHome), (AfterDeclaration::Stop, Behaviour::Done)] {
        let mut post = PostDeclaration::new(&after, &StandardEyes, false).unwrap();
        let o = seen(0.0, place(), 0.0, None);
        for number in 0..3 {
            let d = Declaration::first(1.0, place(), "test");
            let (stamped, then) = post.enter(d, &o, Heading::from_deg(0.0));
            assert_eq!((stamped.number, then), (number, next));
            assert_eq!(post.vertical(), None);
        }
    }
    assert!(area().contains(place()));
}

#[test]
fn parts_that_do_not_go_together_are_named() {
    let says = |spec: SurveySpec| {
        PostDeclaration::new(&AfterDeclaration::Survey(Box::new(spec)), &StandardEyes, false)
            .expect_err("must not be")
            .to_string()
    };
    let blind = SurveySpec { verify: Verify::Both, ..SurveySpec::default() };
    assert!(says(blind).starts_with("strategy.after_declaration.verify: Both needs passes"));
    let none = SurveySpec {
        sidescan: Some(SidescanPasses { offsets_m: Vec::new(), ..SidescanPasses::default() }),
        ..SurveySpec::default()
    };
    assert!(says(none).contains("sidescan.offsets_m: must have from 1 to 32 lines, got 0"));
}

/// What the camera's part of a survey begins with, for a vehicle that hovers or not.
fn first_of_the_camera(hovers: bool, camera: CameraPasses) -> Manoeuvre {
    let spec = SurveySpec { sidescan: None, camera: Some(camera), verify: Verify::Camera, ..SurveySpec::default() };
    let after = AfterDeclaration::Survey(Box::new(spec));
    let mut post = PostDeclaration::new(&after, &StandardEyes, false).unwrap();
    let place = Vector2::new(10.0, 20.0);
    let mut o = seen(0.0, place, 0.0, None);
    o.able.hovers = hovers;
    let first = Declaration::first(0.0, place, "test");
    let _ = post.enter(first, &o, Heading::from_deg(30.0));
    // The first step ends the sidescan's part, which has no lines.
    match post.step(&o, false) {
        Progress::Go(Stride::Start(manoeuvre)) => manoeuvre,
        other => panic!("{other:?}"),
    }
}

#[test]
fn over_a_declared_place_a_vehicle_that_hovers_holds_for_pictures_that_add_up() {
    let added = || CameraPasses { add_up: Some(AddUpSpec::default()), ..CameraPasses::default() };
    let holds = first_of_the_camera(true, added());
    assert!(matches!(holds, Manoeuvre::GoToPoint { .. }), "{holds:?}");
    let not_asked = CameraPasses { held_pictures: 0, ..added() };
    // Each picture by itself, or a vehicle that cannot hover, or one that is told to fly lines.
    for (hovers, camera) in [(true, CameraPasses::default()), (false, added()), (true, not_asked)] {
        let flies = first_of_the_camera(hovers, camera);
        assert!(matches!(flies, Manoeuvre::FollowLine { .. }), "{flies:?}");
    }
}
