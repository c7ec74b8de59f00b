//! The divergence-free field nearest to a field on a grid, as a stream function of quadratic B-splines.
//!
//! *Source*: projection onto divergence-free fields, Chorin 1968, Math. Comp. 22, 745; B-splines: de Boor 1978,
//! A Practical Guide to Splines; here ψ minimises ∫ |curl ψ − u|² over the rectangle (Galerkin, exact quadrature).
//!
//! *Parameters*: cells and spacing (m) of the rectangle.
//!
//! *Deviations*: Chorin projects with a pressure and keeps the field on the grid, where interpolation brings divergence
//! back. The curl of a spline is continuous and free of divergence at every point, not only at nodes. The solution is
//! written once, without fused multiply-add, and compiled for each version of `path`, with the same bits.

use nalgebra::Vector2;

use crate::flow::number::Number;
use crate::simd::dispatch::InstructionSet;

/// Projector for one rectangle of `cells` of size `h`.
#[derive(Clone, Debug)]
pub(crate) struct Solenoidal {
    cells: [usize; 2],
    h: [f64; 2],
    // Lower Cholesky factor of the normal equations, by rows of `band + 1`.
    factor: Vec<f64>,
    // The same below its diagonal, by columns of `band`.
    below: Vec<f64>,
    band: usize,
    // The contribution of each corner of a cell to each spline in it, for x and y.
    shares: [[[f64; 2]; 4]; 9],
    path: InstructionSet,
}

/// The three splines that are not zero in a cell, or their slopes per cell, at t in [0, 1].
fn splines<N: Number>(t: N) -> ([N; 3], [N; 3]) {
    let one = N::from(1.0);
    let r = one - t;
    ([r * 0.5 * r, t * r + 0.5, t * 0.5 * t], [-r, one - t * 2.0, t])
}

/// Integral over a cell of unit length by three Gauss points, exact to the fifth degree.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    let d = 0.5 * 0.6_f64.sqrt();
    (5.0 * f(0.5 - d) + 8.0 * f(0.5) + 5.0 * f(0.5 + d)) / 18.0
}

/// The contribution of each corner of a cell of size `h` to each spline in it, for x and y.
fn shares(h: [f64; 2]) -> [[[f64; 2]; 4]; 9] {
    let hat = |t: f64, i: usize| if i == 0 { 1.0 - t } else { t };
    let mut value = [[0.0; 2]; 3];
    let mut slope = [[0.0; 2]; 3];
    for a in 0..3 {
        for i in 0..2 {
            value[a][i] = integral(|t| splines(t).0[a] * hat(t, i));
            slope[a][i] = integral(|t| splines(t).1[a] * hat(t, i));
        }
    }
    let mut shares = [[[0.0; 2]; 4]; 9];
    for (l, share) in shares.iter_mut().enumerate() {
        let a = [l / 3, l % 3];
        for (corner, share) in share.iter_mut().enumerate() {
            let (p, q) = (corner / 2, corner % 2);
            *share = [h[0] * value[a[0]][p] * slope[a[1]][q], h[1] * slope[a[0]][p] * value[a[1]][q]];
        }
    }
    shares
}

impl Solenoidal {
    pub(crate) fn new(cells: [usize; 2], h: [f64; 2]) -> Self {
        let inner = cells[1] + 2;
        let n = (cells[0] + 2) * inner;
        let band = 2 * inner + 2;
        let mut this = Self {
            cells,
            h,
            factor: vec![0.0; n * (band + 1)],
            below: vec![0.0; n * band],
            band,
            shares: shares(h),
            path: InstructionSet::detect(),
        };
        let mut mass = [[0.0; 3]; 3];
        let mut stiff = [[0.0; 3]; 3];
        for a in 0..3 {
            for b in 0..3 {
                mass[a][b] = integral(|t| splines(t).0[a] * splines(t).0[b]);
                stiff[a][b] = integral(|t| splines(t).1[a] * splines(t).1[b]);
            }
        }
        let aspect = h[1] / h[0];
        for cell in 0..cells[0] * cells[1] {
            for (r, a) in this.alive(cell) {
                for (c, b) in this.alive(cell) {
                    if c <= r {
                        let e = stiff[a[0]][b[0]] * mass[a[1]][b[1]] * aspect
                            + mass[a[0]][b[0]] * stiff[a[1]][b[1]] / aspect;
                        this.factor[r * (band + 1) + band + c - r] += e;
                    }
                }
            }
        }
        // A stream function is defined up to a constant; this weight makes its first coefficient zero and changes no
        // flow.
        this.factor[band] += 1.0;
        this.factorise(n);
        this
    }

    /// (index, local place) of the nine splines that are not zero in a cell.
    fn alive(&self, cell: usize) -> impl Iterator<Item = (usize, [usize; 2])> + use<> {
        let my = self.cells[1];
        let (i, j) = (cell / my, cell % my);
        (0..9).map(move |l| {
            let a = [l / 3, l % 3];
            ((i + a[0]) * (my + 2) + j + a[1], a)
        })
    }

    fn factorise(&mut self, n: usize) {
        let (w, row) = (self.band, self.band + 1);
        for i in 0..n {
            for j in i.saturating_sub(w)..=i {
                let from = i.saturating_sub(w);
                let (ri, rj) = (i * row + w - i, j * row + w - j);
                let dot: f64 = (self.factor[ri + from..ri + j].iter())
                    .zip(&self.factor[rj + from..rj + j])
                    .map(|(a, b)| a * b)
                    .sum();
                let left = self.factor[ri + j] - dot;
                self.factor[ri + j] = if i == j { left.sqrt() } else { left / self.factor[rj + j] };
                if i != j {
                    self.below[j * w + i - j - 1] = self.factor[ri + j];
                }
            }
        }
    }

    /// Coefficients of the stream function of the field nearest to `u` at the nodes (index i·(my + 1) + j).
    pub(crate) fn project(&self, u: &[Vector2<f64>]) -> Vec<f64> {
        self.path.run(
            #[inline(always)]
            || self.solved(u),
        )
    }

    #[inline(always)]
    fn solved(&self, u: &[Vector2<f64>]) -> Vec<f64> {
        let mut c = self.sums(u);
        let n = c.len();
        let (w, row) = (self.band, self.band + 1);
        // What the coefficients so far take from those to come. Column by column, each sum has the order of a row, and
        // the processor works on several at once.
        let mut taken = vec![-0.0; n + w];
        for i in 0..n {
            let known = (c[i] - taken[i]) / self.factor[i * row + w];
            c[i] = known;
            let below = &self.below[i * w..(i + 1) * w];
            for (taken, l) in taken[i + 1..i + 1 + w].iter_mut().zip(below) {
                *taken += l * known;
            }
        }
        for i in (0..n).rev() {
            let from = i.saturating_sub(w);
            let l = &self.factor[i * row + w - (i - from)..=i * row + w];
            c[i] /= l[i - from];
            let done = c[i];
            for (c, l) in c[from..i].iter_mut().zip(l) {
                *c -= l * done;
            }
        }
        c
    }

    /// Right-hand side of the normal equations. Each sum takes the cells round it in their order, though the
    /// processor works on several sums at once.
    #[inline(always)]
    fn sums(&self, u: &[Vector2<f64>]) -> Vec<f64> {
        let [mx, my] = self.cells;
        let (x, y): (Vec<f64>, Vec<f64>) = u.iter().map(|v| (v.x, v.y)).unzip();
        let mut c = vec![0.0; (mx + 2) * (my + 2)];
        for i in 0..mx {
            // The nodes of a row of cells: at their first and their last edge, from either corner on.
            let from = [0, 1].map(|p| (i + p) * (my + 1));
            let corners = from.map(|at| [0, 1].map(|q| at + q..at + q + my));
            let corners = corners.as_flattened();
            let x: [&[f64]; 4] = std::array::from_fn(|k| &x[corners[k].clone()]);
            let y: [&[f64]; 4] = std::array::from_fn(|k| &y[corners[k].clone()]);
            for (a, shares) in self.shares.chunks_exact(3).enumerate() {
                // A later cell holds an earlier spline of the same number.
                for (b, share) in shares.iter().enumerate().rev() {
                    let first = (i + a) * (my + 2) + b;
                    for (j, c) in c[first..first + my].iter_mut().enumerate() {
                        for k in 0..4 {
                            *c += share[k][0] * x[k][j] - share[k][1] * y[k][j];
                        }
                    }
                }
            }
        }
        c
    }

    /// Velocity at a place (m from the rectangle's corner), interpolated between two sets of coefficients at part `f`.
    #[inline]
    pub(crate) fn velocity<N: Number>(&self, p: Vector2<N>, c: [&[f64]; 2], f: N) -> Vector2<N> {
        let zero = N::from(0.0);
        let place = |d: usize| {
            let s = (p[d] / self.h[d]).within(zero, N::from(self.cells[d] as f64));
            let i = (s.value() as usize).min(self.cells[d] - 1);
            (i, s - i as f64)
        };
        let ((i, s), (j, t)) = (place(0), place(1));
        let ((bx, dx), (by, dy)) = (splines(s), splines(t));
        let mut u = Vector2::new(zero, zero);
        for a in 0..3 {
            let at = (i + a) * (self.cells[1] + 2) + j;
            let (c0, c1) = (&c[0][at..at + 3], &c[1][at..at + 3]);
            let (mut value, mut slope) = (zero, zero);
            for b in 0..3 {
                let k = f * (c1[b] - c0[b]) + c0[b];
                value += k * by[b];
                slope += k * dy[b];
            }
            u.x += bx[a] * slope;
            u.y -= dx[a] * value;
        }
        Vector2::new(u.x / self.h[1], u.y / self.h[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(cells: [usize; 2], h: [f64; 2], f: impl Fn(f64, f64) -> [f64; 2]) -> Vec<Vector2<f64>> {
        let n = (cells[0] + 1) * (cells[1] + 1);
        (0..n)
            .map(|k| {
                let (i, j) = (k / (cells[1] + 1), k % (cells[1] + 1));
                Vector2::from(f(i as f64 * h[0], j as f64 * h[1]))
            })
            .collect()
    }

    /// Shear, rotation, strain and uniform flow pass unchanged.
    #[test]
    fn keeps_what_is_free_of_divergence() {
        let (cells, h) = ([6, 4], [2.0, 3.0]);
        let s = Solenoidal::new(cells, h);
        let field = |x: f64, y: f64| [1.0 + 0.2 * y - 0.1 * x, 0.1 * y + 0.3 * x];
        let kept = s.project(&nodes(cells, h, field));
        for (x, y) in [(0.0, 0.0), (5.3, 7.7), (12.0, 12.0), (11.0, 0.4)] {
            let p = Vector2::new(x, y);
            let want = Vector2::from(field(x, y));
            assert!((s.velocity(p, [&kept, &kept], 0.5) - want).norm() < 1e-9);
        }
    }

    /// The gradient of a bump that is zero on the edges is orthogonal to every divergence-free field. Only the error of
    /// putting it on the grid is left, h²/12 of its second derivative (π/12)²: 0.1 %.
    #[test]
    fn takes_out_pure_convergence() {
        let (cells, h) = ([24, 24], [0.5, 0.5]);
        let s = Solenoidal::new(cells, h);
        let k = std::f64::consts::PI / 12.0;
        let slope = |x: f64, y: f64| {
            let ((sx, cx), (sy, cy)) = (world::math::sin_cos(k * x), world::math::sin_cos(k * y));
            [cx * sy, sx * cy]
        };
        let gone = s.project(&nodes(cells, h, slope));
        for (x, y) in [(0.1, 5.9), (5.3, 7.7), (12.0, 6.0), (11.0, 0.4)] {
            let left = s.velocity(Vector2::new(x, y), [&gone, &gone], 0.0);
            assert!(left.norm() < 5e-3, "{left}");
        }
    }

    /// The sums cell by cell.
    fn cell_by_cell(s: &Solenoidal, u: &[Vector2<f64>]) -> Vec<f64> {
        let [mx, my] = s.cells;
        let mut c = vec![0.0; (mx + 2) * (my + 2)];
        for (i, j) in (0..mx).flat_map(|i| (0..my).map(move |j| (i, j))) {
            let at = i * (my + 1) + j;
            let corners = [u[at], u[at + 1], u[at + my + 1], u[at + my + 2]];
            for (l, shares) in s.shares.iter().enumerate() {
                let c = &mut c[(i + l / 3) * (my + 2) + j + l % 3];
                for (node, share) in corners.iter().zip(shares) {
                    *c += share[0] * node.x - share[1] * node.y;
                }
            }
        }
        c
    }

    /// In every version, the coefficients are those of sums cell by cell and substitution row by row, to the last bit.
    #[test]
    fn all_versions_give_the_bits_of_rows() {
        for cells in [[2, 2], [9, 7], [20, 6]] {
            let mut rng = world::seeds::Stream::new(4, "test", "field");
            let nodes = (cells[0] + 1) * (cells[1] + 1);
            let field: Vec<_> = (0..nodes).map(|_| Vector2::new(rng.normal(), rng.normal())).collect();
            let mut s = Solenoidal::new(cells, [10.0, 12.0]);
            let (w, row) = (s.band, s.band + 1);
            let mut rows = cell_by_cell(&s, &field);
            for i in 0..rows.len() {
                let from = i.saturating_sub(w);
                let l = &s.factor[i * row + w - (i - from)..=i * row + w];
                let dot: f64 = l.iter().zip(&rows[from..i]).map(|(a, b)| a * b).sum();
                rows[i] = (rows[i] - dot) / l[i - from];
            }
            for i in (0..rows.len()).rev() {
                let from = i.saturating_sub(w);
                let l = &s.factor[i * row + w - (i - from)..=i * row + w];
                rows[i] /= l[i - from];
                let done = rows[i];
                for (c, l) in rows[from..i].iter_mut().zip(l) {
                    *c -= l * done;
                }
            }
            let bits = |all: &[f64]| all.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            for path in InstructionSet::all() {
                s.path = path;
                assert_eq!(bits(&s.project(&field)), bits(&rows), "{cells:?} {path:?}");
            }
        }
    }

    /// Any field becomes free of divergence at every point, and never has more energy than before.
    #[test]
    fn result_is_free_of_divergence_everywhere() {
        let (cells, h) = ([9, 7], [10.0, 12.0]);
        let mut rng = world::seeds::Stream::new(3, "test", "field");
        let field: Vec<_> = (0..80).map(|_| Vector2::new(rng.normal(), rng.normal())).collect();
        let s = Solenoidal::new(cells, h);
        let c = s.project(&field);
        let mut strongest: f64 = 0.0;
        for k in 0..500 {
            let p = Vector2::new(90.0 * rng.uniform(), 84.0 * rng.uniform());
            let at = |dx: f64, dy: f64| s.velocity(p + Vector2::new(dx, dy), [&c, &c], 0.0);
            let e = 1e-4;
            let (ux, vy) = (at(e, 0.0).x - at(-e, 0.0).x, at(0.0, e).y - at(0.0, -e).y);
            // Rounding of a difference over 2e-4 m of velocities of order 1: 1e-11 in all, gradients of order 0.1.
            assert!(((ux + vy) / (2.0 * e)).abs() < 1e-7, "{k}");
            strongest = strongest.max(ux.abs() / (2.0 * e));
        }
        assert!(strongest > 0.01, "a flow is left: {strongest}");
    }
}
