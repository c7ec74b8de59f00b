//! Surge and cast in closed loop: on a plume of puffs, on pulses, in clean water.

use super::*;
use crate::handoff::Behaviour as B;
use crate::track::GantryStrategySpec;
use crate::track::testing::{Puffs, Rig, SOURCE_M, layout};

const LIMIT_S: f64 = 400.0;

fn rig(spec: &SurgeCastSpec, start: [f64; 2], seed: u64) -> Rig {
    let strategy = GantryStrategySpec::new(spec.clone()).build(&layout());
    Rig::new(strategy.expect("legal"), Vector2::from(start), seed)
}

/// Of 20 trials 16 are expected within 30 cm (49 and 48 of 60 in other plumes); three standard errors are 5.4.
#[test]
fn stops_near_the_source_of_a_plume_straight_and_obliquely() {
    for angle in [0.0, 30.0] {
        let spec = SurgeCastSpec { angle_deg: NonNegative::new(angle), ..Default::default() };
        let near = |seed: &u64| {
            let puffs = Puffs::new(*seed, LIMIT_S);
            let mut r = rig(&spec, [0.2, 0.3], *seed);
            r.run(LIMIT_S, |t, p| puffs.above_v(t, p));
            let surges: Vec<_> = r.log.iter().filter(|l| l.1 == B::StepUp).map(|l| l.2 - l.3).collect();
            assert!(surges.iter().all(|by| (by.norm() - 0.125).abs() < 0.01), "{surges:?}");
            let aside = surges.iter().map(|by| by.y.signum());
            assert!(angle == 0.0 || aside.clone().zip(aside.skip(1)).all(|(a, b)| a != b), "{surges:?}");
            r.stopped() == Some(true) && (r.head_m() - SOURCE_M.xy()).norm() < 0.3
        };
        let n = (200..220).filter(near).count();
        assert!(n >= 11, "{angle}: only {n} of 20");
    }
}

/// Pulses of one scan, the more frequent the nearer the source: twice a second 30 cm before it.
#[test]
fn stops_by_the_frequency_of_spikes() {
    let spec = SurgeCastSpec { stop: StopSpec::default(), ..Default::default() };
    let mut r = rig(&spec, [0.2, 0.1], 1);
    r.run(LIMIT_S, |t, p| {
        let (dx, aside) = ((SOURCE_M.x - p.x).max(0.05), (p.y - SOURCE_M.y).abs());
        let lit = ((20.0 * t).round() as u64).is_multiple_of((20.0 * dx / 0.6).round() as u64);
        if lit && aside < 0.2 { 1.0 - 5.0 * aside } else { 0.0 }
    });
    // A surge of 12.5 cm beyond where the window of 3.5 s shows 2 Hz.
    let d = (r.head_m() - SOURCE_M.xy()).norm();
    assert!(r.stopped() == Some(true) && (0.1..0.36).contains(&d), "{d} m");
}

#[test]
fn without_odour_it_casts_over_the_whole_width_and_declares_nothing() {
    let mut r = rig(&SurgeCastSpec::default(), [0.2, 0.1], 1);
    r.run(LIMIT_S, |_, _| 0.0);
    assert_eq!(r.stopped(), Some(false));
    let casts: Vec<_> = r.log.iter().filter(|l| l.1 == B::Cast).map(|l| l.2).collect();
    for left_m in layout().travel_m[1] {
        assert!(casts.iter().any(|to| to.y == left_m), "{casts:?}");
    }
    // To one side and the other, ever farther, a little up-stream each time.
    for w in casts.windows(2) {
        assert!((w[0].y - 0.1) * (w[1].y - 0.1) < 0.0 && (w[1].x - w[0].x - 0.03).abs() < 1e-9);
        let far = |p: Vector2<f64>| (p.y - 0.1).abs();
        assert!((far(w[1]) - far(w[0]) - 0.125).abs() < 1e-9 || w[1].y.abs() == 0.5, "{w:?}");
    }
}

#[test]
fn what_the_machine_cannot_do_is_refused() {
    let travel = "the gantry's travel in m, got";
    let long = Positive::new(2.5);
    for (spec, said) in [
        (SurgeCastSpec { surge_m: long, ..Default::default() }, format!("surge_m: must be at most 2, {travel} 2.5")),
        (SurgeCastSpec { cast_m: long, ..Default::default() }, format!("cast_m: must be at most 1, {travel} 2.5")),
        (
            SurgeCastSpec { angle_deg: NonNegative::new(90.0), ..Default::default() },
            "angle_deg: must be from 0 to below 90, got 90".into(),
        ),
        (
            SurgeCastSpec {
                stop: StopSpec::Experience(Experience { least_hz: Positive::new(9.0), ..Default::default() }),
                ..Default::default()
            },
            "stop.least_hz: must not exceed most_hz, 4".into(),
        ),
    ] {
        let e = SurgeCast::new(&spec, &layout()).expect_err("impossible").to_string();
        assert_eq!(e, format!("tracker.SurgeCast.{said}"));
    }
}
