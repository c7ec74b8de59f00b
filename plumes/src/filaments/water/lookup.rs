//! The flow grid as the drift reads it: the cell of a point, the level of a height, the bed, and the horizontal
//! diffusivity in a cell.
//!
//! *Source*: the layout and the vertical map are those of `flow::grid`. This file turns them into arithmetic without
//! branches, for many filaments at once.
//!
//! *Parameters*: none.
//!
//! *Deviations*: K_h is bilinear in a cell, written as c0 + c1·f + c2·g + c3·f·g, so that one read returns all.

use crate::filaments::store::folded::clamped;
use crate::flow::grid::{FlowGrid, LogLaw};
use crate::flow::ground::NearGround;

/// Bilinear function in a cell: c0 + c1·f + c2·g + c3·f·g.
pub(crate) type Bilinear = [f32; 4];

/// Scalars of the grid, and its columns as bilinear cells.
#[derive(Clone, Debug)]
pub(crate) struct Lookup {
    origin: [f32; 2],
    /// Axis i and axis j, divided by the spacing: cells per metre.
    axes: [[f32; 2]; 2],
    /// Last node along i and j, as numbers.
    last: [f32; 2],
    dims: [i32; 3],
    stretch: f32,
    /// Height of the lowest level above the bed's, as a part of the depth.
    pub(crate) first_level: f32,
    pub(crate) ground: NearGround,
    /// How the current falls to the bed below the lowest level, if not linearly.
    pub(crate) law: Option<LogLaw>,
    k_h: Vec<Bilinear>,
    /// The horizontal diffusivity, if it is the same everywhere.
    pub(crate) even_k_h: Option<f32>,
}

/// Position of a point among the columns.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Column {
    /// Column of the cell's lower corner, i·ny + j.
    pub(crate) at: u32,
    /// Position in the cell along i and j, as parts of it.
    pub(crate) f: f32,
    pub(crate) g: f32,
    /// Whether the point is outside the grid.
    pub(crate) outside: bool,
}

impl Column {
    /// A position inside the grid.
    #[inline(always)]
    pub(crate) fn inside(at: u32, f: f32, g: f32) -> Self {
        let outside = false;
        Self { at, f, g, outside }
    }
}

/// Position of a height among the levels.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Level {
    /// Level below.
    pub(crate) below: u32,
    /// Position between it and the next, as a part.
    pub(crate) part: f32,
    /// Reciprocal of the distance between the two, 1/m.
    pub(crate) per_m: f32,
}

impl Lookup {
    pub(crate) fn new(grid: &FlowGrid) -> Self {
        let [nx, ny, nz] = grid.dims;
        let per = |axis: [f32; 2], spacing: f32| axis.map(|v| v / spacing);
        Self {
            origin: grid.origin,
            axes: [per(grid.along, grid.spacing[0]), per(grid.across, grid.spacing[1])],
            last: [(nx - 1) as f32, (ny - 1) as f32],
            dims: [nx as i32, ny as i32, nz as i32],
            stretch: grid.stretch,
            first_level: grid.levels[1],
            ground: grid.near,
            law: grid.law,
            k_h: bilinear(&grid.k_h, nx, ny),
            even_k_h: None,
        }
    }

    /// Takes over the values that a refresh of the grid has changed; `even_k_h` is the horizontal diffusivity if it is
    /// the same in all columns that are used.
    pub(crate) fn refresh(&mut self, grid: &FlowGrid, even_k_h: Option<f32>) {
        self.even_k_h = even_k_h;
        self.law = grid.law;
        if self.even_k_h.is_none() {
            self.k_h = bilinear(&grid.k_h, grid.dims[0], grid.dims[1]);
        }
    }

    /// Nodes in a column, and nodes from one column to the next along i.
    #[inline(always)]
    pub(crate) fn strides(&self) -> (usize, usize) {
        let nz = self.dims[2] as usize;
        (nz, nz * self.dims[1] as usize)
    }

    /// The column cell of a point; for a point outside the grid, that of the nearest edge.
    #[inline(always)]
    pub(crate) fn column(&self, x: f32, y: f32) -> Column {
        let (dx, dy) = (x - self.origin[0], y - self.origin[1]);
        let c = dx * self.axes[0][0] + dy * self.axes[0][1];
        let d = dx * self.axes[1][0] + dy * self.axes[1][1];
        let (i, f) = split(c, self.last[0], self.dims[0]);
        let (j, g) = split(d, self.last[1], self.dims[1]);
        let inside = (c >= 0.0) & (c <= self.last[0]) & (d >= 0.0) & (d <= self.last[1]);
        Column { at: (i * self.dims[1] + j) as u32, f, g, outside: !inside }
    }

    /// Position of a height among the levels; `up` is the reciprocal of the depth.
    #[inline(always)]
    pub(crate) fn level(&self, z: f32, up: f32) -> Level {
        let s = clamped(1.0 + z * up, 1.0);
        let a = self.stretch;
        let b = 1.0 - a;
        let last = (self.dims[2] - 1) as f32;
        let (k, _) = split(2.0 * s / (b + (b * b + 4.0 * a * s).sqrt()) * last, last, self.dims[2]);
        let h = 1.0 / last;
        let xi = k as f32 * h;
        let s0 = xi * (b + a * xi);
        let per = 1.0 / (h * (b + a * (2.0 * xi + h)));
        // Rounding of the square root may give the neighbouring level; the clamp keeps the result continuous.
        Level { below: k as u32, part: clamped((s - s0) * per, 1.0), per_m: per * up }
    }

    /// Height of the bed, m (negative).
    #[inline(always)]
    pub(crate) fn bed(&self, x: f32, y: f32) -> f32 {
        self.ground.z(x, y)
    }

    /// Horizontal diffusivity (m²/s) and its gradient east and north (m/s).
    #[inline(always)]
    pub(crate) fn k_h(&self, c: Column) -> (f32, [f32; 2]) {
        let q = &self.k_h[c.at as usize];
        let (di, dj) = (q[1] + q[3] * c.g, q[2] + q[3] * c.f);
        let along = |d: usize| di * self.axes[0][d] + dj * self.axes[1][d];
        (value(q, c), [along(0), along(1)])
    }
}

#[inline(always)]
fn value(q: &Bilinear, c: Column) -> f32 {
    q[0] + c.g * q[2] + c.f * (q[1] + c.g * q[3])
}

/// Cell index in 0..n−1, and the position in the cell as a part of it.
#[inline(always)]
fn split(c: f32, last: f32, n: i32) -> (i32, f32) {
    let c = clamped(c, last);
    // SAFETY: the value lies between 0 and the number of nodes, which fits; NaN has become 0.
    let i = unsafe { c.to_int_unchecked::<i32>() };
    let i = if i < n - 2 { i } else { n - 2 };
    (i, c - i as f32)
}

fn bilinear(nodes: &[f32], nx: usize, ny: usize) -> Vec<Bilinear> {
    let mut cells = vec![[0.0; 4]; nx * ny];
    for i in 0..nx - 1 {
        for j in 0..ny - 1 {
            let n = |a: usize, b: usize| nodes[(i + a) * ny + j + b];
            cells[i * ny + j] = [n(0, 0), n(1, 0) - n(0, 0), n(0, 1) - n(0, 0), n(1, 1) - n(1, 0) - n(0, 1) + n(0, 0)];
        }
    }
    cells
}
