//! Distance from the centre of every cell to the nearest solid cell, exact, in time linear in the number of cells.
//!
//! *Source*: Felzenszwalb and Huttenlocher 2012, Theory of Computing 8, 415 (axis by axis, lower envelope of
//! translates); Meijster, Roerdink and Hesselink 2000 (shapes other than the parabola, crossings found between
//! integers).
//!
//! *Parameters*: cells along each axis and their sizes (m).
//!
//! *Deviations*: the distance is to the surface of the solid cell, not to its centre. Along an axis of cells of size h
//! it is (|Δ| − ½)h, and 0 for Δ = 0. The translates are then no parabolas, but they are convex, so two of them cross
//! at most once. The crossing is found by bisection among the integers.

/// Squared distance from the centre of a cell to a cell `d` cells away, along one axis.
fn reach2(d: usize, h: f64) -> f64 {
    let far = (d as f64 - 0.5).max(0.0) * h;
    far * far
}

/// One line: `out[x] = min over i of f[i] + reach2(|x − i|)`.
fn line(f: &[f64], h: f64, hull: &mut Vec<(usize, usize)>, out: &mut [f64]) {
    let n = f.len();
    let at = |i: usize, x: usize| f[i] + reach2(x.abs_diff(i), h);
    // (translate, first x at which it is the lowest).
    hull.clear();
    for u in (0..n).filter(|u| f[*u].is_finite()) {
        let mut from = 0;
        while let Some(&(i, since)) = hull.last() {
            if at(u, since) < at(i, since) {
                hull.pop();
                continue;
            }
            // The first x beyond `since` at which the newer one is lower.
            let (mut low, mut high) = (since, n);
            while high - low > 1 {
                let middle = usize::midpoint(low, high);
                if at(u, middle) < at(i, middle) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            from = high;
            break;
        }
        if from < n {
            hull.push((u, from));
        }
    }
    let mut k = 0;
    for (x, o) in out.iter_mut().enumerate() {
        while k + 1 < hull.len() && hull[k + 1].1 <= x {
            k += 1;
        }
        *o = hull.get(k).map_or(f64::INFINITY, |(i, _)| at(*i, x));
    }
}

/// Distances, m, for cells numbered (i·n[1] + j)·n[2] + k: 0 in solid cells, infinite if none is solid.
pub(super) fn distances(solid: &[bool], n: [usize; 3], h: [f64; 3]) -> Vec<f32> {
    let mut square: Vec<f64> = solid.iter().map(|s| if *s { 0.0 } else { f64::INFINITY }).collect();
    let strides = [n[1] * n[2], n[2], 1];
    let mut hull = Vec::new();
    for axis in [2, 1, 0] {
        let (length, stride) = (n[axis], strides[axis]);
        let (mut f, mut out) = (vec![0.0; length], vec![0.0; length]);
        for first in (0..square.len()).filter(|c| c / stride % length == 0) {
            for (x, v) in f.iter_mut().enumerate() {
                *v = square[first + x * stride];
            }
            line(&f, h[axis], &mut hull, &mut out);
            for (x, v) in out.iter().enumerate() {
                square[first + x * stride] = *v;
            }
        }
    }
    square.iter().map(|d| d.sqrt() as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeds::Stream;

    /// Compared with all pairs, in boxes of several shapes and fillings.
    #[test]
    fn same_as_all_pairs() {
        let mut rng = Stream::new(5, "test", "cells");
        for (n, part) in [([7, 9, 5], 0.02), ([1, 30, 4], 0.1), ([6, 6, 6], 0.5), ([40, 1, 1], 0.1)] {
            let h = [2.5, 4.0, 0.5];
            let count = n[0] * n[1] * n[2];
            let solid: Vec<bool> = (0..count).map(|_| rng.uniform() < part).collect();
            let place = |c: usize| [c / (n[1] * n[2]), c / n[2] % n[1], c % n[2]];
            let got = distances(&solid, n, h);
            for c in 0..count {
                let p = place(c);
                let want = (0..count)
                    .filter(|s| solid[*s])
                    .map(|s| {
                        let q = place(s);
                        (0..3).map(|d| reach2(p[d].abs_diff(q[d]), h[d])).sum::<f64>()
                    })
                    .fold(f64::INFINITY, f64::min)
                    .sqrt();
                let got = f64::from(got[c]);
                assert!(got == want || (got - want).abs() < 1e-6 * want, "{n:?} {p:?}: {got} for {want}");
            }
        }
    }

    #[test]
    fn nothing_solid_is_infinitely_far() {
        assert!(distances(&[false; 8], [2, 2, 2], [1.0; 3]).iter().all(|d| d.is_infinite()));
    }
}
