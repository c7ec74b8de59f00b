//! A periodic box of isotropic turbulence with wave lengths of one octave: velocity and vector potential on a grid.
//!
//! *Source*: kinematic simulation (Kraichnan 1970, Phys. Fluids 13, 22; Fung, Hunt, Malik & Perkins 1992, J. Fluid
//! Mech. 236, 281): random Fourier modes with E(k) ∝ k^(−5/3).
//!
//! *Parameters*: [`NODES`] a side; wave numbers from [`LONGEST`] to twice as many waves in a side.
//!
//! *Deviations*: the same box serves every octave, each at its own size: the inertial range is similar to itself.
//! Between nodes both fields are trilinear; the shortest wave has 6.4 nodes.

use super::super::fourier::{Four, Fourier};
use crate::simd::f32x4::{F32x4, Pair, fetch_soon};
use std::f64::consts::TAU;
use std::sync::OnceLock;
use world::math;
use world::seeds::Stream;

/// Nodes along a side; a power of two.
const NODES: usize = 64;
/// Nodes in all.
pub(super) const COUNT: usize = NODES * NODES * NODES;
/// Number of the longest waves in a side.
pub(super) const LONGEST: f64 = 5.0;

/// Velocity (root of the mean square of each component: 1) and its vector potential, for a side of length 1.
#[derive(Debug)]
pub(super) struct Table {
    nodes: Vec<Node>,
}

/// Velocity and potential at a node, which lie in one line of the processor's cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Node([[f32; 4]; 2]);

/// The box of this process, drawn when it is first asked for.
#[inline]
pub(super) fn table() -> &'static Table {
    static DRAWN: OnceLock<Table> = OnceLock::new();
    DRAWN.get_or_init(Table::new)
}

impl Table {
    fn new() -> Self {
        // Components of the velocity, and of the potential.
        let [mut velocity, mut potential] = [(); 2].map(|()| vec![Four::default(); COUNT]);
        let mut rng = Stream::new(0, "eddies", "octave");
        let reach = 2 * LONGEST as i64;
        let wrapped = |m: i64| m.rem_euclid(NODES as i64) as usize;
        for mx in 0..reach {
            for my in -reach..=reach {
                for mz in -reach..=reach {
                    // One of each pair of opposite waves.
                    if mx == 0 && (my < 0 || (my == 0 && mz <= 0)) {
                        continue;
                    }
                    let m2 = (mx * mx + my * my + mz * mz) as f64;
                    if !(LONGEST * LONGEST..4.0 * LONGEST * LONGEST).contains(&m2) {
                        continue;
                    }
                    let k = [mx, my, mz].map(|m| TAU * m as f64);
                    // E(k) is spread over a sphere, and a velocity is k times its potential.
                    let std = math::powf(m2.sqrt(), (-5.0 / 3.0 - 4.0) / 2.0);
                    let a: [[f64; 2]; 3] = std::array::from_fn(|_| [std * rng.normal(), std * rng.normal()]);
                    let at = (wrapped(mx) * NODES + wrapped(my)) * NODES + wrapped(mz);
                    for c in 0..3 {
                        let (p, q) = ((c + 1) % 3, (c + 2) % 3);
                        let curl = |part: usize| k[p] * a[q][part] - k[q] * a[p][part];
                        // i times (r, s) is (−s, r).
                        for (part, curl) in [-curl(1), curl(0)].into_iter().enumerate() {
                            velocity[at][part][c] = curl;
                            potential[at][part][c] = a[c][part];
                        }
                    }
                }
            }
        }
        summed(&mut velocity);
        summed(&mut potential);
        let of_one = |c: usize| velocity.iter().map(move |v| v[0][c] * v[0][c]);
        let square: f64 = (0..3).flat_map(of_one).sum();
        let scale = 1.0 / (square / (3 * COUNT) as f64).sqrt();
        let of = |v: &Four| v[0].map(|v| (scale * v) as f32);
        let node = |(v, a): (&Four, &Four)| Node([of(v), of(a)]);
        Self { nodes: velocity.iter().zip(&potential).map(node).collect() }
    }

    /// Velocity and potential at a place in sides of the box.
    ///
    /// # Safety
    /// The machine must have the instructions of `P`.
    #[inline(always)]
    pub(super) unsafe fn interpolate<P: Pair>(&self, q: [f32; 3]) -> ([f32; 3], [f32; 3]) {
        let Cell { near, far, part } = Cell::locate(q);
        // SAFETY: here and below, as the caller promises.
        let mut both = unsafe { P::new(&[0.0; 4], &[0.0; 4]) };
        for (i, wi) in [(near[0], 1.0 - part[0]), (far[0], part[0])] {
            for (j, wj) in [(near[1], 1.0 - part[1]), (far[1], part[1])] {
                let line = (i * NODES + j) * NODES;
                for (k, wk) in [(near[2], 1.0 - part[2]), (far[2], part[2])] {
                    let [v, a] = &self.nodes[line + k].0;
                    // SAFETY: as above.
                    both = both.add(unsafe { P::new(v, a) }.times(wi * wj * wk));
                }
            }
        }
        let three = |q: F32x4| {
            let [x, y, z, _] = q.array();
            [x, y, z]
        };
        let [velocity, potential] = both.apart();
        (three(velocity), three(potential))
    }

    /// Asks the processor for the nodes round a place in sides of the box.
    #[inline(always)]
    pub(super) fn fetch_soon(&self, q: [f32; 3]) {
        let Cell { near, far, .. } = Cell::locate(q);
        for i in [near[0], far[0]] {
            for j in [near[1], far[1]] {
                for k in [near[2], far[2]] {
                    fetch_soon(&self.nodes, (i * NODES + j) * NODES + k);
                }
            }
        }
    }
}

/// The cell of a place: numbers of the nodes before and after it, and its position between them as parts.
struct Cell {
    near: [usize; 3],
    far: [usize; 3],
    part: [f32; 3],
}

impl Cell {
    #[inline(always)]
    fn locate(q: [f32; 3]) -> Self {
        let mut new = Self { near: [0; 3], far: [0; 3], part: [0.0; 3] };
        for (d, q) in q.into_iter().enumerate() {
            let c = q * NODES as f32;
            // The whole number below, without a call.
            let cut = c as i32;
            let below = if cut as f32 > c { cut - 1 } else { cut };
            new.part[d] = c - below as f32;
            new.near[d] = below as usize & (NODES - 1);
            new.far[d] = (new.near[d] + 1) & (NODES - 1);
        }
        new
    }
}

/// Sums a cube of coefficients along its three axes.
fn summed(field: &mut [Four]) {
    let fourier = Fourier::new(NODES);
    let mut line = vec![Four::default(); NODES];
    for stride in [1, NODES, NODES * NODES] {
        for from in (0..field.len()).filter(|n| n / stride % NODES == 0) {
            for (n, v) in line.iter_mut().enumerate() {
                *v = field[from + n * stride];
            }
            // Most lines along the first axes: the waves of an octave are few.
            if line.iter().all(|v| *v == Four::default()) {
                continue;
            }
            fourier.sum(&mut line);
            for (n, v) in line.iter().enumerate() {
                field[from + n * stride] = *v;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(table: &Table, q: [f32; 3]) -> ([f32; 3], [f32; 3]) {
        // SAFETY: a pair that every machine of the target has.
        unsafe { table.interpolate::<[F32x4; 2]>(q) }
    }

    /// At the nodes' centres, where the interpolation is smoothest: the curl of the potential is the velocity, and the
    /// velocity has no divergence. Differences over a cell see 6.4 nodes a wave.
    #[test]
    fn velocity_is_the_curl_of_its_potential() {
        let table = table();
        let h = 0.5 / NODES as f32;
        let (mut wrong, mut gathers, mut slopes) = (0.0_f64, 0.0_f64, 0.0_f64);
        for n in 0..2000_u32 {
            let part = |m: u32| n.wrapping_mul(m) as f32 / u32::MAX as f32;
            let q = [part(0x9e37_79b9), part(0x85eb_ca6b), part(0xc2b2_ae35)];
            let slope = |d: usize| {
                let (mut low, mut high) = (q, q);
                low[d] -= h;
                high[d] += h;
                let ((v0, a0), (v1, a1)) = (at(table, low), at(table, high));
                let per = |a: [f32; 3], b: [f32; 3]| {
                    std::array::from_fn::<f64, 3, _>(|c| f64::from(b[c] - a[c]) / f64::from(2.0 * h))
                };
                (per(v0, v1), per(a0, a1))
            };
            let s = [slope(0), slope(1), slope(2)];
            let v = at(table, q).0;
            for c in 0..3 {
                let (p, r) = ((c + 1) % 3, (c + 2) % 3);
                let curl = s[p].1[r] - s[r].1[p];
                wrong += (curl - f64::from(v[c])).powi(2);
                slopes += s[c].0.iter().map(|g| g * g).sum::<f64>();
            }
            gathers += (s[0].0[0] + s[1].0[1] + s[2].0[2]).powi(2);
        }
        assert!((wrong / 6000.0).sqrt() < 0.2, "{}", (wrong / 6000.0).sqrt());
        assert!((gathers / slopes).sqrt() < 0.05, "{}", (gathers / slopes).sqrt());
    }
}
