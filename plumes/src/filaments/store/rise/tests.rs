//! The element against known solutions.

use super::element::{Around, Element, Thread};
use super::simd::RisingLanes;
use crate::release::BuoyancySpec;
use crate::simd::dispatch::InstructionSet;
use world::math;
use world::ranges::Finite;

const RATE_HZ: f64 = 10.0;

/// A thread with a flux of buoyancy B (m⁴/s³) from a small opening.
fn thread(flux: f64, radius_m: f64, least_m_s: f64) -> Thread {
    let volume_m3_s = std::f64::consts::PI * radius_m * radius_m * least_m_s;
    let excess = -flux / volume_m3_s / 9.81 * 1000.0;
    Thread {
        volume_m3: volume_m3_s / RATE_HZ,
        rate_hz: RATE_HZ,
        least_m_s,
        curve: (BuoyancySpec::Excess(Finite::new(excess)).curve(1000.0)).unwrap().unwrap(),
    }
}

fn around(speed_m_s: f64, dissipation_m2_s3: f64, n2_per_s2: f64) -> Around {
    Around { speed_m_s, dissipation_m2_s3, n2_per_s2, largest_m: 1e3 }
}

impl Thread {
    /// Lets an element rise for `dt_s` from a height, m, in the water that `at` tells at each height. Returns where it
    /// comes to.
    fn rise(&self, e: &mut Element, z_m: f64, dt_s: f64, at: impl Fn(f64) -> Around) -> f64 {
        let mut one = RisingLanes { elements: [*e], z_m: [z_m], dt_s: [dt_s] };
        one.rise(InstructionSet::Portable, self, at);
        [*e] = one.elements;
        one.z_m[0]
    }
}

/// Height and element after a time.
fn risen(thread: &Thread, around: Around, t_s: f64, dt_s: f64) -> (f64, Element) {
    let (mut e, mut z) = (thread.released(), 0.0);
    for _ in 0..(t_s / dt_s).round() as usize {
        z = thread.rise(&mut e, z, dt_s, |_| around);
    }
    (z, e)
}

/// Morton, Taylor & Turner 1956, top-hat: b = 6αz/5 and w = 5/(6α)·(9αF/10)^⅓ z^(−⅓), F the flux over π.
#[test]
fn plume_in_still_water() {
    let flux = 1e-4;
    let thread = thread(flux, 0.01, 0.005);
    let (z, e) = risen(&thread, around(0.0, 0.0, 0.0), 400.0, 0.5);
    let f = flux / std::f64::consts::PI;
    let w = 5.0 / (6.0 * 0.117) * math::cbrt(0.9 * 0.117 * f) * math::powf(z, -1.0 / 3.0);
    let got = e.momentum_m4_s / e.shared_m3;
    // The opening shifts the plume's origin by some centimetres of 15 m.
    assert!((got / w - 1.0).abs() < 0.01, "{got} {w} at {z}");
    let b = (e.shared_m3 * RATE_HZ / (std::f64::consts::PI * got)).sqrt();
    assert!((b / (1.2 * 0.117 * z) - 1.0).abs() < 0.01, "{b} at {z}");
    assert_eq!(e.own_m3, e.shared_m3);
}

/// The same in stratified water: highest at 5.32 F^¼ N^(−¾), with F the flux over π (integrated from the equations of Morton,
/// Taylor & Turner with α = 0.117); then it settles at its level, not above that.
#[test]
fn plume_in_stratified_water() {
    let (flux, n) = (1e-4, 0.02);
    let thread = thread(flux, 0.01, 0.002);
    let water = around(0.0, 0.0, n * n);
    let f = flux / std::f64::consts::PI;
    let scale = math::powf(f, 0.25) * math::powf(n, -0.75);
    let (mut e, mut z, mut top) = (thread.released(), 0.0_f64, 0.0_f64);
    let mut late = Vec::new();
    for step in 0..40_000 {
        z = thread.rise(&mut e, z, 0.25, |_| water);
        top = top.max(z);
        if step > 30_000 {
            late.push(z);
        }
    }
    assert!((top / scale - 5.32).abs() < 0.06, "{}", top / scale);
    let (low, high) = late.iter().fold((f64::MAX, 0.0_f64), |(l, h), z| (l.min(*z), h.max(*z)));
    assert!(high - low < 0.1 * top, "{low} to {high}");
    assert!(low / scale > 3.5 && high < top, "{low} to {high} of {top}");
}

/// Briggs 1969: z = 1.6 F^⅓ x^⅔/U.
#[test]
fn thread_bent_over_by_the_stream() {
    let (flux, speed) = (4.8e-8, 0.05);
    let thread = thread(flux, 0.0021, speed);
    let f = flux / std::f64::consts::PI;
    for x in [1.0_f64, 5.0, 50.0] {
        let (z, e) = risen(&thread, around(speed, 0.0, 0.0), x / speed, 0.05);
        let briggs = 1.6 * math::cbrt(f) * math::powf(x, 2.0 / 3.0) / speed;
        // The nozzle's radius and the rise's own part of the speed shift it.
        assert!((z / briggs - 1.0).abs() < if x < 2.0 { 0.15 } else { 0.05 }, "{x}: {z} {briggs}");
        assert!((e.momentum_m4_s / (flux / RATE_HZ * x / speed) - 1.0).abs() < 1e-9);
    }
}

/// Where turbulence shares the momentum out, w = Ft/V with the volume V of Richardson's law alone.
#[test]
fn strong_turbulence_leaves_little_of_the_rise() {
    let (flux, speed, epsilon) = (4.8e-8, 0.05, 1e-3_f64);
    let thread = thread(flux, 0.0021, speed);
    let (z, e) = risen(&thread, around(speed, epsilon, 0.0), 20.0, 0.05);
    let r = math::powf(math::powf(0.0021, 2.0 / 3.0) + 2.0 / 3.0 * 1.0736 * math::cbrt(epsilon) * 20.0, 1.5);
    let got = (e.shared_m3 * RATE_HZ / (std::f64::consts::PI * speed)).sqrt();
    assert!((got / r - 1.0).abs() < 0.01, "{got} {r}");
    let (free, _) = risen(&thread, around(speed, 0.0, 0.0), 20.0, 0.05);
    assert!(z < 0.06 * free, "{z} {free}");
}

/// Momentum is the time integral of the force, in steps of any length; the way depends little on the step.
#[test]
fn steps_change_nothing_that_is_conserved() {
    let thread = thread(4.8e-8, 0.0021, 0.05);
    let water = around(0.05, 1.4e-6, 0.0);
    let (z, _) = risen(&thread, water, 20.0, 0.05);
    for dt in [0.25, 1.0, 10.0] {
        let (other, e) = risen(&thread, water, 20.0, dt);
        assert!((other / z - 1.0).abs() < 0.01, "{dt}: {other} {z}");
        assert!((e.momentum_m4_s / (4.8e-8 / RATE_HZ * 20.0) - 1.0).abs() < 1e-9);
    }
    // Where the water is stratified, what the force loses is what the momentum has passed.
    let mut e = thread.released();
    let n2 = 0.01;
    let (mut z, mut passed) = (0.0, 0.0);
    for _ in 0..1000 {
        let before = e;
        let to = thread.rise(&mut e, z, 0.01, |_| around(0.05, 0.0, n2));
        passed -= n2 * 0.5 * (before.momentum_m4_s + e.momentum_m4_s) * 0.01;
        z = to;
    }
    assert!((e.passed_m4_s2 / passed - 1.0).abs() < 1e-3, "{} {passed}", e.passed_m4_s2);
}

#[test]
fn heavy_releases_sink_as_light_ones_rise() {
    let [light, heavy] =
        [4.8e-8, -4.8e-8].map(|flux| risen(&thread(flux, 0.0021, 0.05), around(0.05, 1e-6, 0.0), 10.0, 0.1).0);
    assert_eq!(light, -heavy);
    assert!(light > 0.01);
}

/// Four of unlike ages and times, of which some take more steps than others.
#[test]
fn elements_rise_side_by_side_as_each_alone() {
    let thread = thread(5e-8, 0.002, 0.05);
    let at = |z: f64| around(0.05 + 0.1 * z, 1e-6 * (1.0 - z), -0.02 * z);
    let mut r = world::seeds::Stream::new(6, "test", "abreast");
    for _ in 0..50 {
        let mut draw = || r.uniform();
        let some: [Element; 4] = std::array::from_fn(|_| {
            let own = thread.volume_m3 * (1.0 + 9.0 * draw());
            Element {
                shared_m3: own * (1.0 + draw()),
                own_m3: own,
                momentum_m4_s: 1e-2 * own * (draw() - 0.2),
                passed_m4_s2: 1e-4 * own * (draw() - 0.5),
            }
        });
        let z: [f64; 4] = std::array::from_fn(|_| -0.2 * draw());
        let mut dt_s: [f64; 4] = std::array::from_fn(|_| 2.0 * draw());
        dt_s[1] = 0.0;
        let alone: [(f64, Element); 4] = std::array::from_fn(|l| {
            let mut e = some[l];
            let z = thread.rise(&mut e, z[l], dt_s[l], at);
            (z, e)
        });
        assert_eq!(alone[1], (z[1], some[1]));
        assert_ne!(alone[0], (z[0], some[0]));
        for path in InstructionSet::all() {
            let mut beside = RisingLanes { elements: some, z_m: z, dt_s };
            beside.rise(path, &thread, at);
            for (l, alone) in alone.iter().enumerate() {
                let risen = (beside.z_m[l], beside.elements[l]);
                assert_eq!(risen, *alone, "{path:?} {l}");
            }
        }
    }
}
