//! The length of the way between two cells of a free grid, in which a cell has 8 neighbours in the plane and 26 in
//! space.
//!
//! *Source*: the octile distance; its form for cells of any shape is ours.
//!
//! *Parameters*: length of a move by the set of axes that it changes.
//!
//! *Deviations*: none. The way takes the longest diagonal as often as it helps, then the next one, then straight
//! moves. None is cheaper: the length of a move is a submodular function of the axes that it changes, so that this
//! chain of diagonals attains the minimum.

/// Axes that are changed least and most by what of d0 < d1, d0 < d2 and d1 < d2 is true, as bits; two of the eight
/// cannot be.
const ORDER: [(usize, usize); 8] = [(2, 0), (2, 1), (2, 0), (0, 1), (1, 0), (0, 2), (1, 2), (0, 2)];

/// Lengths of moves.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Octile {
    lengths: [f64; 8],
}

impl Octile {
    /// For moves whose straight ones have the lengths `side`.
    pub(super) fn new(side: [f64; 3]) -> Self {
        let mut lengths = [0.0; 8];
        for (set, length) in lengths.iter_mut().enumerate() {
            let squares = (0..3).map(|a| if set >> a & 1 == 1 { side[a] * side[a] } else { 0.0 });
            *length = squares.sum::<f64>().sqrt();
        }
        Self { lengths }
    }

    /// Length of a move that changes the axes of `set`, given as bits.
    pub(super) fn length(&self, set: usize) -> f64 {
        self.lengths[set]
    }

    /// Length of the way between two cells, rounded down.
    #[inline]
    pub(super) fn between(&self, a: [usize; 3], b: [usize; 3]) -> u32 {
        let d = [0, 1, 2].map(|axis| a[axis].abs_diff(b[axis]) as u32);
        let (lo, hi) = (d[0].min(d[1]).min(d[2]), d[0].max(d[1]).max(d[2]));
        let middle = d[0] + d[1] + d[2] - lo - hi;
        let less = usize::from(d[0] < d[1]) | usize::from(d[0] < d[2]) << 1 | usize::from(d[1] < d[2]) << 2;
        let (least, most) = ORDER[less];
        let sum = f64::from(lo) * self.lengths[7]
            + f64::from(middle - lo) * self.lengths[7 ^ (1 << least)]
            + f64::from(hi - middle) * self.lengths[1 << most];
        sum as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// One move after the other.
    fn by_moves(octile: &Octile, mut d: [usize; 3]) -> f64 {
        let mut sum = 0.0;
        while d != [0; 3] {
            let set = (0..3).filter(|a| d[*a] > 0).map(|a| 1 << a).sum::<usize>();
            sum += octile.length(set);
            d = d.map(|v| v.saturating_sub(1));
        }
        sum
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn is_the_sum_of_the_moves(
            side in proptest::array::uniform3(1.0..2000.0),
            a in proptest::array::uniform3(0_usize..40), b in proptest::array::uniform3(0_usize..40),
        ) {
            let octile = Octile::new(side);
            let d = [0, 1, 2].map(|k| a[k].abs_diff(b[k]));
            let sum = by_moves(&octile, d);
            let got = f64::from(octile.between(a, b));
            prop_assert!(got <= sum * (1.0 + 1e-12) && got > sum * (1.0 - 1e-12) - 1.0, "{got} {sum}");
        }
    }
}
