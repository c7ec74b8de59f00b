//! Elements that rise side by side: their rates of change, and the integration.
//!
//! *Source*: see `element`; the midpoint rule.
//!
//! *Parameters*: [`PART`], [`MOST_STEPS`] of the integration.
//!
//! *Deviations*: none. The arithmetic is written once, for any number of elements, without fused multiply-add, and
//! compiled for each version of `path`. An element takes the same steps, to the same bits, beside any others.

use super::cube_root::cube_roots;
use super::element::{ACROSS, ALONG, Around, Element, SHARED, Thread};
use crate::simd::dispatch::InstructionSet;
use std::f64::consts::{PI, TAU};

/// Largest part by which a scale changes in a step of the integration.
const PART: f64 = 0.1;
/// Most steps of the integration within one step of the filament.
const MOST_STEPS: f64 = 400.0;
/// Elements that rise side by side.
pub(crate) const ABREAST: usize = 4;

/// The water that each of some elements meets; see [`Around`].
struct AmbientLanes<const N: usize> {
    speed: [f64; N],
    dissipation: [f64; N],
    n2: [f64; N],
    largest: [f64; N],
}

/// Some elements; see [`Element`].
#[derive(Clone, Copy)]
struct ElementLanes<const N: usize> {
    shared: [f64; N],
    own: [f64; N],
    momentum: [f64; N],
    passed: [f64; N],
}

/// Rates of change of some elements, their radii and how fast these grow.
struct RateLanes<const N: usize> {
    rise: [f64; N],
    shared: [f64; N],
    own: [f64; N],
    force: [f64; N],
    passed: [f64; N],
    radius: [f64; N],
    growth: [f64; N],
}

/// Elements that rise, each from its height `z_m` for its time.
#[derive(Clone, Copy)]
pub(crate) struct RisingLanes<const N: usize> {
    pub(crate) elements: [Element; N],
    pub(crate) z_m: [f64; N],
    pub(crate) dt_s: [f64; N],
}

impl<const N: usize> RisingLanes<N> {
    /// Lets them rise in the water that `at` tells at each height.
    pub(crate) fn rise(&mut self, path: InstructionSet, thread: &Thread, at: impl Fn(f64) -> Around) {
        path.run(
            #[inline(always)]
            || self.risen(thread, at),
        );
    }

    #[inline(always)]
    fn risen(&mut self, thread: &Thread, at: impl Fn(f64) -> Around) {
        let (mut e, mut z, dt_s) = (ElementLanes::gather(&self.elements), self.z_m, self.dt_s);
        let mut left_s = dt_s;
        while left_s.iter().any(|left| *left > 0.0) {
            let around = AmbientLanes::gather(&z, &at);
            let here = thread.rates(&e, &around);
            let longest_s = here.longest_s(&e, &around);
            let (mut step_s, mut half_s) = ([0.0; N], [0.0; N]);
            for l in 0..N {
                step_s[l] = longest_s[l].max(dt_s[l] / MOST_STEPS).min(left_s[l]);
                half_s[l] = 0.5 * step_s[l];
            }
            let mut middle_z = z;
            for l in 0..N {
                middle_z[l] = z[l] + half_s[l] * here.rise[l];
            }
            let middle = thread.rates(&e.on(&here, &half_s), &AmbientLanes::gather(&middle_z, &at));
            let next = e.on(&middle, &step_s);
            for l in 0..N {
                // One that has arrived stays as it is, whatever its rates.
                if left_s[l] > 0.0 {
                    e.shared[l] = next.shared[l];
                    e.own[l] = next.own[l];
                    e.momentum[l] = next.momentum[l];
                    e.passed[l] = next.passed[l];
                    z[l] += step_s[l] * middle.rise[l];
                    left_s[l] -= step_s[l];
                    // What is left of rounding is no step.
                    if left_s[l] < 1e-12 * dt_s[l] {
                        left_s[l] = 0.0;
                    }
                }
            }
        }
        (self.elements, self.z_m) = (e.apart(), z);
    }
}

impl<const N: usize> AmbientLanes<N> {
    #[inline(always)]
    fn gather(z: &[f64; N], at: impl Fn(f64) -> Around) -> Self {
        let mut new = Self { speed: [0.0; N], dissipation: [0.0; N], n2: [0.0; N], largest: [0.0; N] };
        for (l, z) in z.iter().enumerate() {
            let around = at(*z);
            new.speed[l] = around.speed_m_s;
            new.dissipation[l] = around.dissipation_m2_s3;
            new.n2[l] = around.n2_per_s2;
            new.largest[l] = around.largest_m;
        }
        new
    }
}

impl<const N: usize> ElementLanes<N> {
    #[inline(always)]
    fn gather(some: &[Element; N]) -> Self {
        Self {
            shared: some.map(|e| e.shared_m3),
            own: some.map(|e| e.own_m3),
            momentum: some.map(|e| e.momentum_m4_s),
            passed: some.map(|e| e.passed_m4_s2),
        }
    }

    #[inline(always)]
    fn apart(&self) -> [Element; N] {
        std::array::from_fn(|l| Element {
            shared_m3: self.shared[l],
            own_m3: self.own[l],
            momentum_m4_s: self.momentum[l],
            passed_m4_s2: self.passed[l],
        })
    }

    /// After times, s.
    #[inline(always)]
    fn on(&self, rates: &RateLanes<N>, dt_s: &[f64; N]) -> Self {
        let mut to = *self;
        for (l, dt_s) in dt_s.iter().enumerate() {
            to.shared[l] += dt_s * rates.shared[l];
            to.own[l] += dt_s * rates.own[l];
            to.momentum[l] += dt_s * rates.force[l];
            to.passed[l] += dt_s * rates.passed[l];
        }
        to
    }
}

impl Thread {
    #[inline(always)]
    fn rates<const N: usize>(&self, e: &ElementLanes<N>, around: &AmbientLanes<N>) -> RateLanes<N> {
        let mut new = RateLanes {
            rise: [0.0; N],
            shared: [0.0; N],
            own: [0.0; N],
            force: [0.0; N],
            passed: [0.0; N],
            radius: [0.0; N],
            growth: [0.0; N],
        };
        let [mut own_m_s, mut own_r, mut round, mut stirring, mut dilution] = [[0.0; N]; 5];
        for l in 0..N {
            let (u, w) = (around.speed[l], e.momentum[l] / e.shared[l]);
            let drawn = self.drawn_m_s(u, w);
            let length = drawn / self.rate_hz;
            let r = (e.shared[l] * self.rate_hz / (PI * drawn)).sqrt();
            own_r[l] = (e.own[l] * self.rate_hz / (PI * drawn)).sqrt();
            own_m_s[l] = (ALONG * w * w + ACROSS * u * w.abs()) / drawn;
            round[l] = TAU * length;
            stirring[l] = around.dissipation[l] * r.min(around.largest[l]);
            dilution[l] = e.shared[l] / self.volume_m3;
            (new.rise[l], new.radius[l]) = (w, r);
        }
        cube_roots(&mut stirring);
        // What is not vector code.
        for dilution in &mut dilution {
            *dilution = self.curve.at(*dilution);
        }
        for l in 0..N {
            let stirred_m_s = SHARED * stirring[l];
            new.shared[l] = round[l] * new.radius[l] * (own_m_s[l] + stirred_m_s);
            new.own[l] = round[l] * own_r[l] * own_m_s[l];
            new.force[l] = self.volume_m3 * dilution[l] + e.passed[l];
            new.passed[l] = -around.n2[l] * e.momentum[l];
            new.growth[l] = own_m_s[l] + stirred_m_s;
        }
        new
    }
}

impl<const N: usize> RateLanes<N> {
    /// Longest steps in which no scale of an element changes much, s.
    #[inline(always)]
    fn longest_s(&self, e: &ElementLanes<N>, around: &AmbientLanes<N>) -> [f64; N] {
        let mut longest_s = [0.0; N];
        for (l, longest_s) in longest_s.iter_mut().enumerate() {
            let lift = self.force[l].abs() / e.shared[l];
            *longest_s = PART
                * (self.radius[l] / self.growth[l])
                    .min((self.radius[l] / lift).sqrt())
                    .min(1.0 / around.n2[l].abs().sqrt());
        }
        longest_s
    }
}
