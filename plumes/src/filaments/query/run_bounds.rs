//! Between which coordinates the members of a group move along one axis during their step, run by run.
//!
//! *Source*: none.
//!
//! *Parameters*: 32 neighbours in a run.
//!
//! *Deviations*: none. Of a thousand neighbours, ten are near a point in the plume. Runs rule out most of the others.

use crate::simd::dispatch::InstructionSet;
use crate::simd::movemask::{LaneMask, bits, mark};

/// Most filaments in a group.
pub(crate) const GROUP: usize = 1024;

/// Neighbours in a run.
pub(crate) const RUN: usize = 32;

/// Runs in a group: one bit each.
pub(crate) const RUNS: usize = GROUP / RUN;

/// Coordinates along an axis at the start and at the end of a step.
type Ways<'a> = [&'a [f32]; 2];

/// Least and greatest coordinate of each run. What is no number does not count.
#[derive(Clone, Debug)]
pub(crate) struct RunBounds {
    lo: [f32; RUNS],
    hi: [f32; RUNS],
    /// Of all of them.
    all: [f32; 2],
}

impl RunBounds {
    pub(crate) fn new(path: InstructionSet, ways: Ways) -> Self {
        path.run(
            #[inline(always)]
            || side(ways),
        )
    }

    /// Whether a coordinate is within `reach` of any of them.
    pub(crate) fn near(&self, p: f32, reach: f32) -> bool {
        let [lo, hi] = self.all;
        p >= lo - reach && p <= hi + reach
    }

    /// The runs that are within reach along three axes, a bit each.
    pub(crate) fn runs(path: InstructionSet, sides: [&Self; 3], p: [f32; 3], reach: [f32; 3]) -> u32 {
        path.run(
            #[inline(always)]
            || runs(sides, p, reach),
        )
    }
}

#[inline(always)]
fn side([start, end]: Ways) -> RunBounds {
    const LANES: usize = 8;
    let mut side = RunBounds { lo: [f32::MAX; RUNS], hi: [f32::MIN; RUNS], all: [f32::MAX, f32::MIN] };
    for (run, (start, end)) in start.chunks(RUN).zip(end.chunks(RUN)).enumerate() {
        let (mut lo, mut hi) = ([f32::MAX; LANES], [f32::MIN; LANES]);
        let mut last = [f32::NAN; RUN];
        for way in [start, end] {
            let way = <&[f32; RUN]>::try_from(way).unwrap_or_else(|_| {
                last[..way.len()].copy_from_slice(way);
                &last
            });
            for some in way.as_chunks::<LANES>().0 {
                for l in 0..LANES {
                    lo[l] = if some[l] < lo[l] { some[l] } else { lo[l] };
                    hi[l] = if some[l] > hi[l] { some[l] } else { hi[l] };
                }
            }
        }
        side.lo[run] = lo.into_iter().fold(f32::MAX, least);
        side.hi[run] = hi.into_iter().fold(f32::MIN, most);
    }
    let (lo, hi) = (side.lo.into_iter(), side.hi.into_iter());
    side.all = [lo.fold(f32::MAX, least), hi.fold(f32::MIN, most)];
    side
}

#[inline(always)]
fn least(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

#[inline(always)]
fn most(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

#[inline(always)]
fn runs(sides: [&RunBounds; 3], p: [f32; 3], reach: [f32; 3]) -> u32 {
    let mut near: LaneMask = [0; RUNS];
    for (run, near) in near.iter_mut().enumerate() {
        let along = |d: usize| {
            let RunBounds { lo, hi, .. } = sides[d];
            (p[d] >= lo[run] - reach[d]) & (p[d] <= hi[run] + reach[d])
        };
        *near = mark(along(0) & along(1) & along(2));
    }
    bits(&near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_those_with_a_member_within_reach() {
        let mut rng = world::seeds::Stream::new(3, "test", "sides");
        for n in [1, 31, 32, 33, 500, GROUP] {
            let mut way = || -> Vec<f32> {
                let on = |k: usize| 0.1 * k as f32 + rng.normal() as f32;
                (0..n).map(on).collect()
            };
            let ways: [[Vec<f32>; 2]; 3] = std::array::from_fn(|_| [way(), way()]);
            let between = |d: usize, range: std::ops::Range<usize>, p: f32, reach: f32| {
                let all = || ways[d].iter().flat_map(|way| &way[range.clone()]).copied();
                let (lo, hi) = (all().fold(f32::MAX, f32::min), all().fold(f32::MIN, f32::max));
                p >= lo - reach && p <= hi + reach
            };
            let reach = [0.7, 0.3, 1.2];
            for path in InstructionSet::all() {
                let sides = [0, 1, 2].map(|d| RunBounds::new(path, ways[d].each_ref().map(|w| &w[..])));
                for k in -5..120 {
                    let p = [0.11, 0.1, 0.09].map(|per| per * k as f32 * 8.0);
                    let got = RunBounds::runs(path, sides.each_ref(), p, reach);
                    for from in (0..GROUP).step_by(RUN) {
                        let range = from.min(n)..(from + RUN).min(n);
                        let want = (0..3).all(|d| between(d, range.clone(), p[d], reach[d]));
                        assert_eq!(got >> (from / RUN) & 1 == 1, want, "{path:?} {n} {k} {from}");
                    }
                    for d in 0..3 {
                        assert_eq!(sides[d].near(p[d], reach[d]), between(d, 0..n, p[d], reach[d]));
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_no_number_does_not_count() {
        let mut way = vec![f32::NAN; 40];
        way[3] = 2.0;
        way[35] = -1.0;
        for path in InstructionSet::all() {
            let side = RunBounds::new(path, [&way, &way]);
            assert_eq!((side.lo[0], side.hi[0], side.lo[1]), (2.0, 2.0, -1.0));
            assert_eq!(side.all, [-1.0, 2.0]);
        }
    }
}
