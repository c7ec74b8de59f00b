//! Boxes side by side: which of them hold a point is seen in one pass of vector code.
//!
//! *Source*: trees with many boxes in a node, Dammertz, Hanika & Keller 2008, Comput. Graph. Forum 27, 1225.
//!
//! *Parameters*: 32 boxes, of which one word tells which hold a point.
//!
//! *Deviations*: none. A box that holds nothing has its sides the wrong way round, and no point is in it.

use crate::simd::movemask::{LaneMask, bits, mark};

/// Boxes side by side.
pub(crate) const BOXES: usize = 32;

/// Least and greatest coordinates along the axes east, north, up, m.
pub(crate) type Ends = [[f32; 2]; 3];

/// The ends of a box that holds nothing.
pub(crate) const EMPTY: Ends = [[f32::MAX, f32::MIN]; 3];

/// [`BOXES`] boxes.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct Boxes {
    lo: [[f32; BOXES]; 3],
    hi: [[f32; BOXES]; 3],
}

impl Boxes {
    /// The first of these, at most [`BOXES`].
    pub(crate) fn new(ends: impl Iterator<Item = Ends>) -> Self {
        let mut new = Self { lo: [[f32::MAX; BOXES]; 3], hi: [[f32::MIN; BOXES]; 3] };
        for (l, ends) in ends.enumerate().take(BOXES) {
            for (d, [lo, hi]) in ends.into_iter().enumerate() {
                (new.lo[d][l], new.hi[d][l]) = (lo, hi);
            }
        }
        new
    }

    /// Those that hold a point, a bit each; for vector code that calls it.
    #[inline(always)]
    pub(crate) fn held(&self, p: [f32; 3]) -> u32 {
        let mut marks: LaneMask = [0; BOXES];
        for (l, one) in marks.iter_mut().enumerate() {
            let along = |d: usize| (p[d] >= self.lo[d][l]) & (p[d] <= self.hi[d][l]);
            *one = mark(along(0) & along(1) & along(2));
        }
        bits(&marks)
    }
}

/// From the least to the greatest of both. What is no number does not count.
#[inline(always)]
pub(crate) fn wider([lo, hi]: [f32; 2], [low, high]: [f32; 2]) -> [f32; 2] {
    [if low < lo { low } else { lo }, if high > hi { high } else { hi }]
}

/// The places of the bits that are set, the least first.
pub(crate) fn set(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        place
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::dispatch::InstructionSet;

    #[test]
    fn boxes_that_hold_a_point_have_their_bits_set() {
        let mut r = world::seeds::Stream::new(4, "test", "boxes");
        let mut seen = 0;
        for n in 0..=BOXES {
            let ends: Vec<Ends> = (0..n)
                .map(|_| {
                    std::array::from_fn(|_| {
                        let (a, b) = (r.uniform() as f32, r.uniform() as f32);
                        [a.min(b), a.max(b)]
                    })
                })
                .collect();
            let boxes = Boxes::new(ends.iter().copied());
            for _ in 0..100 {
                let p: [f32; 3] = std::array::from_fn(|_| r.uniform() as f32);
                let inside = |e: &Ends| (0..3).all(|d| p[d] >= e[d][0] && p[d] <= e[d][1]);
                let want: Vec<usize> = (0..n).filter(|l| inside(&ends[*l])).collect();
                for path in InstructionSet::all() {
                    let hold = path.run(|| boxes.held(p));
                    assert_eq!(set(hold).collect::<Vec<_>>(), want, "{path:?}");
                }
                seen += want.len();
            }
        }
        assert!(seen > 50, "{seen}");
    }
}
