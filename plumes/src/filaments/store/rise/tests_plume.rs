//! Buoyant filaments in water.

use super::element::Element;
use crate::filaments::plume::{Plume, PlumeSettings};
use crate::filaments::tests::water::{Given, basin, source};
use crate::flow::GridShape;
use crate::flow::tests::water::{duck, duck_area, duck_bed};
use crate::release::{BuoyancySpec, SourceSpec};
use crate::simd::dispatch::InstructionSet;
use nalgebra::Vector3;
use world::bits::{Reader, Writer};
use world::fields::{Concentration, Flow, Mixing};
use world::math;
use world::ranges::{Finite, Positive};
use world::terrain::Terrain;

/// A source of 1 L/s, so much heavier than the water around.
fn outfall(excess_kg_m3: f64, height_m: f64) -> SourceSpec {
    let mut spec = source(height_m, 10.0, 0.0, 0.05);
    spec.release.buoyancy = BuoyancySpec::Excess(Finite::new(excess_kg_m3));
    spec.release.volume_l_s = Some(Positive::new(1.0));
    spec
}

fn plume(spec: SourceSpec, flow: &dyn Flow, depth_m: f64) -> Plume {
    let bed = Terrain::Level { depth_m };
    let settings = PlumeSettings { refresh_s: 0.0, grid: GridShape::default() };
    let plume = Plume::new(&[spec], &basin(), &bed, 1, settings).unwrap();
    plume.with_buoyancy(flow).unwrap()
}

fn drifted(plume: &mut Plume, flow: &dyn Flow, steps: u32, dt_s: f64) {
    for n in 0..steps {
        plume.drift(flow, f64::from(n) * dt_s, f64::from(n + 1) * dt_s);
    }
}

fn elements(plume: &Plume) -> &[Element] {
    &plume.stores[0].rise.as_ref().unwrap().elements
}

/// Even water that is 1 kg/m³ lighter in each metre upwards.
struct Stratified;

impl Flow for Stratified {
    fn velocity(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::zeros()
    }
    fn density(&self, p: &Vector3<f64>, _: f64) -> f64 {
        1020.0 - p.z
    }
    fn mixing(&self, _: &Vector3<f64>, _: f64) -> Mixing {
        Mixing::default()
    }
}

/// The filaments of a plume in a steady stream without mixing follow the element; their momentum is what its force has
/// given, to single precision.
#[test]
fn filaments_follow_their_elements() {
    let stream = Given(|_| 0.2, |_| (0.0, 0.0));
    let mut p = plume(outfall(-5.0, 1.0), &stream, 30.0);
    drifted(&mut p, &stream, 200, 0.5);
    let lift = 9.81 * 5.0 / stream.density(&Vector3::zeros(), 0.0) * 1e-3 / 10.0;
    let (store, now_s) = (&p.stores[0], 100.0);
    assert_eq!(elements(&p).len(), store.x.len());
    for (n, e) in elements(&p).iter().enumerate() {
        let age_s = now_s - store.born_s[n];
        assert!((e.momentum_m4_s / (lift * age_s) - 1.0).abs() < 1e-6, "{n}");
    }
    // Briggs: 1.6 F^⅓ x^⅔/U above a source at 1 m.
    let f = 9.81 * 5.0 / 1026.0 * 1e-3 / std::f64::consts::PI;
    let x = f64::from(store.x[0]) - p.sources[0].p_W.x;
    let briggs = 1.6 * math::cbrt(f) * math::powf(x, 2.0 / 3.0) / 0.2;
    let risen = f64::from(store.z[0]) + 29.0;
    assert!((risen / briggs - 1.0).abs() < 0.05, "{risen} {briggs}");
    // Its own entrainment has widened the oldest to half of its radius, 0.6 of the rise.
    let size = f64::from(store.horizontal(0, now_s - store.born_s[0]));
    assert!((size / (0.3 * briggs) - 1.0).abs() < 0.1, "{size} {briggs}");
}

#[test]
fn it_settles_at_its_level_and_stays_below_the_surface() {
    let mut p = plume(outfall(-5.0, 1.0), &Stratified, 30.0);
    drifted(&mut p, &Stratified, 500, 1.0);
    let old: Vec<f32> = p.stores[0].z[..2000].to_vec();
    // F^¼ N^(−¾) with F the flux over π: 0.36 m; the level of no buoyancy lies 4 times as high.
    let (low, high) = old.iter().fold((0.0_f32, -30.0_f32), |(l, h), z| (l.min(*z), h.max(*z)));
    assert!(low > -28.3 && high < -26.9, "{low} to {high}");
    // In even water it goes to the surface and stays there.
    let still = Given(|_| 0.0, |_| (0.0, 0.0));
    let mut p = plume(outfall(-5.0, 1.0), &still, 5.0);
    drifted(&mut p, &still, 400, 1.0);
    let old = &p.stores[0].z[..1000];
    let lowest = old.iter().fold(0.0_f32, |l, z| l.min(*z));
    assert!(lowest > -0.5 && old.iter().all(|z| *z <= 0.0), "{lowest}");
}

#[test]
fn no_excess_is_neutral_to_the_bit() {
    let stream = Given(|_| 0.2, |_| (0.01, 0.001));
    let mut neutral = outfall(0.0, 1.0);
    neutral.release.buoyancy = BuoyancySpec::Neutral;
    let places = |spec: SourceSpec| {
        let mut p = plume(spec, &stream, 30.0);
        drifted(&mut p, &stream, 100, 0.5);
        let s = &p.stores[0];
        let beside = Vector3::new(f64::from(s.x[400]), f64::from(s.y[400]) + 0.1, f64::from(s.z[400]));
        (format!("{:?} {:?} {:?}", s.x, s.y, s.z), p.concentration(&beside).to_bits())
    };
    assert_eq!(places(outfall(0.0, 1.0)), places(neutral));
}

/// In bands, on all paths and threads, and over a pause in which it was kept on a disk.
#[test]
fn rising_filaments_are_the_same_on_every_way() {
    let water = duck().build(&duck_area(), &duck_bed(), 7).unwrap();
    let fresh = |path, threads| {
        let settings = PlumeSettings { refresh_s: 10.0, grid: GridShape::fitting(&duck_area()) };
        let mut p = Plume::new(&[outfall(-5.0, 1.0)], &duck_area(), &duck_bed(), 3, settings)
            .unwrap()
            .with_buoyancy(&water)
            .unwrap();
        p.path = path;
        p.use_threads(crate::filaments::threads(threads));
        p
    };
    let develop = |p: &mut Plume, from_s: f64, to_s: f64| {
        let mut water = water.clone();
        p.pace(from_s, to_s, 10.0);
        let mut t_s = from_s;
        while t_s < to_s {
            water.advance(t_s);
            t_s = p.next_meeting_s();
            p.advance(&water, t_s);
        }
    };
    let state = |p: &Plume| {
        let s = &p.stores[0];
        let beside = |n: usize| Vector3::new(s.x[n] + 0.2, s.y[n], s.z[n]).map(f64::from);
        let felt: Vec<u64> = (0..s.x.len()).step_by(97).map(|n| p.concentration(&beside(n)).to_bits()).collect();
        (s.z.clone(), elements(p).to_vec(), felt)
    };
    let mut first = fresh(InstructionSet::Portable, 1);
    develop(&mut first, 0.0, 200.0);
    let mut bytes = Writer::default();
    first.keep(&mut bytes);
    let mut recalled = fresh(InstructionSet::Portable, 1);
    recalled.recall(&water, &mut Reader::new(&bytes.into_bytes())).unwrap();
    assert_eq!(state(&recalled), state(&first));
    develop(&mut first, 200.0, 300.0);
    develop(&mut recalled, 200.0, 300.0);
    let want = state(&first);
    assert!(state(&recalled) == want, "kept");
    for path in InstructionSet::all() {
        let mut other = fresh(path, 2);
        develop(&mut other, 0.0, 200.0);
        develop(&mut other, 200.0, 300.0);
        assert!(state(&other) == want, "{path:?}");
    }
}

#[test]
fn a_buoyant_release_says_its_volume() {
    let still = Given(|_| 0.0, |_| (0.0, 0.0));
    let mut spec = outfall(-5.0, 1.0);
    spec.release.volume_l_s = None;
    let settings = PlumeSettings { refresh_s: 0.0, grid: GridShape::default() };
    let bed = Terrain::Level { depth_m: 30.0 };
    let plume = Plume::new(&[spec], &basin(), &bed, 1, settings).unwrap();
    let refused = plume.with_buoyancy(&still).expect_err("no volume").to_string();
    assert!(refused.starts_with("sources[0].release.volume_l_s: a release that is buoyant"), "{refused}");
}

/// So many filaments that each step is shared out among threads, and a stream that carries them out of the basin while
/// new ones come: what is left is the same, filament by filament and element by element.
#[test]
fn many_rising_filaments_are_the_same_on_two_threads() {
    let stream = Given(|_| 1.0, |_| (0.01, 1e-3));
    let grown = |threads| {
        let mut spec = outfall(-2.0, 1.0);
        spec.release.rate_hz = Positive::new(100.0);
        let mut plume = plume(spec, &stream, 30.0);
        plume.use_threads(crate::filaments::threads(threads));
        let mut most = 0;
        let mut left = false;
        for n in 0..110 {
            let before = plume.stores[0].len();
            plume.drift(&stream, 2.0 * f64::from(n), 2.0 * f64::from(n + 1));
            let now = plume.stores[0].len();
            left |= now < before + 200 && n > 1;
            most = most.max(now);
        }
        assert!(most > 2 * crate::filaments::step::WORTH_THREADS, "{most}");
        assert!(left, "nothing left the basin");
        let s = &plume.stores[0];
        ([s.x.clone(), s.y.clone(), s.z.clone()], elements(&plume).to_vec())
    };
    assert!(grown(1) == grown(2));
}
