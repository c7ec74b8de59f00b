//! One multigrid cycle: a cheap, symmetric approximation to the inverse of a Poisson operator on bed-following cells.
//!
//! *Source*: Trottenberg, Oosterlee and Schüller 2001, Multigrid, sections 5.1 and 5.2 (line relaxation and
//! semi-coarsening where one direction couples strongest), 2.8.4 (cell-centred grids).
//!
//! *Parameters*: none; one sweep before and one after each coarse correction, coarsened until 4 columns per side are
//! left.
//!
//! *Deviations*: columns are solved exactly, because the water is shallow and the cells are flat, so the vertical
//! coupling is the strongest. They are solved in two colours, in reverse order on the way up, so that the cycle is
//! symmetric. Columns are merged in pairs, levels never. Coarse conductances are the sums of the fine ones over the
//! merged faces, halved for the doubled distance. f64, one thread.

/// A symmetric operator of seven points: (A x)_c = diag x_c − Σ coupling x_neighbour.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub(super) n: [usize; 3],
    /// Coupling of a cell to the next one along, across and upwards.
    pub(super) next: [Vec<f64>; 3],
    /// Coupling to the fixed zero beyond the sides.
    pub(super) edge: Vec<f64>,
    pub(super) diag: Vec<f64>,
    // Reciprocal pivots of the columns.
    pivot: Vec<f64>,
}

impl Level {
    /// Builds a level from couplings; cells without couplings get the diagonal 1.
    pub(super) fn new(n: [usize; 3], next: [Vec<f64>; 3], edge: Vec<f64>) -> Self {
        let mut diag = edge.clone();
        let [_, ny, nz] = n;
        for (d, stride) in [ny * nz, nz, 1].into_iter().enumerate() {
            for (c, a) in next[d].iter().enumerate().filter(|(_, a)| **a != 0.0) {
                diag[c] += a;
                diag[c + stride] += a;
            }
        }
        for d in diag.iter_mut().filter(|d| **d == 0.0) {
            *d = 1.0;
        }
        let mut pivot = vec![0.0; diag.len()];
        for c in 0..diag.len() {
            let below = if c % nz == 0 { 0.0 } else { next[2][c - 1] * next[2][c - 1] * pivot[c - 1] };
            pivot[c] = 1.0 / (diag[c] - below);
        }
        Self { n, next, edge, diag, pivot }
    }

    /// Merges columns in pairs in the directions with more than 3.
    fn coarser(&self) -> Option<Self> {
        let [nx, ny, nz] = self.n;
        let by = [nx, ny].map(|n| if n > 3 { 2 } else { 1 });
        if by == [1, 1] {
            return None;
        }
        let m = [nx.div_ceil(by[0]), ny.div_ceil(by[1]), nz];
        let empty = vec![0.0; m[0] * m[1] * nz];
        let mut next = [empty.clone(), empty.clone(), empty.clone()];
        let mut edge = empty;
        let part = by.map(|b| 1.0 / b as f64);
        for i in 0..nx {
            for j in 0..ny {
                let fine = (i * ny + j) * nz;
                let coarse = (i / by[0] * m[1] + j / by[1]) * nz;
                let ends = [i % by[0] + 1 == by[0], j % by[1] + 1 == by[1]];
                for k in 0..nz {
                    for d in 0..2 {
                        if ends[d] {
                            next[d][coarse + k] += self.next[d][fine + k] * part[d];
                        }
                    }
                    next[2][coarse + k] += self.next[2][fine + k];
                    edge[coarse + k] += self.edge[fine + k] * part[0].min(part[1]);
                }
            }
        }
        Some(Self::new(m, next, edge))
    }

    /// rhs + Σ lateral couplings · x, for one column.
    #[inline]
    fn lateral(&self, i: usize, j: usize, x: &[f64], rhs: &mut [f64]) {
        let [nx, ny, nz] = self.n;
        let at = (i * ny + j) * nz;
        let mut add = |a: &[f64], from: usize| {
            for ((r, a), x) in rhs.iter_mut().zip(a).zip(&x[from..from + nz]) {
                *r += a * x;
            }
        };
        if i > 0 {
            add(&self.next[0][at - ny * nz..], at - ny * nz);
        }
        if i + 1 < nx {
            add(&self.next[0][at..], at + ny * nz);
        }
        if j > 0 {
            add(&self.next[1][at - nz..], at - nz);
        }
        if j + 1 < ny {
            add(&self.next[1][at..], at + nz);
        }
    }

    /// rhs + Σ couplings · x, for one column.
    #[inline]
    fn coupled(&self, i: usize, j: usize, x: &[f64], rhs: &mut [f64]) {
        self.lateral(i, j, x, rhs);
        let [_, ny, nz] = self.n;
        let at = (i * ny + j) * nz;
        let up = &self.next[2][at..at + nz];
        for k in 1..nz {
            rhs[k] += up[k - 1] * x[at + k - 1];
            rhs[k - 1] += up[k - 1] * x[at + k];
        }
    }

    /// Solves every column of one colour exactly, with its neighbours fixed.
    fn relax(&self, colour: usize, b: &[f64], x: &mut [f64], line: &mut [f64]) {
        let [nx, ny, nz] = self.n;
        for i in 0..nx {
            for j in ((i + colour) % 2..ny).step_by(2) {
                let at = (i * ny + j) * nz;
                line.copy_from_slice(&b[at..at + nz]);
                self.lateral(i, j, x, line);
                let (up, pivot) = (&self.next[2][at..at + nz], &self.pivot[at..at + nz]);
                line[0] *= pivot[0];
                for k in 1..nz {
                    line[k] = (line[k] + up[k - 1] * line[k - 1]) * pivot[k];
                }
                x[at + nz - 1] = line[nz - 1];
                for k in (0..nz - 1).rev() {
                    x[at + k] = line[k] + up[k] * pivot[k] * x[at + k + 1];
                }
            }
        }
    }

    /// `out = A x`.
    pub(super) fn apply(&self, x: &[f64], out: &mut [f64]) {
        let [nx, ny, nz] = self.n;
        for i in 0..nx {
            for j in 0..ny {
                let at = (i * ny + j) * nz;
                let line = &mut out[at..at + nz];
                line.fill(0.0);
                self.coupled(i, j, x, line);
                for (k, r) in line.iter_mut().enumerate() {
                    *r = self.diag[at + k] * x[at + k] - *r;
                }
            }
        }
    }
}

/// The operator on levels with fewer and fewer columns.
#[derive(Clone, Debug)]
pub(super) struct Multigrid {
    levels: Vec<Level>,
}

/// Memory for a cycle: right-hand side and result of the coarser levels.
pub(super) struct Scratch {
    sides: Vec<(Vec<f64>, Vec<f64>)>,
    line: Vec<f64>,
}

/// Sweeps on the coarsest level; they almost solve its few columns.
const LAST_SWEEPS: usize = 8;

impl Multigrid {
    pub(super) fn new(finest: Level) -> Self {
        let mut levels = vec![finest];
        while let Some(next) = levels[levels.len() - 1].coarser() {
            levels.push(next);
        }
        Self { levels }
    }

    pub(super) fn finest(&self) -> &Level {
        &self.levels[0]
    }

    pub(super) fn scratch(&self) -> Scratch {
        let empty = |l: &Level| vec![0.0; l.diag.len()];
        Scratch {
            sides: self.levels[1..].iter().map(|l| (empty(l), empty(l))).collect(),
            line: vec![0.0; self.levels[0].n[2]],
        }
    }

    /// `x` approximates A⁻¹ b; it is linear and symmetric in b.
    pub(super) fn cycle(&self, b: &[f64], x: &mut [f64], scratch: &mut Scratch) {
        let Scratch { sides, line } = scratch;
        descend(&self.levels, b, x, sides, line);
    }
}

fn descend(levels: &[Level], b: &[f64], x: &mut [f64], sides: &mut [(Vec<f64>, Vec<f64>)], line: &mut [f64]) {
    let level = &levels[0];
    x.fill(0.0);
    let Some(((coarse_b, coarse_x), rest)) = sides.split_first_mut() else {
        for _ in 0..LAST_SWEEPS {
            for colour in [0, 1, 1, 0] {
                level.relax(colour, b, x, line);
            }
        }
        return;
    };
    level.relax(0, b, x, line);
    level.relax(1, b, x, line);
    let (n, m) = (level.n, levels[1].n);
    let by = [0, 1].map(|d| if n[d] > 3 { 2 } else { 1 });
    let column = |i: usize, j: usize| {
        let fine = (i * n[1] + j) * n[2];
        (fine, (i / by[0] * m[1] + j / by[1]) * n[2])
    };
    coarse_b.fill(0.0);
    for i in 0..n[0] {
        // The columns of the second colour have just been solved, so no residual is left in them.
        for j in (i % 2..n[1]).step_by(2) {
            let (fine, coarse) = column(i, j);
            line.copy_from_slice(&b[fine..fine + n[2]]);
            level.coupled(i, j, x, line);
            for k in 0..n[2] {
                coarse_b[coarse + k] += line[k] - level.diag[fine + k] * x[fine + k];
            }
        }
    }
    descend(&levels[1..], coarse_b, coarse_x, rest, line);
    for i in 0..n[0] {
        for j in 0..n[1] {
            let (fine, coarse) = column(i, j);
            for k in 0..n[2] {
                x[fine + k] += coarse_x[coarse + k];
            }
        }
    }
    level.relax(1, b, x, line);
    level.relax(0, b, x, line);
}
