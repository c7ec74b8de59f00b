//! Elements that rise side by side: their rates of change, and the integration.
//!
//! *Source*: see `element`; the midpoint rule.
//!
//! *Parameters*: [`PART`], [`MOST_STEPS`] of the integration.
//!
//! *Deviations*: none. The arithmetic is written once, for any number of elements, without fused multiply-add, and
//! compiled for each version of `path`. An element takes the same steps, to the same bits, beside any others.

use super::cube_root::cube_roots;
use super::element::{
    ACROSS, ALONG, Around, DIFFUSIVITY_M2_S, Element, JET, LAMINAR, REACH, SHARED, STRAIN, Thread, VISCOSITY_M2_S,
};
use crate::release::Curve;
use crate::simd::dispatch::InstructionSet;
use std::f64::consts::PI;
use world::math;

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

/// Some elements: each number of an [`Element`] side by side.
#[derive(Clone, Copy)]
struct ElementLanes<const N: usize> {
    shared: [f64; N],
    core: [f64; N],
    own: [f64; N],
    momentum: [f64; N],
    passed: [f64; N],
    thinned: [f64; N],
    mixed: [f64; N],
}

/// Rates of change of some elements.
struct RateLanes<const N: usize> {
    /// Speeds at which they rise.
    rise: [f64; N],
    of: ElementLanes<N>,
    /// The fastest rates at which any number of an element changes by itself, 1/s.
    fastest: [f64; N],
    /// Accelerations over the radii, 1/s².
    lift: [f64; N],
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
            let longest_s = here.longest_s(&around);
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
                    e.replace(l, &next);
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
            core: some.map(|e| e.core_m3),
            own: some.map(|e| e.own_m3),
            momentum: some.map(|e| e.momentum_m4_s),
            passed: some.map(|e| e.passed_m4_s2),
            thinned: some.map(|e| e.thinned),
            mixed: some.map(|e| e.mixed),
        }
    }

    #[inline(always)]
    fn apart(&self) -> [Element; N] {
        std::array::from_fn(|l| Element {
            shared_m3: self.shared[l],
            core_m3: self.core[l],
            own_m3: self.own[l],
            momentum_m4_s: self.momentum[l],
            passed_m4_s2: self.passed[l],
            thinned: self.thinned[l],
            mixed: self.mixed[l],
        })
    }

    /// Takes one over from others, within its bounds: momentum is in no less than the core, and a sheet remains one.
    #[inline(always)]
    fn replace(&mut self, l: usize, other: &Self) {
        self.core[l] = other.core[l];
        self.shared[l] = other.shared[l].max(other.core[l]);
        self.own[l] = other.own[l];
        self.momentum[l] = other.momentum[l];
        self.passed[l] = other.passed[l];
        self.thinned[l] = other.thinned[l].max(1e-12);
        self.mixed[l] = other.mixed[l].min(Curve::MIXED);
    }

    /// After times, s.
    #[inline(always)]
    fn on(&self, rates: &RateLanes<N>, dt_s: &[f64; N]) -> Self {
        let mut to = *self;
        for (l, dt_s) in dt_s.iter().enumerate() {
            to.shared[l] += dt_s * rates.of.shared[l];
            to.core[l] += dt_s * rates.of.core[l];
            to.own[l] += dt_s * rates.of.own[l];
            to.momentum[l] += dt_s * rates.of.momentum[l];
            to.passed[l] += dt_s * rates.of.passed[l];
            to.thinned[l] += dt_s * rates.of.thinned[l];
            to.mixed[l] += dt_s * rates.of.mixed[l];
        }
        to.with_bounds()
    }

    #[inline(always)]
    fn with_bounds(self) -> Self {
        let mut to = self;
        for l in 0..N {
            to.replace(l, &self);
        }
        to
    }
}

impl Thread {
    #[inline(always)]
    fn rates<const N: usize>(&self, e: &ElementLanes<N>, around: &AmbientLanes<N>) -> RateLanes<N> {
        let [mut ahead, mut drawn, mut rise, mut turbulent, mut lift] = [[0.0; N]; 5];
        let [mut radius, mut core_radius, mut own_radius, mut through] = [[0.0; N]; 4];
        let [mut stirring, mut core_stirring, mut reach] = [[0.0; N]; 3];
        for l in 0..N {
            reach[l] = e.shared[l] / e.core[l];
            lift[l] = e.mixed[l];
        }
        // What is not vector code.
        for l in 0..N {
            reach[l] = 1.0 + REACH * math::ln(reach[l]);
            lift[l] = self.curve.at(lift[l]);
        }
        for l in 0..N {
            let w = e.momentum[l] / e.shared[l];
            (ahead[l], drawn[l]) = self.ahead_and_drawn_m_s(e.shared[l], around.speed[l], w);
            let disc = self.rate_hz / (PI * drawn[l]);
            radius[l] = (e.core[l] * reach[l] * disc).sqrt();
            core_radius[l] = (e.core[l] * disc).sqrt();
            own_radius[l] = (e.own[l] * disc).sqrt();
            through[l] = (ahead[l] * ahead[l] + w * w).sqrt();
            turbulent[l] = (through[l] * core_radius[l] / (LAMINAR * VISCOSITY_M2_S) - 1.0).clamp(0.0, 1.0);
            stirring[l] = around.dissipation[l] * radius[l].min(around.largest[l]);
            core_stirring[l] = around.dissipation[l] * core_radius[l].min(around.largest[l]);
            rise[l] = w;
        }
        cube_roots(&mut stirring);
        cube_roots(&mut core_stirring);
        let sheet_m2 = self.sheet_m2();
        let mut new = RateLanes { rise, of: *e, fastest: [0.0; N], lift: [0.0; N] };
        for l in 0..N {
            let (u, w) = (around.speed[l], rise[l]);
            let by_itself = JET * ahead[l] * (u + ahead[l]) + ALONG * w * w + ACROSS * u * w.abs();
            let own_m_s = turbulent[l] * by_itself / drawn[l];
            // Within the finest eddies the water is only strained.
            let strained = (around.dissipation[l] / (15.0 * VISCOSITY_M2_S)).sqrt();
            let stirred = |rooted: f64, r: f64| SHARED * rooted.min(r * strained);
            let growth = own_m_s + stirred(stirring[l], radius[l]) + 4.0 * VISCOSITY_M2_S / radius[l];
            let core_growth = own_m_s + stirred(core_stirring[l], core_radius[l]);
            let spreading = 2.0 * growth / radius[l];
            let core_spreading = 2.0 * core_growth / core_radius[l];
            let force = self.volume_m3 * lift[l] + e.passed[l];
            let still = e.momentum[l] == 0.0;
            let fresh = if still { 0.0 } else { (force / e.momentum[l]).max(0.0) };
            let gathering = if still {
                0.5 * (spreading - core_spreading).max(0.0)
            } else {
                fresh * (e.shared[l] / e.core[l] - 1.0)
            };
            let own_dissipation = turbulent[l] * through[l] * through[l] * through[l] / core_radius[l];
            let strain = STRAIN * ((around.dissipation[l] + own_dissipation) / VISCOSITY_M2_S).sqrt();
            let thinning = if self.mixes && e.mixed[l] < Curve::MIXED { strain } else { 0.0 };
            new.of.shared[l] = e.shared[l] * (spreading - gathering);
            new.of.core[l] = e.core[l] * core_spreading;
            new.of.own[l] = e.own[l] * 2.0 * own_m_s / own_radius[l];
            new.of.momentum[l] = force;
            new.of.passed[l] = -around.n2[l] * e.momentum[l];
            new.of.thinned[l] = -2.0 * thinning * e.thinned[l];
            new.of.mixed[l] = if self.mixes { DIFFUSIVITY_M2_S / (sheet_m2 * e.thinned[l]) } else { 0.0 };
            new.lift[l] = force.abs() / (e.shared[l] * radius[l]);
            new.fastest[l] = (0.5 * spreading).max(gathering).max(fresh).max(0.5 * core_spreading).max(2.0 * thinning);
        }
        new
    }
}

impl<const N: usize> RateLanes<N> {
    /// Longest steps in which no scale of an element changes much, s.
    #[inline(always)]
    fn longest_s(&self, around: &AmbientLanes<N>) -> [f64; N] {
        let mut longest_s = [0.0; N];
        for (l, longest_s) in longest_s.iter_mut().enumerate() {
            *longest_s =
                PART * (1.0 / self.fastest[l]).min(1.0 / self.lift[l].sqrt()).min(1.0 / around.n2[l].abs().sqrt());
        }
        longest_s
    }
}
