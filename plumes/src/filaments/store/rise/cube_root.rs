//! Cube roots side by side, to the same bits as [`world::math::cbrt`], which rounds correctly.
//!
//! *Source*: Halley's iteration; exact products of halves (Dekker 1971, Numer. Math. 18, 224); the test whether a result
//! is certain to be rounded correctly (Ziv 1991, ACM Trans. Math. Softw. 17, 410).
//!
//! *Parameters*: [`UNSURE`], how near to the middle between two numbers a root is worked out the other way.
//!
//! *Deviations*: none. Two iterations bring a root to within a few units of its last place, and its cube, with twice
//! the places of a number, gives the rest to a part in 10¹⁵ of it.

use world::math;

/// Units in the last place of a root: of numbers from 1 to 2.
const UNIT: f64 = f64::EPSILON;
/// In units; the rest of a root is known much better.
const UNSURE: f64 = 1e-9;
/// The cube root from 1 to 2 as a polynomial, within 1e-4.
const START: [f64; 4] = [0.553_838, 0.584_949, -0.161_475, 0.022_771];
/// Cube roots of 1, 2 and 4.
const ROOTS: [f64; 3] = [1.0, 1.259_921_049_894_873_2, 1.587_401_051_968_199_4];

/// Replaces numbers by their cube roots.
#[inline(always)]
pub(crate) fn cube_roots<const N: usize>(all: &mut [f64; N]) {
    let (mut roots, mut unsure) = ([0.0; N], [0.0; N]);
    for l in 0..N {
        let (root, doubt) = root(all[l]);
        (roots[l], unsure[l]) = (root, doubt);
    }
    for l in 0..N {
        // Also what is not a positive normal number.
        let normal = all[l] >= f64::MIN_POSITIVE && all[l] < f64::INFINITY;
        all[l] = if normal && unsure[l] > UNSURE { roots[l] } else { math::cbrt(all[l]) };
    }
}

/// The root of a positive normal number, and how far it is from being rounded otherwise, in units of its last place.
#[inline(always)]
fn root(x: f64) -> (f64, f64) {
    let bits = x.to_bits();
    let exponent = (bits >> 52) as u32 & 0x7ff;
    // Exponents from 1 on; 1023 is 3 times 341.
    let third = (exponent * 21_846) >> 16;
    let rest = exponent - 3 * third;
    let from_1_to_2 = f64::from_bits(bits & (u64::MAX >> 12) | 1023 << 52);
    let (root, scale) = match rest {
        0 => (ROOTS[0], 1.0),
        1 => (ROOTS[1], 2.0),
        _ => (ROOTS[2], 4.0),
    };
    // From 1 to 8.
    let m = from_1_to_2 * scale;
    let [a, b, c, d] = START;
    let mut y = (a + from_1_to_2 * (b + from_1_to_2 * (c + from_1_to_2 * d))) * root;
    for _ in 0..2 {
        let cube = y * y * y;
        y *= (cube + 2.0 * m) / (2.0 * cube + m);
    }
    let (square, square_rest) = product(y, y);
    let (cube, cube_rest) = product(square, y);
    let left = (m - cube) - (cube_rest + square_rest * y);
    let more = left / (3.0 * square);
    let rounded = y + more;
    let lost = more - (rounded - y);
    let doubt = (lost.abs() / UNIT - 0.5).abs();
    let power = f64::from_bits(u64::from(third + 1023 - 341) << 52);
    (rounded * power, doubt)
}

/// A product and what its rounding has cut off, to about 105 bits.
#[inline(always)]
fn product(a: f64, b: f64) -> (f64, f64) {
    let halves = |v: f64| {
        let high = f64::from_bits(v.to_bits() & (u64::MAX << 27));
        (high, v - high)
    };
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    let whole = a * b;
    // In this order, in which all sums but the last are exact.
    let rest = (((ah * bh - whole) + ah * bl) + al * bh) + al * bl;
    (whole, rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::seeds::Stream;

    #[test]
    fn roots_are_those_of_the_library_to_the_bit() {
        let mut r = Stream::new(7, "test", "cube roots");
        let mut short = 0;
        for n in 0..250_000 {
            let mut all: [f64; 4] = std::array::from_fn(|_| {
                let size = 600.0 * r.uniform() - 300.0;
                let x = (1.0 + r.uniform()) * math::powf(10.0, size);
                if n % 2 == 0 { x } else { 1e-8 * r.uniform() }
            });
            short += all.iter().filter(|x| root(**x).1 > UNSURE).count();
            let want = all.map(math::cbrt);
            cube_roots(&mut all);
            assert_eq!(all.map(f64::to_bits), want.map(f64::to_bits));
        }
        assert!(short > 999_990, "{short} of a million the short way");
    }

    #[test]
    fn cubes_and_what_is_no_normal_number_too() {
        let some = [0.0, -0.0, 1.0, 8.0, 27.0, 1e-320, -3.0, f64::INFINITY, f64::NAN];
        let cubes = (1..2000).map(|n| f64::from(n).powi(3));
        for x in some.into_iter().chain(cubes).chain([f64::MIN_POSITIVE, f64::MAX]) {
            let mut all = [x];
            cube_roots(&mut all);
            assert_eq!(all[0].to_bits(), math::cbrt(x).to_bits(), "{x}");
        }
    }
}
