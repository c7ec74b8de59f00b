//! The computed effect of a step on mixed water, compared with filaments that take the step.

use super::mixed::{DEPTH, bins, gap, interface, parabola};
use super::water::{Given, basin, no_plume, pour};
use crate::filaments::drift::longest_step::{EVEN, SharpestMixing};
use crate::flow::grid::GridShape;
use world::math;
use world::seeds::Stream;
use world::terrain::Terrain;

const BED: Terrain = Terrain::Level { depth_m: DEPTH };
/// Filaments of a case: one bin has a standard error of 1.3 %, the worst of 24 bins one of about 3 %.
const FILAMENTS: usize = 150_000;
const NOISE: f64 = 0.03;
/// How long they take their steps, s: most of what a step does has grown by then.
const LASTS_S: f64 = 200.0;

fn sharpest(k_z: impl Fn(f64) -> f64 + Send + Sync) -> SharpestMixing {
    let water = Given(|_| 0.0, |z| (0.0, k_z(z)));
    SharpestMixing::sharpest(&water, &basin(), &BED, &GridShape::default(), 600.0)
}

/// Greatest deviation of a bin after `t_s` in steps of `dt_s`, from an even start.
fn sampled(k_z: impl Fn(f64) -> f64 + Send + Sync, dt_s: f64, t_s: f64) -> f64 {
    let water = Given(|_| 0.0, |z| (0.0, k_z(z)));
    let mut p = no_plume(DEPTH);
    let mut r = Stream::new(4, "test", "evenness");
    // One filament in each of as many layers, so that only the steps are random.
    pour(&mut p, FILAMENTS, -DEPTH, |n| {
        let part = (n as f64 + r.uniform()) / FILAMENTS as f64;
        [0.0, 0.0, -DEPTH * part]
    });
    p.drift(&water, -1e-9, 0.0);
    p.drift_on(&water, dt_s, 0..(t_s / dt_s).round() as u32);
    let depths: Vec<f64> = p.iter().map(|f| -f[2]).collect();
    bins(&depths).iter().map(|c| (c - 1.0).abs()).fold(0.0, f64::max)
}

/// All mixing that a scenario can make: bed, interfaces, a gap, waves; from nearly exact to half wrong.
#[test]
fn what_a_step_does_is_foretold() {
    fn check(what: &str, dt_s: f64, k_z: &(dyn Fn(f64) -> f64 + Send + Sync)) {
        let said = sharpest(k_z).uneven(dt_s, LASTS_S).unwrap().part;
        let got = sampled(k_z, dt_s, LASTS_S);
        assert!((said - got).abs() < NOISE + 0.15 * got, "{what}, {dt_s} s: {said} for {got}");
    }
    for dt_s in [2.0, 5.0] {
        check("parabola", dt_s, &parabola(0.02));
        check("0.3 m", dt_s, &interface(0.02, 0.3));
        check("0.5 m", dt_s, &interface(0.02, 0.5));
        check("1 m", dt_s, &interface(0.02, 1.0));
        check("gap", dt_s, &gap(3e-2));
        check("waves", dt_s, &|z: f64| 1e-5 + 1e-2 * math::exp(z / 0.3));
    }
}

#[test]
fn at_the_longest_step_water_is_even_and_beyond_it_no_more() {
    for thickness_m in [0.3, 0.5] {
        let k_z = || interface(0.02, thickness_m);
        let of = sharpest(k_z());
        let longest_s = of.longest_step_s(60.0, LASTS_S).unwrap();
        assert!(of.uneven(longest_s, LASTS_S).unwrap().part <= EVEN);
        assert!(of.uneven(1.1 * longest_s, LASTS_S).unwrap().part > EVEN);
        let at = sampled(k_z(), longest_s, LASTS_S);
        assert!(at < EVEN + NOISE, "{thickness_m} m, {longest_s} s: {at}");
        // A step ten times as long is several times as wrong, and filaments show it.
        let beyond = sampled(k_z(), 10.0 * longest_s, LASTS_S);
        assert!(beyond > 3.0 * EVEN, "{thickness_m} m, {longest_s} s: {beyond}");
    }
}

#[test]
fn steps_that_are_surely_even_are() {
    let mut sure = 0;
    for dt_s in [0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0] {
        for of in [
            sharpest(parabola(0.006)),
            sharpest(parabola(0.02)),
            sharpest(interface(0.001, 0.2)),
            sharpest(interface(0.02, 0.3)),
            sharpest(interface(0.03, 2.0)),
            sharpest(gap(3e-2)),
            sharpest(|z: f64| 1e-5 + 1e-2 * math::exp(z / 0.3)),
        ] {
            if of.surely_even(dt_s) {
                sure += 1;
                assert!(of.uneven(dt_s, 16_000.0).unwrap().part <= EVEN, "{dt_s} s");
            }
        }
    }
    assert!(sure >= 10, "{sure}");
}

/// A case that occurred: 0.3 m at K_z of 1e-2 m²/s deviates by 7 % in steps of 1 s and by 37 % in steps of 5 s. Mixing
/// by the bed alone does not.
#[test]
fn sharp_interfaces_need_short_steps_and_gentle_mixing_does_not() {
    let sharp = sharpest(interface(0.02, 0.3));
    let part = |dt_s: f64| sharp.uneven(dt_s, 600.0).unwrap().part;
    assert!((0.04..0.12).contains(&part(1.0)), "{}", part(1.0));
    assert!((0.25..0.5).contains(&part(5.0)), "{}", part(5.0));
    let longest_s = sharp.longest_step_s(5.0, 600.0).unwrap();
    assert!((0.3..1.0).contains(&longest_s), "{longest_s}");
    assert_eq!(sharpest(parabola(0.006)).longest_step_s(5.0, 600.0), Some(5.0));
    // With the same mixing everywhere, no step is too long; the sums over starts and kicks are accurate to 0.2 %.
    assert!(sharpest(|_| 1e-2).uneven(60.0, 600.0).unwrap().part < 2e-3);
}

#[test]
fn mixing_that_is_no_number_says_nothing() {
    assert_eq!(sharpest(|_| f64::INFINITY).uneven(1.0, 600.0), None);
    assert_eq!(sharpest(|_| f64::NAN).longest_step_s(1.0, 600.0), Some(1.0));
}
