//! Told places inspected by a vehicle that hovers: it takes its pictures while it holds over them.

use crate::common::scenario;
use nalgebra::Vector2;
use rheotaxis::score::Score;
use rheotaxis::trial::Trial;
use robots::handoff::{Declaration, Estimate, Readings, Verdict};
use world::frames::Truth;

/// A picture: when; where the vehicle believed to be when it asked for it; where it is, and its altitude, m.
struct Taken {
    t_s: f64,
    believed: Vector2<f64>,
    real: Vector2<f64>,
    altitude_m: f64,
}

/// The two places of `inspect_places`, inspected by a BlueROV2, with other values.
#[track_caller]
fn inspected(values: &[(&str, &str)]) -> (Vec<Taken>, Vec<Declaration>) {
    let hovering = [
        ("robots[0].vehicle", "Shipped(\"bluerov2\")"),
        ("robots[0].start.speed_m_s", "0"),
        ("robots[0].start.east_m", "-30"),
        ("robots[0].guidance.water_speed_limit_m_s", "0.6"),
        ("robots[0].strategy.speed_m_s", "0.5"),
        ("robots[0].sensors.compass.bias_deg", "0"),
        ("robots[0].sensors.lbl.noise_m", "0.2"),
    ];
    let loaded = scenario("inspect_places", &[&hovering[..], values].concat());
    loaded.check().expect("it can be flown");
    let mut trial = Trial::assemble(&loaded, 1).expect("a run");
    let (mut taken, mut believed) = (Vec::new(), Vector2::zeros());
    let mut goes_on = true;
    while goes_on {
        goes_on = trial.step();
        let world = &mut trial.simulation.world;
        let t_s = world.resource::<world::clock::Clock>().t_s();
        let mut robots = world.query::<(&Truth, &Estimate, &Readings)>();
        let (truth, estimate, readings) = robots.single(world).expect("a robot");
        if readings.picture.is_some() {
            let p = truth.pose.p_WB;
            taken.push(Taken { t_s, believed, real: p.xy(), altitude_m: p.z + 8.0 });
        }
        believed = estimate.position;
    }
    let score = trial.simulation.world.resource::<Score>();
    (taken, score.searchers[0].declarations.clone())
}

/// Where a place was told.
const TOLD: [[f64; 2]; 2] = [[-40.6, 28.7], [-39.5, -28.8]];

/// Each picture by itself, in clear water: all are taken over the place that was told.
#[test]
fn pictures_are_taken_while_it_holds_over_the_place() {
    let (taken, declared) = inspected(&[
        (
            "robots[0].strategy.survey.camera",
            "(half_length_m: 14, altitude_m: 2.5, period_s: 1, held_pictures: 6, verifier: ())",
        ),
        ("optics.clarity.visibility_m", "15"),
    ]);
    for place in TOLD.map(Vector2::from) {
        let here: Vec<&Taken> = (taken.iter()).filter(|p| (p.real - place).norm() < 20.0).collect();
        assert!((1..=6).contains(&here.len()), "{}", here.len());
        for p in here {
            assert!((p.believed - place).norm() <= 1.0, "{}", p.believed);
            assert!((p.real - place).norm() <= 1.3, "{}", p.real);
            assert!((p.altitude_m - 2.5).abs() < 0.9, "{}", p.altitude_m);
        }
    }
    assert_eq!(declared.len(), 2);
    // Without dye and body, all six say no.
    let at_rocks = (taken.iter()).filter(|p| p.real.y < 0.0).count();
    assert_eq!((at_rocks, declared[1].verdict), (6, Verdict::Rejected));
    let [first, .., last] = &taken[..] else {
        panic!("no pictures");
    };
    assert!(last.t_s - first.t_s < 400.0, "{}", last.t_s - first.t_s);
}

/// Pictures added up in murky water: from point to point, until they suffice.
#[test]
fn pictures_that_add_up_are_taken_from_points_held_one_after_the_other() {
    let (taken, declared) = inspected(&[]);
    let verdicts: Vec<Verdict> = declared.iter().map(|d| d.verdict).collect();
    for (place, d) in TOLD.map(Vector2::from).into_iter().zip(&declared) {
        let looked = d.looked.expect("pictures");
        let near = |p: &&Taken| (p.real - place).norm() < 20.0;
        let here: Vec<&Taken> = taken.iter().filter(near).collect();
        assert!(looked.lines >= 2 && looked.lowest_m < 2.0, "{looked:?}");
        assert!(here.len() <= 10 * looked.lines as usize + 1);
    }
    assert_eq!(verdicts, [Verdict::Verified, Verdict::Rejected]);
}
