//! How small eddies carry filaments.
//!
//! *Source*: see `flow::eddies::small`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none of its own.

use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::Span;
use crate::filaments::store::eddy_coordinates::EddyCoordinates;
use crate::flow::eddies::{Life, Small, Weights};
use crate::simd::dispatch::InstructionSet;
#[cfg(target_arch = "x86_64")]
use crate::simd::f32x4::AvxPair;
use crate::simd::f32x4::{F32x4, Pair};
use nalgebra::Vector3;
use std::ops::Range;
use world::fields::Flow;

/// Carries filaments with the small eddies through a step, or from their release on, and the water at the source, which
/// is given in the world and from the datum.
pub(crate) fn carry(
    path: InstructionSet,
    small: &Small,
    flow: &dyn Flow,
    source: (Vector3<f64>, [f32; 3]),
    store: &mut Store,
    range: Range<usize>,
    span: Span,
) {
    let Some(mut labels) = store.labels.take() else {
        return;
    };
    path.run_known(
        #[inline(always)]
        |path| match path {
            // SAFETY: a pair that every machine of the target has.
            InstructionSet::Portable => unsafe { moved::<[F32x4; 2]>(&mut labels, small, store, range, span) },
            // SAFETY: the pair needs AVX, which is part of both versions.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 | InstructionSet::Avx512 => unsafe {
                moved::<AvxPair>(&mut labels, small, store, range, span);
            },
        },
    );
    labels.pass_source(small, flow, source, span.to_s);
    store.labels = Some(labels);
}

/// Moves filaments and their rows.
///
/// # Safety
/// The machine must have the instructions of `P`.
#[inline(always)]
unsafe fn moved<P: Pair>(
    labels: &mut EddyCoordinates,
    small: &Small,
    store: &mut Store,
    range: Range<usize>,
    span: Span,
) {
    let middle_s = 0.5 * (span.from_s + span.to_s);
    let lives = small.lives(middle_s);
    let middle = (middle_s, &*lives);
    if range.is_empty() {
        return;
    }
    let mut next = ready(labels, small, store, range.start, middle);
    for n in range.clone() {
        let weights = next;
        // What moves the next filament is on its way while one is moved.
        if n + 1 < range.end {
            next = ready(labels, small, store, n + 1, middle);
        }
        let dt = (span.to_s - store.born_s[n].max(span.from_s)) as f32;
        let place = [store.x[n], store.y[n], store.z[n]];
        let row = labels.present_row(n);
        // Half the step ahead first, so that an even cloud stays even to second order.
        // SAFETY: here and below, as the caller promises.
        let v = unsafe { small.velocity::<P>(&lives, place[2], &weights, row) };
        let half = v.map(|v| 0.5 * dt * v);
        let mut ahead = [[0.0; 3]; MOST];
        for (ahead, at) in ahead.iter_mut().zip(row.iter()) {
            *ahead = std::array::from_fn(|d| at[d] + half[d]);
        }
        let ahead = &ahead[..row.len()];
        // SAFETY: as above.
        let v = unsafe { small.velocity::<P>(&lives, place[2] + half[2], &weights, ahead) };
        let way = v.map(|v| dt * v);
        for at in row {
            for d in 0..3 {
                at[d] += way[d];
            }
        }
        store.x[n] += way[0];
        store.y[n] += way[1];
        store.z[n] += way[2];
    }
}

/// Works out what moves a filament at a time (s, and the patterns then), and asks the processor for it. Not a closure,
/// which would not be compiled for the caller's instructions.
#[inline(always)]
fn ready(
    labels: &mut EddyCoordinates,
    small: &Small,
    store: &Store,
    n: usize,
    (t_s, lives): (f64, &[Life]),
) -> Weights {
    let age_s = t_s - store.born_s[n];
    let weights = small.weights(store.horizontal(n, age_s), store.size.is_grown(age_s));
    let row = labels.row(n, [store.x[n], store.y[n], store.z[n]], lives);
    small.fetch_soon(lives, &weights, row);
    weights
}

/// Most patterns.
const MOST: usize = 2 * crate::flow::eddies::MOST_OCTAVES;
