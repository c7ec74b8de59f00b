//! The rise of a buoyant release: each filament is an element of a thread, with buoyancy, vertical momentum and the
//! volume that shares it.
//!
//! *Source*: see `element`.
//!
//! *Parameters*: those of the release.
//!
//! *Deviations*: within a step the rise comes after mean flow and kicks (splitting, Strang 1968, SIAM J. Numer. Anal.
//! 5, 506; first order in the step).

mod cube_root;
mod element;
mod profile;
mod simd;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_plume;

use super::arrays::Store;
use super::bands::Span;
use super::folded::folded;
use super::rows::Rows;
use super::size::Size;
use super::structure::Sheet;
use crate::error::PlumeError;
use crate::release::{Source, ThreadStart};
use crate::simd::dispatch::InstructionSet;
pub(crate) use element::{Element, Thread};
use nalgebra::Vector3;
pub(crate) use profile::Profile;
use simd::{ABREAST, RisingLanes};
use std::ops::Range;
use world::fields::Flow;

/// The elements of a store, parallel to its filaments.
#[derive(Clone, Debug)]
pub(crate) struct Rise {
    thread: Thread,
    profile: Profile,
    pub(crate) elements: Rows<Element>,
    /// Variance by which each filament is wider for its own entrainment, m².
    pub(crate) grown_m2: Rows<f32>,
}

impl Rise {
    /// Of the n-th source over a bed (m, negative), in this water; `None` if its release is neutral and has no structure.
    pub(crate) fn new(flow: &dyn Flow, n: usize, source: &Source, bed_m: f64) -> Result<Option<Self>, PlumeError> {
        let release = &source.release;
        let Some(ThreadStart { curve, volume_m3_s, radius_m }) = release.thread(n, flow, &source.p_W)? else {
            return Ok(None);
        };
        let rate_hz = release.rate_hz.get();
        Ok(Some(Self {
            thread: Thread {
                volume_m3: volume_m3_s / rate_hz,
                rate_hz,
                outflow_m_s: volume_m3_s / (std::f64::consts::PI * radius_m * radius_m),
                mixes: release.structure.get() > 0.0 || curve.changes(),
                curve,
            },
            profile: Profile::still(bed_m),
            elements: Rows::default(),
            grown_m2: Rows::default(),
        }))
    }

    /// Volume of an element at its release, m³.
    pub(crate) fn volume_m3(&self) -> f64 {
        self.thread.volume_m3
    }

    /// The dye of an element.
    pub(crate) fn sheet(&self, n: usize) -> Sheet {
        let Element { thinned, mixed, .. } = self.elements[n];
        Sheet { thickness_m: (self.thread.sheet_m2() * thinned).sqrt(), mixed }
    }

    /// Takes the water over the source at a time.
    pub(crate) fn renew(&mut self, flow: &dyn Flow, p_W: Vector3<f64>, bed_m: f64, t_s: f64) {
        self.profile = Profile::over(flow, p_W, bed_m, t_s);
    }

    /// Adds the element of the newest filament.
    pub(crate) fn push(&mut self) {
        self.elements.extend([self.thread.released()]);
        self.grown_m2.extend([0.0]);
    }

    /// Removes elements by their sorted places.
    pub(crate) fn remove(&mut self, gone: &[usize]) {
        self.elements.remove(gone, 1);
        self.grown_m2.remove(gone, 1);
    }

    /// Works out the sizes of filaments anew from their elements and heights.
    pub(crate) fn size(&mut self, range: Range<usize>, z: &[f32]) {
        for n in range {
            let around = self.profile.at(f64::from(z[n]));
            self.grown_m2[n] = self.thread.grown_m2(&self.elements[n], &around) as f32;
        }
    }
}

/// Size of a filament that its own entrainment has widened, m.
#[inline(always)]
pub(crate) fn widened(horizontal: f32, grown_m2: f32) -> f32 {
    (horizontal * horizontal + grown_m2).sqrt()
}

/// The greatest of some numbers, or zero. Sixteen side by side, because each comparison waits for the one before.
fn greatest(all: &[f32]) -> f32 {
    let (some, rest) = all.as_chunks::<16>();
    let greater = |a: f32, b: f32| if b > a { b } else { a };
    let mut most = [0.0; 16];
    for some in some {
        for (most, v) in most.iter_mut().zip(some) {
            *most = greater(*most, *v);
        }
    }
    (most.iter().chain(rest)).fold(0.0, |most, v| greater(most, *v))
}

impl Store {
    /// Size of a filament at an age, s, with what its own entrainment adds, m.
    pub(crate) fn horizontal(&self, n: usize, age_s: f64) -> f32 {
        let size = self.size.horizontal(age_s);
        match &self.rise {
            Some(rise) => widened(size, rise.grown_m2[n]),
            None => size,
        }
    }

    /// The largest size in a range whose oldest filament has this age, s; m.
    pub(crate) fn largest(&self, range: Range<usize>, oldest_s: f64) -> f32 {
        let size: f32 = Size::horizontal(&self.size, oldest_s);
        match &self.rise {
            Some(rise) => widened(size, greatest(&rise.grown_m2[range])),
            None => size,
        }
    }

    /// Lets the filaments of a band rise through a step, or from their release on.
    pub(crate) fn rise(&mut self, path: InstructionSet, range: Range<usize>, span: Span) {
        for from in range.clone().step_by(ABREAST) {
            // The last few one by one.
            if from + ABREAST <= range.end {
                self.rise_abreast::<ABREAST>(path, from, span);
            } else {
                (from..range.end).for_each(|n| self.rise_abreast::<1>(path, n, span));
            }
        }
        if let Some(rise) = &mut self.rise {
            rise.size(range, &self.z);
        }
    }

    /// The same for some filaments from a place on.
    fn rise_abreast<const N: usize>(&mut self, path: InstructionSet, from: usize, span: Span) {
        let Some(Rise { thread, profile, elements, .. }) = &mut self.rise else {
            return;
        };
        let Some(some) = elements[from..].first_chunk_mut() else {
            return;
        };
        let mut rising = RisingLanes::<N> {
            elements: *some,
            z_m: std::array::from_fn(|l| f64::from(self.z[from + l])),
            dt_s: std::array::from_fn(|l| span.to_s - self.born_s[from + l].max(span.from_s)),
        };
        rising.rise(path, thread, |z| profile.at(z));
        *some = rising.elements;
        for (l, (element, to)) in some.iter_mut().zip(rising.z_m).enumerate() {
            let n = from + l;
            let (z, bed) = (self.z[n], self.bed[n]);
            let inside = to.clamp(f64::from(bed), 0.0);
            if inside != to {
                // The boundary takes up the momentum.
                element.momentum_m4_s = 0.0;
            }
            self.z[n] = folded(inside as f32, bed, -1.0 / bed);
            if let Some(labels) = &mut self.labels {
                labels.lift(n, self.z[n] - z);
            }
        }
    }
}
