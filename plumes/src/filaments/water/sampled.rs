//! Which columns of the flow grid are evaluated: only those around cells with filaments in them.
//!
//! A step reads only the four columns around the cell in which it starts, so the other columns
//! change no filament. Steady water is evaluated once. In blocked water and in a flume, all columns are evaluated.

use crate::filaments::store::bands::Scales;
use crate::flow::grid::FlowGrid;
use world::fields::Flow;

/// The columns that hold the flow of the present period.
#[derive(Clone, Debug)]
pub(crate) struct SampledFlow {
    /// Number of the period in which each column was evaluated, and in which each cell was noted; 0 is never.
    column: Vec<u32>,
    cell: Vec<u32>,
    period: u32,
    /// Cells that were noted and whose columns are not evaluated yet.
    open: Vec<u32>,
    /// What the evaluated columns have in common.
    scales: Scales,
    /// The horizontal diffusivity, if it is the same in all of them.
    pub(crate) even_k_h: Option<f32>,
}

impl SampledFlow {
    pub(crate) fn new(grid: &FlowGrid) -> Self {
        let columns = grid.bed.len();
        Self {
            column: vec![0; columns],
            cell: vec![0; columns],
            period: 0,
            open: Vec::new(),
            scales: Scales::default(),
            even_k_h: None,
        }
    }

    /// Starts a period: the flow of all columns is out of date, and must be evaluated in all of them if `all` says so.
    pub(crate) fn renew(&mut self, grid: &mut FlowGrid, t_s: f64, all: bool) {
        self.period += 1;
        self.open.clear();
        self.scales = Scales::default();
        self.even_k_h = None;
        grid.t_s = t_s;
        if all {
            let [nx, ny, _] = grid.dims;
            (0..nx - 1).for_each(|i| (0..ny - 1).for_each(|j| self.note((i * ny + j) as u32)));
        }
    }

    /// Notes that a filament is in a cell of the grid, named by its lowest column.
    #[inline]
    pub(crate) fn note(&mut self, cell: u32) {
        let noted = &mut self.cell[cell as usize];
        if *noted != self.period {
            *noted = self.period;
            self.open.push(cell);
        }
    }

    /// Number of columns evaluated in the present period.
    #[cfg(test)]
    pub(crate) fn evaluated(&self) -> usize {
        self.column.iter().filter(|c| **c == self.period).count()
    }

    /// Evaluates the flow in the columns of all noted cells. Returns whether any were missing.
    ///
    /// # Panics
    /// If the flow returns NaN.
    pub(crate) fn complete(&mut self, flow: &dyn Flow, grid: &mut FlowGrid, threads: bool) -> bool {
        if self.open.is_empty() {
            return false;
        }
        let ny = grid.dims[1];
        let mut missing = Vec::new();
        for cell in self.open.drain(..) {
            let at = cell as usize;
            for column in [at, at + 1, at + ny, at + ny + 1] {
                if self.column[column] != self.period {
                    self.column[column] = self.period;
                    missing.push(column);
                }
            }
        }
        grid.refresh_columns(flow, &missing, threads);
        for column in &missing {
            self.examine(grid, *column);
        }
        true
    }

    fn examine(&mut self, grid: &FlowGrid, column: usize) {
        let nz = grid.dims[2];
        let s = &mut self.scales;
        for (n, v) in grid.data[column * nz..(column + 1) * nz].iter().enumerate() {
            assert!(
                v.iter().all(|v| v.is_finite()) && v[3] >= 0.0,
                "the flow at {} s gives velocity and vertical diffusivity {v:?} at grid node {}: they must be numbers, the diffusivity >= 0",
                grid.t_s,
                column * nz + n
            );
            let [u, w, _, k_z] = v.map(f64::from);
            s.fastest_m_s = s.fastest_m_s.max((u * u + w * w).sqrt());
            s.k_z_m2_s = s.k_z_m2_s.max(k_z);
        }
        let k_h = grid.k_h[column];
        self.even_k_h = if s.k_h_m2_s == 0.0 && self.even_k_h.is_none() {
            Some(k_h)
        } else {
            self.even_k_h.filter(|even| *even == k_h)
        };
        s.k_h_m2_s = s.k_h_m2_s.max(f64::from(k_h));
    }

    /// The scales of the water in the evaluated columns, with the distance over which it changes, m.
    pub(crate) fn scales(&self, reach_m: f64) -> Scales {
        Scales { reach_m, ..self.scales }
    }
}
