//! The whole planner with the real guidance, on a point vehicle in a made-up plume.
//!
//! The plume: flow to the south-south-east, a meandering centre line, a width that grows with the root of the
//! distance, patches of 2 s that are present or not (60 %). The vehicle: 10 deg/s; it follows commands at once.

use super::{Amp, AmpSpec};
use crate::guide::{Guidance, GuidanceSpec};
use crate::handoff::testing::{area, fixed, seen, smelling, steered};
use crate::handoff::{Behaviour, Command, GuidanceStatus, Outcome};
use crate::strategy::Strategy;
use crate::strategy::testing::Blind;
use nalgebra::Vector2;
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;
use world::math;
use world::seeds::Stream;
use world::units::Heading;

const DT_S: f64 = 0.1;
const SOURCE: Vector2<f64> = Vector2::new(-60.0, 180.0);

fn flow() -> Vector2<f64> {
    Heading::from_deg(160.0).unit() * 0.15
}

/// Whether this place is within the plume's width at this time.
fn in_width(p: Vector2<f64>, t_s: f64) -> bool {
    let down = flow().normalize();
    let across = Heading::from_vector(down).turned(FRAC_PI_2).unit();
    let (x, y) = ((p - SOURCE).dot(&down), (p - SOURCE).dot(&across));
    if x < 1.0 {
        return false;
    }
    let meander = 0.03 * x * math::sin(x / 60.0 - t_s / 400.0);
    (y - meander).abs() < 1.0 + 0.5 * x.sqrt()
}

#[derive(Debug)]
struct Report {
    declared: Option<Vector2<f64>>,
    outcome: Option<Outcome>,
    t_s: f64,
    seen: Vec<Behaviour>,
    farthest_outside_m: f64,
}

/// One run; every 30 s a fix moves the believed position by some `fix_m` in each axis.
fn run(seed: u64, plume: bool, limit_s: f64, fix_m: f64) -> Report {
    let mut amp = Amp::new(&AmpSpec::default(), &Blind).expect("defaults are legal");
    let mut guidance = Guidance::new(&GuidanceSpec::default());
    let (mut rng, mut patches) = (Stream::new(seed, "a", "amp"), Stream::new(seed, "a", "patches"));
    let mut noise = Stream::new(seed, "a", "noise");
    let home = Vector2::new(150.0, -260.0);
    let mut o = seen(0.0, home, 270.0, None);
    o.home = home;
    let mut report =
        Report { declared: None, outcome: None, t_s: 0.0, seen: Vec::new(), farthest_outside_m: f64::NEG_INFINITY };
    let (mut patch, mut status) = (false, GuidanceStatus::default());
    let (mut truth, mut off) = (home, Vector2::zeros());
    for tick in 0..(limit_s / DT_S) as u32 {
        o.t_s = f64::from(tick) * DT_S;
        if tick.is_multiple_of(20) {
            patch = patches.uniform() < 0.6;
        }
        // The flow is known from 5 s on; its direction has an error of some 6 degrees.
        if tick >= 50 && tick.is_multiple_of(10) {
            let velocity = flow() + Vector2::new(noise.normal(), noise.normal()) * 0.015;
            o.estimate.flow = Some(crate::handoff::FlowEstimate { velocity, age_s: 0.0 });
        }
        o.estimate.t_s = o.t_s;
        o.guidance = status;
        let smells = plume && patch && in_width(truth, o.t_s);
        let decision = amp.step(&smelling(o.clone(), smells), &mut rng);
        if report.seen.last() != Some(&decision.behaviour) {
            report.seen.push(decision.behaviour);
        }
        report.declared = report.declared.or(decision.declared.map(|d| d.position));
        report.t_s = o.t_s;
        if decision.outcome.is_some() {
            report.outcome = decision.outcome;
            return report;
        }
        let (command, now) = guidance.step(&o.estimate, &decision.goal, &area(), DT_S);
        status = now;
        let Command::Steer(set) = command else {
            panic!("the planner never drives the actuators");
        };
        truth += steered(&mut o.estimate, &set, flow()) * DT_S;
        if tick % 300 == 299 {
            off = Vector2::new(noise.normal(), noise.normal()) * fix_m;
        }
        o.estimate.position = truth + off;
        let outside = -area().edge_distance(truth).0;
        report.farthest_outside_m = report.farthest_outside_m.max(outside);
    }
    report
}

#[test]
fn finds_traces_declares_and_goes_home() {
    for seed in 1..=12 {
        let r = run(seed, true, 7200.0, 0.0);
        let declared = r.declared.unwrap_or_else(|| panic!("seed {seed}: {r:?}"));
        // The first lost points lie within a silence of lambda (5 s at 2 m/s) of the source, and in the
        // plume's width there, 1 + 0.5 sqrt(10) m.
        let error = (declared - SOURCE).norm();
        assert!(error < 13.0, "seed {seed}: {error:.1} m off at {declared:?}");
        assert_eq!(r.outcome, Some(Outcome::Completed), "seed {seed}");
        for wanted in [Behaviour::Find, Behaviour::TrackIn, Behaviour::TrackOut, Behaviour::GoHome] {
            assert!(r.seen.contains(&wanted), "seed {seed}: never in {wanted:?}");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_run() {
    let (a, b) = (run(3, true, 7200.0, 0.0), run(3, true, 7200.0, 0.0));
    assert_eq!((a.declared, a.t_s.to_bits()), (b.declared, b.t_s.to_bits()));
}

#[test]
fn without_a_plume_it_searches_on_inside() {
    let r = run(1, false, 3000.0, 0.0);
    assert_eq!((r.declared, r.outcome), (None, None));
    assert_eq!(r.seen, [Behaviour::Find]);
    assert!(r.farthest_outside_m < 0.0, "{}", r.farthest_outside_m);
}

proptest! {
    #![proptest_config(fixed(8))]

    // With any patches and fixes, the planner never ends a mission by leaving the area.
    #[test]
    fn never_aborts_by_itself(seed in 0u64..1_000_000) {
        let r = run(seed, true, 1500.0, 5.0);
        prop_assert!(r.outcome != Some(Outcome::Aborted));
    }
}
