//! The element against known solutions.

use super::element::{Around, Element, Thread};
use super::simd::RisingLanes;
use crate::release::{BuoyancySpec, CompositionSpec, DissolvedSpec, Solute};
use crate::simd::dispatch::InstructionSet;
use world::math;
use world::ranges::{Finite, Positive};

const RATE_HZ: f64 = 10.0;

/// A thread with a flux of buoyancy B (m⁴/s³) from a small opening.
fn thread(flux: f64, radius_m: f64, outflow_m_s: f64) -> Thread {
    let volume_m3_s = std::f64::consts::PI * radius_m * radius_m * outflow_m_s;
    let excess = -flux / volume_m3_s / 9.81 * 1000.0;
    Thread {
        volume_m3: volume_m3_s / RATE_HZ,
        rate_hz: RATE_HZ,
        outflow_m_s,
        curve: (BuoyancySpec::Excess(Finite::new(excess)).curve(1000.0)).unwrap().unwrap(),
        mixes: false,
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
    // Nothing but its own motion has grown it.
    assert!((e.own_m3 / e.core_m3 - 1.0).abs() < 1e-9);
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

/// Briggs 1969: z = 1.6 F^⅓ x^⅔/U, of a thread thick enough to be turbulent.
#[test]
fn thread_bent_over_by_the_stream() {
    let (flux, speed) = (4.8e-4, 0.5);
    let thread = thread(flux, 0.01, speed);
    for x in [20.0, 100.0, 500.0] {
        let (z, e) = risen(&thread, around(speed, 0.0, 0.0), x / speed, 0.05);
        let briggs = briggs(flux, x, speed);
        assert!((z / briggs - 1.0).abs() < 0.05, "{x}: {z} {briggs}");
        assert!((e.momentum_m4_s / (flux / RATE_HZ * x / speed) - 1.0).abs() < 1e-9);
    }
}

fn briggs(flux: f64, x_m: f64, speed_m_s: f64) -> f64 {
    1.6 * math::cbrt(flux / std::f64::consts::PI) * math::powf(x_m, 2.0 / 3.0) / speed_m_s
}

/// A thread that leaves its source much faster than the stream slows down and then rises as if it had left slowly.
#[test]
fn a_fast_outflow_slows_down_to_the_same_rise() {
    let of = |litres: f64, excess: f64, radius: f64| {
        let volume = 1e-3 * litres;
        let flux = 9.81e-3 * excess * volume;
        (flux, thread(flux, radius, volume / (std::f64::consts::PI * radius * radius)))
    };
    // 10 L/s, 10 kg/m³ lighter, in a stream of 0.2 m/s. The thinner the opening, the faster the jet and the later its
    // momentum is forgotten.
    for (radius, t_s) in [(0.1, 400.0), (0.063, 400.0), (0.03, 4000.0)] {
        let (flux, thread) = of(10.0, 10.0, radius);
        let (z, _) = risen(&thread, around(0.2, 0.0, 0.0), t_s, 0.5);
        let want = briggs(flux, 0.2 * t_s, 0.2);
        assert!((z / want - 1.0).abs() < 0.05, "{radius}: {z} {want}");
    }
    // 1 L/s, 20 kg/m³ lighter, in still water: the height of the plume of Morton, Taylor & Turner after a time.
    for (radius, t_s) in [(0.03, 300.0), (0.01, 3000.0)] {
        let (flux, thread) = of(1.0, 20.0, radius);
        let (z, _) = risen(&thread, around(0.0, 0.0, 0.0), t_s, 0.5);
        let f = flux / std::f64::consts::PI;
        let speed = 5.0 / (6.0 * 0.117) * math::cbrt(0.9 * 0.117 * f);
        let want = math::powf(4.0 / 3.0 * speed * t_s, 0.75);
        assert!((z / want - 1.0).abs() < 0.05, "{radius}: {z} {want}");
    }
}

/// Below a Reynolds number of 100 a thread entrains nothing; viscosity spreads its momentum. Speed of a line force that
/// acts over a disc from a time on: f/8πν · ln(1 + 8νt/r²).
#[test]
fn a_laminar_thread_rises_by_viscosity_alone() {
    let (flux, speed, radius) = (4.8e-9, 0.05, 0.0021);
    let thread = thread(flux, radius, speed);
    let line = flux / speed;
    for t_s in [2.0, 10.0, 40.0] {
        let (_, e) = risen(&thread, around(speed, 0.0, 0.0), t_s, 0.05);
        let got = e.momentum_m4_s / e.shared_m3;
        let want = line / (8.0 * std::f64::consts::PI * 1e-6) * math::ln(1.0 + 8e-6 * t_s / (radius * radius));
        assert!((got / want - 1.0).abs() < 0.05, "{t_s}: {got} {want}");
        assert_eq!(e.own_m3, thread.volume_m3);
    }
}

/// What is neutral until its molecules mix rises later than what is as light from the start, and in the end as fast.
#[test]
fn a_solution_lifts_once_it_is_mixed() {
    let composition = BuoyancySpec::Composition(CompositionSpec {
        solutes: vec![DissolvedSpec { what: Solute::SodiumChloride, g_l: Positive::new(47.0) }],
        neutral_with: Some(Solute::Propanol),
        ..CompositionSpec::default()
    });
    let later =
        Thread { curve: composition.curve(998.2).unwrap().unwrap(), mixes: true, ..thread(4.8e-8, 0.0021, 0.05) };
    let excess = -later.curve.at(1e5) * 998.2 / 9.81;
    let at_once =
        Thread { curve: BuoyancySpec::Excess(Finite::new(excess)).curve(998.2).unwrap().unwrap(), ..later.clone() };
    // The bed of the flume: ε of 1.4e-6 m²/s³.
    let water = around(0.05, 1.4e-6, 0.0);
    let force = |thread: &Thread, t_s: f64| {
        let [(_, before), (_, after)] = [t_s, t_s + 0.5].map(|t| risen(thread, water, t, 0.05));
        (after.momentum_m4_s - before.momentum_m4_s) / 0.5
    };
    let early = force(&later, 1.0) / force(&at_once, 1.0);
    let late = force(&later, 60.0) / force(&at_once, 60.0);
    assert!(early < 0.3 && (late - 1.0).abs() < 0.05, "{early} {late}");
    assert!(risen(&later, water, 10.0, 0.05).0 < 0.8 * risen(&at_once, water, 10.0, 0.05).0);
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
            let core = own * (1.0 + draw());
            Element {
                shared_m3: core * (1.0 + draw()),
                core_m3: core,
                own_m3: own,
                thinned: draw(),
                mixed: draw(),
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
