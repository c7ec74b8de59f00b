//! Products and sums over releases, each a product of one factor per axis: this makes a map fast.
//!
//! *Source*: Wang & Pang, eq. 2, with the two exponentials of eq. 1 tabulated separately: (nx + ny + nz) values per
//! release instead of nx·ny·nz.
//!
//! *Parameters*: none.
//!
//! *Deviations*: p of eq. 1 is a density times a cell's area and exceeds 1 for young releases in narrow plumes; it is
//! limited to 1. A product is held at 1e-280 at least. Factors below 1e-13 are left out.

/// Least value of a product.
pub(in crate::map) const LEAST: f64 = 1e-280;
/// Chances below this are taken as zero.
const NEGLIGIBLE: f64 = 1e-13;

/// One release, or a set of 2^log2 alike.
#[derive(Clone, Copy, Debug)]
struct Term {
    log2: u32,
    /// Cells it reaches along each axis.
    reach: [(usize, usize); 3],
    /// Largest factor along the first axis.
    peak: f64,
    /// Whether its chance may exceed 1.
    clamp: bool,
}

/// Terms over a grid.
#[derive(Clone, Debug)]
pub(in crate::map) struct Terms {
    n: [usize; 3],
    terms: Vec<Term>,
    tables: [Vec<f64>; 3],
}

impl Terms {
    /// No term yet.
    pub(in crate::map) fn new(n: [usize; 3]) -> Self {
        Self { n, terms: Vec::new(), tables: [const { Vec::new() }; 3] }
    }

    /// Forgets all terms, but keeps the memory.
    pub(in crate::map) fn clear(&mut self) {
        self.terms.clear();
        for table in &mut self.tables {
            table.clear();
        }
    }

    /// Adds a term; `fill` writes the factors along an axis into a row of zeros and returns which cells it reaches.
    pub(in crate::map) fn add(&mut self, log2: u32, mut fill: impl FnMut(usize, &mut [f64]) -> (usize, usize)) {
        let mut reach = [(0, 0); 3];
        let mut peaks = [0.0; 3];
        for axis in 0..3 {
            let table = &mut self.tables[axis];
            let from = table.len();
            table.resize(from + self.n[axis], 0.0);
            let row = &mut table[from..];
            reach[axis] = fill(axis, row);
            peaks[axis] = row.iter().fold(0.0, |m: f64, v| m.max(*v));
        }
        if reach.iter().any(|(lo, hi)| lo >= hi) || peaks.iter().product::<f64>() < NEGLIGIBLE {
            for (table, n) in self.tables.iter_mut().zip(self.n) {
                table.truncate(table.len() - n);
            }
            return;
        }
        self.terms.push(Term { log2, reach, peak: peaks[0], clamp: peaks.iter().product::<f64>() > 1.0 });
    }

    /// γ = Π (1 − μ p)^m for each cell.
    pub(in crate::map) fn product(&self, mu: f64, out: &mut [f64]) {
        self.rows(out, 1.0, |row, x, c, term| {
            if term.clamp {
                for (g, e) in row.iter_mut().zip(x) {
                    let f = power(1.0 - mu * (c * e).min(1.0), term.log2);
                    *g = (*g * f).max(LEAST);
                }
            } else {
                let c = mu * c;
                match term.log2 {
                    0 => multiply::<0>(row, x, c),
                    1 => multiply::<1>(row, x, c),
                    2 => multiply::<2>(row, x, c),
                    3 => multiply::<3>(row, x, c),
                    4 => multiply::<4>(row, x, c),
                    5 => multiply::<5>(row, x, c),
                    _ => multiply::<6>(row, x, c),
                }
            }
        });
        for g in out {
            *g = g.max(LEAST);
        }
    }

    /// Σ m p for each cell.
    pub(super) fn sum(&self, out: &mut [f64]) {
        self.rows(out, 0.0, |row, x, c, term| {
            let m = f64::from(1_u32 << term.log2);
            for (s, e) in row.iter_mut().zip(x) {
                *s += m * (c * e).min(1.0);
            }
        });
    }

    /// Works row by row, so that a row stays in the nearest cache while all terms pass over it.
    fn rows(&self, out: &mut [f64], start: f64, each: impl Fn(&mut [f64], &[f64], f64, &Term)) {
        let [nx, ny, _] = self.n;
        for (index, row) in out.chunks_exact_mut(nx).enumerate() {
            row.fill(start);
            let (j, k) = (index % ny, index / ny);
            for (t, term) in self.terms.iter().enumerate() {
                let [(i0, i1), (j0, j1), (k0, k1)] = term.reach;
                if j < j0 || j >= j1 || k < k0 || k >= k1 {
                    continue;
                }
                let c = self.tables[1][t * ny + j] * self.tables[2][t * self.n[2] + k];
                if c * term.peak < NEGLIGIBLE {
                    continue;
                }
                each(&mut row[i0..i1], &self.tables[0][t * nx + i0..t * nx + i1], c, term);
            }
        }
    }
}

fn power(mut f: f64, log2: u32) -> f64 {
    for _ in 0..log2 {
        f *= f;
    }
    f
}

#[inline]
fn multiply<const LOG2: u32>(row: &mut [f64], x: &[f64], c: f64) {
    for (g, e) in row.iter_mut().zip(x) {
        let mut f = 1.0 - c * e;
        for _ in 0..LOG2 {
            f *= f;
        }
        *g *= f;
    }
}
